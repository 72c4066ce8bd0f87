"""What is made of bars: cells, drawbridges with a portcullis, and abacuses."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import X, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, revolve
from . import looks
from .assembling import Assembly, scaled, swing
from .category import Category
from .machine_tools_parts import DARK, handwheel, sideways
from .objects import Body, hinge, slide, spin
from .rigging import FRONT, LEFT, RIGHT, UP, lying


def _bars(wide: float, high: float, count: int, thick: float, round_: bool) -> Pieces:
    """Upright bars between two rails, about x = 0, from z = 0 up."""
    spots = [(x, 0, high / 2) for x in np.linspace(-wide / 2 + thick, wide / 2 - thick, count)]
    bar = cylinder(thick / 2, high, 8) if round_ else box((thick, thick, high))
    rails = [box((wide, 1.6 * thick, 1.8 * thick), (0, 0, z)) for z in (0.9 * thick, high - 0.9 * thick)]
    return [*at(bar, spots), *rails]


def _cell(dice: Dice) -> list[Body]:
    """A front of bars, in it a door of bars that swings or slides, with a lock; walls at times."""
    kit, look = Assembly("front"), looks.metal(dice)
    wide, high, opening = dice.between(1.6, 2.6), dice.between(1.9, 2.3), dice.between(0.7, 0.95)
    thick, step, round_ = dice.between(0.02, 0.035), dice.between(0.09, 0.14), dice.chance(0.6)
    place = dice.between(-0.2, 0.2) * (wide - opening)
    for low, end in ((-wide / 2, place - opening / 2), (place + opening / 2, wide / 2)):
        count = max(int((end - low) / step), 2)
        kit.fix(moved(_bars(end - low, high, count, thick, round_), ((low + end) / 2, 0, 0)), look)
    beam = box((wide, 2 * thick, 2 * thick), (0, 0, high + thick))
    kit.fix([beam, box((wide, 2 * thick, 0.02), (0, 0, -0.01))], look)
    if dice.chance(0.5):
        wall = looks.painted_metal(dice)
        kit.fix([box((0.1, 1.0, high), (s * (wide / 2 + 0.055), 0.45, high / 2)) for s in (-1, 1)], wall)
    slides = dice.chance(0.4)
    door = _bars(opening - 0.012, high - 0.012, int(opening / step) + 1, thick, round_)
    door.append(box((opening - 0.012, 1.6 * thick, 2.5 * thick), (0, 0, 0.45 * high)))
    stile, x = (1.6 * thick, 1.6 * thick, high - 0.012), opening / 2 - 0.006 - 0.8 * thick
    door += [box(stile, (s * x, 0, high / 2 - 0.006)) for s in (-1, 1)]
    y, side = -2.2 * thick if slides else 0.0, dice.sign()
    door = moved(door, (place, y, 0.006))
    if slides:
        kit.fix([box((min(2.2 * opening, wide), 0.02, 0.05), (place, y - 1.3 * thick, high + thick))], look)
    edge = place + side * (opening / 2 - 0.006)
    motion = slide((side, 0, 0), opening) if slides else swing(side, edge, -0.8 * thick, 1.7)
    lock = [box((0.12, 2.4 * thick, 0.14), (place - side * (opening / 2 - 0.09), y, 0.45 * high))]
    number = kit.add("door", motion, [(door, look), (lock, DARK)])
    if dice.chance(0.6):
        spot = np.array([place - side * (opening / 2 - 0.09), y - 1.2 * thick, 0.45 * high])
        if dice.chance(0.5):
            kit.add("handwheel", spin(spot, FRONT), [(moved(handwheel(dice, 0.09), spot), look)], number)
        else:
            knob = box((0.014, 0.04, 0.014), spot - [0, 0.034, 0])
            bolt = [lying(0.012, 0.16) + spot - [0, 0.016, 0], knob]
            kit.add("bolt", slide((side, 0, 0), 0.05), [(bolt, look)], number)
    return kit.done()


def _drawbridge(dice: Dice) -> list[Body]:
    """A gate between two piers, a bridge hinged at its foot, and a portcullis that slides up behind it."""
    kit, stone, scale = Assembly("gatehouse"), looks.ceramic(dice), dice.spread(0.1, 1.2)
    wide, high, deep = dice.between(1.0, 1.4), dice.between(1.3, 1.7), 0.5
    pier = dice.between(0.4, 0.6)
    kit.fix([box((pier, deep, 2.2 * high), (s * (wide + pier) / 2, 0, 1.1 * high)) for s in (-1, 1)], stone)
    kit.fix([box((wide, 0.12, 1.2 * high), (0, t * (deep / 2 - 0.06), 1.6 * high)) for t in (-1, 1)], stone)
    places = np.linspace(-wide / 2 - 0.6 * pier, wide / 2 + 0.6 * pier, 6)
    kit.fix(at(box((0.14, deep, 0.15)), [(x, 0, 2.2 * high + 0.075) for x in places]), stone)
    kit.fix([box((wide + 2 * pier, deep, 0.06), (0, 0, -0.03))], stone)
    wood, count = looks.wood(dice), dice.whole(4, 8)
    planks = [
        box((0.94 * wide / count - 0.006, 0.05, high), (0.94 * wide * ((k + 0.5) / count - 0.5), 0, high / 2))
        for k in range(count)
    ]
    planks += [box((0.92 * wide, 0.03, 0.08), (0, 0.038, z * high)) for z in (0.2, 0.8)]
    planks.append(lying(0.03, 0.98 * wide))
    pin = np.array([0, -deep / 2 - 0.035, 0.035])
    lowered = dice.pick((0.0, 0.0, 1.5))
    planks = moved(turned(planks, rotation(RIGHT, lowered)), pin)
    kit.add("bridge", hinge(pin, RIGHT, 1.55 - lowered, -lowered), [(planks, wood)])
    grate = _bars(0.98 * wide, high, dice.whole(4, 7), 0.05, False)
    grate += [box((0.98 * wide, 0.05, 0.05), (0, 0, z * high)) for z in (0.3, 0.6)]
    kit.add("portcullis", slide(UP, 0.9 * high), [(moved(grate, (0, 0, 0.002)), looks.metal(dice))])
    if dice.chance(0.5):
        spot = np.array([wide / 2 + pier + 0.0005, 0, 0.5 * high])
        kit.add("winch", spin(spot, RIGHT), [(moved(sideways(handwheel(dice, 0.2), 1), spot), wood)])
    return scaled(kit.done(), scale)


def _beads(dice: Dice, kit: Assembly, wide: float, radius: float, z: float) -> None:
    """Beads on a wire, some at its left end and the others at its right."""
    line = [(0.0025, -0.5), (0.5, -0.5), (1, -0.1), (1, 0.1), (0.5, 0.5), (0.0025, 0.5), (0.0025, -0.5)]
    long = dice.between(0.8, 1.4) * radius
    bead = pointed(revolve(np.array(line) * [radius, long], 14), X)
    total = int(min(10, 0.7 * wide / long))
    left = dice.whole(0, total)
    room = wide - total * long - 0.004
    ends = ((left, -wide / 2 + long / 2), (total - left, wide / 2 - (total - left - 0.5) * long))
    for count, start in ends:
        if count:
            way, off = (RIGHT, 0.001) if start < 0 else (LEFT, -0.001)
            run = at(bead * [0.98, 1, 1], [(start + off + i * long, 0, z) for i in range(count)])
            kit.add("beads", slide(way, room), [(run, looks.plastic(dice))])


def _abacus(dice: Dice) -> list[Body]:
    """A frame with wires, on each of which beads slide; those together count as one."""
    kit, wood = Assembly("frame"), looks.wood(dice)
    wide, high, rows = dice.between(0.2, 0.4), dice.between(0.18, 0.35), dice.whole(3, 10)
    thick, stands = 0.02, dice.chance(0.5)
    kit.fix([box((thick, thick, high), (s * (wide / 2 + thick / 2), 0, high / 2)) for s in (-1, 1)], wood)
    levels = (thick / 2, high - thick / 2)
    kit.fix([box((wide + 2 * thick, 1.01 * thick, thick), (0, 0, z)) for z in levels], wood)
    if stands:
        kit.fix([box((0.03, 0.12, 0.02), (s * (wide / 2 + thick / 2), 0, -0.01)) for s in (-1, 1)], wood)
    gap = (high - 2 * thick) / rows
    radius = min(0.42 * gap, 0.02)
    for k in range(rows):
        z = thick + gap * (k + 0.5)
        kit.fix([lying(0.0015, wide + 0.01) + [0, 0, z]], looks.metal(dice))
        _beads(dice, kit, wide, radius, z)
    return kit.done(rotation(RIGHT, -np.pi / 2) if dice.chance(0.3) else None)


CATEGORIES = (
    Category("cell", _cell),
    Category("drawbridge", _drawbridge),
    Category("abacus", _abacus),
)
