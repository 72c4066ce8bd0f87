"""Fronts of furniture: panels in the plane of x and z, from y = 0 (back) to y = -thick (front)."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from .dice import Dice
from .outlines import SQUARE, rounded
from .placing import Y, pointed
from .primitives import Pieces, box, boxes, loft, prism, sheet


def front(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A panel of a random make, its middle at x = z = 0."""
    if min(width, height) < 6 * thick:
        return slab(dice, width, height, thick)
    make = dice.weighted(
        [(9, slab), (4, framed), (2, glazed), (1, louvred), (1, bowed), (2, raised), (1, planked), (1, thin)]
    )
    return make(dice, width, height, thick)


def slab(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A plain board; some with bevelled edges or round corners."""
    style = dice.unit()
    if style < 0.75:
        return [box((width, thick, height), (0, -thick / 2, 0))]
    if style < 0.88:
        outline = rounded(dice.between(0.02, 0.15) * min(1.0, width / height), height / width)
        return [pointed(prism(outline, (height, width, thick)), Y) - [0, thick / 2, 0]]
    return [_pyramid(width, height, thick, dice.between(0.3, 1.0) * thick)]


def frame(width: float, height: float, thick: float, border: float) -> FloatArray:
    """Four boards about an opening."""
    x, z = (width - border) / 2, (height - border) / 2
    middle = -thick / 2
    uprights = boxes((border, thick, height), [(-x, middle, 0), (x, middle, 0)])
    rails = boxes((width - 2 * border, thick, border), [(0, middle, -z), (0, middle, z)])
    return np.concatenate([uprights, rails])


def framed(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A frame about a thinner panel."""
    border = min(width, height) * dice.between(0.08, 0.22)
    inner = thick * dice.between(0.2, 0.7)
    panel = box((width - 2 * border, inner, height - 2 * border), (0, -thick / 2, 0))
    return [frame(width, height, thick, border), panel]


def glazed(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A frame with bars about a pane, or about nothing."""
    border = min(width, height) * dice.between(0.06, 0.2)
    wide, high = width - 2 * border, height - 2 * border
    pieces = [frame(width, height, thick, border)]
    if dice.chance(0.75):
        pieces.append(box((wide, thick * dice.pick((0.02, 0.1, 0.3)), high), (0, -thick / 2, 0)))
    bar = border * dice.between(0.3, 0.6)
    if dice.chance(0.35):
        levels = np.linspace(-high / 2, high / 2, dice.whole(1, 3) + 2)[1:-1]
        pieces.append(boxes((wide, thick * 0.8, bar), [(0, -thick / 2, z) for z in levels]))
    if dice.chance(0.3):
        pieces.append(box((bar, thick * 0.8, high), (0, -thick / 2, 0)))
    return pieces


def louvred(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A frame with slats, which may slope."""
    border = min(width, height) * dice.between(0.05, 0.12)
    wide, high = width - 2 * border, height - 2 * border
    levels = np.linspace(-high / 2, high / 2, 2 * dice.whole(3, 10) + 1)[1::2]
    step = high / len(levels)
    slats = boxes((wide, thick * 0.3, step * dice.between(0.5, 1.1)), [(0, 0, 0)] * len(levels))
    slats = slats.reshape(len(levels), -1, 3)
    slats[..., 1] += slats[..., 2] * dice.between(0, min(0.8, thick / step)) - thick / 2
    slats[..., 2] += levels[:, None]
    return [frame(width, height, thick, border), slats.reshape(-1, 3, 3)]


def bowed(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A board bent about z."""
    along = np.linspace(-1, 1, 9)
    bend = min(width, height) * dice.between(-0.08, 0.15) * (1 - along**2)
    outer, inner = -thick - bend, -bend
    loop = np.column_stack(
        [np.concatenate([along, along[::-1]]) * width / 2, np.concatenate([outer, inner[::-1]])]
    )
    return [loft(loop, [(0, 1, -height / 2), (1, 1, -height / 2), (1, 1, height / 2), (0, 1, height / 2)])]


def raised(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A board with one or two raised or sunken fields."""
    back = thick * dice.between(0.4, 0.7)
    count, margin = dice.whole(1, 2), min(width, height) * dice.between(0.08, 0.2)
    share = height / count
    field = _pyramid(width - 2 * margin, share - 1.6 * margin, thick - back, margin * 0.3)
    centers = [(0, -back, -height / 2 + (k + 0.5) * share) for k in range(count)]
    return [box((width, back, height), (0, -back / 2, 0)), *(field + np.array(c) for c in centers)]


def planked(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """Boards side by side with gaps, held by rails behind."""
    count = dice.whole(3, 8)
    step = width / count
    places = [(-width / 2 + (k + 0.5) * step, -0.7 * thick, 0) for k in range(count)]
    planks = boxes((step * dice.between(0.6, 0.97), 0.6 * thick, height), places)
    rails = boxes(
        (width * 0.95, 0.4 * thick, height * 0.08), [(0, -0.2 * thick, s * height / 3) for s in (-1, 1)]
    )
    return [planks, rails]


def thin(dice: Dice, width: float, height: float, thick: float) -> Pieces:
    """A sheet without thickness, with or without folded edges."""
    x, z = width / 2, height / 2
    plane = np.array([[[-x, -thick, -z], [-x, -thick, z]], [[x, -thick, -z], [x, -thick, z]]])
    if dice.chance(0.5):
        return [sheet(plane)]
    return [sheet(plane), frame(width, height, thick, thick * 0.3)]


def _pyramid(width: float, height: float, thick: float, bevel: float) -> FloatArray:
    """A board with its front edges bevelled."""
    slope = min(bevel, 0.45 * width, 0.45 * height)
    skin = loft(
        SQUARE,
        [
            (0, 0, 0),
            (width, height, 0),
            (width, height, thick / 2),
            (width - 2 * slope, height - 2 * slope, thick),
            (0, 0, thick),
        ],
    )
    return skin[..., [0, 2, 1]] * [1, -1, 1]
