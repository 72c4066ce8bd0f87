"""Joints as MuJoCo has them, for whoever builds a model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .asset import JointKind

if TYPE_CHECKING:
    import mujoco

STIFF_FRICTION = [0.9999, 0.9999, 0.001, 0.5, 2.0]
"""`solimp_friction` of a joint whose dry friction holds: with MuJoCo's own 0.9 .. 0.95 a held lid creeps."""

STIFF_LIMIT = [0.005, 1.0]
"""`solref_limit` of a joint, time constant [s] and damping ratio: with MuJoCo's own 0.02 s a light handle
that is pushed gives way by degrees behind its limit. MuJoCo takes two time steps where these are longer."""


def joint_type(kind: JointKind) -> mujoco.mjtJoint:
    """MuJoCo's type of a joint that is neither fixed nor free."""
    import mujoco

    types: dict[JointKind, mujoco.mjtJoint] = {
        "revolute": mujoco.mjtJoint.mjJNT_HINGE,
        "continuous": mujoco.mjtJoint.mjJNT_HINGE,
        "prismatic": mujoco.mjtJoint.mjJNT_SLIDE,
        "ball": mujoco.mjtJoint.mjJNT_BALL,
    }
    return types[kind]
