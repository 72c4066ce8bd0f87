"""What playgrounds and fairs swing and turn on."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import around, moved, pointed, rotation, turned
from ...shapes.primitives import box, boxes, cylinder, rod, torus
from ...shapes.primitives import superquadric as soft
from . import looks
from .assembling import Assembly, scaled
from .category import Category
from .objects import Body, Look, hinge, slide, spin
from .rigging import BACK, RIGHT, UP, lying


def _frame_of_swings(dice: Dice, kit: Assembly, wide: float, high: float, look: Look) -> None:
    """A beam on four splayed legs."""
    spread = dice.between(0.25, 0.4) * high
    for s in (-1, 1):
        for t in (-1, 1):
            kit.fix([rod((s * wide / 2, 0, high), (s * (wide / 2 + 0.1), t * spread, 0), 0.035, 8)], look)
    kit.fix([lying(0.04, wide + 0.12) + [0, 0, high]], look)


def _swing_set(dice: Dice) -> list[Body]:
    """A beam on splayed legs from which boards, bars or seats for small children hang."""
    kit, look = Assembly("frame"), looks.painted_metal(dice) if dice.chance(0.5) else looks.wood(dice)
    count, high = dice.whole(1, 3), dice.between(1.6, 2.3)
    wide = 0.75 * count + 0.3
    _frame_of_swings(dice, kit, wide, high, look)
    rope = looks.metal(dice)
    for k in range(count):
        x, low = 0.75 * (k - (count - 1) / 2), dice.between(0.35, 0.55)
        pin = np.array([x, 0, high - 0.055])
        width = dice.between(0.36, 0.48)
        cords = [
            rod((x + s * width / 2, 0, high - 0.05), (x + s * width / 2, 0, low), 0.008, 6) for s in (-1, 1)
        ]
        seat = [box((width + 0.06, dice.between(0.16, 0.24), 0.03), (x, 0, low))]
        style = dice.unit()
        if style < 0.2:
            seat = [lying(0.018, width + 0.08) + [x, 0, low]]
        elif style < 0.45:  # for the small ones
            seat += [
                box((width + 0.06, 0.02, 0.25), (x, 0.11, low + 0.13)),
                box((width, 0.015, 0.03), (x, -0.1, low + 0.16)),
            ]
            seat += [box((0.02, 0.24, 0.03), (x + s * width / 2, 0, low + 0.16)) for s in (-1, 1)]
        kit.fix([cylinder(0.012, 0.03) + [x + s * width / 2, 0, high - 0.045] for s in (-1, 1)], rope)
        kit.add("swing", hinge(pin, RIGHT, 0.8, -0.8), [(cords, rope), (seat, looks.plastic(dice))])
    return kit.done()


def _ferris_wheel(dice: Dice) -> list[Body]:
    """A wheel between two trestles, with cabins that hang from its rim."""
    kit, look, scale = Assembly("stand"), looks.painted_metal(dice), dice.spread(0.15, 1.0)
    radius, count, half = 1.0, dice.whole(5, 10), 0.16
    hub = np.array([0, 0, radius + 0.45])
    for s in (-1, 1):
        for t in (-1, 1):
            kit.fix(
                [rod((t * 0.6, s * (half + 0.09), 0.02), hub + [0, s * (half + 0.06), 0], 0.035, 8)], look
            )
        kit.fix([box((1.4, 0.08, 0.04), (0, s * (half + 0.09), 0.02))], look)
    kit.fix([box((0.08, 2 * half + 0.18, 0.04), (t * 0.6, 0, 0.02)) for t in (-1, 1)], look)
    kit.fix([pointed(cylinder(0.03, 2 * half + 0.16), 1) + hub], looks.metal(dice))
    angles = 2 * np.pi * np.arange(count) / count + dice.between(0, 1)
    rims, spots = [], np.column_stack([np.cos(angles), 0 * angles, np.sin(angles)]) * radius
    for s in (-1, 1):
        rims.append(pointed(torus(0.96 * radius, 0.018, 40), 1) + [0, s * half, 0])
        rims += [rod((0, s * half, 0), 0.96 * spot + [0, s * half, 0], 0.012) for spot in spots]
        rims.append(pointed(cylinder(0.09, 0.03, 16), 1) + [0, s * half, 0])
    rims += [pointed(cylinder(0.012, 2 * half), 1) + spot for spot in spots]
    wheel = kit.add("wheel", spin(hub, BACK), [(moved(rims, hub), looks.painted_metal(dice))])
    drop, box_ = dice.between(0.2, 0.26), dice.chance(0.5)
    for spot in spots:
        cabin = [box((0.02, 0.02, drop), (0, t * 0.12, -drop / 2)) for t in (-1, 1)]
        cabin += [
            box((0.2, 0.26, 0.02), (0, 0, -drop)),
            *[box((0.02, 0.26, 0.12), (t * 0.1, 0, 0.06 - drop)) for t in (-1, 1)],
        ]
        cabin.append(box((0.22, 0.26, 0.02), (0, 0, -0.03)) if box_ else box((0.03, 0.26, 0.03), (0, 0, 0)))
        kit.add("cabin", spin(hub + spot, BACK), [(moved(cabin, hub + spot), looks.plastic(dice))], wheel)
    return scaled(kit.done(), scale)


def _carousel(dice: Dice) -> list[Body]:
    """A round platform that turns about a post, with horses that rise or seats that do not."""
    kit, scale = Assembly("base"), dice.spread(0.1, 0.8)
    radius, count = 1.0, dice.whole(3, 8)
    kit.fix(
        [cylinder(1.1 * radius, 0.08, 32) + [0, 0, 0.04], cylinder(0.05, 1.3, 14) + [0, 0, 0.7]],
        looks.painted_metal(dice),
    )
    deck = [pointed(torus(0.55 * radius, 0.45 * radius, 32, 0.025), 2) + [0, 0, 0.115]]
    roofed = dice.chance(0.7)
    if roofed:
        deck += [
            rod((0.95 * np.cos(a), 0.95 * np.sin(a), 0.1), (0.95 * np.cos(a), 0.95 * np.sin(a), 1.05), 0.015)
            for a in np.arange(6) * np.pi / 3
        ]
        deck.append(torus(0.56 * radius, 0.48 * radius, 32, 0.03) + [0, 0, 1.07])
    number = kit.add("platform", spin((0, 0, 0.1), UP), [(deck, looks.wood(dice))])
    for k in range(count):
        yaw = rotation(UP, 2 * np.pi * k / count)
        if roofed:
            lift = dice.between(-0.08, 0.08)
            horse = [
                soft((0.1, 0.32, 0.13), 0.6, 0.8) + [0, 0, 0.5],
                box((0.06, 0.06, 0.2), (0, -0.15, 0.6)),
                box((0.055, 0.14, 0.07), (0, -0.2, 0.69)),
            ]
            horse += [
                boxes((0.03, 0.03, 0.2), [(s * 0.03, t * 0.1, 0.36) for s in (-1, 1) for t in (-1, 1)]),
                cylinder(0.01, 0.74) + [0, 0, 0.57],
            ]
            pieces = turned(moved(horse, (0.62 * radius, 0, lift)), yaw)
            kit.add("horse", slide(UP, 0.08 - lift, -0.08 - lift), [(pieces, looks.plastic(dice))], number)
        else:
            seat = [
                box((0.3, 0.25, 0.05), (0.62 * radius, 0, 0.3)),
                box((0.3, 0.04, 0.3), (0.62 * radius, 0.12, 0.42)),
                box((0.06, 0.06, 0.2), (0.62 * radius, 0, 0.2)),
            ]
            kit.fix(turned(seat, yaw), looks.plastic(dice), number)
    if not roofed:
        kit.add(
            "wheel",
            spin((0, 0, 1.35), UP),
            [
                (
                    [
                        torus(0.2, 0.02, 24) + [0, 0, 1.38],
                        *around([rod((0, 0, 1.38), (0.2, 0, 1.38), 0.012)], 4),
                        cylinder(0.045, 0.03) + [0, 0, 1.37],
                    ],
                    looks.metal(dice),
                )
            ],
        )
    return scaled(kit.done(), scale)


CATEGORIES = (
    Category("swing_set", _swing_set),
    Category("ferris_wheel", _ferris_wheel),
    Category("carousel", _carousel),
)
