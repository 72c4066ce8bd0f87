"""Words for colours, as people use them for things."""

from __future__ import annotations

import colorsys

import numpy as np

from simart_kit.arrays import FloatArray

# Grey below this saturation or in the dark, and the hues [degrees] at which one word gives way to the next.
_GREY, _DARK, _LIGHT = 0.16, 0.16, 0.85
_HUES = ((15, "red"), (42, "orange"), (68, "yellow"), (165, "green"), (200, "cyan"), (255, "blue"))
_LATER = ((290, "purple"), (335, "pink"), (361, "red"))
# A colour counts for a part when it covers this share of its surface.
_FAIR = 0.1


def color_word(color: tuple[int, int, int]) -> str:
    """The word for an sRGB colour, 0..255."""
    hue, saturation, value = colorsys.rgb_to_hsv(*(channel / 255 for channel in color))
    if value < _DARK:
        return "black"
    if saturation < _GREY:
        return "white" if value > _LIGHT else "grey" if value > 2 * _DARK else "black"
    degrees = hue * 360
    word = next(word for end, word in (*_HUES, *_LATER) if degrees < end)
    # Dark or dull orange and yellow are what people call brown.
    return "brown" if word in ("orange", "yellow") and value * saturation < 0.62 else word


def fair_shares(words: list[str], areas: FloatArray) -> tuple[str, ...]:
    """The words that cover a fair share of an area, the largest share first.

    Args:
        words: one a face or surface.
        areas: (N,) of the same.
    """
    total = dict.fromkeys(words, 0.0)
    for word, area in zip(words, areas, strict=True):
        total[word] += float(area)
    least = _FAIR * float(np.sum(areas))
    return tuple(sorted((w for w in total if total[w] >= least), key=lambda w: (-total[w], w)))
