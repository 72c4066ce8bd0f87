"""Fittings by themselves: what turns or is pressed on the plane y = 0, standing off to -y.

Each is made for a room of a width (x) and a height (z) about 0 [m], and brings along what holds it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes import legs
from ...shapes.dice import Dice
from ...shapes.fronts import frame
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import X, Y, around, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, prism, revolve, rod, torus, tube
from .assembling import Assembly, dial, disc, press, turning
from .objects import Look, ball, hinge, spin
from .rigging import ball_knob


@dataclass(frozen=True)
class Room:
    """What a fitting is made for.

    Attributes:
        wide, high: of its room [m].
        base, own, accent: looks of what holds it, of itself and of its grips.
    """

    wide: float
    high: float
    base: Look
    own: Look
    accent: Look

    @property
    def least(self) -> float:
        return min(self.wide, self.high)


Fitting = Callable[[Dice, Room], Assembly]


def standing(pieces: Pieces) -> Pieces:
    """What stands on z = 0, standing off the plane y = 0 instead."""
    return turned(pieces, rotation((1, 0, 0), np.pi / 2))


def sleeve_of(inner: float, outer: float, long: float, sides: int) -> FloatArray:
    """A tube with a wall, from z = 0 up."""
    ring = [(inner, 0), (outer, 0), (outer, long), (inner, long), (inner, 0)]
    return revolve(np.array(ring), sides)


def knob(dice: Dice, room: Room) -> Assembly:
    """A dial, some on a rosette."""
    kit, radius = Assembly(), room.least * dice.between(0.15, 0.45)
    back = radius * 0.1 if dice.chance(0.4) else 0.0
    if back:
        kit.fix([disc(radius * dice.between(1.1, 1.4), back)], room.base)
    kit.add("knob", turning(dice, (0, 0, 0)), [(moved(dial(dice, radius), (0, -back, 0)), room.accent)])
    return kit


def buttons(dice: Dice, room: Room) -> Assembly:
    """A field of buttons or keys, some in a frame."""
    kit, cell = Assembly(), room.least / dice.pick((1, 1, 2, 2, 3, 5))
    columns, rows = (min(10, max(1, int(length / cell))) for length in (room.wide, room.high))
    rows = min(rows, dice.pick((12, 50)) // columns)
    thick = max(cell * dice.between(0.1, 0.4), 0.0035)
    outline = dice.pick((SQUARE, rounded(0.2), rounded(0.5)))
    size = cell * dice.between(0.45, 0.9)
    for row in range(rows):
        for column in range(columns):
            place = ((column - (columns - 1) / 2) * cell, -thick / 2, (row - (rows - 1) / 2) * cell)
            key = pointed(prism(outline, (size, size, thick)), Y) + place
            kit.add("button", press(thick * dice.between(0.3, 0.8)), [([key], room.accent)])
    if dice.chance(0.3):
        rim, deep = 0.06 * cell, thick * dice.between(0.3, 1.0)
        kit.fix([frame(columns * cell + 2 * rim, rows * cell + 2 * rim, deep, rim)], room.base)
    return kit


def toggle(dice: Dice, room: Room) -> Assembly:
    """A short lever that tips up and down on a long plate, or a stick on a round one that tips every way."""
    kit, radius = Assembly(), room.least * dice.between(0.04, 0.12)
    reach = room.least * dice.between(0.3, 0.8)
    flat, tips = radius * dice.between(1.5, 4), dice.chance(0.65)
    slot = box((2 * flat, radius, min(5 * flat, room.high)), (0, -radius / 2, 0))
    kit.fix([slot if tips else disc(flat, radius)], room.base)
    tip = (0.0, -reach, 0.0)
    pieces = [rod((0, -radius, 0), tip, radius * 0.8, 8)]
    if dice.chance(0.6):
        pieces += moved([ball_knob(radius * dice.between(1.2, 2.2))], tip)
    if not tips:
        kit.add("stick", ball((0, -radius, 0)), [(pieces, room.accent)])
        return kit
    most = dice.between(0.2, 0.7)
    kit.add("toggle", hinge((0, -radius, 0), (1, 0, 0), most, -most), [(pieces, room.accent)])
    return kit


def crank(dice: Dice, room: Room) -> Assembly:
    """An arm or a disc with a grip off its middle, which turns without end."""
    kit, reach = Assembly(), room.least * dice.between(0.3, 0.5)
    thick, off = reach * dice.between(0.08, 0.2), reach * dice.between(0.1, 0.5)
    kit.fix([disc(thick, off, 12)], room.base)
    if dice.chance(0.4):
        pieces = moved([disc(reach, thick)], (0, -off, 0))
    else:
        pieces = [box((reach + thick, thick, 1.6 * thick), (reach / 2, -off - thick / 2, 0))]
    grip = rod((reach * 0.85, -off, 0), (reach * 0.85, -off - reach * dice.between(0.4, 0.9), 0), thick, 10)
    kit.add("crank", spin((0, 0, 0), (0, 1, 0)), [(pieces, room.own), ([grip], room.accent)])
    return kit


def rotor(dice: Dice, room: Room) -> Assembly:
    """Blades around a hub, before a stub."""
    kit, reach = Assembly(), room.least * dice.between(0.3, 0.5)
    off, hub = reach * dice.between(0.1, 0.4), reach * dice.between(0.1, 0.25)
    kit.fix([disc(hub * 0.6, off, 12)], room.base)
    wide, thick = reach * dice.between(0.15, 0.4), reach * 0.03
    blade = turned([box((reach - hub, wide, thick))], rotation((1, 0, 0), dice.between(-0.7, 0.7)))
    blades = around(moved(blade, ((reach + hub) / 2 - 0.1 * hub, 0, 0)), dice.whole(2, 6), dice.between(0, 1))
    pieces = [pointed(piece, Y) for piece in [cylinder(hub, reach * 0.2, 14), *blades]]
    middle = (0.0, -off - 0.1 * reach, 0.0)
    kit.add("blades", spin(middle, (0, 1, 0)), [(moved(pieces, middle), room.own)])
    return kit


def wheel(dice: Dice, room: Room) -> Assembly:
    """A wheel on a stub axle."""
    kit, radius = Assembly(), room.least * dice.between(0.25, 0.5)
    pieces = legs.wheel(dice, radius)
    half = max(float(piece[..., 1].max()) for piece in pieces)
    off = radius * dice.between(0.05, 0.3)
    kit.fix([disc(radius * dice.between(0.08, 0.2), off + half, 10)], room.base)
    middle = (0.0, -off - half, 0.0)
    kit.add("wheel", spin(middle, (0, 1, 0)), [(moved(pieces, middle), room.own)])
    return kit


def roller(dice: Dice, room: Room) -> Assembly:
    """A wheel or a roller between two cheeks."""
    kit, radius = Assembly(), room.least * dice.between(0.15, 0.35)
    long = min(room.wide, 2.5 * radius) * dice.between(0.3, 0.8)
    off, thick = radius * dice.between(1.05, 1.4), radius * dice.between(0.1, 0.2)
    reach = off + radius * dice.between(0.15, 0.4)
    spots = [(s * (long / 2 + 0.8 * thick), -reach / 2, 0) for s in (-1, 1)]
    kit.fix([boxes((thick, reach, radius * dice.between(0.3, 1.0)), spots)], room.base)
    pin = pointed(cylinder(radius * 0.12, long + 2 * thick, 8), X)
    drum = pointed(cylinder(radius, long, dice.whole(12, 20)), X)
    middle = (0.0, -off, 0.0)
    kit.add("wheel", spin(middle, (1, 0, 0)), [(moved([drum, pin], middle), room.own)])
    return kit


def handwheel(dice: Dice, room: Room) -> Assembly:
    """A ring with spokes on a stem."""
    kit, ring = Assembly(), room.least * dice.between(0.25, 0.45)
    thick, off = ring * dice.between(0.06, 0.15), ring * dice.between(0.3, 0.8)
    kit.fix([disc(1.8 * thick, off * 0.4, 12)], room.base)
    spokes = around([rod((0, 0, 0), (ring, 0, 0), 0.6 * thick, 6)], dice.whole(2, 6))
    flat = [torus(ring, thick, 20), cylinder(2 * thick, 2 * thick, 12), *spokes]
    pieces = moved([pointed(piece, Y) for piece in flat], (0, -off, 0))
    stem = rod((0, 0, 0), (0, -off, 0), thick, 8)
    kit.add("handle wheel", spin((0, 0, 0), (0, 1, 0)), [([*pieces, stem], room.own)])
    return kit


def turntable(dice: Dice, room: Room) -> Assembly:
    """A low disc on a smaller foot."""
    kit, radius = Assembly(), room.least * dice.between(0.3, 0.5)
    off, thick = radius * dice.between(0.03, 0.15), radius * dice.between(0.05, 0.2)
    kit.fix([disc(radius * dice.between(0.2, 0.7), off, 16)], room.base)
    top = moved([disc(radius, thick, 24)], (0, -off, 0))
    kit.add("turntable", spin((0, 0, 0), (0, 1, 0)), [(top, room.own)])
    return kit


def bail(dice: Dice, room: Room) -> Assembly:
    """A bow that hangs on two lugs and can be lifted."""
    kit, wide = Assembly(), room.wide * dice.between(0.4, 0.9)
    drop, thick = min(room.high * 0.45, wide) * dice.between(0.5, 1.0), room.least * dice.between(0.015, 0.04)
    off = thick * dice.between(1.5, 2.5)
    lug = box((2.5 * thick, 1.6 * off, 3 * thick))
    kit.fix(at(lug, [(s * wide / 2, -0.8 * off, 0) for s in (-1, 1)]), room.base)
    along = np.linspace(-1, 1, 13)
    shape = -drop * (1 - np.abs(along) ** dice.pick((2, 4, 8)))
    bow = tube(np.column_stack([along * wide / 2, np.full(13, -off), shape]), thick, 8)
    kit.add("handle", hinge((0, -off, 0), (-1, 0, 0), dice.between(1.2, 2.4)), [([bow], room.accent)])
    return kit
