"""Cases to carry things in: make-up cases, at times with a tray, and cases for instruments."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import moved, rotation, turned
from ...shapes.primitives import Pieces, box, loft, open_box, tube
from . import looks
from .assembling import Assembly
from .category import Category
from .machine_tools_parts import DARK
from .objects import Body, Look, hinge, slide
from .rigging import LEFT, RIGHT, UP, lying


def _bow(half: float, reach: float, thick: float = 0.007) -> Pieces:
    """A handle that lies along -y from ears at x = -half and half."""
    line = [(-half, 0, 0), (-0.8 * half, -reach, 0), (0.8 * half, -reach, 0), (half, 0, 0)]
    return [tube(np.array(line), thick, 8)]


def _latch(kit: Assembly, spot: FloatArray, look: Look, to: int) -> None:
    """A clasp on a lid's front edge, which swings up and away."""
    kit.fix([box((0.03, 0.004, 0.018), spot - [0, 0.001, 0.024])], look)
    clasp = [box((0.024, 0.004, 0.045), (0, -0.004, -0.018)), lying(0.003, 0.024)]
    kit.add("latch", hinge(spot - [0, 0.004, 0], LEFT, 1.4), [(moved(clasp, spot - [0, 0.004, 0]), look)], to)


def _half_lids(kit: Assembly, coat: Look, metal: Look, size: tuple[float, float, float]) -> None:
    """Two halves of a lid that open to both sides of a bar with a handle."""
    wide, deep, high = size
    top = high + 0.004
    posts = [box((0.012, 0.02, 0.03), (s * (wide / 2 + 0.006), 0, high - 0.01)) for s in (-1, 1)]
    kit.fix([box((wide, 0.02, 0.02), (0, 0, top)), *posts], metal)
    for s in (-1, 1):
        lid = [box((wide, deep / 2 - 0.016, 0.012), (0, s * (deep / 4 + 0.003), top + 0.004))]
        motion = hinge((0, s * (deep / 2 + 0.004), top + 0.002), (s * -1.0, 0, 0), 1.9)
        kit.add("lid", motion, [(lid, coat)], name="front_lid" if s < 0 else "rear_lid")
    ears = np.array([0, 0, top + 0.018])
    kit.fix([box((0.012, 0.014, 0.018), ears + [s * 0.07, 0, -0.004]) for s in (-1, 1)], metal)
    kit.add("handle", hinge(ears, LEFT, 1.6, -0.05), [(moved(_bow(0.062, 0.05), ears), DARK)])


def _back_lid(dice: Dice, kit: Assembly, coat: Look, metal: Look, size: tuple[float, float, float]) -> None:
    """A lid that opens back, with a handle on it and two latches."""
    wide, deep, high = size
    rise, pin = dice.between(0.03, 0.06), np.array([0, deep / 2 + 0.004, high + 0.002])
    lid = turned([open_box((wide, deep, rise), 0.004)], rotation(RIGHT, np.pi))
    lid = moved(lid, (0, 0, high + 0.0015 + rise))
    number = kit.add("lid", hinge(pin, LEFT, dice.between(1.5, 1.8)), [(lid, coat)])
    ears = np.array([0, 0.02, high + rise + 0.01])
    kit.fix([box((0.012, 0.014, 0.02), ears + [s * 0.07, 0, -0.002]) for s in (-1, 1)], metal, number)
    kit.add("handle", hinge(ears, LEFT, 1.6), [(moved(_bow(0.062, 0.05), ears), DARK)], number)
    for s in (-1, 1):
        _latch(kit, np.array([s * 0.3 * wide, -deep / 2 - 0.001, high + 0.4 * rise]), metal, number)


def _makeup_case(dice: Dice) -> list[Body]:
    """A box with a lid in halves that open to both sides, or one that opens back, at times a tray inside."""
    kit, coat, metal = Assembly("case"), looks.painted_metal(dice), looks.metal(dice)
    wide, deep, high = dice.between(0.26, 0.38), dice.between(0.2, 0.28), dice.between(0.16, 0.24)
    kit.fix([open_box((wide, deep, high), 0.005)], coat)
    kit.fix([box((0.012, deep + 0.004, 0.012), (s * wide / 2, 0, high - 0.004)) for s in (-1, 1)], metal)
    if dice.chance(0.5):
        _half_lids(kit, coat, metal, (wide, deep, high))
    else:
        _back_lid(dice, kit, coat, metal, (wide, deep, high))
    if dice.chance(0.5):
        drop = 0.05
        tray = [open_box((wide - 0.03, deep - 0.03, drop), 0.003) + [0, 0, high - drop - 0.012]]
        kit.add("tray", slide(UP, 0.8 * high), [(tray, looks.plastic(dice))])
    return kit.done()


def _outline(dice: Dice, long: float, wide: float) -> FloatArray:
    """(N, 2) of a case for a violin, a guitar or a horn, along x, about 0; or a plain one."""
    at = np.linspace(0, 1, 14)
    style = dice.unit()
    if style < 0.4:  # a body and a neck
        half = np.interp(at, [0, 0.1, 0.3, 0.45, 0.6, 0.75, 1], [0.3, 0.5, 0.42, 0.48, 0.3, 0.17, 0.14])
    elif style < 0.7:
        half = np.interp(at, [0, 0.05, 0.4, 0.5, 1], [0.4, 0.5, 0.5, 0.3, 0.2])
    else:
        half = np.interp(at, [0, 0.03, 0.97, 1], [0.44, 0.5, 0.5, 0.44])
    x = (at - 0.5) * long
    return np.concatenate([np.column_stack([x, -half * wide]), np.column_stack([x, half * wide])[::-1]])


def _case_handle(
    dice: Dice, kit: Assembly, metal: Look, line: FloatArray, rim: FloatArray, x: float, z: float
) -> None:
    """A handle on the front of an instrument's case, which swings."""
    y = min(float(np.interp(place, line[:14, 0], rim[:14, 1])) for place in (x, x - 0.06, x + 0.06))
    ears = np.array([x, y - 0.008, z])
    kit.fix([box((0.012, 0.016, 0.014), ears + [s * 0.065, 0.003, 0]) for s in (-1, 1)], metal)
    grip = turned(_bow(0.058, 0.045, 0.006), rotation(RIGHT, dice.pick((0.0, 1.3))))
    kit.add("handle", hinge(ears, LEFT, 1.2, -1.3), [(moved(grip, ears), DARK)])


def _instrument_case(dice: Dice) -> list[Body]:
    """Two shells in the outline of an instrument, with latches and a handle."""
    kit, coat = Assembly("case"), looks.plastic(dice) if dice.chance(0.6) else looks.fabric(dice)
    metal = looks.metal(dice)
    long, wide, high = dice.between(0.5, 1.1), dice.between(0.25, 0.4), dice.between(0.06, 0.1)
    line = _outline(dice, long, wide)
    rim = line * (1 - 0.02)
    floor = [
        (0, 0, 0),
        (0.96, 0.96, 0),
        (1, 1, 0.02),
        (1, 1, high),
        (0.97, 0.94, high),
        (0.97, 0.94, 0.008),
        (0, 0, 0.008),
    ]
    kit.fix([loft(rim, floor)], coat)
    rise, low = dice.between(0.4, 1.0) * high, high + 0.0015
    roof = [
        (0, 0, low + rise),
        (0.95, 0.95, low + rise),
        (1, 1, low + 0.7 * rise),
        (1, 1, low),
        (0.97, 0.94, low),
        (0.97, 0.94, low + 0.7 * rise),
        (0, 0, low + rise - 0.006),
    ]
    pin = np.array([0, rim[:, 1].max() + 0.004, high + 0.001])
    number = kit.add("top", hinge(pin, LEFT, dice.between(1.5, 1.9)), [([loft(rim, roof)[:, ::-1]], coat)])
    kit.fix([lying(0.004, 0.03) + pin + [x * long, 0, 0] for x in (-0.3, -0.15)], metal)
    count = dice.whole(2, 4)
    for x in np.linspace(-0.42, 0.38, count) * long:
        y = np.interp(x, line[:14, 0], rim[:14, 1])
        _latch(kit, np.array([x, y - 0.004, high + 0.4 * rise]), metal, number)
    _case_handle(dice, kit, metal, line, rim, np.linspace(-0.42, 0.38, count)[:2].mean() * long, 0.6 * high)
    return kit.done()


CATEGORIES = (Category("makeup_case", _makeup_case), Category("instrument_case", _instrument_case))
