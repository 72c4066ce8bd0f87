"""Rectangles along the axes, most of what furniture is made of: their voxels are a box of cells each."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray
from simart_kit.voxels import GridFrame

# Slack on the borders of cells, in voxels, as in `voxelise`.
_SLACK = 1e-9


def split(triangles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Triangles 2k and 2k + 1 that are the halves of a rectangle along the axes, and all others.

    Args:
        triangles: (F, 3, 3) corners.

    Returns:
        (N, 2, 3) lowest and highest corners of the rectangles, and the (M, 3, 3) other triangles.
    """
    pairs = triangles[: len(triangles) // 2 * 2].reshape(-1, 6, 3)
    low, high = pairs.min(axis=1), pairs.max(axis=1)
    at_high = pairs == high[:, None]
    # Halves of one rectangle miss opposite corners of it: of the six corners, three lie at the end of each of
    # its sides, and all at the end of the flat direction.
    at_corners = (at_high | (pairs == low[:, None])).all(axis=(1, 2))
    ends = at_high.sum(axis=1)
    halves = at_corners & (np.sort(ends, axis=1) == [3, 3, 6]).all(axis=1)
    code = (at_high @ np.array([1, 2, 4])).reshape(-1, 2, 3)
    halves &= (code != np.roll(code, 1, axis=2)).all(axis=(1, 2))
    others = np.concatenate([pairs[~halves].reshape(-1, 3, 3), triangles[2 * len(pairs) :]])
    return np.stack([low[halves], high[halves]], axis=1), others


def fill(grid: BoolArray, frame: GridFrame, rectangles: FloatArray) -> None:
    """Turn on the cells of an (R, R, R) grid whose closed box (N, 2, 3) rectangles touch."""
    places = frame.to_grid(rectangles)
    first = np.maximum(np.ceil(places[:, 0] - _SLACK) - 1, 0).astype(int)
    end = np.minimum(np.floor(places[:, 1] + _SLACK) + 1, frame.resolution).astype(int)
    for (x, y, z), (to_x, to_y, to_z) in zip(first.tolist(), end.tolist(), strict=True):
        grid[x:to_x, y:to_y, z:to_z] = True
