"""What cars and lorries share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, moved, rotation, turned
from ...shapes.primitives import box, rod, sheet, torus
from . import looks
from .objects import Look, hinge, spin, surface
from .rigging import RIGHT, UP, Rig, axle_wheel, lying


@dataclass(frozen=True)
class Shell:
    """Measures of a car [m]: its nose is at -long / 2.

    Attributes:
        long, wide, tall: outer size; `tall` is the roof's height.
        sill, belt: heights of the floor and of the windows' lower edge.
        posts: y of the A, B and C posts: where the doors begin and end.
    """

    long: float
    wide: float
    tall: float
    sill: float
    belt: float
    posts: tuple[float, float, float]


def size_of(dice: Dice) -> float:
    """Real, or a toy."""
    return 1.0 if dice.chance(0.5) else dice.spread(0.03, 0.15)


def sheet_between(low: FloatArray, high: FloatArray) -> FloatArray:
    """A pane between two edges of (2, 3) points."""
    return sheet(np.stack([low, high]))


def wheels(dice: Dice, whole: Rig, car: Shell, places: tuple[float, ...], steer: bool) -> None:
    """Wheels on both sides at these y; the first pair may steer."""
    radius = dice.between(0.28, 0.36) * car.tall / 1.5
    form = axle_wheel(dice, radius)
    half = max(float(np.abs(piece[..., 0]).max()) for piece in form)
    rubber, metal = looks.rubber(dice), looks.metal(dice)
    level, turn = max(car.sill + 0.03, radius * 0.9), dice.between(0.22, 0.4)
    for row, y in enumerate(places):
        steers = steer and row == 0
        # Those that steer stand off as far as they swing in.
        out = car.wide / 2 + (radius * float(np.sin(turn)) if steers else 0.0)
        whole.dress(0, surface([lying(0.03, 2 * out + 0.02, X, 8) + [0, y, level]], metal))
        for name, s in (("left", -1), ("right", 1)):
            spot = np.array([s * (out + half + 0.015), y, level])
            label = f"{name}_{('front', 'rear', 'last', 'fourth')[row]}"
            parent = 0
            if steers:
                knuckle = surface([box((0.06, 0.06, 0.16), spot - [s * (half + 0.02), 0, 0])], metal)
                pin = spot - [s * (half + 0.02), 0, 0]
                parent = whole.add(
                    "steering knuckle", hinge(pin, UP, turn, -turn), knuckle, name=f"{label}_knuckle"
                )
            disc = lying(0.55 * radius, 2 * half + 0.006, X, 14) + spot
            whole.add(
                "wheel",
                spin(spot, RIGHT),
                surface(moved(form, spot), rubber),
                surface([disc], metal),
                parent=parent,
                name=f"{label}_wheel",
            )


def steering(whole: Rig, at: FloatArray, look: Look, size: float = 0.18) -> None:
    """A steering wheel on a sloping column, which faces back."""
    lean = rotation(RIGHT, -1.0)
    ring = [
        torus(size, 0.015, 16),
        *[rod((0, 0, 0), (size * np.cos(a), size * np.sin(a), 0), 0.012) for a in (0, 2.1, 4.2)],
    ]
    column = rod((0, 0, 0), (0, 0, -0.25), 0.02)
    whole.add("steering wheel", spin(at, lean @ UP), surface(moved(turned([*ring, column], lean), at), look))
