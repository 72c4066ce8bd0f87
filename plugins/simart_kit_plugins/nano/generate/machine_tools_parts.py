"""Pieces that machine tools share: hand wheels, star handles, chucks, collars and levers."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray

from ...shapes.dice import Dice
from ...shapes.placing import X, Y, around, moved, pointed, rotation, turned
from ...shapes.primitives import Pieces, box, cylinder, revolve, rod, torus
from .assembling import Assembly, disc
from .objects import Look, hinge
from .rigging import LEFT, RIGHT, ball_knob, lying

DARK = Look("plastic", (30, 30, 32))


def sleeve(inner: float, outer: float, high: float) -> FloatArray:
    """A round collar about z, from z = 0 up."""
    line = [[inner, 0], [outer, 0], [outer, high], [inner, high], [inner, 0]]
    return revolve(line, 20)


def sideways(pieces: Pieces, side: int) -> Pieces:
    """What faces -y, facing the right (1) or the left (-1)."""
    return turned(pieces, rotation((0, 0, side), np.pi / 2))


def handwheel(dice: Dice, radius: float) -> Pieces:
    """A wheel or a crank about y before y = 0, with a grip to turn it by."""
    thick, style = max(0.1 * radius, 0.004), dice.unit()
    pieces = [disc(0.25 * radius, 2.4 * thick)]
    if style < 0.35:
        pieces.append(box((1.1 * radius, thick, 0.22 * radius), (0.4 * radius, -1.9 * thick, 0)))
    elif style < 0.7:
        spokes = around([rod((0, 0, 0), (0.85 * radius, 0, 0), 0.07 * radius, 6)], dice.whole(3, 5))
        rim = torus(0.9 * radius, 0.1 * radius, 20)
        pieces += [pointed(piece, Y) - [0, 1.6 * thick, 0] for piece in [*spokes, rim]]
    else:
        pieces.append(disc(radius, 0.8 * thick, 20) - [0, 1.2 * thick, 0])
    if style < 0.7 or dice.chance(0.6):
        pieces.append(disc(0.11 * radius, dice.between(0.4, 0.8) * radius, 10) + [0.82 * radius, -thick, 0])
    return turned(pieces, rotation((0, 1, 0), dice.between(0, 6.28)))


def star(dice: Dice, radius: float) -> Pieces:
    """A hub about x, from x = 0 to the right, with arms that end in knobs."""
    count, lean = dice.pick((3, 3, 3, 2, 4, 1)), dice.between(0.0, 0.3) * radius
    pieces, start = [lying(0.17 * radius, 0.04) + [0.02, 0, 0]], dice.between(0, 6.28)
    tip = dice.between(0.07, 0.12) * radius
    for k in range(count):
        arm = [rod((0.025, 0, 0), (0.025 + lean, 0, radius), 0.045 * radius, 8)]
        arm.append(ball_knob(tip) + [0.025 + lean, 0, radius])
        pieces += turned(arm, rotation(RIGHT, start + 2 * np.pi * k / count))
    return pieces


def chuck(dice: Dice, radius: float, high: float) -> Pieces:
    """A drill chuck about z, from z = 0 down, mostly with a bit in it."""
    line = [[0, -1], [0.4, -1], [1, -0.6], [1, -0.25], [0.6, 0], [0, 0]]
    pieces = [revolve(np.array(line) * [radius, high], 16)]
    pieces += around([box((0.3 * radius, 0.2 * radius, 0.2 * high), (0.2 * radius, 0, -1.05 * high))], 3)
    pieces += around([pointed(cylinder(0.15 * radius, 0.2 * radius, 8), X) + [radius, 0, -0.42 * high]], 3)
    if dice.chance(0.6):
        pieces.append(rod((0, 0, -high), (0, 0, -1.7 * high), 0.12 * radius, 8))
    return pieces


def clamp_lever(kit: Assembly, pin: ArrayLike, reach: float, look: Look, to: int, stop: float = 1.2) -> None:
    """A lever on a bolt about x that holds what slides; it turns up at the front."""
    pieces = [lying(0.14 * reach, 0.02) + [0.01, 0, 0], rod((0.014, 0, 0), (0.022, -reach, 0), 0.06 * reach)]
    pieces.append(ball_knob(0.12 * reach) + [0.022, -reach, 0])
    kit.add("lever", hinge(pin, LEFT, stop, -0.3), [(moved(pieces, pin), look)], to)


def lobed_knob(radius: float, spot: ArrayLike) -> Pieces:
    """A lobed knob on top of a screw."""
    lobes = around([cylinder(0.4 * radius, 0.6 * radius, 8) + [0.8 * radius, 0, 0]], 5)
    return moved([cylinder(radius, 0.7 * radius, 14), *lobes], spot)
