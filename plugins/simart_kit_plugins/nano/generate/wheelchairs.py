"""Wheelchairs."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, boxes, cylinder, rod, torus, tube
from . import looks
from .assembling import Assembly
from .category import Category
from .machine_tools_parts import DARK
from .objects import Body, Look, hinge, spin
from .rigging import LEFT, RIGHT, UP, lying


def _wheelchair_side(dice: Dice, kit: Assembly, s: int, size: tuple[float, float, float], look: Look) -> None:
    """Large wheel, caster, footrest and armrest of one side."""
    wide, radius, seat = size
    side = "left" if s < 0 else "right"
    hub = np.array([s * (wide / 2 + 0.04), 0.14, radius])
    kit.add("wheel", spin(hub, RIGHT), [(moved(_large_wheel(s, radius), hub), DARK)], name=f"{side}_wheel")
    low = dice.between(0.07, 0.1)
    _caster(kit, np.array([s * (wide / 2 - 0.03), -0.24, 2 * low + 0.06]), low, side, look)
    _footrest(kit, np.array([s * (wide / 2 - 0.02), -0.3, seat - 0.05]), s, seat, look)
    if dice.chance(0.7):
        pin = np.array([s * wide / 2, 0.22, seat + 0.22])
        pad = [box((0.05, 0.36, 0.03), (0, -0.2, 0.012))]
        posts = [
            rod((0, 0, 0), (0, -0.04, 0.0), 0.012),
            rod((0, -0.36, 0), (0, -0.36, -0.19), 0.011),
        ]
        parts = [(moved(pad, pin), DARK), (moved(posts, pin), look)]
        kit.add("armrest", hinge(pin, LEFT, 1.5), parts, name=f"{side}_armrest")


def _large_wheel(s: int, radius: float) -> Pieces:
    """A spoked wheel about x with a ring to push it on its outer side."""
    wheel = [
        pointed(torus(radius - 0.015, 0.015, 32), X),
        lying(0.03, 0.05),
        pointed(torus(0.88 * radius, 0.009, 28), X) + [s * 0.03, 0, 0],
    ]
    spoke = [rod((0, 0, 0), (0, 0, radius - 0.02), 0.004)]
    return wheel + [turned(spoke, rotation(RIGHT, k * np.pi / 6))[0] for k in range(12)]


def _caster(kit: Assembly, spot: FloatArray, low: float, side: str, look: Look) -> None:
    """A fork that swivels about a spot, with a small wheel of radius `low`."""
    fork = [
        cylinder(0.012, 0.06) + [0, 0, 0.02],
        boxes((0.006, 0.03, 1.3 * low), [(t * 0.022, 0.02, -0.6 * low) for t in (-1, 1)]),
        box((0.05, 0.05, 0.012), (0, 0.01, 0)),
    ]
    parts = [(moved(fork, spot - [0, 0, 0.02]), look)]
    caster = kit.add("caster", spin(spot, UP), parts, name=f"{side}_caster")
    roll = np.array([spot[0], spot[1] + 0.03, low])
    wheel = [lying(low, 0.028) + roll, lying(0.012, 0.036) + roll]
    kit.add("wheel", spin(roll, RIGHT), [(wheel, DARK)], caster, f"{side}_front_wheel")


def _footrest(kit: Assembly, pin: FloatArray, s: int, seat: float, look: Look) -> None:
    """A hanger that swings out about a pin, with a step that folds up."""
    side = "left" if s < 0 else "right"
    hanger = [rod((0, 0, 0), (0, -0.12, 0.05 - seat), 0.012, 8), cylinder(0.018, 0.06)]
    parts = [(moved(hanger, pin), look)]
    number = kit.add("footrest", hinge(pin, (0, 0, s), 1.6), parts, name=f"{side}_footrest")
    step = pin + [0, -0.12, 0.062 - seat]
    plate = box((0.16, 0.15, 0.012), (-s * 0.09, -0.16, 0.05 - seat)) + [0, 0.12, 0.012]
    parts = [(moved([plate], step - [0, 0, 0.062 - seat]), DARK)]
    kit.add("step", hinge(step, (0, s, 0), 1.5), parts, number, f"{side}_step")


def _wheelchair(dice: Dice) -> list[Body]:
    """A seat between two large wheels, with casters, footrests and armrests that swing away, and brakes."""
    kit, look, cloth = Assembly("frame"), looks.metal(dice), looks.fabric(dice)
    wide, radius, seat = dice.between(0.42, 0.5), dice.between(0.27, 0.32), dice.between(0.46, 0.52)
    kit.fix(
        [box((wide, 0.42, 0.025), (0, -0.04, seat)), box((wide, 0.02, 0.4), (0, 0.2, seat + 0.25))], cloth
    )
    for s in (-1, 1):
        _frame_side(kit, s, (wide, radius, seat), look)
    cross = [
        rod((-wide / 2, 0.1, 0.2), (wide / 2, 0.1, seat - 0.04), 0.01),
        rod((-wide / 2, 0.12, seat - 0.04), (wide / 2, 0.12, 0.2), 0.01),
    ]
    kit.fix(cross, look)
    for s in (-1, 1):
        _wheelchair_side(dice, kit, s, (wide, radius, seat), look)
        pin = np.array([s * (wide / 2 + 0.016), -0.2, seat - 0.04])
        lever = [
            rod((0, 0, 0), (0, -0.05, 0.1), 0.007),
            lying(0.012, 0.016),
            box((0.04, 0.015, 0.03), (s * 0.02, 0.02, -0.02)),
        ]
        name = "left_brake" if s < 0 else "right_brake"
        kit.add("brake", hinge(pin, LEFT, 0.6), [(moved(lever, pin), DARK)], name=name)
    return kit.done()


def _frame_side(kit: Assembly, s: int, size: tuple[float, float, float], look: Look) -> None:
    """Tubes of one side of the frame, with the wheel's axle and a grip to push it."""
    wide, radius, seat = size
    x = s * wide / 2
    rail = [(x, -0.3, seat - 0.02), (x, 0.22, seat - 0.02), (x, 0.22, seat + 0.45), (x, 0.32, seat + 0.48)]
    kit.fix([tube(rail, 0.012, 8)], look)
    front = x - s * 0.03
    stay = [(x, 0.22, seat), (x, 0.22, 0.18), (front, -0.24, 0.3), (front, -0.28, seat - 0.04)]
    kit.fix([tube(stay, 0.012, 8)], look)
    axle = lying(0.012, 0.04) + [x + s * 0.012, 0.14, radius]
    kit.fix([axle, rod((x, 0.14, radius), (x, 0.14, seat), 0.012)], look)
    kit.fix([box((0.02, 0.1, 0.02), (x, 0.36, seat + 0.48))], DARK)


CATEGORIES = (Category("wheelchair", _wheelchair),)
