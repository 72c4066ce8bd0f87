"""Trash cans: lids with pedals, swing flaps, two lids, wheels, liners."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.handles import handle
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import X, mirrored, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, between, box, boxes, cylinder, loft, rod, tube, vessel
from . import looks
from .assembly import Assembly, Leaf
from .carcass import Size, board
from .category import Category
from .objects import Body, Look, free, hinge, surface
from .rolling import wheel_leaf


def _trash_can(dice: Dice) -> Sequence[Body]:
    return dice.weighted([(5, _plain), (2, _swing), (2, _street), (1.5, _split)])(dice)


def _begun(dice: Dice) -> tuple[Assembly, FloatArray, Size, float, Look]:
    """A vessel: its outline, its mouth's size and its flare."""
    width = dice.between(0.2, 0.5)
    size = (width, width * dice.between(0.7, 1.15), dice.between(0.25, 0.8))
    round_one = dice.chance(0.45)
    outline = ngon(20) if round_one else dice.pick((SQUARE, rounded(0.1), rounded(0.25)))
    flare, look = (
        dice.pick((1.0, dice.between(1.02, 1.25))),
        dice.pick((looks.plastic(dice), looks.metal(dice))),
    )
    made = Assembly("body")
    made.fix([vessel(outline, size, dice.between(0.002, 0.01), flare)], look)
    if dice.chance(0.4):
        ring = [(1.01, 1.01, 0.0), (1.04, 1.04, 0.0), (1.04, 1.04, 0.03), (1.01, 1.01, 0.03)]
        made.fix([loft(outline, [(a * size[0], b * size[1], c) for a, b, c in ring])], looks.rubber(dice))
    return made, outline, (size[0] * flare, size[1] * flare, size[2]), flare, look


def _cap(dice: Dice, outline: FloatArray, size: Size, rise: float) -> FloatArray:
    """A closed lid on the mouth of a vessel."""
    wide, deep, high = size
    inset = dice.between(0.4, 0.98)
    stages = [(0, 0, 0), (1.03, 1.03, 0), (1.03, 1.03, rise * 0.4), (inset, inset, rise), (0, 0, rise)]
    return loft(outline, [(a * wide, b * deep, high + 0.001 + c) for a, b, c in stages])


def _plain(dice: Dice) -> Sequence[Body]:
    """A lid on a hinge at the back, mostly with a pedal; or a loose lid."""
    made, outline, size, flare, look = _begun(dice)
    wide, deep, high = size
    rise, cover = dice.between(0.015, 0.2 * high), dice.pick((look, looks.darker(look), looks.plastic(dice)))
    parts = [surface([_cap(dice, outline, size, rise)], cover)]
    if dice.chance(0.3):
        pull = turned(handle(dice, 0.3 * wide), rotation((1, 0, 0), -np.pi / 2))
        parts.append(surface(moved(pull, (0, 0, high + rise)), looks.metal(dice)))
    if dice.chance(0.2):
        made.add(Leaf("lid", "lid", tuple(parts), free()))
        return made.bodies()
    pin = (0, 0.515 * deep, high)
    made.fix([box((0.3 * wide, 0.02, 0.03), (0, 0.5 * deep + 0.01, high - 0.02))], looks.darker(look))
    parts.append(surface([rod((-0.15 * wide, *pin[1:]), (0.15 * wide, *pin[1:]), 0.006, 8)], cover))
    made.add(Leaf("lid", "lid", tuple(parts), hinge(pin, (-1, 0, 0), np.radians(dice.between(60, 105)))))
    if dice.chance(0.6):
        made.add(_pedal(dice, deep / flare, wide / flare))
    if dice.chance(0.3):
        scale = (0.9 * wide / flare, 0.9 * deep / flare, 0.9 * high)
        liner = vessel(outline, scale, 0.003, flare) + [0, 0, 0.02]
        made.add(Leaf("liner", "bucket", (surface([liner], looks.plastic(dice)),), free()))
    if dice.chance(0.25):
        made.add(_bail(wide, 0.75 * high, looks.metal(dice)))
    return made.bodies()


def _pedal(dice: Dice, deep: float, wide: float) -> Leaf:
    """A plate before the foot of the bin on a lever that pivots inside of it."""
    reach, long, level = dice.between(0.03, 0.07), 0.3 * deep, dice.between(0.02, 0.035)
    plate = box((dice.between(0.25, 0.5) * wide, reach, 0.008), (0, -deep / 2 - 0.012 - reach / 2, level))
    arm = between((-0.01, -deep / 2 - 0.02, level - 0.004), (0.01, -deep / 2 + long, level + 0.003))
    pin = (0, -deep / 2 + long, level)
    motion = hinge(pin, (1, 0, 0), 0.6 * level / (long + reach))
    return Leaf("pedal", "pedal", (surface([plate, arm], looks.metal(dice)),), motion)


def _bail(wide: float, level: float, look: Look) -> Leaf:
    """A bow about the bin that hangs at its back and turns over it."""
    x = 0.53 * wide
    angle = np.linspace(0, np.pi, 11)
    path = np.column_stack(
        [x * np.cos(angle), 0.06 + 0 * angle + x * 1.05 * np.sin(angle), level - 0.2 * x * np.sin(angle)]
    )
    path[[0, -1], 1] = 0.0
    motion = hinge((0, 0, level), (1, 0, 0), np.radians(95))
    return Leaf("bail", "handle", (surface([tube(path, 0.004)], look),), motion)


def _swing(dice: Dice) -> Sequence[Body]:
    """A hood with a flap that swings both ways about an axis in its middle."""
    made, outline, size, _, look = _begun(dice)
    wide, deep, high = size
    tall, border = dice.between(0.08, 0.25), 0.03
    x, y = 0.49 * wide, 0.46 * deep
    cover = dice.pick((look, looks.darker(look), looks.plastic(dice)))
    rim = [(1, 1, 0), (1.03, 1.03, 0), (1.03, 1.03, 0.02), (0.9, 0.9, 0.02), (0.9, 0.9, 0)]
    made.fix([loft(outline, [(a * wide, b * deep, high + c) for a, b, c in rim])], cover)
    base = high + 0.02
    if dice.chance(0.5):
        # Sides of a roof, the flap lies on its front slope; the axis is halfway up.
        loop = np.array([[-y, base], [y, base], [y, base + tall], [0.3 * y, base + tall]])
        made.fix([pointed(board(loop, 0.006), X) + [s * (x - 0.003), 0, 0] for s in (-1, 1)], cover)
        made.fix([between((-x, y - 0.006, base), (x, y, base + tall))], cover)
        made.fix([between((-x, 0.3 * y, base + tall), (x, y, base + tall + 0.006))], cover)
        ends = np.array([[-y, base], [0.3 * y, base + tall]])
    else:
        made.fix(
            [between((s * x - 0.004, -y, base), (s * x + 0.004, y, base + 0.03)) for s in (-1, 1)], cover
        )
        ends = np.array([[-y, base + 0.02], [y, base + 0.02]])
    middle, along = ends.mean(axis=0), np.diff(ends, axis=0)[0]
    long, tilt = np.hypot(*along) - 0.012, np.arctan2(along[1], along[0])
    thick = dice.between(0.004, 0.01)
    flap = turned([box((2 * x - border, long, thick))], rotation((1, 0, 0), tilt))
    pin = np.array([0, *middle])
    reach = np.radians(dice.between(40, 85))
    motion = hinge(pin, (1, 0, 0), reach, lower=-reach)
    made.add(Leaf("swing_flap", "flap", (surface(moved(flap, pin), dice.pick((cover, look))),), motion))
    return made.bodies()


def _street(dice: Dice) -> Sequence[Body]:
    """A bin on two wheels with a big lid and a bar behind."""
    width, depth, height = dice.between(0.4, 0.75), dice.between(0.45, 0.75), dice.between(0.7, 1.1)
    look = looks.plastic(dice)
    made, low = Assembly("body"), dice.between(0.65, 0.9)
    stages = [(1, 1, -0.08), (1.03, 1.03, -0.08), (1.03, 1.03, -0.02), (1, 1, -0.02)]
    band = loft(rounded(0.06), [(a * width, b * depth, height + c) for a, b, c in stages])
    shell = vessel(rounded(0.06), (width * low, depth * low, height), 0.008, 1 / low)
    made.fix([shell, band], look)
    made.fix(
        [rod((-0.4 * width, depth / 2 + 0.05, height), (0.4 * width, depth / 2 + 0.05, height), 0.012, 8)],
        look,
    )
    made.fix([box((0.03, 0.08, 0.04), (s * 0.38 * width, depth / 2 + 0.03, height)) for s in (-1, 1)], look)
    pin = (0, depth / 2 + 0.02, height + 0.01)
    rise, cover = dice.between(0.03, 0.1), dice.pick((look, looks.plastic(dice)))
    skin = loft(
        rounded(0.06),
        [(width * 1.05, depth * 1.05, height + 0.001), (width, depth, height + rise), (0, 0, height + rise)],
    )
    parts = [surface([skin], cover)]
    if dice.chance(0.5):
        parts.append(surface([box((0.3 * width, 0.03, 0.015), (0, -depth * 0.55, height + 0.02))], cover))
    made.add(Leaf("lid", "lid", tuple(parts), hinge(pin, (-1, 0, 0), np.radians(dice.between(90, 200)))))
    radius = dice.between(0.08, 0.14)
    y = depth * low / 2 + radius * 0.3
    made.fix([rod((-width / 2, y, radius), (width / 2, y, radius), 0.01, 8)], looks.metal(dice))
    for side, name in ((-1, "left_wheel"), (1, "right_wheel")):
        made.add(wheel_leaf(dice, radius, (side * (0.5 * width * low + 0.02), y, radius), name))
    made.fix([boxes((width * 0.6, 0.05, 0.02), [(0, y - 0.05, radius)])], look)
    return made.bodies()


def _split(dice: Dice) -> Sequence[Body]:
    """Two lids side by side, each over its half, or opening like wings; some with two pedals."""
    width, depth, height = dice.between(0.4, 0.7), dice.between(0.25, 0.4), dice.between(0.35, 0.75)
    look, thick = dice.pick((looks.metal(dice), looks.plastic(dice))), dice.between(0.012, 0.03)
    made = Assembly("body")
    made.fix([vessel(SQUARE, (width, depth, height), 0.006)], look)
    made.fix([box((0.006, depth - 0.012, height - 0.02), (0, 0, height / 2))], look)
    cover = dice.pick((look, looks.plastic(dice)))
    half: Pieces = [box((width / 2 - 0.002, depth * 1.02, thick), (width / 4, 0, height + 0.001 + thick / 2))]
    if dice.chance(0.4):
        half += moved(
            turned(handle(dice, 0.1), rotation((1, 0, 0), -np.pi / 2)),
            (width / 4, -0.3 * depth, height + thick),
        )
    wings = dice.chance(0.4)
    for side, pieces, name in ((-1, mirrored(half), "left_lid"), (1, half, "right_lid")):
        upper = np.radians(dice.between(70, 100))
        motion = hinge((side * width / 2, 0, height), (0, side, 0), upper)
        if not wings:
            motion = hinge((side * width / 4, depth * 0.51, height), (-1, 0, 0), upper)
        made.add(Leaf(name, "lid", (surface(pieces, cover),), motion))
    if not wings and dice.chance(0.6):
        for side, name in ((-1, "left_pedal"), (1, "right_pedal")):
            pedal = _pedal(Dice(7), depth, width / 2).moved((side * width / 4, 0, 0))
            made.add(Leaf(name, "pedal", pedal.surfaces, pedal.motion))
    if dice.chance(0.3):
        made.fix(
            [cylinder(0.02, 0.02, 10) - [s * 0.4 * width, 0.3 * depth, 0.01] for s in (-1, 1)],
            looks.rubber(dice),
        )
    return made.bodies()


CATEGORIES: tuple[Category, ...] = (Category("trash_can", _trash_can),)
