"""Doors and windows in frames, gates."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ....shapes.dice import Dice
from ....shapes.fronts import frame, front, glazed
from ....shapes.handles import handle, knob
from ....shapes.placing import Y, Z, mirrored, moved, pointed, rotation, turned
from ....shapes.primitives import Pieces, box, cylinder, rod


def opening(dice: Dice) -> list[Pieces]:
    """A frame first, then one or two leaves and, mostly, their handles."""
    return _window(dice) if dice.chance(0.25) else _doorway(dice)


def _doorway(dice: Dice) -> list[Pieces]:
    height, count = dice.between(1.8, 2.3), dice.weighted([(3, 1), (1, 2)])
    width = dice.between(0.6, 1.0) * count
    border, deep, thick = dice.between(0.03, 0.12), dice.between(0.06, 0.2), dice.between(0.025, 0.06)
    surround = [frame(width + 2 * border, height + border, deep, border) + [0, deep / 2, border / 2]]
    if dice.chance(0.15):
        surround.append(box((dice.between(0.3, 1.0), deep, height), (width, 0, 0)))
    parts = [surround]
    kind, angle = dice.whole(0, 2**31), dice.between(0.1, 1.8) if dice.chance(0.4) else 0.0
    for side in (-1, 1)[:count]:
        leaf = front(Dice(kind), width / count * 0.99, height * 0.99, thick)
        lever = _lever(dice, thick)
        spot = (-side * 0.42 * width / count, 0, dice.between(-0.1, 0.0) * height)
        pin = np.array([side * width / count / 2, 0, 0])
        home = [side * width / 4 if count == 2 else 0, 0, 0]
        turn = rotation((0, 0, side), angle)
        levers = moved(lever if side < 0 else mirrored(lever), spot)
        levers = moved(turned(levers, turn, pin), home)
        panel = moved(turned(leaf + _hinges(pin, height, thick), turn, pin), home)
        parts += [panel, levers] if dice.chance(0.7) else [panel + levers]
    return parts


def _hinges(pin: FloatArray, height: float, thick: float) -> Pieces:
    return [
        pointed(cylinder(0.3 * thick, 0.05 * height, 8), Z) + pin + [0, 0, z * height] for z in (-0.35, 0.35)
    ]


def _lever(dice: Dice, thick: float) -> Pieces:
    """Handles on both sides of a leaf that lies from y = -thick to 0; the lever points to -x."""
    style = dice.unit()
    if style < 0.35:
        one = knob(dice, dice.between(0.02, 0.035))
    elif style < 0.8:
        reach = dice.between(0.09, 0.14)
        one = [rod((0, 0, 0), (0, -0.05, 0), 0.01, 8), rod((0, -0.05, 0), (-reach, -0.05, 0), 0.009, 8)]
    else:
        one = handle(dice, dice.between(0.2, 0.6), upright=True)
    plate = box((0.05, 0.008, dice.between(0.05, 0.25)), (0, -0.004, 0))
    if dice.chance(0.3):
        plate = pointed(cylinder(0.03, 0.01, 12), Y)
    near = moved([plate, *one], (0, -thick, 0))
    return near + mirrored([plate, *one], Y) if dice.chance(0.7) else near


def _window(dice: Dice) -> list[Pieces]:
    width, height, border = dice.between(0.6, 1.8), dice.between(0.6, 1.6), dice.between(0.03, 0.08)
    deep, count = dice.between(0.06, 0.15), dice.whole(1, 3)
    parts = [[frame(width, height, deep, border) + [0, deep / 2, 0]]]
    room, slides = width - 2 * border, dice.chance(0.4)
    for k in range(count):
        sash = glazed(dice, room / count, height - 2 * border, deep * 0.4)
        place = np.array([(k + 0.5) * room / count - room / 2, 0.0, 0.0])
        if slides:
            sash = moved(sash, (0, (k % 2) * deep * 0.4, 0))
        elif dice.chance(0.4):
            side = dice.sign()
            sash = turned(
                sash, rotation((0, 0, side), dice.between(0.1, 1.2)), (side * room / count / 2, 0, 0)
            )
        parts.append(moved(sash, place))
    return parts
