"""Links and joints of a URDF, in the frame of its root at position 0 of every joint."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import cast
from xml.etree.ElementTree import Element

import numpy as np

from ...arrays import FloatArray, vec3
from ...errors import BadInputError
from ...kinematics import rotation
from ..articulation import Link, LinkJoint, LinkJointKind, ordered
from .xml_files import numbers

_KINDS = {kind: kind for kind in ("revolute", "continuous", "prismatic", "fixed")} | {
    "floating": "free",
    "spherical": "ball",  # of PyBullet
    "planar": "unknown",
}
_WITH_AXIS = ("revolute", "continuous", "prismatic")


@dataclass(frozen=True, eq=False)
class UrdfTree:
    """What a URDF says without its shapes.

    Attributes:
        links: in the order of the file.
        poses: (L, 4, 4) `world_T_link`: pose of each in the frame of the root.
        notes: what could not be taken over.
    """

    links: tuple[Link, ...]
    poses: FloatArray
    notes: tuple[str, ...]


def read_tree(robot: Element) -> UrdfTree:
    """Read links and joints.

    `<limit>` may lack everything: a joint without positions in it has no limits, and one of the two alone
    leaves the other 0, as the specification has it. The default axis is x. Several roots stand at one place.

    Raises:
        BadInputError: names that are missing, double or unknown, a link with two parents, a loop, an unknown
            kind of joint, or numbers that are none.
    """
    names = _link_names(robot)
    joints = _joints_by_child(robot, names)
    parents = [names[_end(joints[n], "parent", names)] if n in joints else -1 for n in names]
    bare = tuple(Link(name, parent) for name, parent in zip(names, parents, strict=True))
    order = ordered(bare)
    if len(order) < len(bare):
        loop = ", ".join(f"'{bare[i].name}'" for i in sorted(set(range(len(bare))) - set(order)))
        raise BadInputError(f"the links {loop} form a loop of joints")
    world_T_link, links = np.tile(np.eye(4), (len(bare), 1, 1)), list(bare)
    for index in order:
        element = joints.get(bare[index].name)
        if element is not None:
            world_T_link[index] = world_T_link[bare[index].parent] @ origin(element)
            links[index] = replace(bare[index], joint=_joint(element, world_T_link[index]))
    return UrdfTree(tuple(links), world_T_link, tuple(_notes(joints, links)))


def origin(element: Element) -> FloatArray:
    """(4, 4) transform of an element's `<origin>`: `rpy` turns about the fixed x, y and z, in this order."""
    matrix, found = np.eye(4), element.find("origin")
    if found is not None:
        roll, pitch, yaw = numbers(found, "rpy", 3, "0 0 0")
        about_x, about_y = rotation(np.array([roll, 0, 0])), rotation(np.array([0, pitch, 0]))
        matrix[:3, :3] = rotation(np.array([0, 0, yaw])) @ about_y @ about_x
        matrix[:3, 3] = numbers(found, "xyz", 3, "0 0 0")
    return matrix


def _link_names(robot: Element) -> dict[str, int]:
    names = [element.get("name", "") for element in robot.findall("link")]
    if not names:
        raise BadInputError("it has no <link>")
    if "" in names:
        raise BadInputError("a <link> has no name")
    if len(set(names)) < len(names):
        raise BadInputError(f"two links are named '{next(n for n in names if names.count(n) > 1)}'")
    return {name: index for index, name in enumerate(names)}


def _joints_by_child(robot: Element, names: Mapping[str, int]) -> dict[str, Element]:
    found: dict[str, Element] = {}
    for element in robot.findall("joint"):
        child = _end(element, "child", names)
        if child in found:
            raise BadInputError(f"link '{child}' has two parents: {_named(found[child])}, {_named(element)}")
        found[child] = element
    return found


def _end(joint: Element, tag: str, names: Mapping[str, int]) -> str:
    found = joint.find(tag)
    name = "" if found is None else found.get("link", "")
    if name not in names:
        raise BadInputError(f"{_named(joint)}: its {tag} link '{name}' does not exist")
    return name


def _joint(element: Element, world_T_joint: FloatArray) -> LinkJoint:
    kind = element.get("type", "")
    if kind not in _KINDS:
        raise BadInputError(f"{_named(element)}: type '{kind}' is not one of {', '.join(_KINDS)}")
    point, name = vec3(world_T_joint[:3, 3]), element.get("name", "")
    if kind not in _WITH_AXIS:
        return LinkJoint(cast(LinkJointKind, _KINDS[kind]), None, point, name=name)
    found = element.find("axis")
    axis = np.array([1.0, 0.0, 0.0]) if found is None else numbers(found, "xyz", 3, "1 0 0")
    lower, upper = (None, None) if kind == "continuous" else _limits(element)
    return LinkJoint(cast(LinkJointKind, kind), vec3(world_T_joint[:3, :3] @ axis), point, lower, upper, name)


def _limits(element: Element) -> tuple[float | None, float | None]:
    limit = element.find("limit")
    if limit is None or not {"lower", "upper"} & set(limit.attrib):
        return None, None
    return float(numbers(limit, "lower", 1, "0")[0]), float(numbers(limit, "upper", 1, "0")[0])


def _notes(joints: Mapping[str, Element], links: list[Link]) -> list[str]:
    notes = []
    for link in links:
        element, joint = joints.get(link.name), link.joint
        if element is None:
            continue
        if element.get("type") == "planar":
            notes.append(f"{_named(element)} is planar: read as a movement of unknown kind")
        if element.find("mimic") is not None:
            notes.append(f"{_named(element)} mimics another one: read as a joint of its own")
        if joint.kind in ("revolute", "prismatic") and joint.lower is None:
            notes.append(f"{_named(element)} is {joint.kind} and has no limits")
        elif joint.lower is not None and joint.upper is not None and joint.lower >= joint.upper:
            notes.append(f"{_named(element)} has limits {joint.lower:g} to {joint.upper:g}: no travel")
    return notes


def _named(joint: Element) -> str:
    return f"joint '{joint.get('name', '')}'"
