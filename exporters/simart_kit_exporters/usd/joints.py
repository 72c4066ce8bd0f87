"""Joints: frames, limits and passive damping, and what holds the root."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from simart_kit.arrays import FloatArray
from simart_kit.asset import Joint

from .frames import turn_x_to

if TYPE_CHECKING:
    from pxr import Sdf, Usd, UsdPhysics


def define_joint(stage: Usd.Stage, path: Sdf.Path, joint: Joint, origin: FloatArray) -> UsdPhysics.Joint:
    """Author a joint that is not free, between bodies that exist.

    Both frames are at the joint's origin and coincide at rest. X is along the axis of a joint that has one;
    other joints have the asset's axes.

    Args:
        stage: the bodies are children of its default prim.
        path: of the new joint.
        joint: what to write.
        origin: (3,) of the joint in the parent's frame [m].
    """
    from pxr import Gf

    result = _schema(joint).Define(stage, path)
    root = stage.GetDefaultPrim().GetPath()
    result.CreateBody0Rel().SetTargets([root.AppendChild(joint.parent)])
    result.CreateBody1Rel().SetTargets([root.AppendChild(joint.child)])
    has_axis = joint.turns or joint.kind == "prismatic"
    turn = turn_x_to(joint.axis) if has_axis else Gf.Quatf(1.0)
    result.CreateLocalPos0Attr(Gf.Vec3f(*origin.tolist()))
    result.CreateLocalRot0Attr(turn)
    result.CreateLocalPos1Attr(Gf.Vec3f(0.0))
    result.CreateLocalRot1Attr(turn)
    if has_axis:
        result.CreateAxisAttr("X")
        _set_passive_drive(result, joint)
    if joint.limits:
        # USD measures angles in degrees.
        result.CreateLowerLimitAttr(joint.limits.lower * _per_radian(joint))
        result.CreateUpperLimitAttr(joint.limits.upper * _per_radian(joint))
    return result


def define_fixed_base(stage: Usd.Stage, path: Sdf.Path, body: Sdf.Path) -> None:
    """Fix a body to the world and make it the base of the articulation.

    The other end names the default prim: as that is no rigid body, simulators take it as the world, and the
    base stays where a scene puts the asset instead of jumping to the scene's origin.
    """
    from pxr import Gf, UsdPhysics

    joint = UsdPhysics.FixedJoint.Define(stage, path)
    joint.CreateBody0Rel().SetTargets([stage.GetDefaultPrim().GetPath()])
    joint.CreateBody1Rel().SetTargets([body])
    for create in (joint.CreateLocalPos0Attr, joint.CreateLocalPos1Attr):
        create(Gf.Vec3f(0.0))
    for create in (joint.CreateLocalRot0Attr, joint.CreateLocalRot1Attr):
        create(Gf.Quatf(1.0))
    UsdPhysics.ArticulationRootAPI.Apply(joint.GetPrim())


def _schema(joint: Joint) -> type[UsdPhysics.Joint]:
    from pxr import UsdPhysics

    schemas: dict[str, type[UsdPhysics.Joint]] = {
        "fixed": UsdPhysics.FixedJoint,
        "revolute": UsdPhysics.RevoluteJoint,
        "continuous": UsdPhysics.RevoluteJoint,
        "prismatic": UsdPhysics.PrismaticJoint,
        "ball": UsdPhysics.SphericalJoint,
    }
    return schemas[joint.kind]


def _set_passive_drive(result: UsdPhysics.Joint, joint: Joint) -> None:
    """Damping without a spring; a controller that takes over finds the most that it may exert."""
    from pxr import UsdPhysics

    drive = UsdPhysics.DriveAPI.Apply(result.GetPrim(), "angular" if joint.turns else "linear")
    drive.CreateTypeAttr(UsdPhysics.Tokens.force)
    drive.CreateStiffnessAttr(0.0)
    drive.CreateDampingAttr(joint.damping / _per_radian(joint))
    drive.CreateTargetVelocityAttr(0.0)
    if joint.effort:  # a limit of 0 would also switch the damping off
        drive.CreateMaxForceAttr(joint.effort)


def _per_radian(joint: Joint) -> float:
    """USD's unit of a joint's position, in the asset's: degrees in a radian, or 1 for metres."""
    return math.degrees(1.0) if joint.turns else 1.0
