"""Profiles and sheets that hollow things are made of."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from .dice import Dice


def smooth_wall(dice: Dice, knots: int, narrowest: float) -> FloatArray:
    """(12, 2) radius `narrowest`..1 and height 0..1 of a wall without corners."""
    heights = np.linspace(0, 1, 12)
    radii = np.interp(heights, np.linspace(0, 1, knots), narrowest + (1 - narrowest) * dice.units(knots))
    soft = np.convolve(np.pad(radii, 1, mode="edge"), [0.25, 0.5, 0.25], mode="valid")
    return np.column_stack([soft, heights])


def hollow(wall: FloatArray, thick: float) -> FloatArray:
    """(2 K + 2, 2) profile of a vessel: its outer wall upwards, then its inner one down to the axis."""
    inner = wall[::-1] - [thick, 0]
    inner[-1, 1] += thick
    bottom = [[0.0, wall[0, 1]]]
    return np.concatenate([bottom, wall, np.maximum(inner, [0.0, -np.inf]), [[0.0, inner[-1, 1]]]])


def pierced(width: float, height: float, radius: float, level: float) -> FloatArray:
    """A sheet at y = 0 from z = 0 up, with a round hole at a level."""
    angle = np.linspace(0, 2 * np.pi, 25)
    x, z = np.cos(angle), np.sin(angle)
    reach = 1 / np.maximum(np.abs(x), np.abs(z))
    edge_z = np.where(z > 0, height - level, level)
    zero = np.zeros_like(x)
    outer = np.column_stack([x * reach * width / 2, zero, z * reach * edge_z + level])
    inner = np.column_stack([x * radius, zero, z * radius + level])
    a, b, c, d = outer[:-1], outer[1:], inner[1:], inner[:-1]
    return np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3, 3)
