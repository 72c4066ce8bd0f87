"""The part of a mesh around some of its faces, numbered anew: small where little is in doubt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class Region:
    """The wanted faces, and those that touch them.

    Attributes:
        face_ids: (F,) ids in the mesh, ascending.
        vertex_ids: (V,) ids in the mesh, ascending.
        points: (V, 3) [m].
        faces: (F, 3) corners as numbers in the region.
        wanted: (F,) whether the face is wanted, and not only beside one.
        inner: (V,) whether the vertex is a corner of a wanted face.
    """

    face_ids: IntArray
    vertex_ids: IntArray
    points: FloatArray
    faces: IntArray
    wanted: BoolArray
    inner: BoolArray

    def faces_here(self, face_ids: IntArray) -> IntArray:
        """Numbers in the region of faces of the mesh."""
        return np.searchsorted(self.face_ids, face_ids)


def region_around(points: FloatArray, faces: IntArray, wanted: BoolArray) -> Region:
    """The region of the (F,) wanted ones of (F, 3) faces on (V, 3) points [m]."""
    inner = np.zeros(len(points), dtype=np.bool_)
    inner[faces.take(np.flatnonzero(wanted), axis=0)] = True
    a, b, c = inner.take(faces).T
    face_ids = np.flatnonzero(a | b | c)
    around = faces.take(face_ids, axis=0)
    used = np.zeros(len(points), dtype=np.bool_)
    used[around] = True
    vertex_ids = np.flatnonzero(used)
    here = np.zeros(len(points), dtype=np.int64)
    here[vertex_ids] = np.arange(len(vertex_ids))
    return Region(
        face_ids,
        vertex_ids,
        points.take(vertex_ids, axis=0),
        here.take(around),
        wanted[face_ids],
        inner[vertex_ids],
    )
