"""A Mechanism as a MuJoCo model, for formats that MuJoCo does not read."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray
from ..mujoco_joints import STIFF_FRICTION, STIFF_LIMIT, joint_type
from .mechanism import WORLD, Body, Link, Mechanism

if TYPE_CHECKING:
    import mujoco


def spec_of(mechanism: Mechanism) -> mujoco.MjSpec:
    """Bodies with explicit inertias, convex hulls and joints; the base is fixed to the world.

    Every body has the world's axes and sits at the origin of the joint that moves it. What a free joint holds
    is fixed to the world where it stands, like the base.

    Raises:
        BadInputError: the joints are no tree.
    """
    import mujoco

    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.tolerance = 1e-10  # as in our MJCF: light parts on heavy ones would creep
    made, origins = {WORLD: spec.worldbody}, {WORLD: np.zeros(3)}
    above = {link.child: link for link in mechanism.links}
    for source in mechanism.order:
        name, link = source.name, above.get(source.name)
        parent = link.parent if link and link.kind != "free" else WORLD
        origins[name] = np.array(link.origin if link else (0.0, 0.0, 0.0))
        made[name] = made[parent].add_body(name=name, pos=origins[name] - origins[parent])
        _fill(spec, made[name], source, origins[name])
        if link and link.kind != "free" and not link.rigid:
            _add_joint(made[name], link)
    for pair in mechanism.excluded | mechanism.passing:
        one, *other = sorted(pair)
        spec.add_exclude(bodyname1=one, bodyname2=(other or [one])[0])
    return spec


def _fill(spec: mujoco.MjSpec, body: mujoco.MjsBody, source: Body, origin: FloatArray) -> None:
    import mujoco

    if source.mass:
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = source.mass.inertia
        body.explicitinertial = True
        body.mass = source.mass.mass
        body.ipos = np.array(source.mass.center) - origin
        body.fullinertia = [xx, yy, zz, xy, xz, yz]
    for number, points in enumerate(source.colliders):
        mesh = spec.add_mesh(name=f"{source.name}_{number}")
        mesh.uservert = (points - origin).ravel()
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=mesh.name, condim=4)


def _add_joint(body: mujoco.MjsBody, link: Link) -> None:
    import mujoco

    joint = body.add_joint(name=link.name, type=joint_type(link.kind), axis=link.axis)
    joint.frictionloss, joint.armature = link.friction, link.armature
    joint.solimp_friction = STIFF_FRICTION
    joint.damping = np.array([link.damping, 0.0, 0.0])
    if link.lower is not None and link.upper is not None:
        joint.range = [link.lower, link.upper]
        joint.limited = mujoco.mjtLimited.mjLIMITED_TRUE
        joint.solref_limit = STIFF_LIMIT
