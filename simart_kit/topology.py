"""How faces hang together: vertices that coincide, rows that repeat, edges that are shared, pieces.

Faces are (F, 3) ids of their corners, of vertices or of whatever else they meet at.
"""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, IntArray


def weld(vertices: FloatArray, tolerance: float) -> IntArray:
    """(V,) ids 0.. such that vertices in one cell of a `tolerance` grid share an id."""
    # A floor: a quotient of subnormal numbers would overflow.
    cells = np.round((vertices - vertices.min(axis=0)) / max(tolerance, 1e-12)).astype(np.int64)
    return unique_rows(cells)[1].astype(np.int32)


def unique_rows(rows: IntArray) -> tuple[IntArray, IntArray]:
    """The rows (N, K) that differ, in ascending order, three times as fast as `numpy.unique`.

    Returns:
        Index of the first of each, and (N,) which of them every row is.
    """
    order = np.lexsort(rows.T[::-1])
    ordered = rows[order]
    new = np.ones(len(rows), dtype=np.bool_)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    ids = np.zeros(len(rows), dtype=np.int64)
    ids[order] = np.cumsum(new) - 1
    return order[new], ids


def edges(faces: IntArray) -> IntArray:
    """(F, 3) ids 0.. of the edges from each corner to the next, whichever way they are walked."""
    start, end = faces, faces[:, [1, 2, 0]]
    return unique_rows(np.sort(np.stack([start, end], axis=-1).reshape(-1, 2), axis=1))[1].reshape(-1, 3)


def neighbours(faces: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Pairs of faces that follow each other around an edge: (N,) edge, and the two faces of each."""
    edge = edges(faces).ravel()
    order = np.argsort(edge, kind="stable")
    same = np.flatnonzero(edge[order[1:]] == edge[order[:-1]])
    return edge[order[same]], order[same] // 3, order[same + 1] // 3


def touching(faces: IntArray) -> IntArray:
    """(F,) labels 0.. of faces that hang together by shared corners.

    Not by shared edges: edges with more than two faces, as repeated faces make them, would cut all apart.
    """
    used, corners = np.unique(faces, return_inverse=True)
    a, b, c = corners.reshape(-1, 3).T
    return connected(len(used), np.r_[a, b], np.r_[b, c])[a]


def connected(count: int, one: IntArray, two: IntArray) -> IntArray:
    """(count,) labels 0.. of the pieces of a graph whose links join `one` (N,) and `two` (N,)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    links = coo_array((np.ones(len(one)), (one, two)), shape=(count, count))
    return np.asarray(connected_components(links, directed=False)[1], dtype=np.int64)
