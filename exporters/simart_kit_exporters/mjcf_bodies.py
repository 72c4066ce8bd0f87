"""The tree of bodies and joints of an MJCF model, without shapes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint, MassProperties
from simart_kit.kinematics import ordered_joints, rest_origin

from .gaps import rigid

if TYPE_CHECKING:
    import mujoco


def add_bodies(spec: mujoco.MjSpec, asset: Asset, armature: float) -> dict[str, mujoco.MjsBody]:
    """Add a body for every part and its joint; returns the bodies by part, in the asset's order of parts.

    Args:
        spec: a model whose angles are radians.
        asset: body frames are its part frames.
        armature: inertia added to joints [kg*m^2 | kg].
    """
    root = spec.worldbody.add_body(name=asset.root.name)
    if asset.floating:
        root.add_freejoint()
    bodies = {asset.root.name: root}
    for joint in ordered_joints(asset):
        # MuJoCo takes free joints under the world alone.
        free = joint.kind == "free"
        parent = spec.worldbody if free else bodies[joint.parent]
        parent_origin = np.zeros(3) if free else rest_origin(asset, joint.parent)
        bodies[joint.child] = parent.add_body(name=joint.child, pos=np.array(joint.origin) - parent_origin)
        _add_joint(bodies[joint.child], joint, armature)
    return {part.name: bodies[part.name] for part in asset.parts}


def set_inertial(body: mujoco.MjsBody, mass: MassProperties, origin: FloatArray) -> None:
    """Set mass properties on a body whose frame stands at (3,) `origin` in the asset frame."""
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = mass.inertia
    body.mass = mass.mass
    body.ipos = np.array(mass.center) - origin
    body.fullinertia = [xx, yy, zz, xy, xz, yz]
    body.explicitinertial = True


def _add_joint(body: mujoco.MjsBody, joint: Joint, armature: float) -> None:
    import mujoco

    if rigid(joint):
        return
    if joint.kind == "free":
        body.add_freejoint(name=joint.name)
        return
    kinds = {
        "revolute": mujoco.mjtJoint.mjJNT_HINGE,
        "continuous": mujoco.mjtJoint.mjJNT_HINGE,
        "prismatic": mujoco.mjtJoint.mjJNT_SLIDE,
        "ball": mujoco.mjtJoint.mjJNT_BALL,
    }
    added = body.add_joint(
        name=joint.name,
        type=kinds[joint.kind],
        axis=joint.axis,
        limited=mujoco.mjtLimited.mjLIMITED_TRUE if joint.limits else mujoco.mjtLimited.mjLIMITED_FALSE,
        damping=joint.damping,
        frictionloss=joint.friction,
        armature=armature,
    )
    if joint.limits:
        added.range = [joint.limits.lower, joint.limits.upper]
    if joint.kind != "ball" and joint.effort > 0:
        added.actfrclimited = mujoco.mjtLimited.mjLIMITED_TRUE
        added.actfrcrange = [-joint.effort, joint.effort]
