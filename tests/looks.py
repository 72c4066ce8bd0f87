"""The colours that other tools read off the surfaces of a source file and of its exports, in one form.

Nothing of simart_kit takes part: trimesh reads sources and URDF meshes, MuJoCo MJCF, and pxr USD.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np
import trimesh
import yourdfpy
from numpy.typing import NDArray
from PIL import Image
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade

Floats = NDArray[np.float64]

CENTRES = np.full((1, 3), 1 / 3)
CORNERS = np.eye(3)
"""Barycentric weights at which triangles are looked at: corners where only those have colours."""


@dataclass(frozen=True)
class Look:
    """What a surface looks like at points of its triangles.

    Attributes:
        faces: number of triangles.
        places: (N, 6) points [m] and the unit normals of their triangles.
        colors: (N, 3) sRGB, 0..255.
        textured: whether they come from a picture of more than one colour, at coordinates that vary.
    """

    faces: int
    places: Floats
    colors: Floats
    textured: bool

    def __add__(self, other: Look) -> Look:
        return Look(
            self.faces + other.faces,
            np.concatenate([self.places, other.places]),
            np.concatenate([self.colors, other.colors]),
            self.textured and other.textured,
        )


def source_look(path: Path, asset_from_source: Floats, weights: Floats) -> Look:
    """A GLB of one mesh with a texture or vertex colours, moved to the asset frame."""
    mesh = trimesh.load(path, process=False, force="mesh")
    mesh.apply_transform(asset_from_source)
    if mesh.visual.kind == "vertex":
        return _colored(mesh.triangles, mesh.visual.vertex_colors[mesh.faces][..., :3], weights)
    picture = np.asarray(mesh.visual.material.baseColorTexture.convert("RGB"))
    return _textured(mesh.triangles, mesh.visual.uv[mesh.faces], picture, weights)


def mjcf_looks(path: Path, weights: Floats) -> dict[str, Look]:
    """What MuJoCo draws of each body at rest; groups up to 2 are what its viewer shows."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    found: dict[str, list[Look]] = defaultdict(list)
    for geom in np.flatnonzero(model.geom_group <= 2):
        mesh = model.geom_dataid[geom]
        faces = slice(model.mesh_faceadr[mesh], model.mesh_faceadr[mesh] + model.mesh_facenum[mesh])
        vertices = model.mesh_vert[model.mesh_vertadr[mesh] :]
        triangles = vertices[model.mesh_face[faces]] @ data.geom_xmat[geom].reshape(3, 3).T
        uv = model.mesh_texcoord[model.mesh_texcoordadr[mesh] :][model.mesh_facetexcoord[faces]]
        uv = np.stack([uv[..., 0], 1.0 - uv[..., 1]], axis=-1)  # its v counts from the top
        material = model.geom_matid[geom]
        assert (model.mat_rgba[material] == 1.0).all()
        picture = _mujoco_picture(model, model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB])
        body = model.body(model.geom_bodyid[geom]).name
        found[body].append(_textured(triangles + data.geom_xpos[geom], uv, picture, weights))
    return _joined(found)


def urdf_looks(path: Path, weights: Floats) -> dict[str, Look]:
    """What yourdfpy draws of each link at rest."""
    scene = yourdfpy.URDF.load(str(path)).scene
    found: dict[str, list[Look]] = defaultdict(list)
    for node in scene.graph.nodes_geometry:
        base_T_mesh, name = scene.graph[node]
        mesh = scene.geometry[name]
        triangles = mesh.triangles @ base_T_mesh[:3, :3].T + base_T_mesh[:3, 3]
        picture = np.asarray(mesh.visual.material.image.convert("RGB"))
        link = scene.graph.transforms.parents[node]
        found[link].append(_textured(triangles, mesh.visual.uv[mesh.faces], picture, weights))
    return _joined(found)


def usd_looks(path: Path, weights: Floats) -> dict[str, Look]:
    """What a UsdPreviewSurface renderer draws of each rigid body at rest."""
    stage = Usd.Stage.Open(str(path))
    found: dict[str, list[Look]] = defaultdict(list)
    for prim in stage.Traverse():
        if prim.IsA(UsdGeom.Mesh) and UsdGeom.Imageable(prim).ComputePurpose() == "default":
            assert prim.GetParent().HasAPI(UsdPhysics.RigidBodyAPI)
            found[prim.GetParent().GetName()].append(_usd_look(UsdGeom.Mesh(prim), weights))
    return _joined(found)


def _usd_look(mesh: UsdGeom.Mesh, weights: Floats) -> Look:
    world_T_mesh = np.array(mesh.ComputeLocalToWorldTransform(Usd.TimeCode.Default())).T
    points = np.array(mesh.GetPointsAttr().Get()) @ world_T_mesh[:3, :3].T + world_T_mesh[:3, 3]
    faces = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    material, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    surface, _, _ = material.ComputeSurfaceSource()
    (connected,), _ = surface.GetInput("diffuseColor").GetConnectedSources()
    node = UsdShade.Shader(connected.source.GetPrim())
    primvars = UsdGeom.PrimvarsAPI(mesh)
    if node.GetIdAttr().Get() == "UsdUVTexture":
        picture = np.asarray(Image.open(node.GetInput("file").Get().resolvedPath).convert("RGB"))
        assert tuple(node.GetInput("scale").Get())[:3] == (1.0, 1.0, 1.0)
        uv = np.array(primvars.GetPrimvar("st").ComputeFlattened())
        return _textured(points[faces], uv[faces], picture, weights)
    assert node.GetIdAttr().Get() == "UsdPrimvarReader_float3"
    name = node.GetInput("varname").Get()
    linear = np.array(primvars.GetPrimvar(name).ComputeFlattened(), dtype=np.float64)
    curve = 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055  # IEC 61966-2-1
    return _colored(points[faces], 255 * np.where(linear <= 0.0031308, 12.92 * linear, curve)[faces], weights)


def _mujoco_picture(model: mujoco.MjModel, texture: int) -> NDArray[np.uint8]:
    assert texture >= 0
    height, width, channels = (
        int(count[texture]) for count in (model.tex_height, model.tex_width, model.tex_nchannel)
    )
    start = model.tex_adr[texture]
    pixels = model.tex_data[start : start + height * width * channels]
    return np.asarray(pixels.reshape(height, width, channels)[..., :3])


def _textured(triangles: Floats, uv: Floats, picture: NDArray[np.uint8], weights: Floats) -> Look:
    """Of (F, 3, 3) corners and their (F, 3, 2) coordinates, origin bottom left."""
    colors = _bilinear(picture, np.einsum("wc,fcx->fwx", weights, uv).reshape(-1, 2))
    varied = (picture != picture[0, 0]).any() and np.ptp(uv.reshape(-1, 2), axis=0).min() > 0
    return Look(len(triangles), _places(triangles, weights), colors, bool(varied))


def _colored(triangles: Floats, colors: Floats, weights: Floats) -> Look:
    """Of (F, 3, 3) corners and their (F, 3, 3) colours."""
    mixed = np.einsum("wc,fcx->fwx", weights, colors).reshape(-1, 3)
    return Look(len(triangles), _places(triangles, weights), mixed, False)


def _places(triangles: Floats, weights: Floats) -> Floats:
    points = np.einsum("wc,fcx->fwx", weights, triangles)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    return np.concatenate([points, np.repeat(normals[:, None], len(weights), axis=1)], axis=2).reshape(-1, 6)


def _bilinear(picture: NDArray[np.uint8], uv: Floats) -> Floats:
    """(N, 3) colours at (N, 2) coordinates of a picture that repeats; row 0 is the top."""
    height, width = picture.shape[:2]
    place = np.stack([uv[:, 0] * width, (1.0 - uv[:, 1]) * height], axis=1) - 0.5
    corner = np.floor(place).astype(np.int64)
    share = place - corner
    result = np.zeros((len(uv), 3))
    for across in (0, 1):
        for down in (0, 1):
            weight = np.abs(1 - across - share[:, 0]) * np.abs(1 - down - share[:, 1])
            texel = picture[(corner[:, 1] + down) % height, (corner[:, 0] + across) % width]
            result += weight[:, None] * texel
    return result


def _joined(found: dict[str, list[Look]]) -> dict[str, Look]:
    return {name: sum(looks[1:], looks[0]) for name, looks in found.items()}
