"""Sun loungers."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import X, at, moved, rotation, turned
from ...shapes.primitives import Pieces, box
from ...shapes.primitives import superquadric as soft
from . import looks
from .assembling import Assembly
from .category import Category
from .machine_tools_parts import DARK
from .objects import Body, Look, hinge, slide, spin
from .rigging import LEFT, RIGHT, lying


def _lounger_frame(kit: Assembly, look: Look, size: tuple[float, float, float], rolls: bool) -> None:
    """Rails and legs, those at the head shorter where it stands on wheels."""
    wide, long, level = size
    kit.fix([box((0.04, long, 0.07), (s * wide / 2, 0, level)) for s in (-1, 1)], look)
    short = 0.06 if rolls else 0.0
    front = [(s * wide / 2, -0.35 * long, level / 2) for s in (-1, 1)]
    rear = [(s * wide / 2, 0.35 * long, level / 2 + short / 2) for s in (-1, 1)]
    kit.fix(at(box((0.05, 0.05, level)), front) + at(box((0.05, 0.05, level - short)), rear), look)
    kit.fix([box((wide, 0.04, 0.05), (0, s * (long / 2 - 0.02), level)) for s in (-1, 1)], look)


def _lounger_wheels(kit: Assembly, look: Look, wide: float, y: float) -> None:
    """A wheel on an axle at both sides of the head."""
    for s in (-1, 1):
        hub = np.array([s * (wide / 2 + 0.06), y, 0.1])
        kit.fix([lying(0.012, 0.1) + [s * (wide / 2 + 0.02), y, 0.1]], look)
        wheel = [lying(0.1, 0.04, X, 20) + hub, lying(0.03, 0.05) + hub]
        name = "left_wheel" if s < 0 else "right_wheel"
        kit.add("wheel", spin(hub, RIGHT), [(wheel, DARK)], name=name)


def _slats(inside: float, low: float, high: float) -> Pieces:
    """Level slats across, from one y to another."""
    return [box((inside, 0.042, 0.018), (0, y, 0.02)) for y in np.arange(low + 0.03, high - 0.02, 0.055)]


def _rest(inside: float, size: float, way: int) -> Pieces:
    """Slats on two bars, from y = 0 towards the head (1) or the foot (-1)."""
    slats = [piece * [1, way, 1] for piece in _slats(inside, 0.0, size)]
    bars = [box((0.035, size, 0.03), (s * (inside / 2 - 0.03), way * size / 2, 0)) for s in (-1, 1)]
    return [piece[:, ::-1] if way < 0 else piece for piece in slats] + bars


def _rests(
    dice: Dice, kit: Assembly, wood: Look, inside: float, long: float, level: float, split: float, foot: float
) -> None:
    """A back and at times a foot that tip up, at times with a cushion each."""
    cushion = looks.fabric(dice) if dice.chance(0.4) else None
    for label, y, size, axis in (("back", split, 0.44 * long, RIGHT), ("footrest", foot, 0.18 * long, LEFT)):
        if label == "footrest" and foot < -0.4 * long:
            continue
        raised = dice.between(0, 0.9) if label == "back" else dice.between(0, 0.4)
        way = 1 if axis == RIGHT else -1
        pin, yaw = np.array([0, y, level]), rotation(axis, raised)
        parts = [(_rest(inside, size, way), wood)]
        if cushion:
            pad = soft((0.9 * inside, 0.9 * size, 0.06), 0.3, 0.3) + [0, way * size / 2, 0.06]
            parts.append(([pad], cushion))
        motion = hinge(pin, axis, 1.3 - raised if label == "back" else 0.7 - raised, -raised)
        kit.add(label, motion, [(moved(turned(pieces, yaw), pin), look) for pieces, look in parts])


def _lounger_shelf(kit: Assembly, look: Look, wide: float, y: float, level: float) -> None:
    """A board below the frame that slides out to the right, on two rails."""
    board = [box((0.3, 0.25, 0.015), (0, y, level - 0.06)), box((0.02, 0.25, 0.03), (0.15, y, level - 0.06))]
    rails = [box((wide, 0.02, 0.012), (0, y + s * 0.09, level - 0.075)) for s in (-1, 1)]
    kit.fix([*rails, box((0.03, 0.2, 0.05), (-wide / 2, y, level - 0.055))], look)
    kit.add("shelf", slide(RIGHT, 0.3), [(board, look)])


def _sun_lounger(dice: Dice) -> list[Body]:
    """A frame with slats, a back that tips up, at times a foot that does, wheels and a shelf that slides."""
    kit, wood = Assembly("frame"), looks.wood(dice) if dice.chance(0.6) else looks.plastic(dice)
    long, wide, level = dice.between(1.8, 2.1), dice.between(0.6, 0.75), dice.between(0.28, 0.36)
    rolls = dice.chance(0.6)
    _lounger_frame(kit, wood, (wide, long, level), rolls)
    if rolls:
        _lounger_wheels(kit, wood, wide, 0.35 * long)
    split, foot = 0.02 * long, -0.3 * long if dice.chance(0.3) else -long / 2 + 0.05
    inside = wide - 0.05
    cross = [box((inside + 0.02, 0.03, 0.03), (0, y, level)) for y in (split - 0.02, foot + 0.02)]
    kit.fix(moved(_slats(inside, foot + 0.01, split - 0.01), (0, 0, level)) + cross, wood)
    _rests(dice, kit, wood, inside, long, level, split, foot)
    if dice.chance(0.4):
        _lounger_shelf(kit, wood, wide, -0.05 * long, level)
    return kit.done()


CATEGORIES = (Category("sun_lounger", _sun_lounger),)
