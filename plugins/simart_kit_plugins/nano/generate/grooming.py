"""What hair and beards are groomed with."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import Y, moved, pointed, rotation, turned
from ...shapes.primitives import box, boxes, cylinder, loft, revolve, rod, torus
from . import looks
from .assembling import Assembly, dial, turning
from .category import Category
from .machine_tools_parts import DARK, sideways
from .objects import Body, Look, hinge, slide, spin
from .rigging import BACK, FRONT, LEFT, RIGHT, UP, lying


def _hair_straightener(dice: Dice) -> list[Body]:
    """Two arms about a pin at one end, with plates inside; at times a dial, a switch and a cord."""
    kit, shell = Assembly("lower arm"), looks.plastic(dice)
    long, wide, thick = dice.between(0.22, 0.3), dice.between(0.025, 0.045), dice.between(0.012, 0.018)
    angle = dice.between(0.12, 0.25)
    yaw = rotation(LEFT, angle)
    arm = _straightener_arm(long, wide, thick)
    plate = (0.75 * wide, 0.35 * long, 0.003)
    kit.fix([arm], shell)
    kit.fix([box(plate, (0, -0.78 * long + 0.02, thick + 0.0017))], looks.metal(dice))
    pin = np.array([0, 0.0, thick + 0.007])
    ears = boxes((0.2 * wide, 0.02, 0.012), [(s * 0.38 * wide, 0, thick + 0.005) for s in (-1, 1)])
    kit.fix([ears, lying(0.0025, wide) + pin], shell)
    upper = [arm * [1, 1, -1] - [0, 0, 0.007], box((0.45 * wide, 0.02, 0.018), (0, 0, 0.0))]
    upper = [np.ascontiguousarray(upper[0][:, ::-1]) + [0, 0, 2 * 0.007 + thick], upper[1]]
    hot = [box(plate, (0, -0.78 * long + 0.02, 0.0052))]
    other = kit.add(
        "upper arm",
        hinge(pin, RIGHT, angle, -0.3),
        [(moved(turned(upper, yaw), pin), shell), (moved(turned(hot, yaw), pin), looks.metal(dice))],
    )
    if dice.chance(0.7):
        spot = np.array([wide / 2 + 0.0005, -0.25 * long, thick / 2])
        motion = turning(dice, spot, RIGHT)
        kit.add("dial", motion, [(moved(sideways(dial(dice, 0.4 * thick), 1), spot), DARK)])
    if dice.chance(0.6):
        spot = pin + yaw @ np.array([0, -0.3 * long, thick + 0.0075])
        key = [box((0.3 * wide, 0.02, 0.004), (0, 0, 0.0025))]
        kit.add("switch", slide(yaw @ np.array(FRONT), 0.008), [(moved(turned(key, yaw), spot), DARK)], other)
    cord = np.array([0, 0.0205, thick / 2])
    if dice.chance(0.7):
        tail = [
            pointed(cylinder(0.35 * thick, 0.03, 12), Y) + [0, 0.016, 0],
            rod((0, 0.03, 0), (0, 0.1, 0), 0.003, 8),
        ]
        kit.add("cord", spin(cord, BACK), [(moved(tail, cord), DARK)])
    return kit.done()


def _straightener_arm(long: float, wide: float, thick: float) -> FloatArray:
    """The lower arm on z = 0, its back end behind the pin at y = 0."""
    rings = [(0, 0, 0), (0.9 * wide, 0.97 * long, 0), (wide, long, 0.3 * thick), (wide, long, thick)]
    return loft(rounded(0.3, wide / long, 4), [*rings, (0, 0, thick)]) + [0, -long / 2 + 0.02, 0]


def _hair_dryer(dice: Dice) -> list[Body]:
    """A barrel with a handle that folds, a nozzle that turns, a grille behind, switches and a button."""
    kit, shell = Assembly("barrel"), looks.plastic(dice)
    radius, long = dice.between(0.032, 0.045), dice.between(0.15, 0.22)
    line = [
        (0, 0.5 * long),
        (0.85 * radius, 0.5 * long),
        (radius, 0.3 * long),
        (0.95 * radius, -0.2 * long),
        (0.7 * radius, -0.5 * long),
        (0.62 * radius, -0.5 * long),
        (0.62 * radius, 0.3 * long),
        (0, 0.3 * long),
    ]
    kit.fix([pointed(revolve(line, 28), Y)], shell)
    pin = np.array([0, dice.between(0.0, 0.12) * long, -radius - 0.012])
    kit.fix([boxes((0.008, 0.03, 0.03), [pin + [s * 0.018, 0, 0.006] for s in (-1, 1)])], shell)
    _dryer_handle(dice, kit, pin, shell)
    tip = np.array([0, -long / 2 + 0.01, 0])
    wide = dice.between(1.2, 1.9) * radius
    if dice.chance(0.75):
        nozzle = moved(turned([_dryer_nozzle(radius, wide)], rotation(RIGHT, np.pi / 2)), tip)
        kit.add("nozzle", spin(tip, FRONT), [(turned(nozzle, rotation(BACK, dice.between(0, 3.1))), DARK)])
    if dice.chance(0.6):
        spot = np.array([0, long / 2 + 0.0005, 0])
        cap = [
            pointed(cylinder(0.8 * radius, 0.012, 24), Y) + [0, 0.0062, 0],
            *[pointed(torus(r * radius, 0.002, 20), Y) + [0, 0.013, 0] for r in (0.3, 0.55)],
            box((0.02, 0.006, 0.006), (0, 0.012, 0.75 * radius)),
        ]
        kit.add("cap", spin(spot, BACK), [(moved(cap, spot), DARK)])
    return kit.done()


def _dryer_handle(dice: Dice, kit: Assembly, pin: FloatArray, shell: Look) -> None:
    """A handle below the barrel, that folds, with switches and at times a button in front."""
    rings = [(0, 0, -0.017), (0.038, 0.045, -0.017), (0.03, 0.036, -0.13), (0, 0, -0.13)]
    grip = [
        box((0.026, 0.03, 0.02), (0, 0, -0.006)),
        loft(rounded(0.4, 0.8, 4), rings),
        lying(0.006, 0.05),
    ]
    start = dice.between(0.05, 0.2)
    yaw = rotation(RIGHT, start)
    handle = kit.add("handle", hinge(pin, LEFT, 1.3 + start), [(moved(turned(grip, yaw), pin), shell)])
    for k in range(dice.whole(1, 2)):
        spot = pin + yaw @ np.array([0, -0.0225, -0.045 - 0.035 * k])
        key = [box((0.016, 0.006, 0.014), (0, -0.0035, 0)), box((0.014, 0.004, 0.003), (0, -0.008, 0.003))]
        motion = slide(yaw @ np.array(UP), 0.008, -0.004)
        kit.add("switch", motion, [(moved(turned(key, yaw), spot), DARK)], handle)
    if dice.chance(0.5):
        spot = pin + yaw @ np.array([0, -0.022, -0.028])
        cool = moved(turned([box((0.012, 0.006, 0.01), (0, -0.0032, 0))], yaw), spot)
        kit.add("button", slide(yaw @ np.array(BACK), 0.002), [(cool, looks.plastic(dice))], handle)


def _dryer_nozzle(radius: float, wide: float) -> FloatArray:
    """A hollow nozzle up from z = 0, round below and a slit above."""
    rings = [
        (1.55 * radius, 1.55 * radius, 0),
        (1.6 * radius, 1.6 * radius, 0.02),
        (wide, 0.35 * radius, 0.05),
        (wide - 0.006, 0.35 * radius - 0.006, 0.05),
        (1.48 * radius, 1.48 * radius, 0.015),
        (1.48 * radius, 1.48 * radius, 0),
        (1.55 * radius, 1.55 * radius, 0),
    ]
    return loft(rounded(0.3, 1.0, 5), rings)


def _rotary_shaver(dice: Dice) -> list[Body]:
    """A handle with round heads in a plate, a trimmer that flips out behind, and a switch or a button."""
    kit, shell = Assembly("handle"), looks.plastic(dice)
    wide, high = dice.between(0.045, 0.06), dice.between(0.1, 0.13)
    rings = [
        (0, 0, 0),
        (0.7 * wide, 0.6 * wide, 0),
        (wide, 0.8 * wide, 0.4 * high),
        (0.8 * wide, 0.65 * wide, high),
        (0, 0, high),
    ]
    kit.fix([loft(rounded(0.4, 1.2, 5), rings)], shell)
    _shaving_head(dice, kit, wide, high)
    if dice.chance(0.7):
        pin = np.array([0, 0.4 * wide + 0.004, 0.72 * high])
        flip = [box((0.5 * wide, 0.006, 0.28 * high), (0, 0.0, -0.14 * high)), lying(0.003, 0.5 * wide)]
        kit.fix([box((0.3 * wide, 0.008, 0.02), pin + [0, -0.008, 0])], shell)
        kit.add("trimmer", hinge(pin, RIGHT, 1.6), [(moved(flip, pin + [0, 0.001, 0]), looks.metal(dice))])
    spot = np.array([0, -0.4 * wide - 0.0012, 0.5 * high])
    if dice.chance(0.5):
        key = [pointed(cylinder(0.011, 0.006, 18), Y)]
        kit.add("button", slide(BACK, 0.002), [(moved(key, spot - [0, 0.002, 0]), DARK)])
    else:
        key = [box((0.016, 0.006, 0.02)), box((0.014, 0.003, 0.003), (0, -0.004, 0.004))]
        kit.add("switch", slide(UP, 0.01), [(moved(key, spot - [0, 0.002, 0]), DARK)])
    return kit.done()


def _shaving_head(dice: Dice, kit: Assembly, wide: float, high: float) -> None:
    """A tilted plate on top of the handle, with two or three cutters that spin."""
    heads = dice.pick((2, 3, 3))
    tilt, radius = rotation(RIGHT, dice.between(0.2, 0.5)), 0.4 * wide if heads == 3 else 0.36 * wide
    top, up = np.array([0, 0, high + 0.006]), tilt @ np.array(UP)
    circle = np.array([(np.cos(a), np.sin(a)) for a in np.arange(24) * np.pi / 12]) * 0.5
    rings = [(0, 0, 0), (1.0 * wide, 0.8 * wide, 0), (1.45 * wide, 1.2 * wide, 0.012), (0, 0, 0.012)]
    plate = [loft(circle, rings), cylinder(0.2 * wide, 0.02) - [0, 0, 0.006]]
    number = kit.add("head", spin(top, up), [(moved(turned(plate, tilt), top), DARK)])
    ring = [
        cylinder(0.75 * radius, 0.005, 20) + [0, 0, 0.003],
        torus(0.5 * radius, 0.0012, 18) + [0, 0, 0.006],
        box((0.8 * radius, 0.003, 0.002), (0, 0, 0.0055)),
    ]
    for k in range(heads):
        a = 2 * np.pi * k / heads + np.pi / 2 * (heads == 3)
        spot = np.array([np.cos(a), np.sin(a) * (0.85 if heads == 3 else 1), 0]) * 0.42 * wide
        spot = spot + [0, 0, 0.0125]
        cutter = moved(turned(moved(ring, spot), tilt), top)
        kit.add("cutter", spin(top + tilt @ spot, up), [(cutter, looks.metal(dice))], number)


CATEGORIES = (
    Category("hair_straightener", _hair_straightener),
    Category("hair_dryer", _hair_dryer),
    Category("shaver", _rotary_shaver),
)
