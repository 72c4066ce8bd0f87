"""The tree of bodies and joints of an MJCF model, without shapes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint, MassProperties
from simart_kit.kinematics import ordered_joints, rest_origin
from simart_kit.mujoco_joints import STIFF_FRICTION, STIFF_LIMIT, joint_type

if TYPE_CHECKING:
    import mujoco


def add_bodies(
    world: mujoco.MjsBody, asset: Asset, names: Mapping[str, str], free: bool = True
) -> dict[str, mujoco.MjsBody]:
    """Add a body for every part and its joint; returns the bodies by part, in the asset's order of parts.

    Args:
        world: body that carries them; angles of its model are radians.
        asset: body frames are its part frames.
        names: name of the body of each part.
        free: whether `world` is the world itself. MuJoCo takes free joints nowhere else: what floats is
            fixed without.
    """
    root = world.add_body(name=names[asset.root.name])
    if asset.floating and free:
        root.add_freejoint()
    bodies = {asset.root.name: root}
    for joint in ordered_joints(asset):
        loose = joint.kind == "free" and free
        parent = world if loose else bodies[joint.parent]
        parent_origin = np.zeros(3) if loose else rest_origin(asset, joint.parent)
        body = parent.add_body(name=names[joint.child], pos=np.array(joint.origin) - parent_origin)
        if loose:
            body.add_freejoint(name=joint.name)
        elif joint.kind != "free" and not joint.rigid:
            _add_joint(body, joint)
        bodies[joint.child] = body
    return {part.name: bodies[part.name] for part in asset.parts}


def set_inertial(body: mujoco.MjsBody, mass: MassProperties, origin: FloatArray) -> None:
    """Set mass properties on a body whose frame stands at (3,) `origin` in the asset frame."""
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = mass.inertia
    body.mass = mass.mass
    body.ipos = np.array(mass.center) - origin
    body.fullinertia = [xx, yy, zz, xy, xz, yz]
    body.explicitinertial = True


def _add_joint(body: mujoco.MjsBody, joint: Joint) -> None:
    import mujoco

    added = body.add_joint(
        name=joint.name,
        type=joint_type(joint.kind),
        axis=joint.axis,
        limited=mujoco.mjtLimited.mjLIMITED_TRUE if joint.limits else mujoco.mjtLimited.mjLIMITED_FALSE,
        damping=joint.damping,
        frictionloss=joint.friction,
        armature=joint.armature,
    )
    if joint.friction:
        added.solimp_friction = STIFF_FRICTION
    if joint.limits:
        added.range = [joint.limits.lower, joint.limits.upper]
        added.solref_limit = STIFF_LIMIT
    if joint.kind != "ball" and joint.effort > 0:
        added.actfrclimited = mujoco.mjtLimited.mjLIMITED_TRUE
        added.actfrcrange = [-joint.effort, joint.effort]
