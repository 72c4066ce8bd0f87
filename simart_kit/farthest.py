"""Which of very many points lies farthest in each of many directions, without asking all of them."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, IntArray
from .topology import stable_order

_FEW = 30_000
_CELLS = 32  # along each axis
_CHUNK = 4_000_000  # products held in memory at once


def farthest(points: FloatArray, directions: FloatArray) -> IntArray:
    """(K,) index of the farthest of (N, 3) points in each of (K, 3) directions, the first of several."""
    cells = _Cells(points) if len(points) > _FEW else None
    products = len(directions) * (len(points) if cells is None else len(cells.starts))
    chunks = np.array_split(directions, max(1, products // _CHUNK))
    if cells is None:
        return np.concatenate([(chunk @ points.T).argmax(axis=1) for chunk in chunks])
    return np.concatenate([cells.farthest(chunk) for chunk in chunks])


class _Cells:
    """Points sorted into the cells of a grid: a box tells how far a cell's points can lie at most."""

    def __init__(self, points: FloatArray) -> None:
        low, extent = points.min(axis=0), np.maximum(np.ptp(points, axis=0), 1e-300)
        place = np.minimum((points - low) / extent * _CELLS, _CELLS - 1).astype(np.int64)
        self._order, cell = stable_order((place[:, 0] * _CELLS + place[:, 1]) * _CELLS + place[:, 2])
        self._points = points.take(self._order, axis=0)
        self.starts = np.flatnonzero(np.r_[True, cell[1:] != cell[:-1]])
        self._ends = np.r_[self.starts[1:], len(cell)]
        self._low = np.minimum.reduceat(self._points, self.starts, axis=0)
        self._high = np.maximum.reduceat(self._points, self.starts, axis=0)

    def farthest(self, directions: FloatArray) -> IntArray:
        """(K,) index of the farthest point in each of (K, 3) directions."""
        most = np.maximum(directions, 0) @ self._high.T + np.minimum(directions, 0) @ self._low.T
        return np.array(
            [self._best(direction, reach) for direction, reach in zip(directions, most, strict=True)]
        )

    def _best(self, direction: FloatArray, reach: FloatArray) -> int:
        """Index of the farthest point in a (3,) direction, in which the cells reach (C,) at most."""
        first = int(reach.argmax())
        along = self._points[self.starts[first] : self._ends[first]] @ direction
        # Sums of three products may differ in their last digits.
        cells = np.flatnonzero(reach >= along.max() - 1e-12 * np.abs(reach).max())
        rows = np.concatenate([np.arange(self.starts[c], self._ends[c]) for c in cells])
        along = self._points.take(rows, axis=0) @ direction
        return int(self._order[rows[along == along.max()]].min())
