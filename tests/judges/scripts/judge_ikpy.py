"""ikpy: the kinematic chain from the root of a URDF to each of its links."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from ikpy.chain import Chain
from verdict import Positions, Reading, main, rows

Joint = tuple[str, str]


def read(path: Path, positions: Positions) -> Reading:
    """What the chains say; ikpy knows kinematics only."""
    joint_to = {
        joint.find("child").get("link"): (joint.get("name"), joint.find("parent").get("link"))
        for joint in ElementTree.parse(path).iter("joint")
    }
    chains = {link: chain_to(path, link, joint_to) for link in joint_to}
    return {"errors": [], "poses": [poses(chains, at) for at in positions]}


def chain_to(path: Path, link: str, joint_to: Mapping[str, Joint]) -> tuple[Chain, int]:
    """A chain through a link, and how many joints lead there.

    Elements up to the link are named, for at a fork ikpy takes the first; behind it ikpy goes on by itself.
    """
    elements = [link]
    while elements[0] in joint_to:
        name, parent = joint_to[elements[0]]
        elements = [parent, name, *elements]
    return Chain.from_urdf_file(str(path), base_elements=elements[:-1]), len(elements) // 2


def poses(chains: Mapping[str, tuple[Chain, int]], positions: Mapping[str, float]) -> dict[str, Any]:
    """Pose of every link at joint positions; the frames of a chain are those behind its joints."""
    result = {}
    for name, (chain, depth) in chains.items():
        values = [positions.get(link.name, 0.0) for link in chain.links]
        result[name] = rows(chain.forward_kinematics(values, full_kinematics=True)[depth])
    return result


if __name__ == "__main__":
    main(read)
