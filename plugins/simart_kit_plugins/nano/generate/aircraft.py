"""Aeroplanes and helicopters."""

from __future__ import annotations

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import X, around, moved, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, revolve, rod, superquadric, tube
from . import looks
from .category import Category
from .objects import Body, hinge, spin, surface
from .rigging import BACK, RIGHT, UP, Rig, lying, plate, profile


def _rotor(dice: Dice, reach: float, count: int) -> Pieces:
    """Twisted blades and a hub about z."""
    blade = turned(
        [box((reach * 0.95, dice.between(0.06, 0.16) * reach, 0.012 * reach), (reach * 0.5, 0, 0))],
        rotation(RIGHT, dice.between(0.1, 0.4)),
    )
    return [*around(blade, count, dice.between(0, 1)), cylinder(0.08 * reach, 0.1 * reach, 12)]


def _aeroplane(dice: Dice) -> list[Body]:
    """A propeller plane; a toy or a drawing-room model."""
    long, span = dice.between(0.3, 2.0), dice.between(0.9, 1.4)
    span, girth = span * long, dice.between(0.05, 0.08) * long
    paint = looks.painted_metal(dice) if dice.chance(0.5) else looks.wood(dice)
    line = np.array([[0, -0.5], [0.7, -0.49], [1, -0.3], [1, 0.05], [0.25, 0.5], [0, 0.5]]) * [girth, long]
    hull = turned([revolve(line, 14)], rotation(RIGHT, -np.pi / 2))
    chord, thick = dice.between(0.14, 0.22) * long, 0.014 * long
    wing_y, high = -0.12 * long, dice.pick((-0.6, 0.0, 0.95)) * girth
    tip = dice.between(0.5, 1.0)
    main = 0.76 * chord
    half = plate(
        [[0, -0.5 * chord], [span / 2, -0.5 * chord * tip], [span / 2, 0.26 * main * tip], [0, 0.26 * main]],
        thick,
    )
    tail = plate(
        [[0, 0.36 * long], [0.22 * long, 0.4 * long], [0.22 * long, 0.47 * long], [0, 0.47 * long]], thick
    )
    fin = profile(
        [[0.36 * long, 0], [0.47 * long, 0], [0.47 * long, 0.18 * long], [0.43 * long, 0.18 * long]], thick
    )
    wings = [w * [s, 1, 1] + [0, wing_y, high] for w in (half,) for s in (-1, 1)] + [
        tail,
        tail * [-1, 1, 1],
        fin,
    ]
    whole = Rig(surface(hull, paint), surface(wings, paint), label="fuselage")
    nose = np.array([0, -0.5 * long - 0.01 * long, 0])
    prop = moved(turned(_rotor(dice, 0.16 * long, dice.whole(2, 4)), rotation(RIGHT, np.pi / 2)), nose)
    whole.add("propeller", spin(nose, BACK), surface(prop, looks.metal(dice)))
    edge = wing_y + 0.26 * main * (0.35 * tip + 0.65) + 0.002 * long
    for name, s in (("left_aileron", -1), ("right_aileron", 1)):
        flap = box((0.3 * span, 0.2 * chord, 0.8 * thick), (s * 0.32 * span, edge + 0.1 * chord, high))
        whole.add(
            "aileron",
            hinge((s * 0.32 * span, edge, high), RIGHT, 0.4, -0.4),
            surface([flap], looks.darker(paint)),
            name=name,
        )
    rudder = box((0.8 * thick, 0.06 * long, 0.16 * long), (0, 0.503 * long, 0.09 * long))
    whole.add(
        "rudder", hinge((0, 0.473 * long, 0.09 * long), UP, 0.5, -0.5), surface([rudder], looks.darker(paint))
    )
    if dice.chance(0.6):
        lift = box((0.4 * long, 0.05 * long, 0.8 * thick), (0, 0.498 * long, -0.01 * long))
        whole.add(
            "elevator",
            hinge((0, 0.473 * long, -0.01 * long), RIGHT, 0.4, -0.4),
            surface([lift], looks.darker(paint)),
        )
    _landing_gear(dice, whole, long, girth)
    return whole.bodies()


def _landing_gear(dice: Dice, whole: Rig, long: float, girth: float) -> None:
    """Three wheels on struts."""
    radius = 0.04 * long
    for name, x, y in (("left_wheel", -0.1, -0.2), ("right_wheel", 0.1, -0.2), ("tail_wheel", 0.0, 0.4)):
        hub = np.array([x * long, y * long, -girth - 0.06 * long])
        whole.dress(
            0, surface([rod((0.4 * hub[0], hub[1], -0.3 * girth), hub, 0.006 * long)], looks.metal(dice))
        )
        whole.add(
            "wheel",
            spin(hub, RIGHT),
            surface([lying(radius, 0.02 * long, X, 14) + hub], looks.rubber(dice)),
            name=name,
        )


def _helicopter(dice: Dice) -> list[Body]:
    long = dice.between(0.25, 1.2)
    wide, tall, paint = (
        dice.between(0.2, 0.28) * long,
        dice.between(0.24, 0.32) * long,
        looks.painted_metal(dice),
    )
    cabin = superquadric((wide, 0.5 * long, tall), 0.6, 0.6, 9) + [0, -0.2 * long, 0]
    boom = rod((0, 0, 0.05 * long), (0, 0.55 * long, 0.1 * long), 0.035 * long, 8)
    mast = cylinder(0.02 * long, 0.14 * long, 10) + [0, -0.15 * long, tall / 2 + 0.02 * long]
    fin = profile(
        [
            [0.48 * long, 0.08 * long],
            [0.58 * long, 0.08 * long],
            [0.6 * long, 0.25 * long],
            [0.55 * long, 0.25 * long],
        ],
        0.012 * long,
    )
    skids = [
        tube(
            np.array([(s * 0.13, -0.42, -0.2), (s * 0.13, -0.38, -0.24), (s * 0.13, 0.05, -0.24)]) * long,
            0.01 * long,
        )
        for s in (-1, 1)
    ]
    skids += [
        rod((s * 0.13 * long, y * long, -0.24 * long), (s * 0.3 * wide, y * long, -0.3 * tall), 0.008 * long)
        for s in (-1, 1)
        for y in (-0.3, -0.05)
    ]
    whole = Rig(surface([cabin, boom, fin], paint), surface([mast, *skids], looks.metal(dice)))
    top = np.array([0, -0.15 * long, tall / 2 + 0.1 * long])
    whole.add(
        "rotor",
        spin(top, UP),
        surface(moved(_rotor(dice, dice.between(0.4, 0.6) * long, dice.whole(2, 5)), top), looks.metal(dice)),
    )
    side = dice.sign()
    at = np.array([side * 0.04 * long, 0.55 * long, 0.12 * long])
    small = turned(_rotor(dice, 0.1 * long, dice.whole(2, 4)), rotation((0, 1, 0), np.pi / 2))
    whole.add("tail rotor", spin(at, RIGHT), surface(moved(small, at), looks.metal(dice)))
    if dice.chance(0.7):
        for name, s in (("left_door", -1), ("right_door", 1)):
            x, y = s * (wide / 2 + 0.006 * long), -0.3 * long
            leaf = box((0.01 * long, 0.16 * long, 0.6 * tall), (x, y + 0.08 * long, 0))
            pane = box((0.012 * long, 0.1 * long, 0.25 * tall), (x, y + 0.08 * long, 0.12 * tall))
            moves = hinge((x, y, 0), (0, 0, -s), 1.3)
            whole.add(
                "door",
                moves,
                surface([leaf], looks.darker(paint)),
                surface([pane], looks.glass(dice)),
                name=name,
            )
    return whole.bodies()


CATEGORIES: tuple[Category, ...] = (
    Category("aeroplane", _aeroplane),
    Category("helicopter", _helicopter),
)
