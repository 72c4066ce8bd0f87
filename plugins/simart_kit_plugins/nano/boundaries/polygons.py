"""A triangle with further corners on its sides, as triangles."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray, IntArray


def triangulated(points: FloatArray, sides: Sequence[int]) -> IntArray:
    """(N - 2, 3) triangles of a polygon, wound like it and none without area.

    Args:
        points: (N, 3) corners, all on the sides of a triangle.
        sides: of each, the sides that it is on, a bit each.
    """
    apart = np.linalg.norm(points[:, None] - points[None], axis=2)
    mask = np.array(sides)
    open_polygons, triangles = [list(range(len(points)))], []
    while open_polygons:
        polygon = open_polygons.pop()
        if len(polygon) == 3:
            triangles.append(polygon)
            continue
        ids = np.array(polygon)
        # A cut between corners of one side would leave a piece without area.
        cost = np.where(mask[ids][:, None] & mask[ids][None], np.inf, apart[np.ix_(ids, ids)])
        next_one = np.roll(np.arange(len(ids)), -1)
        cost[np.arange(len(ids)), next_one] = cost[next_one, np.arange(len(ids))] = np.inf
        low, high = sorted(divmod(int(cost.argmin()), len(ids)))
        open_polygons += [polygon[low : high + 1], polygon[high:] + polygon[: low + 1]]
    return np.array(triangles)
