"""Lines that leaves turn about beyond their edges: through two pins, or along a post."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray

from .candidates import Candidate, Choice
from .rounds import is_rod
from .scene import Box
from .views import View

_ON_EDGE = 0.02  # diagonals from an edge within which a pin is on it
_LEVEL = 0.01  # diagonals by which two pins may be out of line


def pivot(view: View, hardware: Sequence[Box]) -> Choice | None:
    """About the line through two pins alike, on opposite edges and away from their ends."""
    for along in (0, 1):
        low, high = (_pins(view.box, hardware, along, end) for end in (view.box.lower, view.box.upper))
        across = [_pins(view.box, hardware, 1 - along, end) for end in (view.box.lower, view.box.upper)]
        if len(low) == 1 and len(high) == 1 and not any(across) and _pair(view.box, low[0], high[0], along):
            axis = np.zeros(3)
            axis[along] = 1.0
            origin = np.asarray((low[0].center + high[0].center) / 2)
            candidate = Candidate("revolute", axis, origin, np.pi / 2)
            return candidate, 0.7, ("a pin on either side, at one height",)
    return None


def on_post(hinge: Candidate, panel: Box, posts: Sequence[Box]) -> Candidate:
    """The hinge, about the axis of the round post beside it where there is one: the leaf hangs on that."""
    if hinge.edge not in ("left", "right"):
        return hinge
    for post in posts:
        beside = post.lower[0] - _ON_EDGE <= hinge.origin[0] <= post.upper[0] + _ON_EDGE
        as_high = post.lower[1] <= panel.lower[1] + _ON_EDGE and post.upper[1] >= panel.upper[1] - _ON_EDGE
        if beside and as_high and panel.lower[2] <= post.center[2] <= panel.upper[2]:
            return replace(hinge, origin=np.array([post.center[0], hinge.origin[1], post.center[2]]))
    return hinge


def is_post(points: FloatArray) -> bool:
    """Whether (N, 3) points are of an upright round rod."""
    size = np.ptp(points, axis=0)
    return bool(size[2] > 4 * size[:2].max()) and is_rod(points, 2)


def _pins(panel: Box, hardware: Sequence[Box], axis: int, end: FloatArray) -> list[Box]:
    """Those on one edge of a panel."""
    other = 1 - axis
    return [
        box
        for box in hardware
        if box.lower[axis] - _ON_EDGE <= end[axis] <= box.upper[axis] + _ON_EDGE
        and panel.lower[other] <= box.center[other] <= panel.upper[other]
        and box.lower[2] <= panel.upper[2] + _ON_EDGE
        and box.upper[2] >= panel.lower[2] - _ON_EDGE
    ]


def _pair(panel: Box, one: Box, other: Box, along: int) -> bool:
    across = 1 - along
    place = (one.center[across] - panel.lower[across]) / panel.size[across]
    level = np.abs(one.center - other.center)[[across, 2]].max() < _LEVEL
    return bool(level and 0.2 < place < 0.8 and (np.abs(one.size - other.size) < _LEVEL).all())
