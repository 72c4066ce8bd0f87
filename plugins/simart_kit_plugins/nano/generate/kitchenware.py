"""Small household things with lids, caps and pumps."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.outlines import SQUARE, ngon, rounded
from ...shapes.placing import Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import (
    Pieces,
    box,
    cylinder,
    loft,
    revolve,
    rod,
    superquadric,
    tube,
    vessel,
)
from . import looks
from .assembling import Assembly, press
from .category import Category
from .cookware import bail, ear, tilting
from .objects import Body, Look, hinge, slide, spin


def _cap(dice: Dice, radius: float, high: float) -> Pieces:
    """A screw cap on z = 0, plain or ribbed."""
    inner, roof = radius * 0.93, high * 0.8
    outside = [(inner, 0), (radius, 0), (radius, high * 0.9), (radius * 0.92, high), (0, high)]
    cap: Pieces = [revolve(np.array([*outside, (0, roof), (inner, roof), (inner, 0)]), 20)]
    if dice.chance(0.5):
        cap += around(
            [box((radius * 0.08, radius * 0.12, high * 0.8), (radius, 0, high * 0.45))], dice.whole(8, 14)
        )
    return cap


def _jar(dice: Dice) -> list[Body]:
    """A jar or a bottle with a screw cap, a stopper or a swing top."""
    kit, look = Assembly(), dice.pick((looks.glass, looks.glass, looks.ceramic, looks.plastic))(dice)
    bottle = dice.chance(0.5)
    radius = dice.between(0.025, 0.06)
    height = radius * (dice.between(2.5, 5.0) if bottle else dice.between(1.2, 2.8))
    neck = radius * (dice.between(0.25, 0.5) if bottle else dice.between(0.75, 1.0))
    throat = height * (dice.between(0.6, 0.75) if bottle else 0.72)
    profile = [
        [0.0, 0.0],
        [radius, 0],
        [radius, throat * 0.9],
        [neck, throat * 1.1],
        [neck, height],
        [neck * 0.85, height],
        [neck * 0.85, throat],
        [0, throat],
    ]
    if dice.chance(0.75):
        kit.fix([revolve(profile, 20)], look)
    else:
        square = [(2 * r, 2 * r, z) for r, z in profile[:3]]
        kit.fix([loft(rounded(0.15), [*square, (1.2 * radius, 1.2 * radius, throat), (0, 0, throat)])], look)
        kit.fix([revolve(profile[3:], 20)], look)
    if dice.chance(0.2):
        kit.fix([ear(dice, radius, throat * 0.9)], look)
    if dice.chance(0.4):
        kit.fix([cylinder(radius * 1.01, throat * 0.4, 20) + [0, 0, throat * 0.45]], looks.fabric(dice))
    style, stuff = dice.unit(), looks.plastic(dice) if dice.chance(0.5) else looks.metal(dice)
    high = min(max(neck * dice.between(0.3, 1.0), 0.008), 1.5 * (height - 1.1 * throat))
    base = (0.0, 0.0, height - high * 0.6)
    cap = moved(_cap(dice, neck * dice.between(1.08, 1.2), high), base)
    if style < 0.65:
        kit.add("cap", spin(base, (0, 0, 1)), [(cap, stuff)])
    elif style < 0.8:
        _swing_top(dice, kit, neck, height, 1.1 * throat, stuff)
    else:
        pin = (0, neck * 1.15, height + 0.001)
        shape = moved(_cap(dice, neck * 1.1, high * 0.6), (0, 0, height + 0.001))
        shape.append(box((neck * 0.5, neck * 0.2, high * 0.4), (0, neck * 1.1, height + high * 0.2)))
        kit.add("lid", hinge(pin, (-1, 0, 0), dice.between(1.5, 2.6)), [(shape, stuff)])
    return kit.done()


def _swing_top(dice: Dice, kit: Assembly, neck: float, height: float, shoulder: float, look: Look) -> None:
    """A wire bow on pins at the neck with a stopper in it, hollow about the pins: so it clears the rim."""
    wire = max(neck * 0.07, 0.001)
    level = max(height - neck * 0.8, shoulder + 2 * wire)
    reach, angle = 1.03 * np.hypot(neck, height - level), np.arctan2(neck, height - level)
    line = np.column_stack([np.sin(angle * np.linspace(0, 1, 8)), np.cos(angle * np.linspace(0, 1, 8))])
    stop = revolve(reach * np.concatenate([line, 1.15 * line[::-1]]), 16) + [0, 0, level]
    pin, side, top = (0, 0, level), neck * 1.12, level + 1.15 * reach
    bow = [(-side, 0, level), (-side, 0, top), (side, 0, top), (side, 0, level)]
    kit.fix([rod((-neck * 1.1, 0, level), (neck * 1.1, 0, level), wire * 1.2)], look)
    parts = [([tube(bow, wire, 6)], look), ([stop], looks.ceramic(dice))]
    kit.add("stopper", hinge(pin, (dice.sign(), 0, 0), dice.between(1.3, 1.9)), parts)


def _thermos(dice: Dice) -> list[Body]:
    """A flask: a cup that screws on, a cap, a flip lid, or a pump top with a button."""
    kit, coat = Assembly(), looks.painted_metal(dice)
    radius, height = dice.between(0.03, 0.07), dice.between(0.16, 0.34)
    neck = radius * dice.between(0.7, 1.0)
    kit.fix(
        [
            revolve(
                [
                    [0.0, 0.0],
                    [radius, 0],
                    [radius, height * 0.8],
                    [neck, height * 0.88],
                    [neck, height * 0.92],
                    [0, height * 0.92],
                ],
                20,
            )
        ],
        coat,
    )
    if dice.chance(0.35):
        kit.fix([ear(dice, radius, height * 0.8)], looks.plastic(dice))
    base, stuff = np.array([0, 0, height * 0.93]), looks.plastic(dice) if dice.chance(0.5) else coat
    style, tall = dice.unit(), height * dice.between(0.1, 0.3)
    if style < 0.5:
        cup = revolve([[neck * 0.9, 0], [neck, 0], [neck * dice.between(0.8, 1.0), tall], [0, tall]], 20)
        kit.add("cap", spin(base, (0, 0, 1)), [(moved([cup], base), stuff)])
    elif style < 0.75:
        kit.fix([cylinder(neck * 0.95, 0.012, 18) + base], stuff)
        pin = base + [0, neck * 0.9, 0.008]
        lid = moved(
            [*_cap(dice, neck * 0.9, 0.016), box((0.02, 0.012, 0.01), (0, -neck * 0.95, 0.006))],
            base + [0, 0, 0.007],
        )
        kit.add("lid", hinge(pin, (-1, 0, 0), dice.between(1.4, 2.8)), [(lid, stuff)])
        if dice.chance(0.5):
            bow = [bail(dice, neck * 1.05, neck) + base]
            kit.add("handle", tilting((0, 0, base[2]), 1.5), [(bow, looks.metal(dice))])
    else:
        kit.fix(
            [
                superquadric((2 * radius, 2.4 * radius, tall), 0.4, 0.7, 7)
                + base
                + [0, -0.1 * radius, tall / 2]
            ],
            stuff,
        )
        push = cylinder(radius * 0.5, 0.014, 16) + base + [0, 0, tall + 0.006]
        kit.add("button", slide((0, 0, -1), 0.008), [([push], looks.plastic(dice))])
    return kit.done()


def _pepper_mill(dice: Dice) -> list[Body]:
    """A mill whose head, or crank, spins on its body."""
    kit, look = Assembly(), looks.wood(dice) if dice.chance(0.6) else looks.metal(dice)
    radius, height = dice.between(0.02, 0.035), dice.between(0.08, 0.3)
    up = np.linspace(0, 1, 12)
    waves = 0.75 + 0.2 * np.sin(up * dice.between(4, 14) + dice.between(0, 6)) + 0.05 * (1 - up)
    body = np.column_stack([radius * waves, up * height])
    kit.fix([revolve(np.vstack([[[0.0, 0.0]], body, [[0, height]]]), 18)], look)
    top = np.array([0, 0, height + 0.0015])
    if dice.chance(0.35):
        reach = radius * dice.between(1.5, 3.0)
        crank = [cylinder(radius * 0.5, 0.012, 12), rod((0, 0, 0.006), (reach, 0, 0.012), 0.003)]
        crank += [
            rod((reach, 0, 0.01), (reach, 0, 0.025), 0.003),
            superquadric((0.016, 0.016, 0.02), rows=6) + [reach, 0, 0.03],
        ]
        kit.add("crank", spin(top, (0, 0, 1)), [(moved(crank, top + [0, 0, 0.006]), looks.metal(dice))])
        return kit.done()
    head = radius * dice.between(0.7, 1.1)
    dome = [
        [0.0, 0.0],
        [head * 0.8, 0],
        [head, head * 0.5],
        [head * 0.8, head * 1.3],
        [head * 0.3, head * 1.7],
        [0, head * 1.75],
    ]
    shape: Pieces = [revolve(dome, dice.pick((6, 8, 18)))]
    knob = superquadric((head * 0.5, head * 0.5, head * 0.5), rows=6) + [0, 0, head * 1.95]
    number = kit.add("head", spin(top, (0, 0, 1)), [(moved(shape, top), look)])
    kit.fix(moved([knob], top), looks.metal(dice), number)
    return kit.done()


def _soap_dispenser(dice: Dice) -> list[Body]:
    """A bottle with a pump, or a box on a wall with a lever or a push plate."""
    kit, look = Assembly(), dice.pick((looks.ceramic, looks.plastic, looks.glass, looks.metal))(dice)
    if dice.chance(0.3):
        size = np.array([dice.between(0.08, 0.14), dice.between(0.08, 0.12), dice.between(0.16, 0.26)])
        kit.fix([box(size) + [0, 0, size[2] / 2]], look)
        plate = [box((size[0] * 0.7, 0.012, size[2] * 0.25), (0, -size[1] / 2 - 0.006, size[2] * 0.18))]
        if dice.chance(0.5):
            kit.add("push plate", press(0.006), [(plate, looks.plastic(dice))])
        else:
            motion = hinge((0, -size[1] / 2, size[2] * 0.305), (1, 0, 0), 0.12)
            kit.add("push plate", motion, [(plate, looks.plastic(dice))])
        if dice.chance(0.5):
            lid = [box((size[0], size[1], 0.012), (0, 0, size[2] + 0.007))]
            kit.add("lid", hinge((0, size[1] / 2, size[2] + 0.001), (-1, 0, 0), 1.5), [(lid, look)])
        return kit.done()
    radius, height = dice.between(0.025, 0.045), dice.between(0.09, 0.17)
    outline = dice.pick((ngon(18), SQUARE, rounded(0.2)))
    kit.fix(
        [
            loft(
                outline,
                [
                    (0, 0, 0),
                    (2 * radius, 2 * radius, 0),
                    (2 * radius, 2 * radius, height * 0.8),
                    (radius, radius, height),
                    (0, 0, height),
                ],
            )
        ],
        look,
    )
    stuff = looks.plastic(dice) if dice.chance(0.5) else looks.metal(dice)
    kit.fix([cylinder(radius * 0.5, 0.016, 16) + [0, 0, height + 0.008]], stuff)
    rise, reach = dice.between(0.02, 0.035), radius * dice.between(1.0, 1.8)
    top = height + 0.016 + rise
    pump: Pieces = [
        rod((0, 0, height + 0.016 - 0.8 * rise), (0, 0, top), radius * 0.16, 10),
        cylinder(radius * 0.35, 0.008, 14) + [0, 0, top],
    ]
    pump.append(tube([(0, 0, top), (0, -reach, top), (0, -reach - 0.004, top - 0.008)], radius * 0.12, 8))
    turn = rotation((0, 0, 1), dice.pick((0, 0, np.pi / 2, -np.pi / 2)))
    kit.add("pump", slide((0, 0, -1), rise * 0.7), [(turned(pump, turn), stuff)])
    return kit.done()


def _scale(dice: Dice) -> list[Body]:
    """A kitchen scale: a plate that sinks, a pointer or buttons."""
    kit, coat = Assembly(), looks.plastic(dice) if dice.chance(0.5) else looks.painted_metal(dice)
    width, depth, height = dice.between(0.14, 0.25), dice.between(0.14, 0.22), dice.between(0.02, 0.2)
    kit.fix(
        [loft(SQUARE, [(0, 0, 0), (width, depth, 0), (width * 0.85, depth * 0.85, height), (0, 0, height)])],
        coat,
    )
    plate = vessel(
        dice.pick((ngon(22), SQUARE, rounded(0.15))),
        (width, depth, dice.between(0.008, 0.05)),
        0.003,
        dice.between(1.0, 1.3),
    )
    post = cylinder(0.015, 0.016, 10) + [0, 0, height + 0.008]
    kit.add("plate", slide((0, 0, -1), 0.006), [([plate + [0, 0, height + 0.012], post], looks.metal(dice))])
    if height > 0.09:
        lean = rotation((1, 0, 0), -np.arctan2(0.075 * depth, height))
        face = np.array([0, -depth * 0.4625, height / 2])
        clock = turned([pointed(cylinder(height * 0.4, 0.006, 20), Y)], lean)
        hand = turned([box((0.004, 0.002, height * 0.34), (0, -0.005, height * 0.15))], lean)
        kit.fix(moved(clock, face), Look("plastic", (240, 240, 235)))
        kit.add(
            "pointer", spin(face, lean @ [0, 1, 0]), [(moved(hand, face), Look("plastic", (180, 30, 30)))]
        )
    return kit.done()


CATEGORIES: tuple[Category, ...] = (
    Category("jar", _jar),
    Category("thermos", _thermos),
    Category("pepper_mill", _pepper_mill),
    Category("soap_dispenser", _soap_dispenser),
    Category("kitchen_scale", _scale),
)
