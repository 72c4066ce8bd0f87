"""Bodies of any make, blocks, posts, frames, cases, seats or hulls, and where fittings may go on them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes import legs
from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import rotation
from ...shapes.primitives import Pieces, box, boxes, cylinder, open_box, prism, revolve, superquadric
from .assembling import shell

# Turns that bring what stands off to -y to the front, the right, the back, the left and the top.
_SIDES = tuple(rotation((0, 0, 1), k * np.pi / 2) for k in range(4))
_TOP = rotation((1, 0, 0), -np.pi / 2)


@dataclass(frozen=True, eq=False)
class Site:
    """A place for a fitting.

    Attributes:
        origin: (3,) its middle.
        turn: (3, 3) from the fitting's frame.
        wide, high: its room.
        open: whether nothing is behind it.
    """

    origin: FloatArray
    turn: FloatArray
    wide: float
    high: float
    open: bool = False

    def cells(self, columns: int, rows: int) -> list[Site]:
        """Side by side and on top of each other, with a little room between."""
        wide, high = self.wide / columns, self.high / rows
        spots = [
            ((column - (columns - 1) / 2) * wide, 0.0, (row - (rows - 1) / 2) * high)
            for row in range(rows)
            for column in range(columns)
        ]
        return [
            replace(self, origin=self.origin + self.turn @ np.array(spot), wide=0.9 * wide, high=0.9 * high)
            for spot in spots
        ]

    def turned(self, quarters: int) -> Site:
        """The same with what was upright lying."""
        wide, high = (self.high, self.wide) if quarters % 2 else (self.wide, self.high)
        turn = self.turn @ rotation((0, 1, 0), quarters * np.pi / 2)
        return replace(self, turn=turn, wide=wide, high=high)

    def scaled(self, size: float) -> Site:
        """The same on a body so many times as large."""
        return replace(self, origin=size * self.origin, wide=size * self.wide, high=size * self.high)


Frame = tuple[Pieces, list[Site]]


def _box_sites(low: FloatArray, high: FloatArray, is_round: bool = False) -> list[Site]:
    """The four sides and the top of a box; only their middles where it is round."""
    middle, size = (low + high) / 2, high - low
    share = 0.5 if is_round else 0.94
    sites = []
    for k, turn in enumerate(_SIDES):
        out, wide = size[1 - k % 2] / 2, size[k % 2]
        # A fitting lies against the outermost line of what is round.
        sites.append(Site(middle + turn @ [0, -out, 0], turn, share * wide, 0.94 * size[2]))
    top = Site(middle + [0, 0, size[2] / 2], _TOP, 0.94 * size[0], 0.94 * size[1])
    return [*sites, Site(top.origin, _TOP, 0.66 * size[0], 0.66 * size[1]) if is_round else top]


def _blocks(dice: Dice) -> Frame:
    """One to three blocks on or beside each other."""
    pieces: Pieces = []
    sites: list[Site] = []
    low = np.zeros(3)
    for left in range(dice.weighted([(5, 1), (3, 2), (1, 3)]), 0, -1):
        size = np.array([dice.spread(0.25, 1), dice.spread(0.2, 1), dice.spread(0.15, 1)])
        style = dice.unit()
        outline = SQUARE if style < 0.6 else rounded(0.15) if style < 0.8 else ngon(dice.whole(8, 20))
        if style >= 0.8:
            size[1] = size[0]
        high = low + size
        pieces.append(prism(outline, size) + (low + high) / 2)
        front, right, back, aside, top = _box_sites(low, high, style >= 0.8)
        on_it = dice.chance(0.5)  # and not to its right
        low = np.array([low[0], low[1], high[2]] if on_it else [high[0], low[1], low[2]])
        sites += [front, back, aside]
        sites += [right, top] if left == 1 else [right] if on_it else [top]
    return pieces, sites


def _post(dice: Dice) -> Frame:
    """A column on a foot, some with a block on it."""
    thick, high = dice.between(0.06, 0.2), dice.between(0.5, 1.2)
    foot = dice.between(0.25, 0.6)
    flat = 0.2 * thick
    pieces: Pieces = [box((foot, foot * dice.between(0.5, 1), flat), (0, 0, flat / 2))]
    low, top = np.array([-thick / 2, -thick / 2, flat]), np.array([thick / 2, thick / 2, high + flat])
    is_round = dice.chance(0.5)
    column = cylinder(thick / 2, high, 14) if is_round else box((thick, thick, high))
    pieces.append(column + (low + top) / 2)
    sites = _box_sites(low, top, is_round)
    if dice.chance(0.5):
        size = np.array([dice.between(0.2, 0.6), dice.between(0.15, 0.5), dice.between(0.1, 0.4)])
        low = np.array([-size[0] / 2, -size[1] / 2, high + flat])
        pieces.append(box(size, low + size / 2))
        sites = [*sites[:-1], *_box_sites(low, low + size)]
    return pieces, sites


def _bench(dice: Dice) -> Frame:
    """A slab on legs."""
    wide, deep, high = dice.between(0.5, 1.2), dice.between(0.3, 0.8), dice.between(0.3, 0.9)
    thick = dice.between(0.04, 0.2)
    pieces = [piece + [0, 0, high] for piece in legs.feet(dice, wide, deep, high)]
    low = np.array([-wide / 2, -deep / 2, high])
    pieces.append(box((wide, deep, thick), (0, 0, high + thick / 2)))
    return pieces, _box_sites(low, low + [wide, deep, thick])


def _frame(dice: Dice) -> Frame:
    """An upright frame of bars with one to three openings."""
    wide, high, thick = dice.between(0.4, 1.2), dice.between(0.4, 1.2), dice.between(0.03, 0.12)
    deep = thick * dice.between(0.5, 2)
    count = dice.whole(1, 3)
    places = np.linspace(-wide / 2, wide / 2, count + 1)
    pieces: Pieces = [boxes((thick, deep, high), [(x, deep / 2, high / 2) for x in places])]
    levels = [thick / 2, high - thick / 2] if dice.chance(0.8) else [thick / 2]
    pieces += [box((wide, 0.8 * deep, thick), (0, deep / 2, z)) for z in levels]
    turn, clear = _SIDES[0], wide / count - thick
    sites = [
        Site(np.array([x, 0.0, high / 2]), turn, clear + 0.6 * thick, high - 1.4 * thick, True)
        for x in (places[1:] + places[:-1]) / 2
    ]
    return pieces, sites


def _tub(dice: Dice) -> Frame:
    """An open box; its mouth may be covered."""
    wide, deep, high = dice.spread(0.3, 1), dice.spread(0.3, 1), dice.spread(0.2, 1)
    wall = min(wide, deep) * dice.between(0.02, 0.08)
    sites = _box_sites(np.array([-wide / 2, -deep / 2, 0]), np.array([wide / 2, deep / 2, high]))
    mouth = Site(sites[4].origin, _TOP, wide, deep, True)
    return [open_box((wide, deep, high), wall)], [*sites[:4], mouth]


def _plank(dice: Dice) -> Frame:
    """A long bar, lying or upright."""
    long, deep, high = dice.between(0.7, 1.4), dice.between(0.05, 0.25), dice.between(0.05, 0.25)
    size = np.array([long, deep, high] if dice.chance(0.6) else [high, deep, long])
    outline = SQUARE if dice.chance(0.6) else rounded(0.25)
    sites = _box_sites(-size / 2, size / 2)
    return [prism(outline, size)], sites


def _case(dice: Dice) -> Frame:
    """A box with an open front, some with boards in it."""
    wide, deep, high = dice.spread(0.3, 1), dice.spread(0.25, 0.7), dice.spread(0.3, 1.2)
    wall = min(wide, high) * dice.between(0.02, 0.07)
    pieces: Pieces = [shell(wide, deep, high, wall)]
    inside = wide - 2 * wall
    levels = np.linspace(0, high, dice.whole(0, 3) + 2)[1:-1]
    pieces += [box((inside, 0.85 * deep, wall), (0, 0.05 * deep, z)) for z in levels]
    sites = _box_sites(np.array([-wide / 2, -deep / 2, 0]), np.array([wide / 2, deep / 2, high]))
    return pieces, [replace(sites[0], open=True), *sites[1:]]


def _seat(dice: Dice) -> Frame:
    """A slab on legs with a back, some with arms."""
    pieces, sites = _bench(dice)
    low, high = pieces[-1].min(axis=(0, 1)), pieces[-1].max(axis=(0, 1))
    wide, deep, _ = high - low
    tall, thick = dice.between(0.2, 0.8), 0.1 * deep
    back = np.array([low[0], high[1] - thick, high[2]]), np.array([high[0], high[1], high[2] + tall])
    pieces.append(box(back[1] - back[0], (back[0] + back[1]) / 2))
    for side in (-1, 1) if dice.chance(0.5) else ():
        size = (0.12 * wide, dice.between(0.5, 0.9) * deep, dice.between(0.3, 0.7) * tall)
        pieces.append(box(size, ((high[0] - 0.06 * wide) * side, 0, high[2] + size[2] / 2)))
    # Only what is before the back of the seat's top is free.
    top = replace(sites[-1], origin=sites[-1].origin - [0, thick, 0], wide=0.7 * wide, high=0.75 * deep)
    return pieces, [*sites[:-1], top, *_box_sites(*back)[1:]]


def _pot(dice: Dice) -> Frame:
    """Something round and upright with a flat top: a bottle, a pot, a drum."""
    rise = np.cumsum([0, *(dice.between(0.05, 0.5) for _ in range(3))])
    radius = np.array([dice.between(0.15, 0.5) for _ in rise])
    line = np.column_stack([[0, *radius, 0], [0, *rise, rise[-1]]])
    sites = _box_sites(np.array([-radius[-1], -radius[-1], 0]), np.array([radius[-1], radius[-1], rise[-1]]))
    return [revolve(line, dice.whole(12, 24))], [replace(sites[4], wide=2 * radius[-1], high=2 * radius[-1])]


def _hull(dice: Dice) -> Frame:
    """A long rounded body with flat wings or fins."""
    long, thick = dice.between(0.8, 1.5), dice.between(0.15, 0.35)
    pieces: Pieces = [superquadric((thick, long, thick), dice.between(0.4, 1.0), dice.between(0.4, 1.0), 8)]
    nose = Site(np.array([0, -long / 2, 0]), _SIDES[0], 0.6 * thick, 0.6 * thick)
    sites = [nose]
    for _ in range(dice.whole(1, 3)):
        reach, deep, flat = dice.between(0.2, 0.8), dice.between(0.15, 0.4), thick * dice.between(0.06, 0.25)
        y, turn = dice.between(-0.3, 0.3) * long, rotation((0, 1, 0), dice.pick((0, 0, 0.5)) * np.pi)
        for side in (-1, 1) if dice.chance(0.8) else (1,):
            middle = np.array([side * (0.3 * thick + reach / 2), y, 0])
            pieces.append(box((reach, deep, flat), middle) @ turn.T)
            edge = turn @ (middle + [0, deep / 2, 0])
            sites.append(Site(edge, turn @ _SIDES[2], 0.9 * reach, flat))
    return pieces, sites


FRAMES: Sequence[tuple[float, Callable[[Dice], Frame]]] = (
    (6, _blocks),
    (2, _post),
    (2, _bench),
    (2, _frame),
    (2, _tub),
    (2, _plank),
    (3, _case),
    (2, _seat),
    (1.5, _pot),
    (2, _hull),
)
