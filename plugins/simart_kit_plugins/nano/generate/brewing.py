"""Small things of kitchens that are screwed, shaken and fried with: moka pots, shakers and air fryers."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import X, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, revolve, tube
from . import looks
from .assembling import Assembly, dial, disc, holder, press, pull, turning
from .category import Category
from .machine_tools_parts import DARK
from .mixing_machines_parts import cup
from .objects import Body, Look, free, hinge, spin
from .rigging import LEFT, UP, ball_knob, lying

_WALL = 0.012
"""Thickness of an air fryer's walls [m]."""


def _jug(dice: Dice, waist: float, rim: float, high: float, tall: float, sides: int) -> tuple[Pieces, Pieces]:
    """A jug that narrows above its foot, with a spout and a pipe inside, and its grip."""
    line = [
        (0, high + 0.001),
        (0.95 * waist, high + 0.001),
        (waist, high + 0.014),
        (0.9 * waist, high + 0.02),
        (rim, high + tall),
    ]
    inner = [
        (rim - 0.003, high + tall),
        (0.9 * waist - 0.003, high + 0.024),
        (0.012, high + 0.024),
        (0.006, high + 0.8 * tall),
        (0, high + 0.8 * tall),
    ]
    triangle = np.array([(-0.5, -0.5), (0.5, -0.5), (0, 0.5)])
    beak = loft(triangle, [(0, 0, -0.035), (0.03, 0.03, 0.0), (0, 0, 0.0)]) * [1, -1, 1]
    jug = [revolve(line + inner, sides), beak + [0, -rim - 0.006, high + tall]]
    x = rim + dice.between(0.035, 0.05)
    bow = [(waist, 0, high + 0.75 * tall), (x, 0, high + 0.85 * tall), (x, 0, high + 0.1 * tall)]
    return jug, turned([tube(np.array(bow), 0.008, 8)], rotation(UP, np.pi / 2))


def _jug_lid(dice: Dice, kit: Assembly, metal: Look, rim: float, top: float, sides: int, jug: int) -> None:
    """A lid with a knob, on a hinge at the jug's back."""
    pin = np.array([0, rim + 0.006, top + 0.002])
    ears = [pin + [s * 0.009, -0.004, -0.006] for s in (-1, 1)]
    kit.fix([boxes((0.006, 0.014, 0.012), ears)], metal, jug)
    line = [(0, top), (rim, top), (rim, top + 0.003), (0.3 * rim, top + 0.016), (0, top + 0.016)]
    lid = [revolve(line, sides), lying(0.003, 0.011) + pin, box((0.01, 0.012, 0.004), pin + [0, -0.006, 0])]
    knob = [
        cylinder(0.005, 0.01) + [0, 0, top + 0.02],
        ball_knob(dice.between(0.008, 0.012)) + [0, 0, top + 0.03],
    ]
    kit.add("lid", hinge(pin, LEFT, dice.between(1.4, 1.9)), [(lid, metal), (knob, DARK)], jug)


def _moka_pot(dice: Dice) -> list[Body]:
    """A boiler, on which a jug with a spout, a handle and a hinged lid is screwed."""
    kit, metal = Assembly("boiler"), looks.metal(dice)
    radius, high, sides = dice.between(0.04, 0.055), dice.between(0.07, 0.09), dice.pick((8, 10, 24))
    waist = 0.78 * radius
    line = [(0, 0), (radius, 0), (waist, high - 0.012), (waist, high), (0, high)]
    valve = pointed(cylinder(0.006, 0.012), X) + [0.93 * radius, 0, 0.3 * high]
    kit.fix([revolve(line, sides), valve], metal)
    tall, rim = dice.between(0.08, 0.11), dice.between(0.95, 1.1) * radius
    jug, grip = _jug(dice, waist, rim, high, tall, sides)
    number = kit.add("jug", spin((0, 0, high), UP), [(jug, metal), (grip, DARK)])
    _jug_lid(dice, kit, metal, rim, high + tall + 0.0015, sides, number)
    return kit.done()


def _cap_line(plain: bool, neck: float, z: float, rise: float) -> list[tuple[float, float]]:
    """Half of a section of a cap over a neck: a plain one, or one with a waist."""
    if plain:
        return [
            (neck + 0.003, z),
            (neck + 0.003, z + 0.8 * rise),
            (0.8 * neck, z + rise),
            (0, z + rise),
            (0, z + rise - 0.003),
            (neck + 0.001, z + 0.8 * rise - 0.003),
            (neck + 0.001, z),
            (neck + 0.003, z),
        ]
    return [
        (neck + 0.002, z),
        (0.7 * neck, z + 0.6 * rise),
        (neck, z + 0.85 * rise),
        (0, z + rise),
        (0, z + rise - 0.003),
        (0.65 * neck, z + 0.6 * rise - 0.002),
        (neck + 0.001, z),
        (neck + 0.002, z),
    ]


def _cocktail_shaker(dice: Dice) -> list[Body]:
    """A cup, a shoulder pushed on it, and a cap on that."""
    kit, metal = Assembly("cup"), looks.metal(dice)
    radius, high = dice.between(0.038, 0.048), dice.between(0.13, 0.18)
    kit.fix([cup([(0.72 * radius, 0), (radius, high)], 0.0015, 28)], metal)
    low, tall, neck = high + 0.0008, dice.between(0.04, 0.06), dice.between(0.4, 0.5) * radius
    line = [
        (radius + 0.001, low),
        (radius + 0.001, low + 0.012),
        (0.8 * radius, low + 0.7 * tall),
        (neck, low + tall),
        (0, low + tall),
        (0, low + tall - 0.002),
        (neck - 0.002, low + tall - 0.002),
        (0.8 * radius - 0.002, low + 0.7 * tall),
        (radius - 0.002, low + 0.01),
        (radius - 0.002, low),
        (radius + 0.001, low),
    ]
    middle = kit.add("top", free(), [([revolve(line, 28)], metal)])
    z, rise = low + tall - 0.01, dice.between(0.03, 0.045)
    shape = _cap_line(dice.chance(0.5), neck, z, rise)
    kit.add("cap", free(), [([revolve(shape, 24)], metal)], middle)
    return kit.done()


def _fryer_body(
    kit: Assembly, coat: Look, skin: FloatArray, size: tuple[float, float, float], low: float, tall: float
) -> None:
    """A head with a round top over walls, a floor and a back, open in front."""
    wide, deep, high = size
    stages = [
        (0, 0, low + tall),
        (wide, deep, low + tall),
        (wide, deep, 0.75 * high),
        (0.75 * wide, 0.75 * deep, high),
        (0, 0, high),
    ]
    kit.fix([loft(skin, stages)], coat)
    x, z = 0.5 * wide - _WALL / 2 - 0.001, low + tall / 2
    kit.fix([box((_WALL, 0.8 * deep, tall), (s * x, 0.05 * deep, z)) for s in (-1, 1)], coat)
    floor = box((wide - 0.002, 0.9 * deep, 0.025), (0, 0, low - 0.013))
    kit.fix([floor, box((0.8 * wide, _WALL, tall), (0, 0.45 * deep - _WALL, z))], coat)


def _fryer_basket(
    dice: Dice, kit: Assembly, coat: Look, wide: float, deep: float, low: float, tall: float
) -> None:
    """A basket behind a front with a grip."""
    inside = wide - 2 * _WALL - 0.008
    bowl = cup([(0.44 * inside, 0), (0.49 * inside, tall - 0.02)], 0.003, 24)
    bin_ = [bowl * [1, min(1.0, 0.8 * deep / inside), 1] + [0, -0.02, low + 0.004]]
    y, z = -0.47 * deep, low + 0.6 * tall
    face = [box((inside + 2 * _WALL, 0.02, tall - 0.008), (0, y, low + tall / 2))]
    grip = moved(holder(dice, dice.between(0.1, 0.16), dice.chance(0.3)), (0, y - 0.01, z))
    if dice.chance(0.5):
        grip = [box((0.03, 0.11, 0.035), (0, y - 0.065, z)), box((0.05, 0.02, 0.05), (0, y - 0.012, z))]
    kit.add("basket", pull(0.8 * deep), [(bin_, DARK), (face, coat), (grip, DARK)])


def _fryer_controls(dice: Dice, kit: Assembly, coat: Look, spot: FloatArray) -> None:
    """One dial or two, or a row of keys."""
    if dice.chance(0.6):
        for z in dice.pick(((0.0,), (-0.024, 0.024))):
            place = spot + [0, 0, z]
            kit.add("dial", turning(dice, place), [(moved(dial(dice, 0.019), place), coat)])
    else:
        for k in range(dice.whole(3, 5)):
            place = spot + [0.03 * (k - 2), 0, 0]
            kit.add("button", press(0.002), [(moved([disc(0.01, 0.004, 14)], place), coat)])


def _air_fryer(dice: Dice) -> list[Body]:
    """An egg or a block with a basket that slides out by its grip, with dials or keys above."""
    kit, coat = Assembly("body"), looks.plastic(dice)
    wide, deep, high = dice.between(0.24, 0.32), dice.between(0.27, 0.34), dice.between(0.27, 0.36)
    low, tall = 0.03, dice.between(0.42, 0.5) * high
    skin = rounded(dice.between(0.15, 0.4), wide / deep, 5)
    _fryer_body(kit, coat, skin, (wide, deep, high), low, tall)
    _fryer_basket(dice, kit, coat, wide, deep, low, tall)
    spot = np.array([0, -0.5 * deep - 0.0005, (low + tall + 0.75 * high) / 2 + 0.01])
    kit.fix([box((0.5 * wide, 0.02, 0.3 * high - 0.02), spot + [0, 0.0105, 0])], DARK)
    _fryer_controls(dice, kit, coat, spot)
    return kit.done()


CATEGORIES = (
    Category("moka_pot", _moka_pot),
    Category("cocktail_shaker", _cocktail_shaker),
    Category("air_fryer", _air_fryer),
)
