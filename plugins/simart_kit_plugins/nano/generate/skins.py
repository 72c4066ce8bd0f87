"""Closed skins of generated objects: what a generative model delivers of them, or a scanner."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import BoolArray, ByteArray, Float32Array, FloatArray, IntArray, vec3
from simart_kit.triangles import areas
from simart_kit.voxels import GridFrame, voxelise

from ...shapes.surface_nets import surface_nets
from ..cloud import sample_evenly
from .writing import GeneratedMesh

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

# The mesh of an object beside input.glb.
VARIANT = "fused"
# Voxels along the longest side of an object, and empty ones before and behind it.
CELLS = 112
_MARGIN = 3
_BESIDE = np.ones((3, 3, 3), dtype=np.bool_)
# Air nearer to the surface than this is closed, in voxels: cells that it meets have their middles so near.
_CLOSED = math.sqrt(3) / 2
# The skin lies so far outside the surface, in voxels, and about so unevenly.
_OFFSET, _UNEVEN = 0.66, 0.1
# Samples of the surface in the square of a voxel.
_DENSITY = 9


@dataclass(frozen=True, eq=False)
class Skin:
    """A closed surface about an object, +Y up [m]: each edge has two faces.

    Attributes:
        vertices: (V, 3).
        colors: (V, 3) sRGB.
        faces: (F, 3), outward.
        face_part: (F,) int32 number of the body that each face lies on.
    """

    vertices: Float32Array
    colors: ByteArray
    faces: IntArray
    face_part: IntArray


def skin_of(mesh: GeneratedMesh, generator: np.random.Generator, cells: int = CELLS) -> Skin:
    """The skin that air from outside touches: what is hidden is gone, and gaps below 1.7 voxels are bridged.

    Args:
        mesh: the object.
        generator: of the unevenness.
        cells: voxels along the longest side of the object.
    """
    triangles = mesh.vertices[mesh.faces].astype(np.float64)
    frame = _frame(mesh.vertices, cells)
    solid = voxelise(triangles, frame).occupancy
    air = _outside(~solid)
    samples = _samples(mesh, triangles, frame, air, generator)
    tree = samples.tree()
    vertices, faces = surface_nets(_values(tree, air, solid, generator))
    away, nearest = map(np.asarray, tree.query(vertices))
    step = np.minimum(away, _CLOSED - _OFFSET) / np.maximum(away, 1e-9)
    vertices += (samples.points[nearest] - vertices) * step[:, None]
    part = mesh.face_part[samples.face]
    corners = part[nearest[faces]]
    face_part = corners[:, 0]
    between = (corners != face_part[:, None]).any(axis=1)
    face_part[between] = part[tree.query(vertices[faces[between]].mean(axis=1))[1]]
    places = frame.to_world(vertices + 0.5).astype(np.float32)
    return Skin(places, samples.colors(mesh)[nearest], faces, face_part)


def write_skin(skin: Skin, folder: Path) -> None:
    """Write fused.glb and fused.npz into a folder, as SIMART-Bench objects name and number them."""
    import trimesh

    surface = trimesh.Trimesh(skin.vertices, skin.faces, vertex_colors=skin.colors, process=False)
    (folder / f"{VARIANT}.glb").write_bytes(surface.export(file_type="glb"))
    np.savez_compressed(folder / f"{VARIANT}.npz", allow_pickle=False, face_part=skin.face_part)


@dataclass(frozen=True, eq=False)
class _Samples:
    """Places on faces next to the outside: (N,) faces, (N, 3) corner weights, (N, 3) points [voxels].

    Points count from the middle of the first cell.
    """

    face: IntArray
    weights: FloatArray
    points: FloatArray

    def tree(self) -> cKDTree:
        from scipy.spatial import cKDTree

        return cKDTree(self.points)

    def colors(self, mesh: GeneratedMesh) -> ByteArray:
        """(N, 3) sRGB of the texture's pixels."""
        u, v = np.einsum("nk,nkx->xn", self.weights, mesh.uv[mesh.faces[self.face]])
        height, width = mesh.picture.shape[:2]
        row, column = ((1 - v) * height).astype(np.int64), (u * width).astype(np.int64)
        return np.asarray(mesh.picture[row.clip(0, height - 1), column.clip(0, width - 1)])


def _frame(vertices: FloatArray, cells: int) -> GridFrame:
    """Cubic cells about the object's middle, so many along its longest side, and the margin."""
    low, high = vertices.min(axis=0).astype(np.float64), vertices.max(axis=0).astype(np.float64)
    size = float((high - low).max()) / cells
    resolution = cells + 2 * _MARGIN
    return GridFrame(vec3((low + high) / 2 - size * resolution / 2), size, resolution)


def _samples(
    mesh: GeneratedMesh,
    triangles: FloatArray,
    frame: GridFrame,
    air: BoolArray,
    generator: np.random.Generator,
) -> _Samples:
    """Places all over the surface, and all corners, up to two cells behind the air."""
    from scipy.ndimage import binary_dilation

    area = areas(triangles)
    count = int(area.sum() / frame.voxel_size**2 * _DENSITY)
    spread = sample_evenly(area, count, generator)
    face = np.concatenate([spread.face, np.repeat(np.arange(len(mesh.faces)), 3)])
    weights = np.concatenate([spread.weights, np.tile(np.eye(3), (len(mesh.faces), 1))])
    points = frame.to_grid(np.einsum("nk,nkx->nx", weights, triangles[face]))
    shallow = binary_dilation(air, _BESIDE, iterations=2)
    kept = shallow[tuple(np.floor(points).astype(np.int64).T)]
    return _Samples(face[kept], weights[kept], points[kept] - 0.5)


def _values(tree: cKDTree, air: BoolArray, solid: BoolArray, generator: np.random.Generator) -> FloatArray:
    """(N, N, N) negative in what is closed; near its border the distance to there [voxels], uneven."""
    from scipy.ndimage import binary_dilation

    near = air & binary_dilation(solid, _BESIDE)
    distance = np.where(solid, 0.0, np.inf)
    distance[near] = tree.query(np.argwhere(near))[0]
    closed = ~_outside(distance > _CLOSED)
    behind = closed & binary_dilation(~closed)
    distance[behind] = tree.query(np.argwhere(behind))[0]
    known = behind | (near & ~closed)
    values = np.minimum(distance - _CLOSED, 1.0)
    values[known] += _UNEVEN * generator.standard_normal(np.count_nonzero(known)).clip(-3, 3)
    return np.where(closed, np.minimum(values, -1e-9), np.maximum(values, 0.0))


def _outside(empty: BoolArray) -> BoolArray:
    """The cells joined through faces to the first one."""
    from scipy.ndimage import label

    number, _ = label(empty)
    return np.asarray(number == number[0, 0, 0])
