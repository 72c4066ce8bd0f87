"""Bodies, joints and shapes of an MJCF model as MuJoCo compiles it, with defaults and includes resolved."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import vec3
from ...errors import BadInputError
from ..articulation import Articulation, Link, LinkJoint
from .folding import grounded
from .mesh_files import Triangles, joined, moved
from .primitives import box, capsule, cylinder, ellipsoid
from .xml_files import nan_attributes, read_xml

if TYPE_CHECKING:
    import mujoco

# A truth need not have masses: these let MuJoCo compile moving bodies without one. Nothing is simulated.
_SOME_MASS, _SOME_INERTIA = 1e-6, 1e-9


def compiled(path: Path) -> mujoco.MjModel:
    """Compile a file; raises BadInputError, without the file's name, when MuJoCo does not take it."""
    import mujoco

    # MuJoCo takes NaN and writes a log into the working folder.
    for text in nan_attributes(read_xml(path, "mujoco")):
        raise BadInputError(f"{text} holds NaN")
    try:
        spec = mujoco.MjSpec.from_file(str(path))
        spec.compiler.boundmass = max(spec.compiler.boundmass, _SOME_MASS)
        spec.compiler.boundinertia = max(spec.compiler.boundinertia, _SOME_INERTIA)
        for mesh in spec.meshes:  # any surface will do, closed or not
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
        return spec.compile()
    except (ValueError, mujoco.FatalError) as error:
        raise BadInputError(f"MuJoCo does not load it: {' '.join(str(error).split())}") from error


def articulation(model: mujoco.MjModel, name: str) -> Articulation:
    """The model in the pose of its file (qpos0), in the frame of the world.

    Bodies are links, in MuJoCo's order; the world is one where it has shapes other than floors. Limits count
    from the pose of the file, which a joint's `ref` names. Of several joints of a body the first is its joint
    and the rest are in `also`. Where everything floats, the first body stands still.
    """
    import mujoco

    data = mujoco.MjData(model)  # at qpos0
    mujoco.mj_kinematics(model, data)
    shown = [_shown(model, body) for body in range(model.nbody)]
    first = 0 if shown[0] else 1
    links = [_link(model, data, body, first) for body in range(first, model.nbody)]
    pieces, labels = [], []
    for body in range(first, model.nbody):
        for geom in shown[body]:
            piece = moved(_surface(model, geom), _pose(data.geom_xpos[geom], data.geom_xmat[geom]))
            pieces.append(piece)
            labels.append(np.full(len(piece[1]), body - first, dtype=np.int32))
    if not pieces:
        raise BadInputError("no body has a shape")
    vertices, faces = joined(pieces)
    return grounded(Articulation(name, vertices, faces, np.concatenate(labels), tuple(links)))


def _shown(model: mujoco.MjModel, body: int) -> list[int]:
    """Shapes of a body to look at: those without contacts, or all that it has, where it has none such.

    Floors, height fields and shapes that are fully transparent, which mark regions, are left out.
    """
    import mujoco

    unbounded = (int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD))
    start = int(model.body_geomadr[body])
    geoms = [
        geom
        for geom in range(start, start + int(model.body_geomnum[body]))
        if int(model.geom_type[geom]) not in unbounded
    ]
    visual = [g for g in geoms if not model.geom_contype[g] and not model.geom_conaffinity[g]]
    return [geom for geom in visual if model.geom_rgba[geom, 3] > 0] or [g for g in geoms if g not in visual]


def _surface(model: mujoco.MjModel, geom: int) -> Triangles:
    import mujoco

    kind, size = int(model.geom_type[geom]), [float(v) for v in model.geom_size[geom]]
    if kind in (int(mujoco.mjtGeom.mjGEOM_MESH), int(mujoco.mjtGeom.mjGEOM_SDF)):
        mesh = int(model.geom_dataid[geom])
        vertex, face = int(model.mesh_vertadr[mesh]), int(model.mesh_faceadr[mesh])
        vertices = model.mesh_vert[vertex : vertex + int(model.mesh_vertnum[mesh])]
        faces = model.mesh_face[face : face + int(model.mesh_facenum[mesh])]
        return np.array(vertices, dtype=np.float64), np.array(faces, dtype=np.int32)
    if kind == int(mujoco.mjtGeom.mjGEOM_BOX):
        return box([2 * half for half in size])
    if kind == int(mujoco.mjtGeom.mjGEOM_CYLINDER):
        return cylinder(size[0], 2 * size[1])
    if kind == int(mujoco.mjtGeom.mjGEOM_CAPSULE):
        return capsule(size[0], 2 * size[1])
    return ellipsoid(size if kind == int(mujoco.mjtGeom.mjGEOM_ELLIPSOID) else size[:1] * 3)


def _link(model: mujoco.MjModel, data: mujoco.MjData, body: int, first: int) -> Link:
    name = model.body(body).name or f"body_{body}"
    start = int(model.body_jntadr[body])
    joints = [_joint(model, data, start + i) for i in range(int(model.body_jntnum[body]))]
    parent = int(model.body_parentid[body]) - first if body else -1
    return Link(name, max(parent, -1), joints[0] if joints else LinkJoint(), tuple(joints[1:]))


def _joint(model: mujoco.MjModel, data: mujoco.MjData, joint: int) -> LinkJoint:
    import mujoco

    name, kind = model.joint(joint).name, int(model.jnt_type[joint])
    axis, origin = vec3(data.xaxis[joint]), vec3(data.xanchor[joint])
    if kind == int(mujoco.mjtJoint.mjJNT_FREE):
        return LinkJoint("free", None, origin, name=name)
    if kind == int(mujoco.mjtJoint.mjJNT_BALL):
        return LinkJoint("ball", None, origin, name=name)
    lower = upper = None
    if model.jnt_limited[joint]:
        at_rest = model.qpos0[model.jnt_qposadr[joint]]
        lower, upper = (float(value) for value in model.jnt_range[joint] - at_rest)
    if kind == int(mujoco.mjtJoint.mjJNT_SLIDE):
        return LinkJoint("prismatic", axis, origin, lower, upper, name)
    return LinkJoint("continuous" if lower is None else "revolute", axis, origin, lower, upper, name)


def _pose(position: object, turn: object) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = np.reshape(np.asarray(turn), (3, 3)), np.asarray(position)
    return matrix
