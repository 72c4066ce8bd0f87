"""Machine tools that turn, drill, saw and print."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import Y, moved, rotation, turned
from ...shapes.primitives import Pieces, between, box, cylinder, prism, rod, vessel
from . import looks
from .assembling import Assembly, dial, disc, lift, press, swing, turning
from .category import Category
from .machine_tools_lathes import lathe
from .machine_tools_parts import DARK, chuck, clamp_lever, handwheel, sideways, sleeve, star
from .machine_tools_printers import printer_3d
from .machine_tools_saws import power_saw
from .objects import Body, Look, hinge, slide, spin
from .rigging import DOWN, FRONT, LEFT, RIGHT, UP, ball_knob, lying


def _bored(low: ArrayLike, high: ArrayLike, half: float) -> Pieces:
    """A block between two corners with a square bore along z through x = y = 0."""
    (x, y, z), (a, b, c) = np.asarray(low).tolist(), np.asarray(high).tolist()
    spans = [(x, -half, y, b), (half, a, y, b), (-half, half, y, -half), (-half, half, half, b)]
    return [between((one[0], one[2], z), (one[1], one[3], c)) for one in spans]


def _buttons(dice: Dice, kit: Assembly, spot: FloatArray, to: int = 0) -> None:
    """A green and a red button on a plate before y = 0, or a knob."""
    kit.fix([box((0.05, 0.006, 0.09), spot - [0, 0.003, 0])], DARK, to)
    if dice.chance(0.3):
        knob = moved(dial(dice, 0.018), spot - [0, 0.006, 0])
        kit.add("knob", turning(dice, spot, FRONT), [(knob, looks.plastic(dice))], to)
        return
    for k, color in enumerate(((40, 150, 60), (200, 40, 40))):
        cap = [disc(0.014, 0.009, 14) + spot + [0, -0.007, 0.02 - 0.04 * k]]
        kit.add("button", press(0.004), [(cap, Look("plastic", color))], to)


def _quill(
    dice: Dice, kit: Assembly, floor: float, high: float, radius: float, x: float, metal: Look, to: int = 0
) -> None:
    """A quill that comes down from a bored head, its chuck, and the handle on the right that feeds it."""
    feed = dice.between(0.05, 0.1)
    body = [cylinder(radius, high, 18) + [0, 0, floor - 0.012 + high / 2]]
    body.append(cylinder(0.5 * radius, 0.02) + [0, 0, floor - 0.02])
    quill = kit.add("quill", slide(DOWN, feed), [(body, metal)], to)
    wide = dice.between(0.75, 1.05) * radius
    nose = moved(chuck(dice, wide, dice.between(2.0, 3.0) * wide), (0, 0, floor - 0.031))
    kit.add("chuck", spin((0, 0, floor), UP), [(nose, looks.metal(dice))], quill)
    pin = np.array([x + 0.001, dice.between(-0.02, 0.04), floor + dice.between(0.3, 0.5) * high])
    arms = moved(star(dice, dice.between(0.1, 0.17)), pin)
    kit.add("handle", hinge(pin, RIGHT, dice.between(2.5, 5.5)), [(arms, looks.metal(dice))], to)


def _belt_cover(
    dice: Dice, kit: Assembly, x: float, low: float, high: float, level: float, coat: Look
) -> None:
    """A tray with pulleys on top of a head, from y = low to high, and the lid over them."""
    long, middle, tall = high - low, (low + high) / 2, dice.between(0.05, 0.09)
    outline = dice.pick((SQUARE, rounded(0.3)))
    kit.fix([prism(outline, (2 * x, long, 0.012)) + [0, middle, level + 0.006]], coat)
    floor, size = level + 0.013, min(0.75 * x, 0.24 * long)
    for y, radius in ((low + 0.25 * long, size), (high - 0.25 * long, 0.75 * size)):
        steps = [
            cylinder(radius * (1 - 0.25 * k), 0.012, 18) + [0, y, floor + 0.006 + 0.012 * k] for k in range(3)
        ]
        kit.add("pulley", spin((0, y, floor), UP), [(steps, looks.metal(dice))])
    lid = turned([vessel(outline, (2 * x, long, tall), 0.004)], rotation(RIGHT, np.pi))
    lid = moved(lid, (0, middle, floor + 0.001 + tall))
    grip = [box((0.06, 0.012, 0.014), (0, low - 0.006, floor + 0.4 * tall))]
    side = dice.pick((0, -1, 1))
    if side == 0:
        motion, shift = lift(high, floor, dice.between(1.2, 1.7)), 0.8 * x
        pin = lying(0.006, 0.05) + [0, high + 0.003, floor + 0.006]
    else:
        motion, shift = hinge((side * x, middle, floor), (0, side, 0), dice.between(1.2, 1.9)), 0.6 * long
        pin = lying(0.006, 0.05, Y) + [side * (x + 0.003), middle, floor + 0.006]
        grip = [box((0.012, 0.06, 0.014), (-side * (x + 0.006), middle, floor + 0.4 * tall))]
    along = np.array([shift / 2, 0, 0]) if side == 0 else np.array([0, shift / 2, 0])
    knuckles = [pin - along, pin + along]
    kit.add("lid", motion, [(lid, coat), (grip, DARK), (knuckles, looks.metal(dice))])


def _work_table(dice: Dice, kit: Assembly, away: float, pipe: float, level: float, room: float) -> None:
    """A bracket that slides on a column behind, with a table before it that tilts or turns."""
    metal, coat = looks.metal(dice), looks.painted_metal(dice)
    face, tall = away - pipe - 0.05, 0.07
    body: Pieces = [sleeve(pipe + 0.001, pipe + 0.025, tall) + [0, away, level]]
    round_ = dice.chance(0.45)
    front = -0.03 if round_ else face
    body.append(between((-0.03, front, level + 0.015), (0.03, away - pipe - 0.004, level + 0.055)))
    if not round_:
        body.append(disc(0.045, 0.02) + [0, face + 0.019, level + 0.035])
    bracket = kit.add("bracket", slide(UP, room, 0.1 - level), [(body, coat)])
    size = face - 0.003
    if round_:
        plate_ = [
            cylinder(size, 0.022, 28) + [0, 0, level + 0.071],
            cylinder(0.035, 0.004) + [0, 0, level + 0.058],
        ]
        kit.add("table", spin((0, 0, level), UP), [(plate_, metal)], bracket)
    else:
        wide, up = dice.between(1.0, 1.5) * size, level + 0.11
        plate_ = [*_bored((-wide, -size, up), (wide, size, up + 0.02), 0.012)]
        plate_ += [
            disc(0.045, 0.02) + [0, face - 0.002, level + 0.035],
            box((0.06, 0.018, 0.06), (0, face - 0.012, up - 0.025)),
        ]
        tilt = hinge((0, face, level + 0.035), FRONT, 0.75, -0.75)
        table = kit.add("table", tilt, [(plate_, metal)], bracket)
        if dice.chance(0.3):
            jaws = [
                box((0.1, 0.03, 0.035), (0, 0.055, up + 0.038)),
                box((0.08, 0.13, 0.016), (0, 0, up + 0.0285)),
            ]
            kit.fix(jaws, coat, table)
            jaw = [
                box((0.1, 0.02, 0.033), (0, -0.01, up + 0.054)),
                rod((0, -0.02, up + 0.054), (0, -0.1, up + 0.054), 0.006),
            ]
            kit.add("jaw", slide((0, 1, 0), 0.045, -0.03), [(jaw, looks.metal(dice))], table)
    clamp_lever(kit, (pipe + 0.026, away, level + 0.05), dice.between(0.07, 0.1), metal, bracket)
    if dice.chance(0.6):
        spot = np.array([-pipe - 0.026, away, level + 0.035])
        crank = moved(sideways(handwheel(dice, 0.055), -1), spot)
        kit.add("crank", spin(spot, LEFT), [(crank, metal)], bracket)


def _column_press(dice: Dice, kit: Assembly) -> None:
    """A head on a pipe, with belts on top and a table on the pipe."""
    coat, metal = looks.painted_metal(dice), looks.metal(dice)
    away, pipe, tall = (
        dice.between(0.17, 0.24),
        dice.between(0.026, 0.04),
        dice.pick((0.6, 0.66, 0.74, 1.15, 1.3)),
    )
    x, radius, high = dice.between(0.07, 0.12), dice.between(0.024, 0.034), dice.between(0.15, 0.24)
    foot = between((-1.5 * x, -0.55 * away, 0), (1.5 * x, away + 0.08, 0.035))
    kit.fix([foot, sleeve(pipe, pipe + 0.022, 0.06) + [0, away, 0.034]], coat)
    kit.fix([cylinder(pipe, tall + high, 20) + [0, away, 0.03 + (tall + high) / 2]], metal)
    front, back = -radius - dice.between(0.03, 0.06), away + pipe + 0.02
    head = _bored((-x, front, tall), (x, back, tall + high), radius + 0.001)
    kit.fix([*head, sleeve(radius + 0.0015, radius + 0.014, 0.02) + [0, 0, tall - 0.0195]], coat)
    motor = dice.between(0.055, 0.075)
    y = back + motor + 0.012
    kit.fix([cylinder(motor, 0.85 * high, 18) + [0, y, tall + high * 0.55]], looks.painted_metal(dice))
    kit.fix([box((0.06, 0.04, 0.05), (0, back + 0.01, tall + 0.5 * high))], metal)
    _belt_cover(dice, kit, x * 0.95, front, y + motor, tall + high, coat)
    _quill(dice, kit, tall, high * 0.9, radius, x, metal)
    _buttons(dice, kit, np.array([dice.between(-0.4, 0.3) * x, front, tall + 0.55 * high]))
    level = dice.between(0.105, min(tall - 0.48, 0.5 * tall))
    _work_table(dice, kit, away, pipe, level, tall - level - 0.45)
    if dice.chance(0.4):
        y, side = -radius - 0.03, dice.sign()
        pane = [
            box((0.1, 0.004, 0.1), (0, y, tall - 0.075)),
            cylinder(0.006, 0.1) + [side * 0.052, y, tall - 0.075],
        ]
        kit.fix([box((0.016, 0.016, 0.024), (side * 0.052, y, tall - 0.0125))], metal)
        kit.add("guard", swing(side, side * 0.052, y, 1.6), [(pane, looks.glass(dice))])


def _drill_stand(dice: Dice, kit: Assembly) -> None:
    """A hand drill in a carriage that a lever moves along a thin column."""
    coat, metal, shell = looks.painted_metal(dice), looks.metal(dice), looks.plastic(dice)
    away, pipe, tall = dice.between(0.1, 0.15), dice.between(0.012, 0.02), dice.between(0.4, 0.55)
    foot = between((-0.09, -0.1, 0), (0.09, away + 0.05, 0.018))
    kit.fix([foot, sleeve(pipe, pipe + 0.014, 0.04) + [0, away, 0.017]], coat)
    kit.fix([cylinder(pipe, tall, 16) + [0, away, 0.01 + tall / 2]], metal)
    z, ring = dice.between(0.55, 0.62) * tall, dice.between(0.024, 0.03)
    arm: Pieces = [
        sleeve(pipe + 0.001, pipe + 0.016, 0.09) + [0, away, z],
        sleeve(ring, ring + 0.014, 0.03) + [0, 0, z],
    ]
    arm += [between((-0.018, ring + 0.004, z), (0.018, away - pipe - 0.004, z + 0.03))]
    carriage = kit.add("carriage", slide(DOWN, z - 0.28 * tall, -0.05), [(arm, coat)])
    trunk = [
        cylinder(ring - 0.0005, 0.03, 18) + [0, 0, z + 0.015],
        cylinder(1.35 * ring, 0.14, 18) + [0, 0, z + 0.102],
    ]
    grip = between((-0.016, -0.15, z + 0.13), (0.016, -ring, z + 0.165))
    kit.fix([*trunk, grip], shell, carriage)
    kit.fix([box((0.05, 0.06, 0.07), (0, -0.17, z + 0.147))] if dice.chance(0.5) else [], DARK, carriage)
    spot = np.array([0, -ring * 1.35 - 0.03, z + 0.129])
    kit.add(
        "trigger", slide(UP, 0.006), [([box((0.014, 0.03, 0.014), spot - [0, 0, 0.006])], DARK)], carriage
    )
    nose = moved(chuck(dice, 0.02, 0.045), (0, 0, z - 0.001))
    kit.add("chuck", spin((0, 0, z), UP), [(nose, metal)], carriage)
    pin = np.array([pipe + 0.017, away, z + 0.045])
    lever = [
        lying(0.014, 0.03) + [0.015, 0, 0],
        rod((0.02, 0, 0), (0.03, -0.17, 0.08), 0.006, 8),
        ball_knob(0.016) + [0.03, -0.17, 0.08],
    ]
    kit.add("handle", hinge(pin, RIGHT, dice.between(1.2, 2.0)), [(moved(lever, pin), metal)], carriage)
    spot = np.array([0, away + pipe + 0.016, z + 0.06])
    screw = moved(turned(dial(dice, 0.016), rotation(UP, np.pi)), spot)
    kit.add("knob", turning(dice, spot), [(screw, DARK)], carriage)


def _mill_drill(dice: Dice, kit: Assembly) -> None:
    """A head on an upright dovetail over a table that slides both ways, all moved by hand wheels."""
    coat, metal, tall = looks.painted_metal(dice), looks.metal(dice), dice.between(0.75, 0.95)
    x, radius, high, away = (
        0.09,
        dice.between(0.026, 0.036),
        dice.between(0.22, 0.3),
        dice.between(0.16, 0.22),
    )
    kit.fix(
        [
            between((-0.13, -0.2, 0), (0.13, away + 0.16, 0.07)),
            between((-0.09, away + 0.02, 0.07), (0.09, away + 0.16, tall)),
        ],
        coat,
    )
    kit.fix(
        [
            between((-0.05, away, 0.2), (0.05, away + 0.02, tall)),
            between((-0.06, -0.19, 0.07), (0.06, away - 0.02, 0.085)),
        ],
        metal,
    )
    saddle = [
        between((-0.1, -0.1, 0.0865), (0.1, 0.1, 0.13)),
        *[between((s * 0.081 - 0.019, -0.1, 0.072), (s * 0.081 + 0.019, 0.1, 0.0865)) for s in (-1, 1)],
    ]
    first = kit.add("saddle", slide(FRONT, 0.06, -0.04), [(saddle, coat)])
    spot = np.array([0, -0.201, 0.045])
    kit.add("handwheel", spin(spot, FRONT), [(moved(handwheel(dice, 0.042), spot), metal)])
    half = dice.between(0.22, 0.32)
    top = [
        between((-half, -0.075, 0.1315), (half, 0.075, 0.15)),
        *[
            between((-half, y - 0.012, 0.15), (half, y + 0.012, 0.165))
            for y in (-0.063, -0.021, 0.021, 0.063)
        ],
    ]
    second = kit.add("table", slide(RIGHT, half - 0.12, 0.12 - half), [(top, metal)], first)
    for side in dice.pick(((1,), (-1, 1))):
        spot = np.array([side * (half + 0.001), 0, 0.145])
        kit.add(
            "handwheel",
            spin(spot, (side, 0, 0)),
            [(moved(sideways(handwheel(dice, 0.05), side), spot), metal)],
            second,
        )
    low = dice.between(0.42, 0.46)
    head = _bored((-x, -radius - 0.04, low), (x, away - 0.003, low + high), radius + 0.001)
    head += [
        between((s * 0.064 - 0.012, away - 0.003, low), (s * 0.064 + 0.012, away + 0.018, low + high))
        for s in (-1, 1)
    ]
    head.append(cylinder(0.07, 0.16, 18) + [0, 0.02, low + high + 0.08])
    number = kit.add("head", slide(UP, tall - low - 0.7 * high, 0.4 - low), [(head, coat)])
    _quill(dice, kit, low, 0.85 * high, radius, x, metal, number)
    _buttons(dice, kit, np.array([-0.04, -radius - 0.04, low + 0.6 * high]), number)
    if dice.chance(0.6):
        clamp_lever(kit, (x + 0.001, away - 0.02, low + 0.8 * high), 0.06, metal, number)


def _drill_press(dice: Dice) -> list[Body]:
    """A drill over a table: on a column with belts, in a stand, or on an upright slide."""
    kit = Assembly("base")
    dice.weighted([(6, _column_press), (2, _drill_stand), (3, _mill_drill)])(dice, kit)
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("drill_press", _drill_press),
    Category("power_saw", power_saw),
    Category("lathe", lathe),
    Category("printer_3d", printer_3d),
)
