"""Fronts that are alike: twins of such that open, and rows, in one plane and seen from the same side."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .fronts import Front
from .scene import FACINGS, Scene

_SAME = 0.02  # of their longer side by which the sizes of twins may differ
_LEVEL = 0.004  # diagonals by which twins may be out of line


def same_plane_axes(front: Front) -> tuple[int, int, int]:
    """Axes of the aligned frame: the normal of a front, and the two in its plane."""
    u, v, w = (int(np.abs(row).argmax()) for row in FACINGS[front.facing])
    return w, u, v


def alike(scene: Scene, one: Front, other: Front) -> bool:
    """Whether two fronts towards one side, or its opposite, are of one size."""
    if one.piece == other.piece or same_plane_axes(one)[0] != same_plane_axes(other)[0]:
        return False
    sizes = scene.boxes[one.piece].size, scene.boxes[other.piece].size
    return bool((np.abs(sizes[0] - sizes[1]) <= _SAME * sizes[0].max()).all())


def twins(scene: Scene, found: Sequence[Front], fronts: Sequence[Front]) -> list[Front]:
    """Those of `fronts` that have a twin among those `found`, and are not among them."""
    known = {front.piece for front in found}
    return [
        front
        for front in fronts
        if front.piece not in known
        and any(alike(scene, front, other) and _in_row(scene, front, other) for other in found)
    ]


def rows(scene: Scene, fronts: Sequence[Front], count: int) -> list[list[Front]]:
    """Groups of at least so many fronts that are alike and in one row or column with the first."""
    left, found = list(fronts), list[list[Front]]()
    while left:
        first = left[0]
        row = [
            one for one in left if one is first or (alike(scene, one, first) and _in_row(scene, one, first))
        ]
        left = [one for one in left if all(one is not other for other in row)]
        if len(row) >= count:
            found.append(row)
    return found


def _in_row(scene: Scene, one: Front, other: Front) -> bool:
    """Whether two fronts are in one plane, and level or upright with each other."""
    apart = np.abs(scene.boxes[one.piece].center - scene.boxes[other.piece].center)
    normal, *within = same_plane_axes(one)
    return bool(apart[normal] <= _LEVEL and apart[within].min() <= _LEVEL)
