"""PyBullet: URDF with the inertia of the file."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pybullet
from verdict import Positions, Reading, inertial, main, pose, turn, turned


def read(path: Path, positions: Positions) -> Reading:
    """What the loaded body says; its base is left free, for a fixed one reports a mass of 0."""
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(path), flags=pybullet.URDF_USE_INERTIA_FROM_FILE)
        infos = [pybullet.getJointInfo(body, index) for index in range(pybullet.getNumJoints(body))]
        links = {pybullet.getBodyInfo(body)[0].decode(): -1}
        links |= {info[12].decode(): info[0] for info in infos}
        moving = [info for info in infos if info[2] != pybullet.JOINT_FIXED]
        return {
            "errors": [],
            "poses": [poses(body, infos, links, at) for at in positions],
            "inertials": {name: link_inertial(body, link) for name, link in links.items()},
            "limits": {
                info[1].decode(): [info[8], info[9]] if info[8] <= info[9] else None for info in moving
            },
            "colliders": {
                name: len(pybullet.getCollisionShapeData(body, link)) for name, link in links.items()
            },
        }
    finally:
        pybullet.disconnect(client)


def poses(
    body: int, infos: list[Any], links: Mapping[str, int], positions: Mapping[str, float]
) -> dict[str, Any]:
    """Pose of every link at joint positions."""
    for info in infos:
        pybullet.resetJointState(body, info[0], positions.get(info[1].decode(), 0.0))
    base_T_world = pybullet.invertTransform(*base(body))
    result = {}
    for name, link in links.items():
        state = (
            pybullet.getLinkState(body, link, computeForwardKinematics=True)[4:6] if link >= 0 else base(body)
        )
        position, quaternion = pybullet.multiplyTransforms(*base_T_world, *state)
        result[name] = pose(turn(*quaternion), position)
    return result


def base(body: int) -> Any:
    """Pose of the base link's frame; PyBullet gives that of its centre of mass, and moves the base there."""
    dynamics = pybullet.getDynamicsInfo(body, -1)
    world_T_com = pybullet.getBasePositionAndOrientation(body)
    return pybullet.multiplyTransforms(*world_T_com, *pybullet.invertTransform(dynamics[3], dynamics[4]))


def link_inertial(body: int, link: int) -> dict[str, Any]:
    """Mass properties of a link in its own frame."""
    dynamics = pybullet.getDynamicsInfo(body, link)
    return inertial(dynamics[0], dynamics[3], turned(dynamics[2], turn(*dynamics[4])))


if __name__ == "__main__":
    main(read)
