"""What joints have that UsdPhysics lacks, in the schemas of Newton and of MuJoCo.

The schemas need not be installed: a reader that knows them finds the attributes, the others pass over them,
and the bytes are the same everywhere. Damping is left to the drive of a joint that has one, or simulators
that read both would damp twice.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from simart_kit.asset import Joint

if TYPE_CHECKING:
    from pxr import Usd

    from .draft import Role

RUNTIME_SCHEMAS: dict[Role, tuple[str, str]] = {
    "newton": ("NewtonCollisionAPI", "NewtonMeshCollisionAPI"),
    "mujoco": ("MjcCollisionAPI", "MjcMeshCollisionAPI"),
}
"""What says that a collider is one of a simulator's, and that a mesh is; settings keep their defaults."""


def set_newton(prim: Usd.Prim, joint: Joint) -> None:
    """Apply NewtonJointAPI (newton-usd-schemas 0.6), which measures angles in degrees."""
    from pxr import Sdf

    unit = 1.0 if joint.kind == "prismatic" else math.degrees(1.0)
    values = {"newton:armature": joint.armature, "newton:friction": joint.friction}
    if joint.kind == "ball":
        values["newton:damping"] = joint.damping / unit
    if joint.velocity:  # 0 would hold the joint
        values["newton:velocityLimit"] = joint.velocity * unit
    prim.AddAppliedSchema("NewtonJointAPI")
    for name, value in values.items():
        prim.CreateAttribute(name, Sdf.ValueTypeNames.Float, custom=False).Set(value)


def set_mujoco(prim: Usd.Prim, joint: Joint) -> None:
    """Apply MjcJointAPI (mjcPhysics of MuJoCo 4.0), which measures these in radians."""
    from pxr import Sdf

    values = {"mjc:armature": joint.armature, "mjc:frictionloss": joint.friction}
    if joint.kind == "ball":
        values["mjc:damping"] = joint.damping
    prim.AddAppliedSchema("MjcJointAPI")
    for name, value in values.items():
        attribute = prim.CreateAttribute(
            name, Sdf.ValueTypeNames.Double, custom=False, variability=Sdf.VariabilityUniform
        )
        attribute.Set(value)
