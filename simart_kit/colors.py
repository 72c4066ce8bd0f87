"""The colours of parts, the same in every picture and recording."""

from __future__ import annotations

Color = tuple[int, int, int]
"""sRGB, 0..255."""

BODY: Color = (168, 160, 150)
# Told apart by hue, and on light ground.
_PALETTE: tuple[Color, ...] = (
    (37, 116, 232),
    (242, 138, 18),
    (22, 163, 98),
    (226, 61, 98),
    (133, 84, 224),
    (8, 166, 190),
    (176, 142, 8),
    (208, 80, 180),
    (110, 160, 30),
    (150, 98, 62),
)
_SHADES = (1.0, 0.72, 0.5)


def part_color(index: int) -> Color:
    """Colour of a part by its index; the first, most often the body, is grey.

    Where there are more parts than hues, these come again in darker shades.
    """
    if index == 0:
        return BODY
    turn, hue = divmod(index - 1, len(_PALETTE))
    r, g, b = (round(_SHADES[turn % len(_SHADES)] * value) for value in _PALETTE[hue])
    return (r, g, b)
