"""Handles: along x, fixed to the plane y = 0, standing off towards -y."""

from __future__ import annotations

import numpy as np

from .dice import Dice
from .outlines import half_round
from .placing import Y, Z, at, moved, pointed, rotation, turned
from .primitives import Pieces, between, box, boxes, cylinder, prism, revolve, rod, superquadric, torus, tube


def handle(dice: Dice, length: float, upright: bool = False) -> Pieces:
    """A handle of about this length, along z when `upright`."""
    make = dice.weighted(
        [(5, _bar), (3, _round_bar), (3, _bow), (5, _knob), (2, _strip), (2, _cup), (1, _block), (1, _drop)]
    )
    pieces = make(dice, length)
    return turned(pieces, rotation((0, 1, 0), np.pi / 2)) if upright else pieces


def knob(dice: Dice, radius: float) -> Pieces:
    """A round knob or dial."""
    height = radius * dice.between(0.6, 1.8)
    neck, mouth = dice.between(0.35, 0.9), dice.between(0.5, 1.1)
    profile = np.array([[0, 0], [neck, 0], [neck, 0.4], [1, 0.6], [mouth, 1], [0, 1]]) * [radius, height]
    pieces = [pointed(revolve(profile, dice.whole(8, 16)), Y) * [1, -1, 1]]
    if dice.chance(0.3):
        grip = (2 * radius, height * 0.4, radius * 0.35)
        pieces += turned([box(grip, (0, -height, 0))], rotation((0, 1, 0), dice.between(0, np.pi)))
    return pieces


def _bar(dice: Dice, length: float) -> Pieces:
    thick, off = length * dice.between(0.04, 0.12), length * dice.between(0.1, 0.3)
    reach = length / 2 - thick * dice.pick((0.5, 0.5, 2.0))
    grip = box((length, thick * dice.pick((0.5, 1.0, 1.0)), thick), (0, -off, 0))
    return [grip, boxes((thick, off, thick), [(-reach, -off / 2, 0), (reach, -off / 2, 0)])]


def _round_bar(dice: Dice, length: float) -> Pieces:
    radius, off = length * dice.between(0.025, 0.06), length * dice.between(0.1, 0.25)
    reach = length * dice.between(0.3, 0.48)
    grip = rod((-length / 2, -off, 0), (length / 2, -off, 0), radius, 8)
    return [grip, *at(rod((0, 0, 0), (0, -off, 0), radius * 0.8), [(-reach, 0, 0), (reach, 0, 0)])]


def _bow(dice: Dice, length: float) -> Pieces:
    along = np.linspace(-1, 1, 9)
    off = length * dice.between(0.12, 0.3) * (1 - np.abs(along) ** dice.between(2, 8))
    return [tube(np.column_stack([along * length / 2, -off, 0 * along]), length * dice.between(0.03, 0.07))]


def _knob(dice: Dice, length: float) -> Pieces:
    return knob(dice, length * dice.between(0.1, 0.22))


def _strip(dice: Dice, length: float) -> Pieces:
    """An edge pull: an angle of sheet metal over the edge."""
    off, high = length * dice.between(0.08, 0.2), length * dice.between(0.08, 0.2)
    thick = length * 0.02
    top = between((-length / 2, -off, high - thick), (length / 2, 0, high))
    return [top, between((-length / 2, -off, high / 2), (length / 2, thick - off, high))]


def _cup(dice: Dice, length: float) -> Pieces:
    """A cup pull, open below."""
    size = np.array([length * 0.6, length * dice.between(0.2, 0.35), length * dice.between(0.15, 0.3)])
    return moved([prism(half_round(), size) * [1, -1, 1]], (0, -size[1] / 2, 0))


def _block(dice: Dice, length: float) -> Pieces:
    off, high = length * dice.between(0.1, 0.3), length * dice.between(0.08, 0.3)
    if dice.chance(0.5):
        return [box((length * 0.8, off, high), (0, -off / 2, 0))]
    return [superquadric((length * 0.6, off, high), 0.4, 0.4, 6) - [0, off / 2, 0]]


def _drop(dice: Dice, length: float) -> Pieces:
    """A ring that hangs from a plate."""
    ring, thick = length * dice.between(0.15, 0.25), length * 0.035
    plate = pointed(cylinder(ring * 0.5, thick, 10), Y)
    hoop = pointed(torus(ring, thick, 16), Y) + [0, -2 * thick, -ring]
    if dice.chance(0.5):
        return [plate, hoop]
    return [pointed(cylinder(ring * 0.5, thick * 2, 10), Y), pointed(cylinder(thick, ring * 3, 6), Z)]
