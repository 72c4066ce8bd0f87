"""Which points of a surface can be seen from outside: what a generated or scanned skin still has."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray
from simart_kit.voxels import GridFrame, voxelise

# A surface is behind others where no empty cell beside its own is joined to the outside.
_CELLS = 48
# The grid begins so many cells before the object: no side of its bounding box may lie between two cells,
# both of which it would fill.
_BEFORE = 2.37


def visible(points: FloatArray, triangles: FloatArray) -> BoolArray:
    """(N,) whether air from outside the object comes next to each point.

    Args:
        points: (N, 3) on the surface, in the cube -0.5..0.5.
        triangles: (F, 3, 3) the whole surface, in the same cube.
    """
    from scipy.ndimage import binary_dilation, label

    frame = GridFrame((-0.5 - _BEFORE / _CELLS,) * 3, 1 / _CELLS, _CELLS + 5)
    solid = voxelise(triangles, frame).occupancy
    air, _ = label(~solid)
    outside = binary_dilation(air == air[0, 0, 0], iterations=1)
    cells = np.clip(np.floor(frame.to_grid(points)).astype(np.int64), 0, _CELLS + 4)
    return np.asarray(outside[tuple(cells.T)])
