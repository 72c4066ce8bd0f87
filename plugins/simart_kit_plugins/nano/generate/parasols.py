"""Parasols, on a pole in their middle or hanging from an arm."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import Y, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, rod
from . import looks
from .assembling import Assembly, turning
from .category import Category
from .machine_tools_parts import DARK
from .objects import Body, Look, hinge, spin
from .rigging import FRONT, RIGHT, UP


def _side_pole(kit: Assembly, high: float, metal: Look) -> int:
    """A pole that turns in a foot; gives its number."""
    kit.fix([cylinder(0.05, 0.3, 16) + [0, 0, 0.2]], metal)
    pole = [
        cylinder(0.035, high - 0.36, 14) + [0, 0, high / 2 + 0.18],
        cylinder(0.052, 0.04, 16) + [0, 0, 0.3725],
    ]
    return kit.add("pole", spin((0, 0, 0.35), UP), [(pole, metal)])


def _arm(kit: Assembly, pin: FloatArray, reach: float, metal: Look, pole: int) -> int:
    """An arm that tips about a pin at a pole's top, with a stub down from its end; gives its number."""
    arm = [
        rod((0, -0.045, 0), (0, -reach, 0.35), 0.025, 10),
        boxes((0.02, 0.1, 0.1), [(t * 0.047, 0, 0) for t in (-1, 1)]),
        box((0.11, 0.02, 0.06), (0, -0.05, 0)),
        rod((0, -reach, 0.36), (0, -reach, 0.2), 0.015),
    ]
    return kit.add("arm", hinge(pin, RIGHT, 0.7, -0.15), [(moved(arm, pin), metal)], pole)


def _middle_pole(dice: Dice, kit: Assembly, high: float, metal: Look) -> None:
    """A pole that stands still in a foot, with a knob that holds it."""
    kit.fix([cylinder(0.035, 0.35, 14) + [0, 0, 0.22]], metal)
    kit.fix([cylinder(0.02, high - 0.3, 12) + [0, 0, 0.15 + high / 2]], metal)
    grip = np.array([0, -0.036, 0.36])
    knob = [
        pointed(cylinder(0.008, 0.03), Y) + grip - [0, 0.015, 0],
        box((0.05, 0.015, 0.02), grip - [0, 0.035, 0]),
    ]
    kit.add("knob", turning(dice, grip, FRONT), [(knob, DARK)])


def _cover(sides: int, radius: float, rise: float) -> tuple[Pieces, Pieces]:
    """The cloth of a canopy about z and the ribs under it."""
    angle = 2 * np.pi * np.arange(sides) / sides
    outline = np.column_stack([np.cos(angle), np.sin(angle)])
    stages = [(0, 0, rise), (radius, radius, 0), (radius, radius, -0.012), (0, 0, rise - 0.012)]
    top = (0, 0, rise - 0.02)
    ends = [(0.97 * radius * np.cos(a), 0.97 * radius * np.sin(a), 0.0) for a in angle]
    return [loft(outline, stages)], [rod(top, end, 0.008, 4) for end in ends]


def _crank(kit: Assembly, spot: FloatArray, pole: int) -> None:
    """A housing before a pole, with a crank on it."""
    kit.fix([box((0.06, 0.05, 0.1), spot - [0, 0.02, 0])], DARK, pole)
    crank = [
        box((0.015, 0.012, 0.11), (0, -0.03, -0.045)),
        pointed(cylinder(0.008, 0.04), Y) - [0, 0.02, 0],
        pointed(cylinder(0.012, 0.06), Y) - [0, 0.062, 0.095],
    ]
    pin = spot - [0, 0.045, 0]
    kit.add("crank", spin(pin, FRONT), [(moved(crank, pin), DARK)], pole)


def _parasol(dice: Dice) -> list[Body]:
    """A pole in a foot, with a canopy that tips and a crank; some hang from an arm at the side."""
    kit, metal, cloth = Assembly("foot"), looks.metal(dice), looks.fabric(dice)
    high, radius, rise = dice.between(2.0, 2.5), dice.between(0.9, 1.5), dice.between(0.25, 0.4)
    foot = cylinder(0.25, 0.06, 24) if dice.chance(0.5) else box((0.5, 0.5, 0.06))
    kit.fix(moved([foot], (0, 0, 0.03)), DARK)
    aside = dice.chance(0.35)
    if aside:
        pole, pin = _side_pole(kit, high, metal), np.array([0, 0, high - 0.1])
        holder = _arm(kit, pin, radius + 0.2, metal, pole)
        tip, spot = pin + [0, -radius - 0.2, 0.19], np.array([0, -0.037, 1.2])
        stem, drop = cylinder(0.03, 0.05) + [0, 0, rise - 0.03], [0, 0, -rise - 0.04]
    else:
        _middle_pole(dice, kit, high, metal)
        pole, holder = 0, 0
        tip, spot = np.array([0, 0, high + 0.03]), np.array([0, -0.022, 1.1])
        stem, drop = cylinder(0.018, rise + 0.01) + [0, 0, (rise - 0.05) / 2], [0, 0, 0]
    top, ribs = _cover(dice.pick((6, 8, 8, 4)), radius, rise)
    lean = dice.between(0, 0.3) if dice.chance(0.4) else 0.0
    yaw = rotation(RIGHT, lean)
    if not aside:
        kit.fix([box((0.03, 0.03, 0.05), tip - [0, 0, 0.035])], DARK)
    cover, bones = (moved(turned(moved(one, drop), yaw), tip) for one in (top, [*ribs, stem]))
    tips = hinge(tip, RIGHT, 0.6 - lean, -0.02 - lean)
    kit.add("canopy", tips, [(cover, cloth), (bones, metal)], holder)
    if dice.chance(0.7):
        _crank(kit, spot, pole)
    return kit.done()


CATEGORIES = (Category("parasol", _parasol),)
