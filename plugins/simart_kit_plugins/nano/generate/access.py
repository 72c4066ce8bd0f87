"""What lets people and parcels through: banks of lockers, ticket gates and lifts."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.handles import knob
from ...shapes.outlines import rounded
from ...shapes.placing import at, moved, rotation
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, rod
from . import looks
from .assembling import PAD, Assembly, disc, press, swing
from .category import Category
from .machine_tools_parts import DARK
from .objects import Body, Look, hinge, slide, spin
from .rigging import FRONT, UP

_GRIDS = (
    *((2, 1), (3, 1), (4, 1), (2, 2), (3, 2), (4, 2), (2, 3), (3, 3), (4, 3), (3, 4)),
    *((6, 1), (10, 1), (5, 3), (6, 4), (4, 6), (8, 5)),
)
"""Columns and rows of a bank of lockers."""
_WALL = 0.015
"""Thickness of a locker's walls [m]."""
_DOOR_AT = 0.08
"""How far behind the middle of the wall a lift's doors run [m]."""


def _latch(dice: Dice, kit: Assembly, leaf: int, spot: FloatArray, style: float, side: int) -> None:
    """What a locker is opened by: a lock for a key, a handle that turns, a dial or a bar."""
    if style < 0.25:
        kit.fix(moved([disc(0.012, 0.008), box((0.004, 0.01, 0.014), (0, -0.01, 0))], spot), DARK, leaf)
    elif style < 0.5:
        grip = [disc(0.012, 0.02), box((0.022, 0.014, 0.075), (0, -0.024, -0.02))]
        kit.add(
            "handle",
            hinge(spot, (0, side, 0), 1.57),
            [(moved(grip, spot - [0, 0.0005, 0]), looks.metal(dice))],
            leaf,
        )
    elif style < 0.65:
        kit.fix(moved([disc(0.026, 0.004)], spot), DARK, leaf)
        kit.add("dial", spin(spot, FRONT), [(moved(knob(dice, 0.019), spot - [0, 0.0045, 0]), DARK)], leaf)
    else:
        kit.fix(moved([box((0.014, 0.02, 0.07), (0, -0.01, 0))], spot), looks.metal(dice), leaf)


@dataclass(frozen=True)
class _Doors:
    """How all doors of a bank of lockers are.

    Attributes:
        wide: of a column [m].
        tall: of a row [m].
        gap: from the edge of a column or row to a door [m].
        style: of the latch, 0..1.
        side: where the hinges are, left (-1) or right (1).
        slots: how many louvres.
        plated: whether with a number's plate.
        look: what they are made of.
    """

    wide: float
    tall: float
    gap: float
    style: float
    side: int
    slots: int
    plated: bool
    look: Look


def _carcass(
    kit: Assembly, grid: tuple[int, int], cell: tuple[float, float, float], foot: float, coat: Look
) -> None:
    """Back, upright walls and shelves about cells, on the level of a foot's top."""
    (columns, rows), (wide, tall, deep) = grid, cell
    whole, high = columns * wide + _WALL, rows * tall + _WALL
    kit.fix([box((whole, 0.01, high), (0, deep / 2 - 0.005, foot + high / 2))], coat)
    places = [-whole / 2 + _WALL / 2 + k * wide for k in range(columns + 1)]
    kit.fix([box((_WALL, deep, high), (x, 0, foot + high / 2)) for x in places], coat)
    kit.fix([box((whole, deep, _WALL), (0, 0, foot + _WALL / 2 + k * tall)) for k in range(rows + 1)], coat)


def _plinth(dice: Dice, whole: float, deep: float, foot: float) -> Pieces:
    """What lockers stand on: a block or four legs."""
    if dice.chance(0.5):
        return [box((whole - 0.06, deep - 0.06, foot), (0, 0.01, foot / 2))]
    x, y = whole / 2 - 0.03, deep / 2 - 0.03
    return [boxes((0.04, 0.04, foot), [(s * x, t * y, foot / 2) for s in (-1, 1) for t in (-1, 1)])]


def _door(dice: Dice, kit: Assembly, doors: _Doors, middle: FloatArray) -> None:
    """A door with slots, a number's plate and a latch."""
    size = (doors.wide - 2 * doors.gap, 0.014, doors.tall - 2 * doors.gap)
    leaf = [box(size, middle)]
    if doors.slots:
        louvre = box((0.45 * doors.wide, 0.004, 0.006))
        leaf += at(louvre, [middle + [0, -0.009, 0.36 * doors.tall - 0.018 * n] for n in range(doors.slots)])
    spot = middle + [0, -0.0085, 0.2 * doors.tall]
    plate = [box((0.06, 0.003, 0.025), spot)] if doors.plated else []
    edge, side = middle + [doors.side * size[0] / 2, 0, 0], doors.side
    motion = swing(side, edge[0], edge[1], dice.between(1.6, 2.2))
    number = kit.add("door", motion, [(leaf, doors.look), (plate, looks.metal(dice))])
    lock = middle + [-side * (size[0] / 2 - 0.04), -0.007, 0]
    _latch(dice, kit, number, lock, doors.style, side)


def _locker_bank(dice: Dice) -> list[Body]:
    """Columns of doors alike in a carcass, with slots in them, numbers, and a lock each."""
    kit, coat = Assembly("carcass"), looks.painted_metal(dice)
    columns, rows = dice.pick(_GRIDS)
    wide, tall = dice.between(0.26, 0.4), dice.between(1.5, 1.9) / rows
    deep, foot = dice.between(0.4, 0.55), dice.between(0.0, 0.14)
    whole = columns * wide + _WALL
    _carcass(kit, (columns, rows), (wide, tall, deep), foot, coat)
    if foot > 0.03:
        kit.fix(_plinth(dice, whole, deep, foot), DARK)
    laid, style, side = dice.chance(0.6), dice.unit(), dice.sign()
    slots, plated = dice.whole(0, 4), dice.pick((False, True, True))
    look = coat if dice.chance(0.4) else looks.painted_metal(dice)
    doors = _Doors(wide, tall, 0.004 if laid else 0.002 + _WALL / 2, style, side, slots, plated, look)
    face = -deep / 2 - (0.001 if laid else -0.014)
    for k in range(columns):
        for row in range(rows):
            x, z = -whole / 2 + _WALL / 2 + (k + 0.5) * wide, foot + _WALL / 2 + (row + 0.5) * tall
            _door(dice, kit, doors, np.array([x, face - 0.008, z]))
    return kit.done()


def _cabinet(
    kit: Assembly, x: float, size: tuple[float, float, float], skin: FloatArray | None, coat: Look
) -> None:
    """One cabinet of a gate, whole with a skin, or of two halves with a slot for panes."""
    wide, long, high = size
    if skin is not None:
        body = loft(skin, [(0, 0, 0), (wide, long, 0), (wide, long, high), (0, 0, high)])
        kit.fix([body + [x, 0, 0]], coat)
    else:
        for t in (-1, 1):
            kit.fix([box((wide, long / 2 - 0.012, high), (x, t * (long / 4 + 0.006), high / 2))], coat)
        kit.fix([box((wide, 0.03, 0.1), (x, 0, 0.05))], coat)
    kit.fix([box((0.6 * wide, 0.2, 0.012), (x, -0.38 * long, high + 0.0065))], DARK)


def _flap(kit: Assembly, edge: float, s: int, half: float, high: float, tall: float, clear: Look) -> None:
    """A leaf that swings both ways at a cabinet's edge, between two lugs."""
    pin = np.array([edge + s * 0.016, 0, high - tall / 2 - 0.1])
    leaf = [box((half - 0.05, 0.012, tall), (s * (half / 2 + 0.005), 0, 0)), cylinder(0.012, tall * 0.9)]
    lugs = [(edge, 0, pin[2] + t * 0.47 * tall + t * 0.02) for t in (-1, 1)]
    kit.fix([box((0.02, 0.04, 0.03), spot) for spot in lugs], DARK)
    kit.add("flap", hinge(pin, UP, 1.5, -1.5), [(moved(leaf, pin), clear)])


def _pane(kit: Assembly, edge: float, s: int, half: float, high: float, tall: float, clear: Look) -> None:
    """A pane that slides into a cabinet."""
    spot = (edge + s * (half / 2 - 0.03), 0, high - tall / 2 - 0.06)
    kit.add("pane", slide((-s, 0, 0), half - 0.03), [([box((half + 0.04, 0.014, tall), spot)], clear)])


def _ticket_gate(dice: Dice) -> list[Body]:
    """Cabinets with a passage between: flaps that swing, panes that slide, or a barred arm that turns."""
    kit, coat = Assembly("cabinet"), looks.painted_metal(dice)
    long, wide, high = dice.between(1.1, 1.6), dice.between(0.22, 0.3), dice.between(0.95, 1.05)
    lane, style = dice.between(0.55, 0.8), dice.unit()
    flaps, panes = style < 0.4, 0.4 <= style < 0.75
    rows = dice.pick((2, 2, 3))
    spots = (np.arange(rows) - (rows - 1) / 2) * (lane + wide)
    skin = rounded(dice.between(0.1, 0.45), wide / long, 4)
    for x in spots:
        _cabinet(kit, x, (wide, long, high), None if panes else skin, coat)
        if dice.chance(0.4):
            reader = cylinder(0.03, 0.012, 18) + np.array([x, -0.25 * long, high]) + [0, 0, 0.0065]
            kit.add("button", slide((0, 0, -1), 0.004), [([reader], looks.plastic(dice))])
    clear = looks.glass(dice) if dice.chance(0.7) else looks.plastic(dice)
    tall = dice.between(0.4, 0.75)
    for left, right in pairwise(spots):
        half = (right - left - wide) / 2
        for s, edge in ((1, left + wide / 2), (-1, right - wide / 2)):
            if flaps:
                _flap(kit, edge, s, half, high, tall, clear)
            elif panes:
                _pane(kit, edge, s, half, high, tall, clear)
            elif s > 0:
                _tripod(dice, kit, np.array([edge, 0, high - 0.12]), 2 * half - 0.05)
    return kit.done()


def _tripod(dice: Dice, kit: Assembly, spot: FloatArray, reach: float) -> None:
    """Three arms about a slanted axle in a cabinet's side, one of them across the passage."""
    axis = np.array([1, 0, -1]) / np.sqrt(2)
    kit.fix([box((0.06, 0.12, 0.12), spot - [0.03, 0, 0.03])], DARK)
    hub = spot + np.array([0.045, 0, -0.045])
    arms: Pieces = [rod(hub - 0.03 * axis, hub + 0.025 * axis, 0.04, 16)]
    first = np.array([1.0, 0, 0])
    for k in range(3):
        way = rotation(axis, 2 * np.pi * k / 3) @ first
        arms.append(rod(hub, hub + min(reach, 0.55) * way, 0.018, 10))
    kit.add("arm", spin(hub, axis), [(arms, looks.metal(dice))])


def _portal(kit: Assembly, wide: float, high: float, side: float, wall: Look) -> None:
    """Walls to both sides of a doorway, one over it and a sill."""
    kit.fix([box((side, 0.12, high), (s * (wide + side) / 2, 0, high / 2)) for s in (-1, 1)], wall)
    lintel = box((wide + 2 * side, 0.12, 0.25), (0, 0, high + 0.125))
    kit.fix([lintel, box((wide + 2 * side, 0.3, 0.03), (0, 0.1, -0.015))], wall)


def _cabin(kit: Assembly, wide: float, high: float, side: float, deep: float, metal: Look) -> None:
    """Walls and a floor behind a doorway, with a rail at the back."""
    x, whole = wide / 2 + side - 0.015, wide + 2 * side
    kit.fix([box((0.03, deep, high), (s * x, 0.13 + deep / 2, high / 2)) for s in (-1, 1)], metal)
    back = box((whole, 0.03, high), (0, 0.13 + deep, high / 2))
    kit.fix([back, box((whole, deep + 0.08, 0.03), (0, 0.1 + deep / 2, -0.015))], metal)
    kit.fix([box((wide, 0.04, 0.05), (0, 0.1 + deep, 0.9))], DARK)


def _parting_doors(dice: Dice, kit: Assembly, wide: float, high: float, metal: Look) -> None:
    """Two panels that slide apart, some with a strip on them."""
    y, z = _DOOR_AT, high / 2 + 0.001
    for s in (-1, 1):
        leaf = [box((wide / 2 + 0.02, 0.03, high), (s * (wide / 4 + 0.012), y, z))]
        if dice.chance(0.3):
            leaf.append(box((0.15, 0.004, 0.7 * high), (s * wide / 4, y - 0.017, 0.55 * high)))
        name = "left_door" if s < 0 else "right_door"
        kit.add("door", slide((s, 0, 0), wide / 2), [(leaf, metal)], name=name)


def _stacking_doors(dice: Dice, kit: Assembly, wide: float, high: float, side: float, metal: Look) -> None:
    """Two panels that slide to one side, behind each other."""
    s = dice.sign()
    for k in range(2):
        spot = (s * (k - 0.5) * wide / 2, _DOOR_AT + 0.034 * (1 - k), high / 2 + 0.001)
        leaf = [box((wide / 2 + 0.03, 0.03, high), spot)]
        reach = min((1 - k * 0.5) * wide, side)
        kit.add("door", slide((s, 0, 0), reach), [(leaf, metal)], name=f"door_{k + 1}")


def _buttons(dice: Dice, kit: Assembly, spot: FloatArray, metal: Look) -> None:
    """A plate on a wall with one button or two."""
    count = dice.pick((1, 2, 2))
    kit.fix(moved([box((0.12, 0.008, 0.1 + 0.09 * count), (0, -0.004, 0))], spot), metal)
    for k in range(count):
        place = spot + [0, -0.0085, 0.045 * (count - 1) - 0.09 * k]
        button = disc(0.022, 0.008, 16) if dice.chance(0.6) else box((0.04, 0.008, 0.04), (0, -0.004, 0))
        kit.add("button", press(0.004), [(moved([button], place), looks.plastic(dice))])


def _lift(dice: Dice) -> list[Body]:
    """A portal with panels that slide apart or behind each other, and buttons in a plate beside it."""
    kit, metal = Assembly("portal"), looks.metal(dice)
    wide, high, deep = dice.between(0.9, 1.3), dice.between(2.0, 2.2), dice.between(0.3, 1.3)
    side = dice.between(0.35, 0.75)
    _portal(kit, wide, high, side, looks.painted_metal(dice))
    if dice.chance(0.5):
        _cabin(kit, wide, high, side, deep, metal)
    if dice.unit() < 0.65:
        _parting_doors(dice, kit, wide, high, metal)
    else:
        _stacking_doors(dice, kit, wide, high, side, metal)
    _buttons(dice, kit, np.array([dice.sign() * (wide / 2 + 0.5 * side), -0.06, 1.1]), metal)
    kit.fix([box((0.25, 0.01 + PAD, 0.09), (0, -0.065, high + 0.12))], DARK)
    return kit.done()


CATEGORIES = (
    Category("locker_bank", _locker_bank),
    Category("ticket_gate", _ticket_gate),
    Category("lift", _lift),
)
