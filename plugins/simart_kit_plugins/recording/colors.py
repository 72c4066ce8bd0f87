"""Colours: one a part, the same in every view."""

from __future__ import annotations

import colorsys

import numpy as np

from simart_kit.arrays import ByteArray

Color = tuple[int, int, int, int]
BEFORE: Color = (150, 150, 150, 255)
_BODY: Color = (168, 160, 150, 255)
# Steps of the golden ratio around the colour circle: neighbours differ, however many there are.
_STEP = 0.61803398875


def part_color(index: int) -> Color:
    """Colour of a part by its index; the first, most often the body, is grey."""
    return _BODY if index == 0 else _hue(0.02 + index * _STEP, 0.62, 0.95)


def part_colors(count: int) -> ByteArray:
    """(count, 4) colours of the first parts."""
    return np.array([part_color(i) for i in range(count)], dtype=np.uint8).reshape(-1, 4)


def segment_color(index: int) -> Color:
    """Colour of one of many: saturation and brightness change too."""
    return _hue(index * _STEP, (0.45, 0.65, 0.8)[index % 3], (0.95, 0.8, 0.65)[index // 3 % 3])


def segment_colors(count: int) -> ByteArray:
    """(count, 4) colours of segments, of which there may be thousands."""
    return np.array([segment_color(i) for i in range(count)], dtype=np.uint8).reshape(-1, 4)


def faded(color: Color, alpha: int) -> Color:
    """The colour with another opacity, 0..255."""
    return (*color[:3], alpha)


def srgb_factor(linear: tuple[float, float, float, float]) -> Color:
    """A material's linear RGBA factor as sRGB bytes."""
    rgb = np.clip(np.array(linear[:3]), 0.0, 1.0)
    encoded = np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1 / 2.4) - 0.055)
    r, g, b = (round(255 * float(v)) for v in encoded)
    return (r, g, b, round(255 * min(max(linear[3], 0.0), 1.0)))


def _hue(hue: float, saturation: float, value: float) -> Color:
    r, g, b = (round(255 * v) for v in colorsys.hsv_to_rgb(hue % 1.0, saturation, value))
    return (r, g, b, 255)
