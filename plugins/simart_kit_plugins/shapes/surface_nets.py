"""Surface nets: a function on a grid to the closed surface where it is zero."""

from __future__ import annotations

from itertools import combinations, product

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray
from simart_kit.topology import without_gaps

# Crossings stay so far from the points of the grid, as a share of a cell at values of 1: no face is a point.
_LEAST = 0.02
# The cells about an edge of the grid, counter-clockwise seen from its end: steps along the next two axes.
_AROUND = ((-1, -1), (0, -1), (0, 0), (-1, 0))


def surface_nets(values: FloatArray) -> tuple[FloatArray, IntArray]:
    """The closed surface about the points of a grid at which a function is negative.

    A cell with points on both sides has one vertex, at the mean of where its edges cross zero. A grid edge
    between the sides has one quad, of the four cells about it (Gibson, "Constrained Elastic Surface Nets",
    1998). Each edge of the surface has exactly two faces, and the faces at a vertex are one fan.

    Args:
        values: (X, Y, Z), not negative at the border.

    Returns:
        (V, 3) vertices, with points of the grid at whole numbers, and (F, 3) faces that look out.

    Raises:
        ValueError: the function is negative at the border of the grid.
    """
    solid = well_composed(values < 0)
    if np.count_nonzero(solid) > np.count_nonzero(solid[1:-1, 1:-1, 1:-1]):
        raise ValueError("a closed surface needs a grid that is larger than it")
    signed = np.where(solid, np.minimum(values, -_LEAST), np.maximum(values, _LEAST))
    found = [_crossings(signed, solid, axis) for axis in range(3)]
    places = np.repeat(np.concatenate([places for places, _ in found]), 4, axis=0)
    cells, corner = without_gaps(np.concatenate([quads for _, quads in found]).ravel())
    count = np.bincount(corner, minlength=len(cells))
    vertices = np.column_stack([np.bincount(corner, column, len(cells)) / count for column in places.T])
    quads = corner.reshape(-1, 4)
    return vertices, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def well_composed(solid: BoolArray) -> BoolArray:
    """Turn on points until no two of them meet at an edge or a corner only, nor two that are off.

    The border of such a solid is a surface without places where it touches itself (Latecki, "3D Well-Composed
    Pictures", 1997).

    Args:
        solid: (X, Y, Z) cells.
    """
    solid = solid.copy()
    before = -1
    while before != (before := int(np.count_nonzero(solid))):
        for axes in combinations(range(3), 2):
            _join_edges(np.moveaxis(solid, axes, (0, 1)))
        _join_corners(solid)
    return solid


def _join_edges(solid: BoolArray) -> None:
    """Turn on one more of two by two cells along the first axes that are on across the corner only."""
    one, two, three, four = solid[:-1, :-1], solid[1:, :-1], solid[1:, 1:], solid[:-1, 1:]
    rising, falling = one & three & ~two & ~four, two & four & ~one & ~three
    two |= rising
    one |= falling


def _join_corners(solid: BoolArray) -> None:
    """Turn on one more of two by two by two cells of which two across the middle are alone on, or off."""
    size = np.array(solid.shape) - 1
    cells = {
        steps: solid[tuple(slice(step, step + length) for step, length in zip(steps, size, strict=True))]
        for steps in product((0, 1), repeat=3)
    }
    on = np.sum([cell.view(np.int8) for cell in cells.values()], axis=0, dtype=np.int8)
    for y, z in product((0, 1), repeat=2):
        one, two, beside = cells[0, y, z], cells[1, 1 - y, 1 - z], cells[1, y, z]
        alone_on, alone_off = one & two & (on == 2), ~one & ~two & (on == 6)
        beside |= alone_on
        one |= alone_off


def _crossings(values: FloatArray, solid: BoolArray, axis: int) -> tuple[FloatArray, IntArray]:
    """Where the grid's edges along an axis cross zero, (E, 3), and the (E, 4) cells about each, outward.

    A cell has the number that the lowest of its points has in the flat grid.
    """
    low, high = [slice(None)] * 3, [slice(None)] * 3
    low[axis], high[axis] = slice(0, -1), slice(1, None)
    start = np.argwhere(solid[tuple(low)] != solid[tuple(high)])
    end = start + np.eye(3, dtype=np.int64)[axis]
    below, above = values[tuple(start.T)], values[tuple(end.T)]
    places = start.astype(np.float64)
    places[:, axis] += below / (below - above)
    strides = np.array([values.shape[1] * values.shape[2], values.shape[2], 1])
    second, third = strides[(axis + 1) % 3], strides[(axis + 2) % 3]
    steps = np.array([i * second + j * third for i, j in _AROUND])
    quads = (start @ strides)[:, None] + steps
    return places, np.where(below[:, None] < 0, quads, quads[:, ::-1])
