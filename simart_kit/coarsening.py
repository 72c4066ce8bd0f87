"""Fewer faces for what needs no fine ones."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, IntArray

_FINEST, _COARSEST = 512, 16  # cells along the longest side


def coarsened(vertices: FloatArray, faces: IntArray, most: int) -> tuple[FloatArray, IntArray]:
    """A surface of `most` faces or about as many: vertices that share a cell of a grid become one.

    Surfaces with no more faces come back as they are. No vertex moves by more
    than a cell's diagonal, of the finest grid that is coarse enough.

    Args:
        vertices: (V, 3) [m].
        faces: (F, 3).
        most: faces; with the coarsest grid, 1/16 of the longest side, there may be more.

    Returns:
        (W, 3) vertices and (G, 3) faces.
    """
    cells = _FINEST
    found = vertices, faces
    while len(found[1]) > most and cells >= _COARSEST:
        found, cells = _clustered(vertices, faces, cells), cells // 2
    return found


def _clustered(vertices: FloatArray, faces: IntArray, cells: int) -> tuple[FloatArray, IntArray]:
    used, corners = np.unique(faces, return_inverse=True)
    points = vertices[used]
    lower, size = points.min(axis=0), float(np.ptp(points, axis=0).max())
    place = np.minimum(((points - lower) * (cells / max(size, 1e-12))).astype(np.int64), cells - 1)
    key = (place[:, 0] * cells + place[:, 1]) * cells + place[:, 2]
    _, first, cluster = np.unique(key, return_index=True, return_inverse=True)
    merged = cluster[corners].reshape(-1, 3)
    apart = (merged[:, 0] != merged[:, 1]) & (merged[:, 1] != merged[:, 2]) & (merged[:, 2] != merged[:, 0])
    merged = merged[apart]
    # Faces that fell together count once, wound as the first of them.
    count = np.int64(len(first))
    low, middle, high = np.sort(merged, axis=1).T
    kept = np.unique((low * count + middle) * count + high, return_index=True)[1]
    return points[first], merged[np.sort(kept)]
