"""Which faces lie so near to a part's end that it may run elsewhere among them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray
from simart_kit.topology import connected

from .links import Links

# Half-way into a thin piece of a part begins what is kept for it.
_DEEP = 0.5


@dataclass(frozen=True, eq=False)
class Band:
    """The faces about the ends of parts.

    Attributes:
        free: (F,) faces whose part may change.
        depth: (F,) way to the nearest end of the face's part [m]; infinite beyond the band.
        other: (F,) the part on the other side of that end; -1 beyond the band.
    """

    free: BoolArray
    depth: FloatArray
    other: IntArray


def band(around: Links, face_part: IntArray, breadth: FloatArray, reach: float) -> Band:
    """Find the faces within `reach` of another part.

    Args:
        around: of all faces.
        face_part: (F,) their parts.
        breadth: (F,) longest way through each face [m]; those that are broader than the band are kept.
        reach: how far the end of a part may move [m].
    """
    apart = face_part[around.left] != face_part[around.right]
    depth, nearest = _depths(around, apart, len(face_part), reach)
    other = np.full(len(face_part), -1, dtype=np.int64)
    other[around.left[apart]] = face_part[around.right[apart]]
    other[around.right[apart]] = face_part[around.left[apart]]
    other = np.where(nearest >= 0, other[nearest], -1)
    piece = connected(len(face_part), around.left[~apart], around.right[~apart])
    deepest = np.zeros(int(piece.max(initial=-1)) + 1)
    np.maximum.at(deepest, piece, np.minimum(depth, reach / _DEEP))
    free = (depth < reach) & (depth < _DEEP * deepest[piece]) & (breadth < reach)
    return Band(free, depth, other)


def _depths(around: Links, apart: BoolArray, count: int, reach: float) -> tuple[FloatArray, IntArray]:
    """(F,) way to the nearest face at an end of its own part [m], and that face; inf and -1 beyond reach."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    depth, nearest = np.full(count, np.inf), np.full(count, -1, dtype=np.int64)
    starts = np.unique(np.concatenate([around.left[apart], around.right[apart]]))
    if len(starts):
        left, right = around.left[~apart], around.right[~apart]
        graph = coo_array((np.maximum(around.ways[~apart], 1e-12), (left, right)), shape=(count, count))
        found = dijkstra(
            graph.tocsr(),
            directed=False,
            indices=starts,
            min_only=True,
            limit=reach,
            return_predecessors=True,
        )
        depth, nearest = np.asarray(found[0]), np.asarray(found[2], dtype=np.int64)
    return depth, np.where(np.isfinite(depth), nearest, -1)
