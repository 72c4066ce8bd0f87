"""Numerals and letters in a picture: where they stand, and how they are drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import BoolArray
from simart_kit.colors import Color

if TYPE_CHECKING:
    from PIL import ImageDraw, ImageFont

INK: Color = (25, 28, 34)
PAPER: Color = (255, 255, 255)
SIZE = 19
"""Height of the letters of a badge [pixels]."""
_PAD = 4
_TURNS = np.deg2rad(np.arange(0, 360, 20))
_REACHES = (0, 26, 40, 56, 76, 100, 130)

Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Badge:
    """A short text in a box.

    Attributes:
        text: such as "12".
        spot: (x, y) that it speaks of [pixels].
        color: of its border, and of the line to its spot.
        on_spot: whether the box may cover the spot.
    """

    text: str
    spot: tuple[float, float]
    color: Color
    on_spot: bool = True


def inner_spot(mask: BoolArray) -> tuple[tuple[float, float], float]:
    """The (x, y) pixel of a (H, W) mask that is deepest inside it, and how deep that is [pixels]."""
    from scipy.ndimage import distance_transform_edt

    depth = distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1]
    row, column = np.unravel_index(int(depth.argmax()), depth.shape)
    return (float(column), float(row)), float(depth[row, column])


def draw_badges(draw: ImageDraw.ImageDraw, badges: Sequence[Badge], size: tuple[int, int]) -> None:
    """Draw badges where they do not cover each other; one that stands off its spot has a line to it.

    Args:
        draw: of the picture.
        badges: the first get the best places.
        size: width and height that they must stay within [pixels].
    """
    placed = places(badges, size)
    for badge, box in zip(badges, placed, strict=True):  # lines first: none crosses a box
        _draw_line(draw, badge, box)
    for badge, box in zip(badges, placed, strict=True):
        draw.rounded_rectangle(box, 4, PAPER, badge.color, 2)
        middle = ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
        draw.text(middle, badge.text, INK, font(SIZE), anchor="mm")


def places(badges: Sequence[Badge], size: tuple[int, int]) -> tuple[Box, ...]:
    """The (left, top, right, bottom) of each badge [pixels]; arguments are those of `draw_badges`."""
    placed: list[Box] = []
    spots = [badge.spot for badge in badges]
    for badge in badges:
        placed.append(_place(badge, placed, spots, size))
    return tuple(placed)


@lru_cache(maxsize=8)
def font(size: int) -> ImageFont.FreeTypeFont:
    """The letters of all pictures."""
    from PIL import ImageFont

    found = ImageFont.load_default(size)
    assert isinstance(found, ImageFont.FreeTypeFont)
    return found


def _draw_line(draw: ImageDraw.ImageDraw, badge: Badge, box: Box) -> None:
    x, y = badge.spot
    if box[0] <= x <= box[2] and box[1] <= y <= box[3]:
        return
    middle = ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
    draw.line([badge.spot, middle], PAPER, 4)
    draw.line([badge.spot, middle], INK, 2)
    draw.ellipse((x - 4, y - 4, x + 4, y + 4), badge.color, INK, 1)


def _place(
    badge: Badge, placed: Sequence[Box], spots: Sequence[tuple[float, float]], size: tuple[int, int]
) -> Box:
    """The nearest box to the spot that covers no other box and no other's spot; else the least bad."""
    best, least = (0.0, 0.0, 0.0, 0.0), np.inf
    half = _half_width(badge.text)
    for reach in _REACHES if badge.on_spot else _REACHES[1:]:
        for turn in _TURNS if reach else _TURNS[:1]:
            x = badge.spot[0] + reach * np.cos(turn)
            y = badge.spot[1] + reach * np.sin(turn)
            box = _box(half, float(x), float(y))
            if min(box[0], box[1]) < 1 or box[2] > size[0] - 1 or box[3] > size[1] - 1:
                continue
            others = sum(_inside(box, spot) for spot in spots if spot != badge.spot)
            cost = reach / 1000 + sum(_overlap(box, other) for other in placed) + 0.5 * others
            if cost < least:
                best, least = box, cost
        if least < 0.4:
            break
    return best if np.isfinite(least) else _box(half, *badge.spot)


def _half_width(text: str) -> float:
    return font(SIZE).getlength(text) / 2 + _PAD + 1


def _box(half: float, x: float, y: float) -> Box:
    return (x - half, y - SIZE / 2 - _PAD, x + half, y + SIZE / 2 + _PAD)


def _overlap(one: Box, two: Box) -> float:
    """Share of a box that another covers, counted as much when it is only touched."""
    width = min(one[2], two[2]) - max(one[0], two[0]) + 3
    height = min(one[3], two[3]) - max(one[1], two[1]) + 3
    return 0.5 + width * height / 600 if width > 0 and height > 0 else 0.0


def _inside(box: Box, spot: tuple[float, float]) -> bool:
    return box[0] - 2 <= spot[0] <= box[2] + 2 and box[1] - 2 <= spot[1] <= box[3] + 2
