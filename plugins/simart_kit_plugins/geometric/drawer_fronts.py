"""Which fronts are drawers' although nothing is modelled behind them: by shape, grip and neighbours."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .fronts import Front
from .scene import FACINGS, Scene

STRIP = 2.5  # so many times as wide as high a front is no flap
_LOW = 1.6  # so many times as wide as high a drawer is
_HIGH = 1.2  # the same of deep ones, as of filing cabinets, in a column
_WINDOW = 0.3  # share of a front from which on what lies in it is a window
_MIDDLE = 0.2  # of its width or height, how far from its middle the grip of a drawer is at most
_EDGES = 0.05  # of its width by which the sides of drawers above one another may be out of line
_LEVEL = 0.03  # diagonals between their edges, and half of what is between their planes


def like_drawer(front: Front) -> bool:
    """A low, wide front with its handles in the middle: the box behind was left out of the model.

    What is so wide that it is no flap may have them higher or lower. None is an upright bar, as on doors.
    """
    if front.held is None or front.upright or not _low(front):
        return False
    up = abs(float(front.held[1]))
    return not held_aside(front) and (up < _MIDDLE or _times(front) > STRIP)


def stacked(scene: Scene, fronts: Sequence[Front]) -> set[int]:
    """Pieces of wide fronts that lie above one another, equally wide; the grip tells of high ones."""
    wide = [front for front in fronts if _low(front) or _drawn_out(scene, front)]
    return {one.piece for one in wide for other in wide if one is not other and _above(one, other)}


def held_aside(front: Front) -> bool:
    """Whether its grip is near one side, as that of a car's door below its window."""
    return front.held is not None and abs(float(front.held[0])) >= _MIDDLE


def _drawn_out(scene: Scene, front: Front) -> bool:
    """Whether a front that is not quite low has its grip in the middle of its upper half, and no window.

    With a window it is an oven's door.
    """
    if front.held is None or _times(front) < _HIGH or held_aside(front):
        return False
    sizes = [scene.boxes[inlay].turned(FACINGS[front.facing]).size[:2] for inlay in front.inlays]
    return float(front.held[1]) > 0 and all(size.prod() < _WINDOW * front.area for size in sizes)


def _times(front: Front) -> float:
    """How many times as wide as high it is."""
    return float(front.box.size[0] / front.box.size[1])


def _low(front: Front) -> bool:
    return _times(front) >= _LOW


def _above(one: Front, other: Front) -> bool:
    """Whether one of two fronts lies right above the other, edge over edge."""
    ends = np.abs([one.box.lower - other.box.lower, one.box.upper - other.box.upper])
    between = max(one.box.lower[1] - other.box.upper[1], other.box.lower[1] - one.box.upper[1])
    in_row = one.facing == other.facing and ends[:, 0].max() < _EDGES * one.box.size[0]
    return bool(in_row and ends[:, 2].max() < 2 * _LEVEL and abs(between) < _LEVEL)
