"""What a UsdPhysics stage says, read with pxr alone: masses, joint frames, limits, forward kinematics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdPhysics

from .readings import Array, Inertial

_AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


@dataclass(frozen=True)
class JointFrames:
    """A joint as authored; bodies are prim names, None is the world; limits are in [rad | m]."""

    name: str
    schema: str
    parent: str | None
    child: str
    parent_from_joint: Array
    child_from_joint: Array
    axis: Array
    limits: tuple[float, float] | None
    damping: float

    def motion(self, position: float | Array) -> Array:
        """(4, 4) of the child's joint frame in the parent's; (3,) rotation vector of a spherical joint."""
        result = np.eye(4)
        if self.schema == "PhysicsRevoluteJoint":
            result[:3, :3] = _turn(self.axis * position)
        elif self.schema == "PhysicsSphericalJoint":
            result[:3, :3] = _turn(np.asarray(position))
        elif self.schema == "PhysicsPrismaticJoint":
            result[:3, 3] = self.axis * position
        return result


def open_stage(path: Path) -> Usd.Stage:
    """The stage of a file."""
    return Usd.Stage.Open(str(path))


def read_bodies(stage: Usd.Stage) -> dict[str, Array]:
    """`world_T_body` (4, 4) at rest of every rigid body, by prim name."""
    prims = [prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    return {prim.GetName(): _world(prim) for prim in prims}


def read_inertials(stage: Usd.Stage) -> dict[str, Inertial]:
    """The authored mass properties of every rigid body that has them."""
    result = {}
    for prim in stage.Traverse():
        if prim.HasAPI(UsdPhysics.MassAPI):
            api, world_T_body = UsdPhysics.MassAPI(prim), _world(prim)
            axes = world_T_body[:3, :3] @ _rotation(api.GetPrincipalAxesAttr().Get())
            center = world_T_body @ [*api.GetCenterOfMassAttr().Get(), 1.0]
            inertia = axes @ np.diag(api.GetDiagonalInertiaAttr().Get()) @ axes.T
            result[prim.GetName()] = Inertial(api.GetMassAttr().Get(), center[:3], inertia)
    return result


def read_joints(stage: Usd.Stage) -> dict[str, JointFrames]:
    """Every joint, by prim name."""
    joints = [UsdPhysics.Joint(prim) for prim in stage.Traverse() if prim.IsA(UsdPhysics.Joint)]
    return {joint.GetPrim().GetName(): _read_joint(stage, joint) for joint in joints}


def forward(stage: Usd.Stage, positions: Mapping[str, float | Array]) -> dict[str, Array]:
    """`world_T_body` (4, 4) by name, from the joint frames; bodies that no joint moves stay at rest."""
    joints = read_joints(stage).values()
    moved = {joint.child for joint in joints}
    result = {name: pose for name, pose in read_bodies(stage).items() if name not in moved}
    waiting = list(joints)
    while waiting:
        joint = next(j for j in waiting if j.parent is None or j.parent in result)
        waiting.remove(joint)
        world_T_parent = np.eye(4) if joint.parent is None else result[joint.parent]
        motion = joint.motion(positions.get(joint.name, np.zeros(3) if "Spherical" in joint.schema else 0.0))
        result[joint.child] = (
            world_T_parent @ joint.parent_from_joint @ motion @ np.linalg.inv(joint.child_from_joint)
        )
    return result


def parsed(stage: Usd.Stage) -> dict[str, dict[str, object]]:
    """What OpenUSD's own physics parser finds: descriptors by prim name, by kind such as RigidBody."""
    found = UsdPhysics.UsdPhysicsLoadStageFromPrimRange(stage, ["/"])
    return {
        str(kind).rpartition(".")[2]: {path.name: item for path, item in zip(paths, items, strict=True)}
        for kind, (paths, items) in found.items()
    }


def _read_joint(stage: Usd.Stage, joint: UsdPhysics.Joint) -> JointFrames:
    prim = joint.GetPrim()
    parent, parent_T_end = _end(stage, joint.GetBody0Rel())
    child, child_T_end = _end(stage, joint.GetBody1Rel())
    assert child is not None
    schema = str(prim.GetTypeName())
    angular = schema == "PhysicsRevoluteJoint"
    unit = np.pi / 180 if angular else 1.0
    axis = prim.GetAttribute("physics:axis").Get() or "X"
    lower, upper = (prim.GetAttribute(f"physics:{side}Limit").Get() for side in ("lower", "upper"))
    limited = lower is not None and np.isfinite([lower, upper]).all()
    drive = UsdPhysics.DriveAPI(prim, "angular" if angular else "linear")
    return JointFrames(
        prim.GetName(),
        schema,
        parent,
        child,
        parent_T_end @ _pose(joint.GetLocalPos0Attr().Get(), joint.GetLocalRot0Attr().Get()),
        child_T_end @ _pose(joint.GetLocalPos1Attr().Get(), joint.GetLocalRot1Attr().Get()),
        np.array(_AXES[axis]),
        (lower * unit, upper * unit) if limited else None,
        (drive.GetDampingAttr().Get() or 0.0) / unit if drive else 0.0,
    )


def _end(stage: Usd.Stage, relationship: Usd.Relationship) -> tuple[str | None, Array]:
    """The body at one end of a joint and `body_T_prim` of the prim named; the world is no body."""
    targets = relationship.GetTargets()
    if not targets:
        return None, np.eye(4)
    prim = stage.GetPrimAtPath(targets[0])
    if prim.HasAPI(UsdPhysics.RigidBodyAPI):
        return prim.GetName(), np.eye(4)
    return None, _world(prim)


def _world(prim: Usd.Prim) -> Array:
    # Gf multiplies row vectors.
    return np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(Usd.TimeCode.Default())).T


def _pose(position: Gf.Vec3f, rotation: Gf.Quatf) -> Array:
    result = np.eye(4)
    result[:3, :3] = _rotation(rotation)
    result[:3, 3] = position
    return result


def _rotation(quat: Gf.Quatf) -> Array:
    """(3, 3) of a unit quaternion."""
    w, v = quat.GetReal(), np.array(quat.GetImaginary(), dtype=np.float64)
    cross = np.cross(np.eye(3), v)
    return np.asarray(np.eye(3) + 2 * w * cross + 2 * cross @ cross)


def _turn(vector: Array) -> Array:
    """(3, 3) of a (3,) rotation vector [rad]."""
    half = np.linalg.norm(vector) / 2
    imaginary = np.sinc(half / np.pi) * np.asarray(vector) / 2
    return _rotation(Gf.Quatd(float(np.cos(half)), Gf.Vec3d(*imaginary.tolist())))
