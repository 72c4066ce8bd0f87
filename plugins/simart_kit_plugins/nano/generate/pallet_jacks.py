"""Pallet jacks."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import X, moved, rotation, turned
from ...shapes.primitives import box, boxes, cylinder, tube
from . import looks
from .assembling import Assembly
from .category import Category
from .machine_tools_parts import DARK
from .objects import Body, Look, hinge, spin
from .rigging import LEFT, RIGHT, UP, lying


def _forks(kit: Assembly, coat: Look, long: float, half: float, level: float) -> None:
    """Two forks, each with a roller near its tip."""
    for s in (-1, 1):
        x, y = s * half, 0.05 + long / 2
        kit.fix([box((0.15, long, 0.05), (x, y, level)), box((0.02, long, 0.02), (x, y, level - 0.03))], coat)
        hub = np.array([x, 0.9 * long, 0.04])
        kit.fix([box((0.01, 0.06, 0.06), hub + [t * 0.045, 0, 0.03]) for t in (-1, 1)], coat)
        roller, name = [lying(0.04, 0.07, X, 16) + hub], "left_roller" if s < 0 else "right_roller"
        kit.add("roller", spin(hub, RIGHT), [(roller, DARK)], name=name)


def _steering(kit: Assembly, coat: Look) -> int:
    """A pump that turns about its upright axis, with two wheels below; gives its number."""
    axle = np.array([0, -0.1, 0.2])
    kit.fix([box((0.12, 0.1, 0.04), (0, -0.03, 0.42)), cylinder(0.03, 0.05) + [0, -0.1, 0.42]], coat)
    post = [
        cylinder(0.045, 0.2) + axle + [0, 0, 0.09],
        box((0.1, 0.07, 0.06), axle - [0, 0, 0.04]),
        lying(0.018, 0.26) + [0, -0.1, 0.1],
        box((0.05, 0.05, 0.08), (0, -0.1, 0.14)),
    ]
    steer = kit.add("steering", spin(axle, UP), [(post, coat)])
    for s in (-1, 1):
        hub = np.array([s * 0.09, -0.1, 0.1])
        wheel = [lying(0.1, 0.05, X, 20) + hub, lying(0.04, 0.056) + hub]
        name = "left_wheel" if s < 0 else "right_wheel"
        kit.add("wheel", spin(hub, RIGHT), [(wheel, DARK)], steer, name)
    return steer


def _tow_handle(dice: Dice, kit: Assembly, coat: Look, steer: int) -> None:
    """A long handle that tips, with a lever in its loop."""
    pin, lean = np.array([0, -0.165, 0.2]), dice.between(0, 0.7)
    kit.fix([boxes((0.012, 0.06, 0.04), [(s * 0.04, -0.15, 0.2) for s in (-1, 1)])], coat, steer)
    yaw = rotation(RIGHT, lean)
    loop = [(0, 0, 0.75), (-0.13, 0, 0.85), (-0.13, 0, 1.0), (0.13, 0, 1.0), (0.13, 0, 0.85), (0, 0, 0.75)]
    arm = [box((0.05, 0.035, 0.76), (0, 0, 0.38)), lying(0.016, 0.064), tube(np.array(loop), 0.014, 8)]
    arm = moved(turned(arm, yaw), pin)
    number = kit.add("handle", hinge(pin, RIGHT, 1.2 - lean, -lean), [(arm, coat)], steer)
    spot = pin + yaw @ np.array([0, 0, 0.8])
    grip = box((0.05, 0.014, 0.02), (0, -0.006, 0.12))
    lever = [box((0.014, 0.012, 0.13), (0, -0.006, 0.06)), lying(0.008, 0.03), grip]
    lever = moved(turned(lever, yaw), spot - yaw @ np.array([0, 0.022, 0]))
    kit.add("lever", hinge(spot, LEFT, 0.25, -0.25), [(lever, DARK)], number)


def _pallet_jack(dice: Dice) -> list[Body]:
    """Two forks with rollers, steered wheels below a pump, a long handle that tips, a lever in its loop."""
    kit, coat = Assembly("forks"), looks.painted_metal(dice)
    long, half, level = dice.between(0.9, 1.15), dice.between(0.18, 0.25), dice.between(0.08, 0.11)
    _forks(kit, coat, long, half, level)
    back = 2 * half if dice.chance(0.5) else 0.2
    bridge = box((2 * half + 0.15, 0.06, 0.12), (0, 0.03, level + 0.1))
    kit.fix([bridge, box((back, 0.05, 0.3), (0, 0.03, level + 0.25))], coat)
    _tow_handle(dice, kit, coat, _steering(kit, coat))
    return kit.done()


CATEGORIES = (Category("pallet_jack", _pallet_jack),)
