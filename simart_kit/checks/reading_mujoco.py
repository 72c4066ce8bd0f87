"""A compiled MuJoCo model, of MJCF or of URDF, as a Mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray, mat3, vec3
from ..asset import JointKind, MassProperties
from ..bench.mujoco_loading import NEIGHBOURS
from .mechanism import WORLD, Body, Link, Mechanism
from .names import body_name, joint_name
from .round_shapes import box_corners, capsule_points, cylinder_points, sphere_points

if TYPE_CHECKING:
    import mujoco


def mechanism_of(model: mujoco.MjModel) -> Mechanism:
    """Bodies and joints of a model at its rest pose; a second joint of a body is left out."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    real = [index for index in range(1, model.nbody) if not _is_frame(model, index)]
    bodies = tuple(_body(model, data, index) for index in real)
    links = []
    for index in real:
        carried = model.body_parentid[index] in real
        if carried or model.body_jntnum[index]:
            parent = body_name(model, model.body_parentid[index]) if carried else WORLD
            links.append(_link(model, data, index, parent))
    return Mechanism(bodies, tuple(links), *_passing(model))


def _is_frame(model: mujoco.MjModel, body: int) -> bool:
    """Whether a body is only a frame that others hang on: it stands still, weighs nothing and is not felt."""
    still = not model.body_weldid[body]
    return bool(still and not model.body_mass[body] and not _touching(model, body))


def _body(model: mujoco.MjModel, data: mujoco.MjData, index: int) -> Body:
    principal = data.ximat[index].reshape(3, 3)
    mass = MassProperties(
        float(model.body_mass[index]),
        vec3(data.xipos[index]),
        mat3(principal @ np.diag(model.body_inertia[index]) @ principal.T),
    )
    shapes = tuple(_points(model, data, geom) for geom in _touching(model, index))
    return Body(body_name(model, index), mass, shapes)


def _touching(model: mujoco.MjModel, body: int) -> list[int]:
    """The geoms of a body that collide."""
    own = range(model.body_geomadr[body], model.body_geomadr[body] + model.body_geomnum[body])
    return [geom for geom in own if model.geom_contype[geom] or model.geom_conaffinity[geom]]


def _points(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> FloatArray:
    """(V, 3) corners of a shape, or points on a round one, in the world."""
    import mujoco

    size = model.geom_size[geom]
    match int(model.geom_type[geom]):
        case int(mujoco.mjtGeom.mjGEOM_MESH):
            mesh = model.geom_dataid[geom]
            first = model.mesh_vertadr[mesh]
            points = np.array(model.mesh_vert[first : first + model.mesh_vertnum[mesh]], dtype=np.float64)
        case int(mujoco.mjtGeom.mjGEOM_SPHERE):
            points = sphere_points(size[0])
        case int(mujoco.mjtGeom.mjGEOM_CYLINDER):
            points = cylinder_points(size[0], size[1])
        case int(mujoco.mjtGeom.mjGEOM_CAPSULE):
            points = capsule_points(size[0], size[1])
        case _:
            points = box_corners(size)
    return np.asarray(points @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom])


def _link(model: mujoco.MjModel, data: mujoco.MjData, body: int, parent: str) -> Link:
    name = body_name(model, body)
    if not model.body_jntnum[body]:
        return Link(f"{name}_fixed", "fixed", parent, name, vec3(data.xpos[body]), (0.0, 0.0, 1.0))
    joint = model.body_jntadr[body]
    dof = model.jnt_dofadr[joint]
    limited = bool(model.jnt_limited[joint])
    lower, upper = (float(v) for v in model.jnt_range[joint])
    return Link(
        joint_name(model, joint),
        _kind(model, joint),
        parent,
        name,
        vec3(data.xanchor[joint]),
        vec3(data.xaxis[joint]),
        lower if limited else None,
        upper if limited else None,
        float(model.dof_damping[dof]),
        float(model.dof_frictionloss[dof]),
        float(model.dof_armature[dof]),
    )


def _kind(model: mujoco.MjModel, joint: int) -> JointKind:
    import mujoco

    limited = bool(model.jnt_limited[joint])
    kinds: dict[int, JointKind] = {
        int(mujoco.mjtJoint.mjJNT_HINGE): "revolute" if limited else "continuous",
        int(mujoco.mjtJoint.mjJNT_SLIDE): "prismatic",
        int(mujoco.mjtJoint.mjJNT_BALL): "ball",
        int(mujoco.mjtJoint.mjJNT_FREE): "free",
    }
    return kinds[int(model.jnt_type[joint])]


def _passing(model: mujoco.MjModel) -> tuple[frozenset[frozenset[str]], frozenset[frozenset[str]]]:
    """Pairs of names that the file excludes, and those that pass anyway; both numbers of a pair are one."""
    asked, anyway = set[frozenset[str]](), set[frozenset[str]]()
    for index, signature in enumerate(model.exclude_signature):
        pair = frozenset(body_name(model, int(body)) for body in divmod(int(signature), 1 << 16))
        (anyway if model.exclude(index).name.startswith(NEIGHBOURS) else asked).add(pair)
    return frozenset(asked), frozenset(anyway - asked)
