"""Closed polygons about 0 that a square of edge 1 just holds."""

from __future__ import annotations

from functools import cache

import numpy as np

from simart_kit.arrays import FloatArray, frozen_floats

SQUARE = frozen_floats([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])


@cache
def ngon(sides: int) -> FloatArray:
    """(sides, 2) regular polygon of radius 0.5."""
    angle = np.arange(sides) * (2 * np.pi / sides)
    return frozen_floats(0.5 * np.column_stack([np.cos(angle), np.sin(angle)]))


def rounded(radius: float, aspect: float = 1.0, steps: int = 3) -> FloatArray:
    """(4 (steps + 1), 2) square with round corners.

    Args:
        radius: of the corners, 0..0.5, along x.
        aspect: width by depth of the outline in use, so that its corners come out circular.
        steps: segments of a corner.
    """
    across, up = radius, min(radius * aspect, 0.5)
    angle = np.linspace(0, np.pi / 2, steps + 1)
    corner = np.column_stack([np.cos(angle), np.sin(angle)])
    turns = (corner, corner[::-1] * [-1, 1], -corner, corner[::-1] * [1, -1])
    middles = ((1, 1), (-1, 1), (-1, -1), (1, -1))
    room = np.array([0.5 - across, 0.5 - up])
    return np.concatenate([turn * [across, up] + room * m for turn, m in zip(turns, middles, strict=True)])


def half_round(steps: int = 8) -> FloatArray:
    """(steps + 1, 2) upper half of a circle and its diameter, centred."""
    angle = np.linspace(0, np.pi, steps + 1)
    return np.column_stack([0.5 * np.cos(angle), np.sin(angle) - 0.5])
