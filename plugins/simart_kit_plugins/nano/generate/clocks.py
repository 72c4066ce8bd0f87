"""Clocks, record players and music boxes."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.legs import feet
from ...shapes.placing import X, Y, around, at, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, revolve, rod, superquadric, torus, tube
from . import looks
from .assembling import Assembly, dial, disc, press, turning
from .category import Category
from .objects import Body, Look, hinge, slide, spin


def _hand(long: float, wide: float, level: float) -> Pieces:
    """A clock's hand, upwards, before y = 0."""
    return [box((wide, 0.002, long), (0, -level, long * 0.4)), disc(wide * 1.5, level + 0.001, 10)]


def _clock(dice: Dice) -> list[Body]:
    """Hands on a face: on a wall, on feet with bells, or in a case with a pendulum or a door."""
    kit, coat = Assembly("case"), looks.wood(dice) if dice.chance(0.5) else looks.painted_metal(dice)
    radius = dice.spread(0.04, 0.25)
    deep = radius * dice.between(0.15, 0.8)
    case: FloatArray = pointed(cylinder(radius * 1.1, deep, 24), Y)
    square = dice.chance(0.35)
    if square:
        case = box((2.3 * radius, deep, 2.3 * radius))
    kit.fix([case + [0, deep / 2, 0]], coat)
    kit.fix([disc(radius, 0.003, 24)], Look("plastic", (244, 242, 235)))
    if dice.chance(0.6):
        rim = pointed(torus(radius * 1.04, radius * 0.06, 24), Y)
        kit.fix([rim], looks.metal(dice))
    marks = around([box((radius * 0.03, radius * 0.15, 0.001), (0, radius * 0.85, 0))], 12)
    kit.fix([pointed(m, Y) - [0, 0.0035, 0] for m in marks], Look("plastic", (30, 30, 30)))
    dark = Look("steel", (30, 30, 34))
    wide = radius * dice.between(0.03, 0.07)
    turn = rotation((0, 1, 0), dice.between(0, 6.28))
    kit.add(
        "hour hand",
        spin((0, 0, 0), (0, 1, 0)),
        [(turned(_hand(radius * 0.55, wide * 1.4, 0.006), turn), dark)],
    )
    turn = rotation((0, 1, 0), dice.between(0, 6.28))
    kit.add(
        "minute hand", spin((0, 0, 0), (0, 1, 0)), [(turned(_hand(radius * 0.85, wide, 0.009), turn), dark)]
    )
    if dice.chance(0.3):
        red = Look("plastic", (190, 40, 40))
        kit.add("second hand", spin((0, 0, 0), (0, 1, 0)), [(_hand(radius * 0.9, wide * 0.4, 0.012), red)])
    if not square and radius < 0.1 and dice.chance(0.6):
        legs = [
            rod(
                (s * radius * 0.6, deep / 2, -radius * 0.8),
                (s * radius * 0.9, deep / 2, -radius * 1.4),
                radius * 0.06,
            )
            for s in (-1, 1)
        ]
        bells = [
            superquadric((radius * 0.7, radius * 0.7, radius * 0.5), rows=6)
            + [s * radius * 0.6, deep / 2, radius * 1.2]
            for s in (-1, 1)
        ]
        kit.fix(legs + bells, looks.metal(dice))
    elif dice.chance(0.4):
        _pendulum(dice, kit, radius, deep, coat)
    if dice.chance(0.25):
        key = moved(dial(dice, radius * 0.15), (0, 0, 0))
        shape = moved(turned(key, rotation((0, 0, 1), np.pi)), (radius * 0.4, deep, -radius * 0.3))
        kit.add("knob", turning(dice, (radius * 0.4, deep, -radius * 0.3)), [(shape, looks.metal(dice))])
    return kit.done()


def _pendulum(dice: Dice, kit: Assembly, radius: float, deep: float, coat: Look) -> None:
    """A case below the face with a bob that swings in it."""
    long = radius * dice.between(2.0, 5.0)
    wide, wall = 1.9 * radius, radius * 0.12
    top = -1.0 * radius
    sides = at(box((wall, deep, long)), [(s * (wide - wall) / 2, deep / 2, top - long / 2) for s in (-1, 1)])
    back = box((wide, wall * 0.5, long), (0, deep - wall * 0.25, top - long / 2))
    foot = box((wide * 1.15, deep * 1.1, wall), (0, deep / 2, top - long - wall / 2))
    kit.fix([*sides, back, foot], coat)
    pin = np.array([0, deep * 0.55, top])
    bob = [
        rod(pin, pin - [0, 0, long * 0.7], radius * 0.025, 6),
        pointed(cylinder(radius * 0.25, deep * 0.12, 16), Y) + pin - [0, 0, long * 0.75],
    ]
    kit.add("pendulum", hinge(pin, (0, 1, 0), 0.15, -0.15), [(bob, looks.metal(dice))])
    if deep > 0.05 and dice.chance(0.5):
        side = dice.sign()
        pane = [box((wide * 0.97, 0.006, long * 0.97), (0, -0.004, top - long / 2))]
        kit.add("door", hinge((side * wide / 2, -0.004, 0), (0, 0, side), 1.8), [(pane, looks.glass(dice))])


def _record_player(dice: Dice) -> list[Body]:
    """A deck with a platter, an arm and mostly a lid; or a music box with a drum and a crank."""
    if dice.chance(0.3):
        return _music_box(dice)
    kit, coat = Assembly("deck"), looks.wood(dice)
    width, depth, high = dice.between(0.36, 0.48), dice.between(0.3, 0.38), dice.between(0.05, 0.16)
    kit.fix([box((width, depth, high), (0, 0, high / 2))], coat)
    kit.fix(feet(dice, width * 0.9, depth * 0.9, 0.015), looks.rubber(dice))
    radius = min(0.155, depth * 0.45)
    middle = (-width / 2 + radius + 0.015, 0, high + 0.002)
    disc_ = [cylinder(radius, 0.014, 24) + [0, 0, 0.007], cylinder(0.004, 0.03, 8) + [0, 0, 0.015]]
    parts = [(moved(disc_, middle), looks.metal(dice))]
    if dice.chance(0.6):
        parts.append(
            (
                moved([cylinder(radius * 0.96, 0.003, 24) + [0, 0, 0.0157]], middle),
                Look("plastic", (22, 22, 24)),
            )
        )
    kit.add("platter", spin(middle, (0, 0, 1)), parts)
    pin = np.array([width / 2 - 0.045, depth * 0.3, high])
    metal = looks.metal(dice)
    kit.fix([cylinder(0.022, 0.016, 14) + pin + [0, 0, 0.008]], metal)
    arm = [
        cylinder(0.012, 0.02, 12) + [0, 0, 0.028],
        tube([(0, 0.05, 0.032), (0, 0, 0.032), (0, -0.17, 0.032), (-0.02, -0.2, 0.028)], 0.004, 6),
    ]
    arm += [
        rod((0, 0.03, 0.032), (0, 0.055, 0.032), 0.012, 10),
        box((0.014, 0.025, 0.008), (-0.025, -0.205, 0.026)),
    ]
    kit.add("tone arm", hinge(pin, (0, 0, -1), dice.between(0.5, 0.8)), [(moved(arm, pin), metal)])
    _deck_controls(dice, kit, (width, depth, high))
    if dice.chance(0.6):
        _cover(dice, kit, (width, depth, high), coat)
    return kit.done()


def _deck_controls(dice: Dice, kit: Assembly, size: tuple[float, float, float]) -> None:
    """A knob, buttons or a slider at the front right of a deck."""
    width, depth, high = size
    look, x = looks.metal(dice), width / 2 - 0.03
    if dice.chance(0.5):
        slot = (x, -depth * 0.2, high)
        kit.fix(moved([box((0.006, 0.09, 0.001))], slot), Look("plastic", (20, 20, 20)))
        cap = moved([box((0.02, 0.012, 0.01), (0, 0, 0.006))], slot)
        kit.add("slider", slide((0, 1, 0), 0.04, -0.04), [(cap, look)])
    if dice.chance(0.6):
        spot = (dice.between(-0.3, 0.3) * width, -depth / 2, high / 2)
        kit.add("knob", turning(dice, spot), [(moved(dial(dice, min(0.014, high * 0.3)), spot), look)])
    if dice.chance(0.4):
        for k in range(2):
            spot = (-0.35 * width + 0.03 * k, -depth / 2, high / 2)
            kit.add("button", press(0.003), [(moved([box((0.02, 0.01, 0.012), (0, -0.005, 0))], spot), look)])


def _cover(dice: Dice, kit: Assembly, size: tuple[float, float, float], coat: Look) -> None:
    """A lid with sides, of clear plastic or of wood, hinged at the back."""
    width, depth, high = size
    tall, wall = dice.between(0.06, 0.1), 0.004
    low = high + 0.0015
    faces = [box((width, depth, wall), (0, 0, low + tall - wall / 2))]
    faces += at(
        box((width, wall, tall - wall)),
        [(0, s * (depth - wall) / 2, low + (tall - wall) / 2) for s in (-1, 1)],
    )
    faces += at(
        box((wall, depth - 2 * wall, tall - wall)),
        [(s * (width - wall) / 2, 0, low + (tall - wall) / 2) for s in (-1, 1)],
    )
    look = coat if dice.chance(0.3) else looks.glass(dice)
    kit.add("lid", hinge((0, depth / 2, low), (-1, 0, 0), dice.between(0.9, 1.5)), [(faces, look)])


def _music_box(dice: Dice) -> list[Body]:
    """A box with a lid, a drum or a figure that spins, a crank or a key, and a drawer."""
    kit, coat = Assembly("box"), looks.wood(dice)
    width, depth, high = dice.between(0.1, 0.2), dice.between(0.08, 0.15), dice.between(0.05, 0.1)
    low = high * (dice.between(0.3, 0.45) if dice.chance(0.4) else 0.0)
    kit.fix([box((width, depth, 0.004), (0, 0, low + 0.002))], coat)
    kit.fix(at(box((width, 0.005, high)), [(0, depth / 2 - 0.0025, high / 2)]), coat)
    kit.fix([box((width, 0.005, high - low), (0, -depth / 2 + 0.0025, (high + low) / 2))], coat)
    kit.fix(
        at(box((0.005, depth - 0.01, high)), [(s * (width / 2 - 0.0025), 0, high / 2) for s in (-1, 1)]), coat
    )
    metal = looks.metal(dice)
    if low:
        face = box((width - 0.012, 0.006, low - 0.003), (0, -depth / 2 + 0.003, low / 2))
        tray = box((width - 0.016, depth * 0.85, low * 0.6), (0, -depth * 0.04, low * 0.35))
        knob_ = moved([disc(0.005, 0.01, 10)], (0, -depth / 2, low / 2))
        kit.add("drawer", slide((0, -1, 0), depth * 0.7), [([face, tray], coat), (knob_, metal)])
    floor = low + 0.004
    if dice.chance(0.5):
        figure = revolve(
            [[0.0, 0.0], [0.012, 0], [0.012, 0.004], [0.003, 0.006], [0.004, 0.025], [0, 0.04]], 12
        )
        kit.add(
            "figure",
            spin((0, 0, floor), (0, 0, 1)),
            [([figure + [0, 0, floor + 0.001]], looks.ceramic(dice))],
        )
    else:
        pin = (0.0, 0.0, floor + 0.014)
        drum = pointed(cylinder(0.011, width * 0.5, 16), X) + pin
        kit.add("drum", spin(pin, (1, 0, 0)), [([drum], metal)])
    side = dice.sign()
    pin = (side * width / 2, 0.0, (low + high) / 2)
    crank = [
        rod((0, 0, 0), (0.015, 0, 0), 0.002),
        rod((0.015, 0, 0), (0.015, 0, 0.025), 0.002),
        rod((0.015, 0, 0.025), (0.03, 0, 0.025), 0.004),
    ]
    shape = moved([piece * [side, 1, 1] for piece in crank], pin)
    kit.add("crank", spin(pin, (1, 0, 0)), [(shape, metal)])
    if dice.chance(0.8):
        lid = [box((width + 0.004, depth + 0.004, 0.008), (0, 0, high + 0.005))]
        kit.add("lid", hinge((0, depth / 2, high + 0.001), (-1, 0, 0), dice.between(1.3, 1.8)), [(lid, coat)])
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("clock", _clock),
    Category("record_player", _record_player),
)
