"""Arms that turn about one pin beside each other, their grips, and opening them like a fan."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, at, moved, pointed, rotation
from ...shapes.primitives import Pieces, rod
from . import looks
from .assembling import Assembly, Parts
from .objects import Body, GeneratedObject, Look, hinge
from .posing import posed
from .rigging import UP, ball_knob, lying, ribbon

UPRIGHT, FLAT = np.eye(3), rotation((0, 1, 0), np.pi / 2)
"""Turns of a whole tool: none, and from upright to lying on its side."""


@dataclass(frozen=True)
class Pin:
    """A pin along x, which bodies share: each has an eye at either side, number 0 the outermost two.

    Attributes:
        spot: (3,) its middle.
        half: how far off the middle the eyes of number 0 are.
        thick, radius: of an eye.
    """

    spot: FloatArray
    half: float
    thick: float
    radius: float

    def x(self, number: int) -> float:
        """How far off the middle the eyes of a number are."""
        return self.half - 1.2 * self.thick * number

    def bars(self, number: int, path: ArrayLike, high: float) -> Pieces:
        """Eyes, and bars from them along points of y and z counted from the pin."""
        eye = np.concatenate([flat_bar(path, high, self.thick), lying(self.radius, self.thick)])
        return moved(at(eye, two_places(self.x(number))), self.spot)

    def shaft(self) -> Pieces:
        """The pin with its heads."""
        end = self.half + 0.7 * self.thick
        heads = at(lying(0.75 * self.radius, 0.4 * self.thick), two_places(end))
        return moved([lying(0.4 * self.radius, 2 * end), *heads], self.spot)

    def hang(self, kit: Assembly, label: str, upper: float, parts: Parts, sense: int = -1) -> int:
        """Adds a body that turns about it, up at -y, or at y where `sense` is 1; gives its number."""
        return kit.add(label, hinge(self.spot, (sense, 0, 0), upper), parts)


def two_places(x: float, y: float = 0.0, z: float = 0.0) -> list[tuple[float, float, float]]:
    """Places at either side: at -x and at x."""
    return [(-x, y, z), (x, y, z)]


def flat_bar(path: ArrayLike, high: ArrayLike, wide: float, x: float = 0.0) -> FloatArray:
    """A flat bar along points of y and z, upright, its middle at an x."""
    return pointed(ribbon(path, high, wide, -wide / 2), X) + [x, 0, 0]


def opened(dice: Dice, kit: Assembly, fan: Sequence[int] = (), turn: FloatArray = UPRIGHT) -> list[Body]:
    """The bodies, turned by `turn`, some also a little about z, and in about half a fan of them opened.

    A fan is given by number from the lowest; opened, each is farther than the one below, which stops it.
    """
    bodies = kit.done(rotation(UP, dice.between(-0.7, 0.7) if dice.chance(0.35) else 0.0) @ turn)
    if dice.chance(0.45):
        return bodies
    ends, spots = [0.0, *np.cumsum(0.2 + 0.3 * dice.units(len(fan))).tolist(), 9.0], [0.0] * len(bodies)
    for k, number in enumerate(fan):
        motion = bodies[number].motion
        assert motion is not None
        stops = replace(motion, lower=ends[k], upper=min(motion.upper, ends[k + 2]))
        bodies[number], spots[number] = replace(bodies[number], motion=stops), ends[k + 1]
    return list(posed(GeneratedObject("", tuple(bodies)), spots).bodies)


def gripped_bar(
    dice: Dice, start: ArrayLike, end: ArrayLike, high: float, tall: float
) -> tuple[Pieces, Pieces]:
    """A bar between two points of y and z, and the grip on it, if any.

    Args:
        dice: for its shape.
        start: the bar's first point.
        end: its last, where the grip is.
        high: of the bar.
        tall: height of the grip.
    """
    a, b, wide = np.append(0.0, start), np.append(0.0, end), dice.between(1.0, 2.2) * high
    neck, style = a + dice.between(0.35, 0.6) * (b - a), dice.unit()
    path = [neck[1:], (neck + b)[1:] / 2, b[1:]]
    grip: Pieces = [flat_bar(path, tall * np.array([0.8, 1, 0.9]), 1.4 * wide)]
    if 0.35 < style < 0.6:
        grip = [rod(neck, b, tall / 2, 10)]
    elif 0.6 < style < 0.75:
        step = b - neck
        grip = [rod(neck + u * step, neck + (u + 0.2) * step, tall / 2, 10) for u in (0, 0.27, 0.54)]
    elif style > 0.75:
        grip = [ball_knob(tall * 0.6) + b] if style < 0.88 else []
    return [flat_bar([a[1:], (a + b)[1:] / 2, b[1:]], high * np.array([1.0, 0.8, 1.0]), wide)], grip


def arm_looks(dice: Dice) -> tuple[Look, Look]:
    """Looks of arms, and of their grips."""
    arms = dice.pick((looks.metal, looks.metal, looks.painted_metal, looks.plastic))(dice)
    return arms, dice.pick((looks.rubber, looks.plastic, looks.wood))(dice)
