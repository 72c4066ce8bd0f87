"""Voxels of the parts of an object, several times as fast as one by one.

Rectangles along the axes are filled; what is left of all parts goes to the voxeliser in one call.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray
from simart_kit.voxels import GridFrame, voxelise

from .rectangles import fill, split

_TILES = tuple(product((0, 1), repeat=3))


def occupancies(parts: Sequence[FloatArray], frame: GridFrame) -> BoolArray:
    """(P, R, R, R) what `voxelise` gives of each part; all parts must lie inside the frame."""
    flat, others = zip(*(split(part) for part in parts), strict=True)
    batches = [others[start : start + len(_TILES)] for start in range(0, len(others), len(_TILES))]
    grids = np.concatenate([_side_by_side(batch, frame) for batch in batches])
    for grid, rectangles in zip(grids, flat, strict=True):
        fill(grid, frame, rectangles)
    return grids


def _side_by_side(parts: Sequence[FloatArray], frame: GridFrame) -> BoolArray:
    """Up to eight parts in the corners of one grid of twice the size."""
    if len(parts) == 1:
        return voxelise(parts[0], frame).occupancy[None]
    cells = frame.resolution
    # A cell between the tiles: what lies on a tile's border touches the cell beyond.
    firsts = np.array(_TILES[: len(parts)]) * (cells + 1)
    steps = firsts * frame.voxel_size
    triangles = np.concatenate([part + step for part, step in zip(parts, steps, strict=True)])
    grid = voxelise(triangles, GridFrame(frame.origin, frame.voxel_size, 2 * cells + 1)).occupancy
    return np.stack([grid[x : x + cells, y : y + cells, z : z + cells] for x, y, z in firsts])
