"""The pieces of a surface that parts are made of, and which of them a point lies on."""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..mesh import Mesh
from ..segments import find_segments
from ..stages import Segmentation


def pieces_of(segmentation: Segmentation, given: Mesh) -> IntArray:
    """(F,) number of the piece of each face: the segmenter's own pieces, else the mesh's segments.

    Args:
        segmentation: whose `mesh_of(given)` the faces are of.
        given: the mesh that the segmenter was given.
    """
    if segmentation.face_segment is not None:
        return segmentation.face_segment
    return find_segments(segmentation.mesh_of(given)).face_segment


def whole_pieces(pieces: IntArray, faces: BoolArray) -> tuple[int, ...] | None:
    """The pieces that (F,) faces are; None where they end inside a piece."""
    inside, outside = np.unique(pieces[faces]), np.unique(pieces[~faces])
    return None if np.isin(inside, outside).any() else tuple(inside.tolist())


def nearest_face(mesh: Mesh, point: FloatArray) -> int:
    """The face nearest to a (3,) point [m]."""
    a, b, c = np.moveaxis(mesh.triangles, 1, 0)
    return int(np.argmin(((point - _nearest_points(point, a, b, c)) ** 2).sum(axis=1)))


def _nearest_points(point: FloatArray, a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """(F, 3) the point of each triangle nearest to a point: within it, else on one of its sides."""
    normal = np.cross(b - a, c - a)
    square = np.maximum((normal**2).sum(axis=1), 1e-300)
    flat = point - normal * (((point - a) * normal).sum(axis=1) / square)[:, None]
    inside = np.ones(len(a), dtype=np.bool_)
    best, least = np.zeros_like(a), np.full(len(a), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        side = end - start
        inside &= (np.cross(side, flat - start) * normal).sum(axis=1) >= 0
        length = np.maximum((side**2).sum(axis=1), 1e-300)
        along = np.clip(((point - start) * side).sum(axis=1) / length, 0, 1)
        found = start + along[:, None] * side
        distance = ((point - found) ** 2).sum(axis=1)
        nearer = distance < least
        best[nearer], least[nearer] = found[nearer], distance[nearer]
    # A triangle without area has no inside.
    inside &= (normal**2).sum(axis=1) > 0
    return np.asarray(np.where(inside[:, None], flat, best))
