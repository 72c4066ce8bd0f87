"""Colours beside those of parts: of segments, and of what was before."""

from __future__ import annotations

import colorsys

import numpy as np

from simart_kit.arrays import ByteArray
from simart_kit.colors import Color

BEFORE: Color = (150, 150, 150)
# Steps of the golden ratio around the colour circle: neighbours differ, however many there are.
_STEP = 0.61803398875


def segment_colors(count: int) -> ByteArray:
    """(count, 3) colours of segments, of which there may be thousands."""
    return np.array([_segment_color(i) for i in range(count)], dtype=np.uint8).reshape(-1, 3)


def faded(color: Color, alpha: int) -> tuple[int, int, int, int]:
    """The colour with an opacity, 0..255."""
    return (*color, alpha)


def _segment_color(index: int) -> Color:
    """Saturation and brightness change as well as hue."""
    saturation, value = (0.45, 0.65, 0.8)[index % 3], (0.95, 0.8, 0.65)[index // 3 % 3]
    r, g, b = (round(255 * v) for v in colorsys.hsv_to_rgb(index * _STEP % 1.0, saturation, value))
    return (r, g, b)
