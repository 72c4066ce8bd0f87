"""An object out of an MJCF scene: a body with all that hangs on it."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.bench.articulation import Link, LinkJoint
from simart_kit.bench.formats.mesh_files import Triangles, moved
from simart_kit.bench.formats.mjcf_model import articulation
from simart_kit.bench.formats.primitives import box, cylinder
from simart_kit.errors import BadInputError

from .rigged import Piece, Rigged, unlimited
from .sources import Entry

if TYPE_CHECKING:
    import mujoco

_SEEN = 3  # by convention, shapes of groups from here on are for contact alone
_UNSET = (0.5, 0.5, 0.5, 1.0)  # colour of a shape that has none of its own


def read_mjcf(path: Path, entry: Entry) -> Rigged:
    """Read the body that the entry names, in the pose of the file; metres, +z up.

    Raises:
        BadInputError: MuJoCo does not load the file.
    """
    import mujoco

    _tidy(path, path.parent)
    model = _compiled(path)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    number = {body: index for index, body in enumerate(_below(model, model.body(entry.body).id))}
    everything = articulation(model, path.stem).links
    first = model.nbody - len(everything)  # the world is a link only where it has shapes
    links = tuple(
        _link(everything[b - first], number.get(int(model.body_parentid[b]), -1), entry) for b in number
    )
    pieces = [
        _piece(model, data, geom, number[int(model.geom_bodyid[geom])])
        for geom in range(model.ngeom)
        if int(model.geom_bodyid[geom]) in number and model.geom_group[geom] < _SEEN
    ]
    return Rigged(tuple(pieces), links, notes=_notes(entry))


def _tidy(path: Path, folder: Path) -> None:
    """Take declarations and comments off the heads of a file and of those that it includes.

    MuJoCo includes only files that have none; names of files count from the folder of the first one.
    """
    text = path.read_text(encoding="utf-8", errors="replace")
    bare = re.sub(r"\A\s*(?:(?:<\?xml.*?\?>|<!--.*?-->)\s*)+", "", text, flags=re.DOTALL)
    if bare != text:
        path.write_text(bare, encoding="utf-8")
    for name in re.findall(r'<include\s[^>]*file="([^"]+)"', bare):
        if (folder / name).is_file():
            _tidy(folder / name, folder)


def _compiled(path: Path) -> mujoco.MjModel:
    import mujoco

    try:
        return mujoco.MjModel.from_xml_path(str(path))
    except (ValueError, mujoco.FatalError) as error:
        raise BadInputError(
            f"{path.name}: MuJoCo does not load it: {' '.join(str(error).split())}"
        ) from error


def _below(model: mujoco.MjModel, root: int) -> list[int]:
    """A body and all that hangs on it, in MuJoCo's order, in which parents come first."""
    found = [root]
    for body in range(root + 1, model.nbody):
        if int(model.body_parentid[body]) in found:
            found.append(body)
    return found


def _link(link: Link, parent: int, entry: Entry) -> Link:
    if parent < 0 or link.name in entry.fixed:
        return Link(link.name, parent)
    joint = _in_radians(link.joint) if entry.radians else link.joint
    return replace(link, parent=parent, joint=unlimited(joint))


def _in_radians(joint: LinkJoint) -> LinkJoint:
    """A hinge whose limits were radians, and were taken for degrees."""
    if joint.lower is None or joint.upper is None:
        return joint
    return replace(joint, lower=math.degrees(joint.lower), upper=math.degrees(joint.upper))


def _piece(model: mujoco.MjModel, data: mujoco.MjData, geom: int, link: int) -> Piece:
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
    vertices, faces = moved(_surface(model, geom), pose)
    return Piece(vertices, faces, _color(model, geom), link)


def _surface(model: mujoco.MjModel, geom: int) -> Triangles:
    import mujoco

    kind, size = int(model.geom_type[geom]), model.geom_size[geom]
    if kind == int(mujoco.mjtGeom.mjGEOM_BOX):
        return box([float(2 * half) for half in size])
    if kind == int(mujoco.mjtGeom.mjGEOM_CYLINDER):
        return cylinder(float(size[0]), float(2 * size[1]))
    if kind == int(mujoco.mjtGeom.mjGEOM_CAPSULE):
        return _capsule(float(size[0]), float(2 * size[1]))
    mesh = int(model.geom_dataid[geom])
    vertex, face = int(model.mesh_vertadr[mesh]), int(model.mesh_faceadr[mesh])
    vertices = model.mesh_vert[vertex : vertex + int(model.mesh_vertnum[mesh])]
    faces = model.mesh_face[face : face + int(model.mesh_facenum[mesh])]
    return np.array(vertices, dtype=np.float64), np.array(faces, dtype=np.int32)


def _capsule(radius: float, length: float) -> Triangles:
    """A capsule along z about the origin, as coarse as the meshes around it."""
    import trimesh

    mesh = trimesh.creation.capsule(height=length, radius=radius, count=[16, 16])
    vertices = np.array(mesh.vertices, dtype=np.float64)
    vertices[:, 2] -= mesh.bounds.mean(axis=0)[2]
    return vertices, np.array(mesh.faces, dtype=np.int32)


def _color(model: mujoco.MjModel, geom: int) -> FloatArray:
    """(3,) of a shape: its own, else that of its material, times the mean of the texture."""
    color, material = np.array(model.geom_rgba[geom], dtype=np.float64), int(model.geom_matid[geom])
    if material < 0:
        return np.asarray(color[:3] * 255)
    if np.allclose(color, _UNSET):
        color = np.array(model.mat_rgba[material], dtype=np.float64)
    for texture in [int(t) for t in np.ravel(model.mat_texid[material]) if t >= 0][:1]:
        start, channels = int(model.tex_adr[texture]), int(model.tex_nchannel[texture])
        count = int(model.tex_height[texture] * model.tex_width[texture]) * channels
        pixels = model.tex_data[start : start + count].reshape(-1, channels)[:, :3]
        color[:3] *= pixels.mean(axis=0) / 255
    return np.asarray(color[:3] * 255)


def _notes(entry: Entry) -> tuple[str, ...]:
    held = f"taken as fixed, being no movement of a part: {', '.join(entry.fixed)}"
    limits = "limits are read as radians: the package counts so, its file does not say it"
    return (*((held,) if entry.fixed else ()), *((limits,) if entry.radians else ()))
