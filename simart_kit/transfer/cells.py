"""Points in the cells of a coarse grid: what holds for a whole cell need not be asked of each point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray

_WIDER = 1.25


@dataclass(frozen=True, eq=False)
class Cells:
    """The cells that points lie in.

    Attributes:
        centers: (C, 3) [m].
        radius: from a center to the corners of its cell [m].
        of_point: (N,) cell of each point, 0..C-1.
    """

    centers: FloatArray
    radius: float
    of_point: IntArray


def cells_of(points: FloatArray, edge: float) -> Cells:
    """The occupied cells of the grid with this `edge` [m] over (N, 3) points [m], at least one point.

    The edge is made longer where the grid would have more cells than there are points.
    """
    low = np.array([column.min() for column in points.T])
    extent = np.array([column.max() for column in points.T]) - low
    while np.prod(np.floor(extent / edge) + 1) > len(points):
        edge *= _WIDER
    shape = np.floor(extent / edge).astype(np.int64) + 1
    place = np.zeros(len(points), dtype=np.int64)
    for column, least, length in zip(points.T, low, shape, strict=True):
        place *= length
        place += ((column - least) / edge).astype(np.int64)
    occupied = np.zeros(shape.prod(), dtype=np.bool_)
    occupied[place] = True
    cells = np.flatnonzero(occupied)
    number = np.cumsum(occupied) - 1
    centers = low + (np.stack(np.unravel_index(cells, shape), axis=1) + 0.5) * edge
    return Cells(centers, edge * float(np.sqrt(3)) / 2, number.take(place))
