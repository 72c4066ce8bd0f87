"""A skin cut in grooves, at seams of colour and at sharp edges: where the solids met that it was made of.

Where two solids are fused, their surfaces meet in a hollow edge. The skins of generative models are finely
meshed and rough: the angle between two faces tells little there, how a vertex lies to the mean of its
surroundings does.
"""

from __future__ import annotations

import numpy as np

from ..alignment import straight_from_asset
from ..arrays import BoolArray, FloatArray, IntArray
from ..mesh import Mesh
from ..normals import with_normals
from ..rays import Rays
from ..srgb import linear_to_srgb
from ..topology import without_gaps
from .boards import with_faces_joined
from .fineness import RADIUS
from .frames import with_frames_shared_out
from .graph import SkinGraph, skin_graph, unit
from .lobes import with_lobes_whole
from .partings import with_fronts_parted
from .refining import Refined, longest_side, refined
from .sides import ways, with_sides_parted

# The most steps that the surroundings are wide.
_STEPS = 40
# How far, in radii, the mean of the surroundings lies above a vertex in a groove, and below one at an edge.
_GROOVE, _EDGE = 0.03, 0.05
# Fainter grooves count where there are no mouldings: on what is not boxy. Of that less looks along the axes.
_FAINT, _BOXY = 0.02, 0.6
# Least difference of neighbouring vertices at a seam, of 0..1; a piece that seams bound is no smaller than
# this share of the surface, for stains are none.
_SEAM, _LEAST_COLORED = 0.12, 0.006
_SPECKLED = 0.05  # share of vertices of another colour than those around them from which on they are noise
_LEAST = 0.0006  # share of the surface that a piece has at least
_BIG = 0.1  # share from which on a piece is cut at its sharp edges too
_NARROW = 0.013  # width, in longest sides, below which a piece is but the wall of a step


def relief_pieces(mesh: Mesh, corners: IntArray, kept: IntArray) -> IntArray:
    """(K,) labels 0.. of the `kept` faces of a skin.

    Args:
        mesh: of the faces.
        corners: (K, 3) what they meet at.
        kept: (K,) ids of the faces.
    """
    used, whole = without_gaps(corners)
    places = np.zeros((len(used), 3))
    places[whole] = mesh.triangles[kept]
    radius = RADIUS * float(np.ptp(places, axis=0).max())
    fine = refined(places, whole, longest_side(places, whole, radius))
    faces, source = fine.faces, kept[fine.source]
    areas = mesh.face_areas[source] * fine.shares
    graph = skin_graph(fine.places, faces, mesh.face_normals[source], areas)
    facing = unit(graph.means(graph.normals, 2))
    height = _height(graph, facing)
    way = ways(facing @ straight_from_asset(mesh).T)
    boxy = graph.areas[way >= 0].sum() > _BOXY * graph.areas.sum()
    seams = _seams(graph, _without_speckles(graph, _colors(mesh, fine, kept, graph.spacing)))
    piece = _pieces(graph, height, (height > (_GROOVE if boxy else _FAINT)) | seams)
    if not boxy:
        piece = with_lobes_whole(graph, piece, height)
    piece = with_sides_parted(graph, piece, way, _LEAST)
    piece = with_frames_shared_out(graph, piece, facing)
    on_faces = fine.on_sources(_of_faces(piece, faces), areas)
    piece = with_faces_joined(graph, piece, facing, Rays(places, whole), on_faces)
    piece = with_fronts_parted(graph, piece, facing)
    return fine.on_sources(_of_faces(piece, faces), areas)


def _pieces(graph: SkinGraph, height: FloatArray, barrier: BoolArray) -> IntArray:
    """(V,) labels 0.. of what (V,) barriers part, and large ones sharp edges; strips are none."""
    piece = graph.pieces(barrier)
    area = np.bincount(piece, graph.areas * ~barrier)
    barrier = barrier | ((area > _BIG * graph.areas.sum())[piece] & (height < -_EDGE))
    piece = graph.filled(graph.pieces(barrier), barrier, _LEAST)
    return graph.filled(piece, _narrow(graph, piece)[piece], _LEAST)


def _height(graph: SkinGraph, facing: FloatArray) -> FloatArray:
    """(V,) how far the surroundings' mean lies above each vertex along (V, 3) `facing`, in their radii."""
    steps = int(np.clip(round((RADIUS * graph.size / graph.spacing) ** 2 / 2), 2, _STEPS))
    above = np.einsum("vi,vi->v", graph.means(graph.places, steps) - graph.places, facing)
    return graph.means(above / (graph.spacing * np.sqrt(steps)), 1)


def _narrow(graph: SkinGraph, label: IntArray) -> BoolArray:
    """(P,) which pieces are narrow strips between others."""
    # About two edges of a mesh of triangles cross each of its spacings.
    border = graph.borders(label).sum(axis=1) * graph.spacing / 2
    return np.asarray(np.bincount(label, graph.areas) < _NARROW * graph.size * border)


def _seams(graph: SkinGraph, colors: FloatArray) -> BoolArray:
    """(V,) whether a vertex lies where two regions of other colours meet."""
    a, b = graph.edges.T
    seam = np.zeros(len(colors), dtype=np.bool_)
    seam[graph.edges[np.abs(colors[a] - colors[b]).max(axis=1) > _SEAM]] = True
    region = graph.filled(graph.pieces(seam), seam, _LEAST_COLORED)
    found = np.zeros(len(colors), dtype=np.bool_)
    found[graph.edges[region[a] != region[b]]] = True
    return found


def _without_speckles(graph: SkinGraph, colors: FloatArray) -> FloatArray:
    """(V, 3) colours; where many vertices differ from those around them, none does."""
    middle = graph.medians(colors)
    speckles = np.abs(colors - middle).max(axis=1) > _SEAM
    return middle if speckles.mean() > _SPECKLED else colors


def _colors(mesh: Mesh, fine: Refined, kept: IntArray, width: float) -> FloatArray:
    """(V, 3) sRGB 0..1 of the vertices, as a face of each shows it; textures are averaged over `width`."""
    from ..drawing.appearance import Appearance

    at = np.zeros(len(fine.places), dtype=np.int64)
    at[fine.faces.ravel()] = np.arange(fine.faces.size)
    face, side = np.divmod(at, 3)
    looks = Appearance(mesh if mesh.normals is not None else with_normals(mesh))
    weights = fine.weights[face, side].astype(np.float32)
    widths = np.full(len(at), width, dtype=np.float32)
    linear = looks.colors(kept[fine.source[face]], weights, widths)[:, :3]
    return linear_to_srgb(linear.astype(np.float64))


def _of_faces(label: IntArray, faces: IntArray) -> IntArray:
    """(F,) the label that most of each face's (F, 3) vertices have."""
    a, b, c = label[faces].T
    return np.asarray(np.where(b == c, b, a))
