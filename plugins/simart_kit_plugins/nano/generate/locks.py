"""Locks, and handles alone."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.fronts import frame
from ...shapes.handles import knob
from ...shapes.outlines import SQUARE, rounded
from ...shapes.placing import X, Y, at, moved, pointed, rotation, turned
from ...shapes.primitives import (
    Pieces,
    box,
    cylinder,
    loft,
    prism,
    rod,
    superquadric,
    torus,
    tube,
)
from . import looks
from .assembling import Assembly, disc, lever, rosette
from .category import Category
from .objects import Body, hinge, slide, spin


def _lock(dice: Dice) -> list[Body]:
    return dice.weighted([(4, _padlock), (3, _bolt), (3, _rim_lock), (1, _hasp)])(dice)


def _padlock(dice: Dice) -> list[Body]:
    """A body with a shackle that lifts or turns out of it, a key or wheels with numbers."""
    kit, metal = Assembly("body"), looks.metal(dice)
    wide, high, deep = dice.between(0.025, 0.07), dice.between(0.025, 0.07), dice.between(0.01, 0.025)
    coat = metal if dice.chance(0.5) else looks.painted_metal(dice)
    outline = dice.pick((SQUARE, rounded(0.2, deep / wide), rounded(0.35, deep / wide)))
    if dice.chance(0.25):
        kit.fix([pointed(cylinder(wide / 2, deep, 20), Y)], coat)
        high = wide
    else:
        kit.fix([prism(outline, (wide, deep, high))], coat)
    radius, thick = wide * dice.between(0.26, 0.36), min(deep * 0.3, wide * 0.09)
    rise = high * dice.between(0.2, 0.8)
    bend = np.linspace(0, np.pi, 9)
    base = high / 2 - 0.3 * high
    path = np.column_stack([radius * np.cos(bend), 0 * bend, high / 2 + rise + radius * np.sin(bend)])
    side = dice.sign()
    ends = (side * radius, 0, base), (-side * radius, 0, high / 2 + 0.001)
    line = np.vstack([ends[0], path if side > 0 else path[::-1], ends[1]])
    shackle = [tube(line, thick, 8)]
    if dice.chance(0.5):
        kit.add("shackle", slide((0, 0, 1), high * dice.between(0.15, 0.28)), [(shackle, metal)])
    else:
        kit.add("shackle", hinge(ends[0], (0, 0, dice.sign()), dice.between(1.5, 3.1)), [(shackle, metal)])
    if dice.chance(0.35):
        count, ring = dice.whole(3, 4), deep * 0.42
        for k in range(count):
            x = (k + 0.5 - count / 2) * wide * 0.8 / count
            spot = (x, -deep / 2 + ring * 0.8, -high * 0.15)
            wheel = pointed(cylinder(ring, wide * 0.6 / count, 10), X) + spot
            kit.add("dial", spin(spot, (1, 0, 0)), [([wheel], looks.metal(dice))])
    elif dice.chance(0.6):
        key = [
            rod((0, 0, -high / 2), (0, 0, -high / 2 - 0.012), 0.002),
            pointed(cylinder(0.009, 0.002, 12), Y) + [0, 0, -high / 2 - 0.02],
        ]
        kit.add("key", hinge((0, 0, -high / 2), (0, 0, 1), 1.57), [(key, looks.metal(dice))])
    return kit.done()


def _bolt(dice: Dice) -> list[Body]:
    """A bar that slides in staples on a plate, upright or level."""
    kit, metal = Assembly("plate"), looks.metal(dice)
    long, wide = dice.between(0.06, 0.3), dice.between(0.02, 0.05)
    radius, off = wide * dice.between(0.12, 0.25), 0.004
    kit.fix([box((long, off, wide), (0, off / 2, 0))], metal)
    level = -radius - 0.001
    staple = [
        box((wide * 0.3, radius * 0.6, radius * 3.6), (0, level - radius * 1.2, 0)),
        *at(box((wide * 0.3, radius * 2.6, radius * 0.6)), [(0, level, s * radius * 1.6) for s in (-1, 1)]),
    ]
    for x in (-0.4 * long, 0.1 * long, 0.42 * long)[dice.whole(0, 1) :]:
        kit.fix(moved(staple, (x, 0, 0)), metal)
    travel = long * dice.between(0.12, 0.25)
    if dice.chance(0.6):
        keeper = (0.5 * long + travel * 0.6, 0, 0)
        kit.fix(moved([*staple, box((wide * 0.6, off, wide), (0, off / 2, 0))], keeper), metal)
    bar: Pieces = [rod((-0.48 * long, level, 0), (0.5 * long, level, 0), radius, 8)]
    grip = rod((-0.15 * long, level, 0), (-0.15 * long, level - radius * 5, 0), radius * 0.6, 8)
    bar += [
        grip,
        superquadric((radius * 3, radius * 3, radius * 3), rows=6) + [-0.15 * long, level - radius * 5, 0],
    ]
    kit.add("bolt", slide((1, 0, 0), travel), [(bar, looks.metal(dice))])
    turn = dice.pick(
        (
            np.eye(3),
            rotation((0, 1, 0), np.pi / 2),
            rotation((0, 1, 0), -np.pi / 2),
            rotation((0, 1, 0), np.pi),
        )
    )
    return kit.done(turn)


def _rim_lock(dice: Dice) -> list[Body]:
    """A lock case with a bolt at its edge, and a lever, knob, key or thumb turn on its face."""
    kit, metal = Assembly("case"), looks.painted_metal(dice)
    wide, high, deep = dice.between(0.05, 0.12), dice.between(0.06, 0.2), dice.between(0.015, 0.035)
    kit.fix([box((wide, deep, high))], metal)
    side = dice.sign()
    if dice.chance(0.5):
        kit.fix([box((0.003, deep * 1.3, high * 1.3), (side * (wide / 2 + 0.0015), 0, 0))], looks.metal(dice))
    brass = looks.metal(dice)
    tall, out = high * dice.between(0.12, 0.25), dice.between(0.01, 0.02)
    low = -high * dice.between(0.15, 0.3)
    bolt = [box((0.05, deep * 0.5, tall), (side * (wide / 2 + 0.004 - 0.025), 0, low))]
    kit.add("bolt", slide((side, 0, 0), out), [(bolt, brass)])
    if dice.chance(0.6):
        latch = loft(
            SQUARE,
            [
                (0, 0, 0),
                (tall, deep * 0.5, 0),
                (tall, deep * 0.5, 0.03),
                (tall, deep * 0.1, 0.045),
                (0, 0, 0.045),
            ],
        )
        shape = [pointed(latch, X) * [side, 1, 1] + [side * (wide / 2 - 0.03), 0, high * 0.25]]
        kit.add("latch", slide((-side, 0, 0), 0.012), [(shape, brass)])
    spot = (0, -deep / 2, high * 0.22)
    if dice.chance(0.6):
        shape = [piece * [-side, 1, 1] for piece in lever(dice, dice.between(0.08, 0.13), 0.008)]
        kit.add("handle", hinge(spot, (0, -side, 0), 0.8), [(moved(shape, spot), brass)])
    else:
        kit.add("knob", hinge(spot, (0, 1, 0), 1.0, -1.0), [(moved(knob(dice, 0.022), spot), brass)])
    if dice.chance(0.7):
        place = (0, -deep / 2, low)
        turn = [disc(0.012, 0.004, 14), box((0.005, 0.02, 0.025), (0, -0.014, 0))]
        kit.add("key", hinge(place, (0, 1, 0), dice.pick((1.57, 3.14))), [(moved(turn, place), brass)])
    return kit.done()


def _hasp(dice: Dice) -> list[Body]:
    """A slotted strap on a hinge that falls over a staple."""
    kit, metal = Assembly("plates"), looks.metal(dice)
    long, wide = dice.between(0.05, 0.12), dice.between(0.02, 0.04)
    kit.fix(
        [
            box((0.5 * long, 0.003, wide), (-0.28 * long, 0.0015, 0)),
            box((0.35 * long, 0.003, wide), (0.75 * long, 0.0015, 0)),
        ],
        metal,
    )
    loop = pointed(torus(wide * 0.22, wide * 0.06, 14), X) + [0.75 * long, -wide * 0.15, 0]
    kit.fix([loop], metal)
    strap = [
        frame(0.4 * long, wide, 0.003, wide * 0.25) + [0.75 * long, -0.001, 0],
        box((0.55 * long, 0.003, wide * 0.8), (0.275 * long, -0.0025, 0)),
        pointed(cylinder(0.004, wide, 8), 2) + [0, -0.002, 0],
    ]
    kit.add("hasp", hinge((0, -0.002, 0), (0, 0, -1), dice.between(1.6, 3.0)), [(strap, metal)])
    if dice.chance(0.5):
        pin = (0.75 * long, -0.003, 0)
        key = moved([box((wide * 0.2, wide * 0.4, wide * 0.4), (0, -wide * 0.3, 0))], pin)
        kit.add("knob", hinge(pin, (0, 1, 0), 1.57), [(key, metal)])
    return kit.done()


def _handle(dice: Dice) -> list[Body]:
    """A lever, a knob, a ring or a window handle on its plate, some on a piece of leaf."""
    kit, metal = Assembly("plate"), looks.metal(dice)
    kit.fix(rosette(dice, dice.between(0.05, 0.12)), metal)
    spot, side = (0, -0.008, 0), dice.sign()
    style = dice.unit()
    if style < 0.6:
        shape = [
            piece * [side, 1, 1]
            for piece in lever(dice, dice.between(0.07, 0.15), dice.between(0.006, 0.012))
        ]
        if style < 0.15:
            shape = turned(shape, rotation((0, 1, 0), side * np.pi / 2))
        motion = hinge(spot, (0, side, 0), dice.between(0.5, 1.0) if style > 0.15 else 1.57)
    elif style < 0.8:
        shape = knob(dice, dice.between(0.02, 0.035))
        shape.append(box((0.004, 0.004, 0.02), (0, min(piece[..., 1].min() for piece in shape), 0)))
        motion = hinge(spot, (0, 1, 0), 1.2, -1.2)
    else:
        radius = dice.between(0.02, 0.045)
        shape = [
            pointed(torus(radius, radius * 0.12, 18), Y) + [0, -0.008, -radius],
            rod((0, 0, 0), (0, -0.014, 0), radius * 0.2, 8),
        ]
        motion = hinge((0, -0.014, 0), (-1, 0, 0), dice.between(1.0, 1.57))
    kit.add("handle", motion, [(moved(shape, spot), metal)])
    if dice.chance(0.4):
        kit.fix(
            [box((dice.between(0.06, 0.3), 0.04, dice.between(0.25, 0.4)), (0, 0.02, 0))], looks.wood(dice)
        )
    elif dice.chance(0.3):
        kit.fix([box((0.008, 0.06, 0.008), (0, 0.03, 0))], metal)
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("lock", _lock),
    Category("door_handle", _handle),
)
