"""yourdfpy: URDF with all its meshes, through trimesh."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yourdfpy
from verdict import Positions, Reading, inertial, main, rows


def read(path: Path, positions: Positions) -> Reading:
    """What the robot says."""
    robot = yourdfpy.URDF.load(
        str(path), load_collision_meshes=True, build_collision_scene_graph=True, force_collision_mesh=False
    )
    links = robot.robot.links
    joints = {name: robot.joint_map[name] for name in robot.actuated_joint_names}
    written, loaded = sum(len(link.collisions) for link in links), len(robot.collision_scene.geometry)
    return {
        "errors": validated(robot) + lost(written, loaded),
        "poses": [poses(robot, at) for at in positions],
        "inertials": {
            link.name: inertial(link.inertial.mass, link.inertial.origin[:3, 3], rows(link.inertial.inertia))
            for link in links
            if link.inertial
        },
        "limits": {
            name: None if joint.type == "continuous" else [joint.limit.lower, joint.limit.upper]
            for name, joint in joints.items()
        },
        "colliders": {link.name: len(link.collisions) for link in links if link.collisions},
    }


def validated(robot: yourdfpy.URDF) -> list[str]:
    """What yourdfpy's own validation finds."""
    return [] if robot.validate() else [str(error) for error in robot.errors]


def lost(written: int, loaded: int) -> list[str]:
    """Meshes that cannot be read are left out in silence."""
    return [] if written == loaded else [f"{loaded} of {written} collision shapes have a mesh"]


def poses(robot: yourdfpy.URDF, positions: Mapping[str, float]) -> dict[str, Any]:
    """Pose of every link at joint positions."""
    robot.update_cfg({name: positions.get(name, 0.0) for name in robot.actuated_joint_names})
    return {link.name: rows(robot.get_transform(link.name)) for link in robot.robot.links}


if __name__ == "__main__":
    main(read)
