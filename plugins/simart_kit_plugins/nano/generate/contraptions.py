"""Things that are nothing in particular: bodies of any make with fittings anywhere on them.

What moves, and how, shows in the fitting alone, not in what the thing is: who learns from these learns to
look at hinges, axles, gaps, grips and guides.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes import legs
from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import rotation
from ...shapes.primitives import Pieces, box, boxes, cylinder, open_box, prism
from . import fitted_arms, fitted_leaves, fittings, looks
from .assembling import Assembly
from .assembly import MOST_BODIES, until_moving
from .category import Category
from .fittings import Fitting, Room
from .objects import Body, Look

NAME = "contraption"

_FITTINGS: Sequence[tuple[float, Fitting]] = (
    (2, fittings.knob),
    (2, fittings.buttons),
    (1, fittings.toggle),
    (1, fittings.crank),
    (1, fittings.rotor),
    (3, fittings.wheel),
    (2, fittings.roller),
    (1, fittings.handwheel),
    (0.7, fittings.turntable),
    (1, fittings.bail),
    (1.5, fitted_arms.flat_lever),
    (3, fitted_arms.lifted_arm),
    (2.5, fitted_arms.standing_arm),
    (1, fitted_arms.jaws),
    (4, fitted_leaves.leaf),
    (1.5, fitted_leaves.pair),
    (2, fitted_leaves.drawer),
    (1.5, fitted_leaves.panel_slide),
    (1.5, fitted_leaves.slider),
    (1.5, fitted_leaves.plunger),
    (1, fitted_leaves.bolt),
    (1.5, fitted_leaves.telescope),
)
# What can hang in an opening, with nothing behind.
_HANGING: Sequence[tuple[float, Fitting]] = ((4, fitted_leaves.leaf), (2, fitted_leaves.pair))
# Turns that bring what stands off to -y to the front, the right, the back, the left and the top.
_SIDES = tuple(rotation((0, 0, 1), k * np.pi / 2) for k in range(4))
_TOP = rotation((1, 0, 0), -np.pi / 2)


@dataclass(frozen=True, eq=False)
class _Site:
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

    def cells(self, columns: int, rows: int) -> list[_Site]:
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

    def turned(self, quarters: int) -> _Site:
        """The same with what was upright lying."""
        wide, high = (self.high, self.wide) if quarters % 2 else (self.wide, self.high)
        turn = self.turn @ rotation((0, 1, 0), quarters * np.pi / 2)
        return replace(self, turn=turn, wide=wide, high=high)

    def scaled(self, size: float) -> _Site:
        """The same on a body so many times as large."""
        return replace(self, origin=size * self.origin, wide=size * self.wide, high=size * self.high)


_Frame = tuple[Pieces, list[_Site]]
_Colors = tuple[Look, Look, Look]


def _box_sites(low: FloatArray, high: FloatArray, is_round: bool = False) -> list[_Site]:
    """The four sides and the top of a box; only their middles where it is round."""
    middle, size = (low + high) / 2, high - low
    share = 0.5 if is_round else 0.94
    sites = []
    for k, turn in enumerate(_SIDES):
        out, wide = size[1 - k % 2] / 2, size[k % 2]
        # A fitting lies against the outermost line of what is round.
        sites.append(_Site(middle + turn @ [0, -out, 0], turn, share * wide, 0.94 * size[2]))
    top = _Site(middle + [0, 0, size[2] / 2], _TOP, 0.94 * size[0], 0.94 * size[1])
    return [*sites, _Site(top.origin, _TOP, 0.66 * size[0], 0.66 * size[1]) if is_round else top]


def _blocks(dice: Dice) -> _Frame:
    """One to three blocks on or beside each other."""
    pieces: Pieces = []
    sites: list[_Site] = []
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


def _post(dice: Dice) -> _Frame:
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


def _bench(dice: Dice) -> _Frame:
    """A slab on legs."""
    wide, deep, high = dice.between(0.5, 1.2), dice.between(0.3, 0.8), dice.between(0.3, 0.9)
    thick = dice.between(0.04, 0.2)
    pieces = [piece + [0, 0, high] for piece in legs.feet(dice, wide, deep, high)]
    low = np.array([-wide / 2, -deep / 2, high])
    pieces.append(box((wide, deep, thick), (0, 0, high + thick / 2)))
    return pieces, _box_sites(low, low + [wide, deep, thick])


def _frame(dice: Dice) -> _Frame:
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
        _Site(np.array([x, 0.0, high / 2]), turn, clear + 0.6 * thick, high - 1.4 * thick, True)
        for x in (places[1:] + places[:-1]) / 2
    ]
    return pieces, sites


def _tub(dice: Dice) -> _Frame:
    """An open box; its mouth may be covered."""
    wide, deep, high = dice.spread(0.3, 1), dice.spread(0.3, 1), dice.spread(0.2, 1)
    wall = min(wide, deep) * dice.between(0.02, 0.08)
    sites = _box_sites(np.array([-wide / 2, -deep / 2, 0]), np.array([wide / 2, deep / 2, high]))
    mouth = _Site(sites[4].origin, _TOP, wide, deep, True)
    return [open_box((wide, deep, high), wall)], [*sites[:4], mouth]


def _plank(dice: Dice) -> _Frame:
    """A long bar, lying or upright."""
    long, deep, high = dice.between(0.7, 1.4), dice.between(0.05, 0.25), dice.between(0.05, 0.25)
    size = np.array([long, deep, high] if dice.chance(0.6) else [high, deep, long])
    outline = SQUARE if dice.chance(0.6) else rounded(0.25)
    sites = _box_sites(-size / 2, size / 2)
    return [prism(outline, size)], sites


_FRAMES: Sequence[tuple[float, Callable[[Dice], _Frame]]] = (
    (6, _blocks),
    (2, _post),
    (2, _bench),
    (2, _frame),
    (2, _tub),
    (2, _plank),
)


def _contraption(dice: Dice) -> Sequence[Body]:
    kit, sites, colors = _begun(dice)
    left = dice.whole(1, 6)
    for group in _cells(dice, sites):
        made = dice.weighted(_HANGING if group[0].open else _FITTINGS)
        moves = left > 0 and dice.chance(0.75)
        if not moves and (group[0].open or dice.chance(0.5)):
            continue
        _fit(dice, kit, group, made if moves else fitted_leaves.decoy, colors)
        left -= moves
    return _placed(dice, kit)


def decorated(dice: Dice) -> Sequence[Body]:
    """What a contraption is without all that moves: a body with plates, ribs, handles and blocks on it."""
    kit, sites, colors = _begun(dice)
    for group in _cells(dice, sites):
        if not group[0].open and dice.chance(0.6):
            _fit(dice, kit, group, fitted_leaves.decoy, colors)
    return _placed(dice, kit)[:1]


def _begun(dice: Dice) -> tuple[Assembly, list[_Site], _Colors]:
    """The body, where fittings may go, and the looks."""
    kit, size = Assembly(), dice.spread(0.08, 1.8)
    pieces, sites = dice.weighted(_FRAMES)(dice)
    colors = _looks(dice)
    kit.fix([size * piece for piece in pieces], colors[0])
    return kit, [site.scaled(size) for site in sites], colors


def _fit(dice: Dice, kit: Assembly, group: Sequence[_Site], made: Fitting, colors: _Colors) -> None:
    """The same fitting at each of a few sites, as long as there may be more bodies."""
    quarters, seed = dice.whole(0, 3), dice.whole(0, 2**31)
    for site in group:
        there = site.turned(quarters)
        fitted = made(Dice(seed), Room(there.wide, there.high, *colors))
        if kit.count + fitted.count - 1 > MOST_BODIES:
            return
        kit.graft(fitted, there.origin, there.turn)


def _placed(dice: Dice, kit: Assembly) -> Sequence[Body]:
    """The bodies, seen from any side; some lie on their fronts or backs."""
    turn = rotation((0, 0, 1), dice.whole(0, 3) * np.pi / 2)
    if dice.chance(0.15):
        turn = turn @ rotation((1, 0, 0), dice.pick((-1, 1)) * np.pi / 2)
    return kit.done(turn)


def _cells(dice: Dice, sites: list[_Site]) -> list[list[_Site]]:
    """Groups of sites for one fitting each, in a random order: whole sides, or cells of them."""
    groups = []
    for number in sorted(range(len(sites)), key=lambda _: dice.unit()):
        site = sites[number]
        if site.open:
            groups.append([site])
            continue
        columns = min(4, max(1, round(site.wide / site.high * dice.between(0.5, 1.5))))
        rows = min(4, max(1, round(site.high / site.wide * dice.between(0.5, 1.5))))
        cells = site.cells(columns, rows)
        if dice.chance(0.5):
            groups.append(cells)
        else:
            groups += [[cell] for cell in cells]
    return groups


def _looks(dice: Dice) -> _Colors:
    """Of the body, of what moves and of grips; many things are of one colour."""
    make = dice.pick((looks.wood, looks.painted_metal, looks.plastic, looks.metal))
    base = make(dice)
    if dice.chance(0.3):
        return base, base, base
    own = dice.pick((base, looks.darker(base, 0.8), make(dice), looks.plastic(dice)))
    return base, own, dice.pick((own, looks.metal(dice), looks.plastic(dice)))


CATEGORIES = (Category(NAME, until_moving(_contraption)),)
