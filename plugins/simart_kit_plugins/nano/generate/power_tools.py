"""Tools with a grip and a trigger: cordless drills, glue guns and guns for cartridges."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.outlines import rounded
from ...shapes.placing import Y, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, loft, revolve, rod, torus
from . import looks
from .assembling import Assembly
from .category import Category
from .machine_tools_parts import DARK, sideways
from .objects import Body, Look, free, hinge, slide, spin
from .rigging import BACK, FRONT, LEFT, RIGHT, lying


def _along(radius: float, start: float, end: float, sides: int = 20) -> FloatArray:
    """A cylinder about y between two places."""
    return pointed(cylinder(radius, end - start, sides), Y) + [0, (start + end) / 2, 0]


def _pistol_grip(dice: Dice, wide: float, long: float, lean: float) -> Pieces:
    """A grip that hangs down from 0, its lower end farther back."""
    bar = loft(
        rounded(0.4, 0.7, 4),
        [(0, 0, 0.005), (wide, 1.4 * wide, 0.005), (0.9 * wide, 1.25 * wide, -long), (0, 0, -long)],
    )
    return turned([bar], rotation(RIGHT, lean))


def _trigger(dice: Dice, kit: Assembly, pin: FloatArray, size: float, turns: bool, look: Look) -> None:
    """What a finger pulls back, below a barrel and before its grip."""
    pieces = [
        box((0.6 * size, 0.5 * size, 1.3 * size), (0, 0, -0.8 * size)),
        box((0.55 * size, 0.4 * size, 0.4 * size), (0, -0.25 * size, -1.3 * size)),
    ]
    motion = slide(BACK, 0.35 * size)
    if turns:
        pieces.append(lying(0.25 * size, 0.7 * size))
        motion = hinge(pin, RIGHT, 0.4)
    kit.add("trigger", motion, [(moved(pieces, pin), look)])


def _ribs(size: tuple[float, float, float], y: float, z: float, count: int, step: float) -> Pieces:
    """Ribs along y, each turned about it by a step from the last."""
    return [turned([box(size, (0, y, z))], rotation(BACK, k * step))[0] for k in range(count)]


def _battery(dice: Dice, kit: Assembly, shell: Look, foot: FloatArray) -> None:
    """A foot below the grip, and a battery that slides off it."""
    wide, deep = dice.between(0.06, 0.08), dice.between(0.09, 0.13)
    kit.fix([box((wide, deep, 0.022), foot)], shell)
    tab = box((0.6 * wide, 0.012, 0.015), (0, -deep / 2 - 0.004, 0))
    pack = [box((wide, deep, dice.between(0.03, 0.06)), (0, 0, 0)), tab]
    low = foot - [0, 0, 0.0115 + np.ptp(pack[0][..., 2]) / 2]
    kit.add("battery", slide(FRONT, 0.9 * deep), [(moved(pack, low), DARK)])


def _collar_and_chuck(dice: Dice, kit: Assembly, bright: Look, radius: float, long: float) -> None:
    """A ring with ribs to set the force by, and before it a chuck, at times with a bit in it."""
    ring, front = [_along(0.98 * radius, -0.22 * long, 0.0)], -0.4 * long - 0.001
    ring += _ribs((0.004, 0.2 * long, 0.004), -0.11 * long, 0.98 * radius, 10, 0.628)
    kit.add("collar", hinge((0, front, 0), BACK, 4.7), [(moved(ring, (0, front, 0)), bright)])
    nose = front - 0.22 * long - 0.001
    line = np.array([(0, 0), (0.75, 0), (0.75, 0.5), (0.35, 0.95), (0.2, 1), (0, 1)]) * [radius, 0.34 * long]
    chuck = turned([revolve(line, 20)], rotation(RIGHT, np.pi / 2))
    chuck += _ribs((0.003, 0.15 * long, 0.003), -0.1 * long, 0.75 * radius, 8, 0.785)
    if dice.chance(0.5):
        chuck.append(_along(0.1 * radius, -0.75 * long, -0.3 * long, 8))
    kit.add("chuck", spin((0, nose, 0), BACK), [(moved(chuck, (0, nose, 0)), DARK)])


def _cordless_drill(dice: Dice) -> list[Body]:
    """A motor over a grip, with a chuck, a ring, a trigger, a battery that slides off, at times switches."""
    kit, shell, bright = Assembly("body"), looks.plastic(dice), looks.plastic(dice)
    radius, long, tall = dice.between(0.028, 0.036), dice.between(0.11, 0.15), dice.between(0.1, 0.13)
    motor = [
        _along(radius, -0.4 * long, 0.5 * long),
        _along(0.85 * radius, 0.5 * long, 0.56 * long),
        box((1.3 * radius, 0.7 * long, 0.5 * radius), (0, 0.05 * long, 0.8 * radius)),
    ]
    kit.fix(motor, shell)
    grip = np.array([0, 0.2 * long, -0.8 * radius])
    kit.fix(moved(_pistol_grip(dice, 0.036, tall, 0.12), grip), DARK)
    _battery(dice, kit, shell, grip + [0, -0.02 + np.sin(0.12) * tall, -tall * 0.98])
    _collar_and_chuck(dice, kit, bright, radius, long)
    _trigger(dice, kit, np.array([0, grip[1] - 0.033, -radius - 0.002]), 0.02, False, bright)
    if dice.chance(0.7):
        spot = np.array([0, 0.1 * long, 1.05 * radius + 0.0005])
        ridge = box((0.016, 0.004, 0.004), spot + [0, 0, 0.008])
        switch = [box((0.02, 0.025, 0.006), spot + [0, 0, 0.003]), ridge]
        kit.add("switch", slide(FRONT, 0.012), [(switch, DARK)])
    if dice.chance(0.5):
        spot = np.array([0, grip[1] - 0.01, -radius - 0.004])
        kit.add("button", slide(RIGHT, 0.004, -0.004), [([lying(0.007, 0.048) + spot], bright)])
    return kit.done()


def _glue_gun(dice: Dice) -> list[Body]:
    """A body with a nozzle, a stick that comes in behind, a trigger and at times a wire stand that folds."""
    kit, shell = Assembly("body"), looks.plastic(dice)
    high, long, wide = dice.between(0.035, 0.045), dice.between(0.11, 0.16), dice.between(0.022, 0.03)
    stages = [
        (0, 0, -high / 2),
        (wide, 0.9 * long, -high / 2),
        (wide, long, 0),
        (0.7 * wide, 0.9 * long, high / 2),
        (0, 0, high / 2),
    ]
    kit.fix([loft(rounded(0.3, wide / long, 4), stages)], shell)
    grip = _pistol_grip(dice, 0.026, dice.between(0.08, 0.1), 0.2)
    kit.fix(moved(grip, (0, 0.3 * long, -0.3 * high)), shell)
    line = [(0, 0), (0.4 * high, 0), (0.4 * high, 0.012), (0.12 * high, 0.04), (0.1 * high, 0.04), (0, 0.045)]
    kit.fix([turned([revolve(line, 16)], rotation(RIGHT, np.pi / 2))[0] + [0, -long / 2 + 0.006, 0]], DARK)
    back = 0.5 * long
    kit.fix([pointed(torus(0.009, 0.003, 16), Y) + [0, back, 0]], shell)
    stick = _along(0.0055, back - 0.02, back + dice.between(0.05, 0.12), 14)
    kit.add("stick", slide(FRONT, 0.03), [([stick], Look("plastic", (235, 230, 205)))])
    _trigger(dice, kit, np.array([0, 0.3 * long - 0.028, -0.5 * high - 0.001]), 0.02, dice.chance(0.5), DARK)
    pin = np.array([0, -0.3 * long, -0.4 * high])
    rests = [rod((s * (wide / 2 + 0.002), 0, 0), (s * 0.03, -0.01, -0.055), 0.0018) for s in (-1, 1)]
    rests += [rod((-0.03, -0.01, -0.055), (0.03, -0.01, -0.055), 0.0018), lying(0.0018, wide + 0.006)]
    if dice.chance(0.75):
        kit.add("stand", hinge(pin, LEFT, 0.2, -1.2), [(moved(rests, pin), looks.metal(dice))])
    if dice.chance(0.4):
        spot = np.array([wide / 2 - 0.002, 0.2 * long, -0.3 * high])
        switch = moved(sideways([box((0.014, 0.008, 0.01))], 1), spot)
        kit.add("switch", hinge(spot, BACK, 0.12, -0.12), [(switch, DARK)])
    return kit.done()


def _caulking_gun(dice: Dice) -> list[Body]:
    """A cradle or a tube with a rod through its handle, a trigger to push it on and a catch that frees it."""
    kit, metal = Assembly("frame"), looks.painted_metal(dice)
    radius, long = dice.between(0.025, 0.03), dice.between(0.22, 0.3)
    if dice.chance(0.5):
        sides = [box((0.003, long, 0.012), (s * (radius + 0.003), -long / 2, 0)) for s in (-1, 1)]
        kit.fix([box((0.02, long, 0.003), (0, -long / 2, -radius - 0.004)), *sides], metal)
        hoop = pointed(torus(radius + 0.003, 0.004, 24), Y)
        kit.fix([hoop - [0, y * long, 0] for y in (0.02, 0.5, 0.98)], metal)
    else:
        line = [(radius + 0.005, 0), (radius + 0.005, -long), (radius + 0.003, -long), (radius + 0.003, 0)]
        kit.fix([pointed(revolve([*line, line[0]], 24), Y)], metal)
    kit.fix([_along(radius + 0.006, 0.0, 0.006), box((0.02, 0.09, 0.03), (0, 0.045, -0.004))], metal)
    kit.fix(moved(_pistol_grip(dice, 0.024, dice.between(0.1, 0.12), 0.15), (0, 0.07, -0.01)), metal)
    reach = dice.between(0.1, 0.25)
    push = [
        _along(0.0035, -0.4 * long, reach + 0.02, 8),
        _along(radius - 0.003, -0.4 * long - 0.004, -0.4 * long),
        box((0.004, 0.004, 0.04), (0, reach + 0.018, -0.018)),
    ]
    room = min(0.5 * long, reach - 0.08) if reach > 0.1 else 0.02
    kit.add("plunger", slide(FRONT, room), [(push, looks.metal(dice))])
    if dice.chance(0.7):
        tube_ = [_along(radius - 0.001, -long + 0.01, -0.4 * long - 0.008, 22)]
        line = [(0, 0), (0.008, 0), (0.003, 0.06), (0, 0.06)]
        nose = turned([revolve(line, 14)], rotation(RIGHT, np.pi / 2))
        kit.add("cartridge", free(), [(tube_ + moved(nose, (0, -long + 0.01, 0)), looks.plastic(dice))])
    _trigger(dice, kit, np.array([0, 0.035, -0.0195]), 0.03, True, looks.metal(dice))
    pin = np.array([0, 0.094, 0.004])
    catch = [boxes((0.012, 0.003, 0.035), [(0, 0.003, 0.022)]), lying(0.003, 0.018)]
    kit.add("catch", hinge(pin, LEFT, 0.3, -0.2), [(moved(catch, pin), looks.metal(dice))])
    return kit.done()


CATEGORIES = (
    Category("cordless_drill", _cordless_drill),
    Category("glue_gun", _glue_gun),
    Category("caulking_gun", _caulking_gun),
)
