"""Toilets, taps, sinks, and hand tools with two arms."""

from __future__ import annotations

import numpy as np

from ....shapes.dice import Dice
from ....shapes.outlines import SQUARE, ngon, rounded
from ....shapes.placing import Y, around, mirrored, moved, pointed, rotation, turned
from ....shapes.primitives import (
    Pieces,
    between,
    box,
    cylinder,
    loft,
    prism,
    revolve,
    rod,
    superquadric,
    torus,
    tube,
    vessel,
)


def fixture(dice: Dice) -> list[Pieces]:
    """Something of a bathroom, a kitchen sink or a tool box."""
    return dice.weighted([(3, _toilet), (3, _tap), (2, _scissors), (2, _glasses), (1, _basin)])(dice)


def _toilet(dice: Dice) -> list[Pieces]:
    wide, long, high = dice.between(0.33, 0.4), dice.between(0.42, 0.52), dice.between(0.36, 0.44)
    foot, outline = dice.between(0.5, 0.8), dice.pick((ngon(20), ngon(20), rounded(0.35)))
    skin = [
        (0, 0, 0),
        (wide * foot, long * foot, 0),
        (wide * foot, long * foot, high * 0.3),
        (wide, long, high * 0.8),
        (wide, long, high),
        (wide * 0.8, long * 0.8, high),
        (wide * 0.4, long * 0.4, high * 0.5),
        (0, 0, high * 0.5),
    ]
    body: Pieces = [loft(outline, skin)]
    tank, deep = dice.between(0.2, 0.32), dice.between(0.15, 0.2)
    back = 0.45 * long
    body.append(between((-wide / 2, back, high * 0.7), (wide / 2, back + deep, high + tank)))
    body.append(between((-wide * 0.3, 0, 0), (wide * 0.3, back + deep * 0.7, high * 0.8)))
    ring = loft(
        outline,
        [
            (wide, long, 0),
            (wide, long, 0.02),
            (wide * 0.7, long * 0.7, 0.02),
            (wide * 0.7, long * 0.7, 0),
            (wide, long, 0),
        ],
    )
    lid = prism(outline, (wide * 1.02, long * 1.02, 0.02)) + [0, 0, 0.035]
    angles = [dice.between(1.3, 1.8) if dice.chance(0.4) else 0.0]
    angles.append(angles[0] * dice.pick((0.0, 0.98)))
    turns = [rotation((1, 0, 0), -angle) for angle in angles]
    parts = [
        moved(turned([piece], turn, (0, back, 0)), (0, 0, high + 0.005))
        for piece, turn in zip((lid, ring), turns, strict=True)
    ]
    flush: Pieces = [box((0.08, 0.02, 0.02), (-wide * 0.3, back - 0.01, high + tank * 0.8))]
    if dice.chance(0.5):
        flush = [cylinder(0.03, 0.02, 12) + [0, back + deep / 2, high + tank + 0.035]]
    cover: Pieces = [box((wide * 1.05, deep * 1.1, 0.03), (0, back + deep / 2, high + tank + 0.015))]
    return [body, *parts, flush, cover] if dice.chance(0.5) else [body + cover, *parts, flush]


def _tap(dice: Dice) -> list[Pieces]:
    """A tap with a bent spout and one or two handles."""
    radius, height, reach = dice.between(0.012, 0.03), dice.between(0.08, 0.35), dice.between(0.1, 0.25)
    bend = np.linspace(0, np.pi, 8)
    arch = np.column_stack([0 * bend, -reach / 2 * (1 - np.cos(bend)), height + reach / 2 * np.sin(bend)])
    drop = arch[-1] - [0, 0, dice.between(0.2, 0.6) * height]
    if dice.chance(0.35):
        arch, drop = (
            np.array([[0, 0, height], [0, -reach, height * 1.05]]),
            np.array([0, -reach, height * 0.9]),
        )
    spout = [tube(np.vstack([[0, 0, 0], arch, drop]), radius, 10)]
    base: Pieces = [cylinder(radius * dice.between(1.2, 2.2), height * 0.15, 14) + [0, 0, height * 0.07]]
    if dice.chance(0.45):
        swing = rotation((0, 0, 1), dice.between(-1, 1))
        lever = rod((0, 0, 0), (reach * 0.5, 0, radius), radius * 0.4, 8)
        one = moved(turned([lever, cylinder(radius * 1.1, radius * 2, 10)], swing), (radius, 0, height * 0.5))
        return [base + spout, one] if dice.chance(0.5) else [base, spout, one]
    gap = dice.between(0.06, 0.12)
    handles = []
    for side in (-1, 1):
        base.append(cylinder(radius, height * 0.35, 10) + [side * gap, 0, height * 0.17])
        arms = around(
            [rod((0, 0, 0), (radius * 2, 0, 0), radius * 0.4)], dice.pick((1, 3, 4)), dice.between(0, 6)
        )
        handles.append(moved([*arms, cylinder(radius * 0.9, radius, 8)], (side * gap, 0, height * 0.4)))
    base.append(box((2.4 * gap, radius * 3, radius), (0, 0, radius / 2)))
    return [base + spout, *handles] if dice.chance(0.5) else [base, spout, *handles]


def _scissors(dice: Dice) -> list[Pieces]:
    """Two arms on a pivot: scissors or pliers."""
    blade, wide = dice.between(0.08, 0.14), dice.between(0.008, 0.02)
    angle, loop = dice.between(0.0, 0.6), dice.between(0.015, 0.03)
    tip = loft(SQUARE, [(0, 0, 0), (0.003, wide, 0), (0.002, wide * 0.2, blade), (0, 0, blade)])
    arm: Pieces = [tip, tube([(0, 0, 0), (0, wide, -0.4 * blade), (0, loop, -0.6 * blade)], wide * 0.4)]
    if dice.chance(0.7):
        ring = torus(loop, loop * 0.25, 16) * [1, dice.between(1.0, 1.6), 1]
        arm.append(pointed(ring, 0) + [0, loop, -0.6 * blade - loop])
    else:
        arm.append(
            tube([(0, loop, -0.6 * blade), (0, loop * 1.5, -blade), (0, loop, -1.5 * blade)], wide * 0.6)
        )
    first = turned(arm, rotation((1, 0, 0), angle / 2))
    second = moved(turned(mirrored(arm, Y), rotation((1, 0, 0), -angle / 2)), (0.004, 0, 0))
    first.append(pointed(cylinder(wide * 0.4, 0.012, 8), 0))
    return [first, second]


def _glasses(dice: Dice) -> list[Pieces]:
    """Eyeglasses, or headphones."""
    lens, long = dice.between(0.04, 0.06), dice.between(0.11, 0.15)
    if dice.chance(0.4):
        angle = np.linspace(0, np.pi, 12)
        band = [
            tube(
                np.column_stack([0.09 * np.cos(angle), 0 * angle, 0.11 * np.sin(angle)]),
                dice.between(0.004, 0.012),
            )
        ]
        cup = [
            pointed(cylinder(lens * 0.7, 0.025, 16), 0),
            pointed(torus(lens * 0.6, 0.012), 0) - [0.015, 0, 0],
        ]
        return [band, moved(cup, (0.09, 0, -0.02)), moved(mirrored(cup), (-0.09, 0, -0.02))]
    outline, gap = dice.pick((ngon(16), rounded(0.3), SQUARE)), 0.5 * lens + 0.008
    high, rim = lens * dice.between(0.6, 1.0), dice.between(0.002, 0.005)
    hoop = vessel(outline, (lens, high, 0.004), rim) @ rotation((1, 0, 0), np.pi / 2).T
    front: Pieces = [hoop + [gap, 0, 0], hoop - [gap, 0, 0], rod((-0.01, 0, 0.005), (0.01, 0, 0.005), rim)]
    hinge = gap + lens / 2
    path = [(0, 0, 0), (0, long * 0.75, 0), (0, long, -0.03)]
    fold = dice.between(0.2, 1.5) if dice.chance(0.3) else 0.0
    arm = turned([tube(path, rim * 0.8)], rotation((0, 0, 1), fold))
    return [front, *(moved(one, (s * hinge, 0, 0.005)) for s, one in ((1, arm), (-1, mirrored(arm))))]


def _basin(dice: Dice) -> list[Pieces]:
    """A wash basin or kitchen sink with a tap and a stopper."""
    wide, long, deep = dice.between(0.4, 0.8), dice.between(0.35, 0.5), dice.between(0.12, 0.25)
    outline = dice.pick((ngon(24), rounded(0.2), SQUARE))
    bowl: Pieces = [vessel(outline, (wide * 0.8, long * 0.8, deep), 0.02, 1.2)]
    if dice.chance(0.5):
        bowl.append(revolve([[0.12, 0], [0.08, -0.1], [0.1, -0.7], [0, -0.7]], 14))
    tap = moved([piece * 0.8 for part in _tap(dice)[:3] for piece in part], (0, 0.45 * long, deep))
    plug = [cylinder(0.03, 0.02, 12) + [0, 0, 0.03], superquadric((0.02, 0.02, 0.03), 1, 1, 5) + [0, 0, 0.05]]
    return [bowl, tap, plug]
