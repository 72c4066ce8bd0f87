"""Wheels and casters that things stand on."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...shapes.dice import Dice
from ...shapes.placing import moved, pointed
from ...shapes.primitives import box, boxes, cylinder
from . import looks
from .assembly import Leaf
from .objects import spin, surface


def wheel_leaf(dice: Dice, radius: float, place: Sequence[float], name: str = "wheel") -> Leaf:
    """A wheel about an axis along x through a place."""
    wide = radius * dice.between(0.4, 0.9)
    tyre = pointed(cylinder(radius, wide, 16), 0)
    hub = pointed(cylinder(radius * 0.5, wide * 1.1, 12), 0)
    surfaces = (
        surface(moved([tyre], place), looks.rubber(dice)),
        surface(moved([hub], place), looks.metal(dice)),
    )
    return Leaf(name, "wheel", surfaces, spin(place, (1, 0, 0)))


def caster(dice: Dice, radius: float, top: Sequence[float], swivels: bool, name: str) -> Leaf:
    """A wheel in a fork below a place; the fork turns, or the wheel hangs on what carries it."""
    trail = radius * dice.between(0.3, 0.6) if swivels else 0.0
    place = np.array(top) + [0, trail, -1.5 * radius]
    rolling = wheel_leaf(dice, radius, place.tolist(), f"{name}_wheel")
    if not swivels:
        return rolling
    thin = 0.15 * radius
    spots = [(s * 0.62 * radius, trail, -0.75 * radius) for s in (-1, 1)]
    cheeks = boxes((thin, radius, 1.5 * radius), spots)
    plate = box((1.4 * radius, radius + trail, thin), (0, trail / 2, -thin / 2))
    stem = cylinder(0.2 * radius, 0.35 * radius, 8) - [0, 0, 0.17 * radius]
    fork = surface(moved([cheeks, plate, stem], top), looks.metal(dice))
    return Leaf(f"{name}_caster", "caster", (fork,), spin(top, (0, 0, 1)), (rolling,))
