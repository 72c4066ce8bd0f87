"""A mesh as the cloud of pieces that the network reads, and the pieces' labels back on its faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray
from simart_kit.drawing.appearance import Appearance
from simart_kit.mesh import Mesh
from simart_kit.normals import with_normals
from simart_kit.segments import Segments
from simart_kit.srgb import linear_to_srgb

from .cloud import Cloud, Samples, sample_evenly, sample_pieces
from .superfaces import nearest_superface, superfaces

# Points of a cloud, and pieces at most: of solids that lie apart, and of skins that have to be cut.
POINTS, MOST_PIECES, SUPERFACES = 3072, 384, 144
_SKIN_POINTS = 9216


@dataclass(frozen=True, eq=False)
class MeshCloud:
    """What the network reads of a mesh.

    Attributes:
        cloud: its longest side is 1, about 0.
        face_piece: (F,) the piece that each face is of.
        center: (3,) of the mesh's bounding box [m].
        size: its longest side [m].
        skin: whether it is one skin, and no solids that lie apart.
        middles: (K, 9) of the patches that a skin is cut into, for `nearest_superface`; None where it is cut
            by relief, and for solids.
    """

    cloud: Cloud
    face_piece: IntArray
    center: FloatArray
    size: float
    skin: bool
    middles: FloatArray | None

    @property
    def relief(self) -> bool:
        """Whether the pieces are those of a skin that is cut by relief."""
        return self.skin and self.middles is None


def mesh_cloud(mesh: Mesh, segments: Segments, generator: np.random.Generator) -> MeshCloud:
    """Sample a mesh: by its segments, or by patches where one skin holds it all that relief has not cut.

    Args:
        mesh: in the canonical frame.
        segments: of the mesh.
        generator: of the places.
    """
    center = mesh.bounds.mean(axis=0)
    size = float(np.ptp(mesh.bounds, axis=0).max())
    skin = segments.patches or segments.count == 1
    middles = None
    if skin and not (segments.relief and segments.count > 1):
        cloud, face_piece, middles = _of_skin(mesh, segments.aside, center, size, generator)
    else:
        face_piece = few(mesh, segments.face_segment)
        samples = sample_pieces(mesh.face_areas * ~segments.aside, face_piece, POINTS, generator)
        cloud = cloud_of(mesh, samples, face_piece[samples.face], center, size)
    return MeshCloud(cloud, face_piece, center, size, skin, middles)


def _of_skin(
    mesh: Mesh, aside: BoolArray, center: FloatArray, size: float, generator: np.random.Generator
) -> tuple[Cloud, IntArray, FloatArray]:
    """The cloud of a skin's patches, (F,) the patch of each face, that of its middle, and their middles."""
    samples = sample_evenly(mesh.face_areas * ~aside, _SKIN_POINTS, generator)
    cloud = cloud_of(mesh, samples, np.zeros(len(samples.face), dtype=np.int64), center, size)
    patch, middles = superfaces(cloud.points, cloud.normals, cloud.colors, SUPERFACES, generator)
    every = Samples(np.arange(len(mesh.faces)), np.full((len(mesh.faces), 3), 1 / 3), mesh.face_areas)
    faces = cloud_of(mesh, every, np.zeros(len(mesh.faces), dtype=np.int64), center, size)
    face_piece = nearest_superface(middles, faces.points, faces.normals, faces.colors)
    thin = np.sort(generator.permutation(len(patch))[: len(patch) // 3])
    thin = np.union1d(thin, np.unique(patch, return_index=True)[1])
    area = cloud.area[thin] / cloud.area[thin].sum()
    count = int(patch.max()) + 1
    kept = Cloud(cloud.points[thin], cloud.normals[thin], cloud.colors[thin], patch[thin], area, count)
    return kept, face_piece, middles


def few(mesh: Mesh, segment: IntArray) -> IntArray:
    """(F,) of (F,) segments, those beyond the largest ones joined to the nearest of these."""
    from scipy.spatial import cKDTree

    count = int(segment.max()) + 1
    if count <= MOST_PIECES:
        return segment
    middle = mesh.triangles.mean(axis=1)
    small = np.flatnonzero(segment >= MOST_PIECES)
    large = np.flatnonzero(segment < MOST_PIECES)
    weights = mesh.face_areas[small]
    sums = [np.bincount(segment[small], weights * column, count) for column in middle[small].T]
    total = np.maximum(np.bincount(segment[small], weights, count), 1e-300)
    places = np.stack(sums, axis=1)[MOST_PIECES:] / total[MOST_PIECES:, None]
    nearest = np.asarray(cKDTree(middle[large]).query(places)[1])
    joined = np.concatenate([np.arange(MOST_PIECES), segment[large[nearest]]])
    return np.asarray(joined[segment])


def cloud_of(mesh: Mesh, samples: Samples, piece: IntArray, center: FloatArray, size: float) -> Cloud:
    """The cloud of places on a mesh.

    Args:
        mesh: in its colours.
        samples: N places on its faces.
        piece: (N,) that each is of, 0.. without gaps.
        center: (3,) that becomes the origin [m].
        size: that becomes 1 [m].
    """
    places = np.einsum("nk,nkx->nx", samples.weights, mesh.triangles[samples.face])
    looks = Appearance(mesh if mesh.normals is not None else with_normals(mesh))
    footprint = np.sqrt(samples.area).astype(np.float32)
    linear = looks.colors(samples.face, samples.weights.astype(np.float32), footprint)[:, :3]
    return Cloud(
        (places - center) / size,
        mesh.face_normals[samples.face],
        linear_to_srgb(linear.astype(np.float64)),
        piece,
        samples.area / max(samples.area.sum(), 1e-300),
        int(piece.max()) + 1,
    )
