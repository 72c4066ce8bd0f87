"""Things of many pieces of which none moves: cushions, plants, figures, rows of like things, boards and bars.

Most meshes that somebody drops into a simulator are such: that pieces lie apart does not make them parts.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes import legs
from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import around, moved, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, loft, prism, revolve, rod, superquadric, tube, vessel
from . import looks
from .category import Category
from .contraptions import decorated
from .objects import Body, root, surface

NAME = "heap"


def _solid(dice: Dice, size: FloatArray) -> FloatArray:
    """A box, a cushion, a ball or a cylinder of a (3,) size about 0."""
    style = dice.unit()
    if style < 0.3:
        return box(size)
    if style < 0.7:
        return superquadric(size, dice.between(0.2, 1.0), dice.between(0.2, 1.0), 6)
    return prism(dice.pick((ngon(12), rounded(0.3))), size)


def _tipped(dice: Dice, piece: FloatArray, most: float) -> FloatArray:
    axis = np.array([dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)])
    return turned([piece], rotation(axis, dice.between(0, most)))[0]


def _cluster(dice: Dice) -> Pieces:
    """Solids that lie on and in each other."""
    spread, pieces = np.array([1.0, dice.between(0.3, 1), dice.between(0.2, 1)]), []
    for _ in range(dice.whole(2, 14)):
        size = np.array([dice.spread(0.08, 0.7) for _ in range(3)])
        place = spread * [dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), dice.between(0, 0.8)]
        pieces.append(_tipped(dice, _solid(dice, size), dice.pick((0.0, 0.3, 3.0))) + place)
    return pieces


def _plant(dice: Dice) -> Pieces:
    """A pot, stems, and leaves or balls on them."""
    wide, high = dice.between(0.15, 0.5), dice.between(0.15, 0.5)
    pieces = [vessel(ngon(16), (wide, wide, high), 0.02, dice.between(0.8, 1.5))]
    pieces.append(cylinder(0.4 * wide, 0.05, 14) + [0, 0, 0.8 * high])
    for _ in range(dice.whole(2, 12)):
        lean = np.array([dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), dice.between(0.3, 1.0)])
        start = np.array([0.0, 0.0, 0.8 * high])
        pieces.append(tube([start, start + lean * [0.3, 0.3, 0.6], start + lean], 0.012))
        for share in (1.0, 0.7, 0.5)[: dice.whole(1, 3)]:
            size = np.array([dice.between(0.05, 0.3), dice.between(0.03, 0.15), dice.pick((0.008, 0.1))])
            pieces.append(_tipped(dice, superquadric(size, 1, 1, 5), 3.0) + start + share * lean)
    return pieces


def _figure(dice: Dice) -> Pieces:
    """A body with a head and limbs, some sitting or lying."""
    wide = dice.between(0.2, 0.4)
    pieces = [superquadric((wide, 0.6 * wide, 0.6), 0.6, 0.8) + [0, 0, 0.9]]
    pieces.append(superquadric((0.2, 0.22, 0.26), 1, 1) + [0, 0, 1.35])
    if dice.chance(0.5):
        pieces.append(superquadric((0.23, 0.25, 0.15), 0.8, 1) + [0, 0.02, 1.45])
    for side in (-1, 1):
        hand = np.array([side * dice.between(0.2, 0.6), dice.between(-0.4, 0.2), dice.between(0.5, 1.2)])
        foot = np.array([side * dice.between(0.05, 0.3), dice.between(-0.5, 0.1), dice.between(0.0, 0.4)])
        for end, start, thick in (
            (hand, [side * 0.5 * wide, 0, 1.15], 0.05),
            (foot, [side * 0.1, 0, 0.65], 0.08),
        ):
            middle = (np.array(start) + end) / 2 + [0.05 * side, dice.between(-0.15, 0.15), 0]
            pieces.append(tube([start, middle, end], thick, 8))
            if dice.chance(0.7):
                pieces.append(superquadric((0.1, 0.2, 0.08), 0.7, 0.9, 5) + end)
    lies = dice.chance(0.25)
    return turned(pieces, rotation((1, 0, 0), np.pi / 2)) if lies else pieces


def _array(dice: Dice) -> Pieces:
    """The same thing in a row, a grid, a stack or a ring, mostly on or in something."""
    size = np.array([dice.spread(0.05, 0.3), dice.spread(0.05, 0.3), dice.spread(0.05, 0.5)])
    one = [_solid(dice, size)]
    if dice.chance(0.4):
        one.append(_solid(dice, size * 0.4) + [0, 0, 0.6 * size[2]])
    style, step = dice.unit(), size * dice.between(0.95, 1.5)
    if style < 0.25:
        pieces = around(moved(one, (0.2 + size[0], 0, 0)), dice.whole(3, 10))
    else:
        count = np.array([dice.whole(1, 6), dice.whole(1, 3), dice.whole(1, 3)])
        pieces = []
        for place in np.ndindex(*count):
            jitter = rotation((0, 0, 1), dice.between(-0.2, 0.2) * (style > 0.7))
            pieces += moved(turned(one, jitter), step * (np.array(place) - (count - 1) / 2))
    points = np.concatenate(pieces).reshape(-1, 3)
    low, extent = points.min(axis=0), np.ptp(points, axis=0)
    middle = [(low[0] + extent[0] / 2), (low[1] + extent[1] / 2), low[2] - 0.02]
    if dice.chance(0.6):
        tray = vessel(SQUARE, (*(1.1 * extent[:2]), dice.between(0.03, 0.2)), 0.015)
        pieces.append((tray if dice.chance(0.6) else box((*(1.2 * extent[:2]), 0.04))) + middle)
    return pieces


def _boards(dice: Dice) -> Pieces:
    """Boards, bars and cushions, the same on both sides, on legs: what seats, beds and racks are made of."""
    wide, deep, high = dice.between(0.4, 1.6), dice.between(0.3, 0.9), dice.between(0.2, 0.6)
    pieces = moved(legs.feet(dice, wide, deep, high), (0, 0, high))
    pieces.append(box((wide, deep, dice.between(0.02, 0.12)), (0, 0, high)))
    for _ in range(dice.whole(0, 3)):
        size = (dice.between(0.03, 0.2), deep * dice.between(0.5, 1.0), dice.between(0.03, 0.4))
        side = _solid(dice, np.array(size))
        x, z = wide * dice.between(0.2, 0.5), high + dice.between(0, 0.4)
        pieces += [side + [s * x, 0, z] for s in (-1, 1)]
    for k in range(dice.whole(0, 4)):
        size = (wide * dice.between(0.2, 0.9), deep * dice.between(0.3, 0.9), dice.between(0.06, 0.2))
        cushion = superquadric(size, 0.3, 0.3, 6) + [dice.between(-0.2, 0.2) * wide, 0, high + 0.1 + 0.1 * k]
        pieces.append(cushion)
    if dice.chance(0.6):
        back = [box((wide, 0.05, dice.between(0.2, 0.7)))]
        if dice.chance(0.5):
            back = [
                rod((x, 0, -0.3), (x, 0, 0.3), 0.02)
                for x in np.linspace(-0.45, 0.45, dice.whole(3, 9)) * wide
            ]
        pieces += moved(
            turned(back, rotation((1, 0, 0), dice.between(-0.5, 0.1))), (0, deep / 2, high + 0.35)
        )
    return pieces


def _turned_piece(dice: Dice) -> Pieces:
    """Vases, lamps, stands: round things on each other."""
    pieces, level = [], 0.0
    for _ in range(dice.whole(1, 6)):
        high = dice.spread(0.03, 0.6)
        rise = np.linspace(0, high, 5)
        radius = np.array([dice.between(0.03, 0.3) for _ in rise])
        line = np.column_stack([[0, *radius, 0], [0, *rise, high]]) + [0, level]
        pieces.append(revolve(line, dice.whole(8, 20)))
        level += high * dice.between(0.9, 1.02)
    if dice.chance(0.5):
        shade = loft(ngon(16), [(0.3, 0.3, level), (dice.between(0.2, 0.6),) * 2 + (level - 0.25,)])
        pieces.append(shade)
    return pieces


_MAKES: Sequence[tuple[float, Callable[[Dice], Pieces]]] = (
    (3, _cluster),
    (2, _plant),
    (2, _figure),
    (3, _array),
    (4, _boards),
    (2, _turned_piece),
)


def _heap(dice: Dice) -> Sequence[Body]:
    if dice.chance(0.4):
        return decorated(dice)
    pieces = dice.weighted(_MAKES)(dice)
    low = min(float(piece[..., 2].min()) for piece in pieces)
    size = dice.spread(0.1, 1.6)
    pieces = [size * (piece - [0, 0, low]) for piece in pieces]
    makes = [
        dice.pick((looks.wood, looks.plastic, looks.fabric, looks.metal, looks.ceramic)) for _ in range(3)
    ]
    colors = [make(dice) for make in makes[: dice.whole(1, 3)]]
    owner = [dice.whole(0, len(colors) - 1) for _ in pieces]
    parts = [[p for p, k in zip(pieces, owner, strict=True) if k == n] for n in range(len(colors))]
    return [root([surface(part, color) for part, color in zip(parts, colors, strict=True) if part])]


CATEGORIES = (Category(NAME, _heap, moves=False),)
