"""urchin: URDF with all its meshes."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from urchin import URDF
from verdict import Positions, Reading, inertial, main, rows


def read(path: Path, positions: Positions) -> Reading:
    """What the robot says."""
    robot = URDF.load(str(path), lazy_load_meshes=False)
    moving = [joint for joint in robot.joints if joint.joint_type != "fixed"]
    return {
        "errors": [],
        "poses": [poses(robot, at) for at in positions],
        "inertials": {
            link.name: inertial(link.inertial.mass, link.inertial.origin[:3, 3], link.inertial.inertia)
            for link in robot.links
        },
        "limits": {
            joint.name: None if joint.joint_type == "continuous" else [joint.limit.lower, joint.limit.upper]
            for joint in moving
        },
        "colliders": {
            link.name: sum(len(shape.geometry.meshes) for shape in link.collisions) for link in robot.links
        },
    }


def poses(robot: URDF, positions: Mapping[str, float]) -> dict[str, Any]:
    """Pose of every link at joint positions."""
    return {link.name: rows(pose) for link, pose in robot.link_fk(dict(positions)).items()}


if __name__ == "__main__":
    main(read)
