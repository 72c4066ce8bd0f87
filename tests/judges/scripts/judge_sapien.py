"""SAPIEN: URDF on its CPU simulation. It draws with a GPU only, so visuals are left out."""

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import sapien
from sapien.wrapper.urdf_loader import URDFLoader
from verdict import Positions, Reading, inertial, main, rows, turn, turned


def read(path: Path, positions: Positions) -> Reading:
    """What the articulation says, or the actor where there is one link only."""
    scene = sapien.Scene([sapien.physx.PhysxCpuSystem()])
    loader = URDFLoader()
    loader.set_scene(scene)
    loader.fix_root_link = True
    robots, actors = load(loader, path)
    joints = [joint for robot in robots for joint in robot.get_active_joints()]
    bodies = [link for robot in robots for link in robot.get_links()]
    bodies += [actor.find_component_by_type(sapien.physx.PhysxRigidDynamicComponent) for actor in actors]
    return {
        "errors": [],
        "poses": [poses(robots, bodies, at) for at in positions],
        "inertials": {name_of(body): body_inertial(body) for body in bodies},
        "limits": {joint.name: limits(joint) for joint in joints},
        "colliders": {name_of(body): len(body.get_collision_shapes()) for body in bodies},
    }


def load(loader: URDFLoader, path: Path) -> tuple[list[Any], list[Any]]:
    """Load a copy without visuals, beside the file for its relative paths."""
    tree = ElementTree.parse(path)
    for link in tree.iter("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "meshes").symlink_to(path.parent / "meshes", target_is_directory=True)
        bare = Path(folder) / path.name
        tree.write(bare)
        return loader.load_multiple(str(bare))


def name_of(body: Any) -> str:
    """Name of a link, or of an actor."""
    return body.entity.name if isinstance(body, sapien.physx.PhysxRigidDynamicComponent) else body.name


def poses(robots: list[Any], bodies: list[Any], positions: Mapping[str, float]) -> dict[str, Any]:
    """Pose of every body at joint positions."""
    for robot in robots:
        robot.set_qpos([positions.get(joint.name, 0.0) for joint in robot.get_active_joints()])
    return {name_of(body): rows(body.entity_pose.to_transformation_matrix()) for body in bodies}


def body_inertial(body: Any) -> dict[str, Any]:
    """Mass properties of a body in its own frame."""
    frame = body.cmass_local_pose
    w, x, y, z = rows(frame.q)
    return inertial(body.mass, frame.p, turned(body.inertia, turn(x, y, z, w)))


def limits(joint: Any) -> list[float] | None:
    """Range of a joint, or None where it turns for ever."""
    lower, upper = rows(joint.limits)[0]
    return None if abs(lower) == float("inf") else [lower, upper]


if __name__ == "__main__":
    main(read)
