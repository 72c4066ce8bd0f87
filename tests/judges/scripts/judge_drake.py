"""Drake: URDF by its strict parser, hulls in its scene graph, and physically valid inertias."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, MultibodyPlant
from pydrake.multibody.tree import RigidBody
from pydrake.systems.framework import DiagramBuilder
from verdict import Positions, Reading, inertial, main, rows


def read(path: Path, positions: Positions) -> Reading:
    """What the finalised plant says."""
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, time_step=0.002)
    parser = Parser(plant)
    parser.SetStrictParsing()
    (model,) = parser.AddModels(str(path))
    bodies = [plant.get_body(index) for index in plant.GetBodyIndices(model)]
    joints = [plant.get_joint(index) for index in plant.GetJointIndices(model)]
    children = {joint.child_body().index() for joint in joints}
    (root,) = [body for body in bodies if body.index() not in children]
    plant.WeldFrames(plant.world_frame(), root.body_frame())
    plant.Finalize()
    builder.Build()
    return {
        "errors": [f"{body.name()}: inertia is not physically valid" for body in bodies if not valid(body)],
        "poses": [poses(plant, bodies, at) for at in positions],
        "inertials": {body.name(): link_inertial(body) for body in bodies},
        "limits": {joint.name(): limits(joint) for joint in joints if joint.num_positions()},
        "colliders": {body.name(): len(plant.GetCollisionGeometriesForBody(body)) for body in bodies},
    }


def poses(plant: MultibodyPlant, bodies: list[RigidBody], positions: Mapping[str, float]) -> dict[str, Any]:
    """Pose of every body at joint positions."""
    context = plant.CreateDefaultContext()
    q = plant.GetPositions(context)
    for name, position in positions.items():
        q[plant.GetJointByName(name).position_start()] = position
    plant.SetPositions(context, q)
    return {body.name(): rows(plant.EvalBodyPoseInWorld(context, body).GetAsMatrix4()) for body in bodies}


def valid(body: RigidBody) -> bool:
    """Whether a body of that inertia can be."""
    return body.default_spatial_inertia().IsPhysicallyValid()


def link_inertial(body: RigidBody) -> dict[str, Any]:
    """Mass properties about the centre of mass; Drake keeps them about the body's origin."""
    spatial = body.default_spatial_inertia()
    center = spatial.get_com()
    about_center = spatial.Shift(center).CalcRotationalInertia().CopyToFullMatrix3()
    return inertial(spatial.get_mass(), center, about_center)


def limits(joint: Any) -> list[float] | None:
    """Range of a joint, or None where it turns for ever."""
    lower, upper = joint.position_lower_limits()[0], joint.position_upper_limits()[0]
    return None if lower == -float("inf") and upper == float("inf") else [float(lower), float(upper)]


if __name__ == "__main__":
    main(read)
