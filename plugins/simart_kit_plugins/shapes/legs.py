"""What things stand and roll on: legs, feet, wheels and casters."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from .dice import Dice
from .outlines import SQUARE
from .placing import Y, around, at, corners, moved, pointed
from .primitives import Pieces, box, boxes, cylinder, loft, revolve, rod, torus, tube


def leg(dice: Dice, height: float, thick: float) -> FloatArray:
    """A leg from z = 0 down to -height, straight, tapered, turned or splayed to -x."""
    style = dice.unit()
    foot = dice.between(0.4, 1.0) * thick
    if style < 0.4:
        return box((thick, thick, height), (0, 0, -height / 2))
    if style < 0.55:
        return loft(SQUARE, [(0, 0, 0), (thick, thick, 0), (foot, foot, -height), (0, 0, -height)])
    if style < 0.75:
        return revolve(np.array([[0, 0], [thick / 2, 0], [foot / 2, -height], [0, -height]]), 10)
    if style < 0.88:
        down = np.linspace(0, 1, 10)
        swell = 0.35 + 0.15 * np.sin(down * dice.between(6, 25) + dice.between(0, 6))
        return revolve(np.column_stack([thick * swell, -height * down]), 10)
    splay = dice.between(0.1, 0.3) * height
    return rod((0, 0, 0), (-splay, -splay, -height), thick / 2, 8)


def four(piece: FloatArray, width: float, depth: float) -> Pieces:
    """A piece at the corners of a rectangle, mirrored so that what points to -x, -y points outwards."""
    x, y = width / 2, depth / 2
    return [(piece + [-x, -y, 0]) * [sx, sy, 1] for sx in (-1, 1) for sy in (-1, 1)]


def feet(dice: Dice, width: float, depth: float, height: float) -> Pieces:
    """Legs or a pair of runners below z = 0, inside a rectangle."""
    thick = min(max(width, depth) * dice.between(0.025, 0.08), 0.4 * min(width, depth))
    if dice.chance(0.15):
        runner = boxes(
            (thick, depth, thick), [(s * (width - thick) / 2, 0, -height + thick / 2) for s in (-1, 1)]
        )
        return [runner, *four(box((thick, thick, height), (0, 0, -height / 2)), width - thick, depth - thick)]
    return four(leg(dice, height, thick), width - 1.2 * thick, depth - 1.2 * thick)


def wheel(dice: Dice, radius: float) -> Pieces:
    """A wheel about the y axis through 0."""
    wide = radius * dice.between(0.2, 0.9)
    style = dice.unit()
    if style < 0.45:
        hub = radius * dice.between(0.2, 0.8)
        tread = [[0, -wide * 0.3], [hub, -wide * 0.3], [hub, -wide / 2], [radius, -wide / 2]]
        profile = np.array(tread + [[r, -y] for r, y in reversed(tread)])
        return [pointed(revolve(profile, dice.whole(12, 20)), Y)]
    if style < 0.6:
        return [pointed(cylinder(radius, wide, dice.whole(10, 18)), Y)]
    thick = min(wide / 2, radius * 0.3)
    spoke = rod((0, 0, 0), (radius - thick, 0, 0), radius * 0.06, 4)
    pieces = [torus(radius - thick, thick, 18), cylinder(radius * 0.2, wide, 10)]
    return [pointed(piece, Y) for piece in pieces + around([spoke], dice.whole(3, 8))]


def caster(dice: Dice, radius: float) -> Pieces:
    """A wheel below a fork, from z = 0 down."""
    fork = radius * dice.between(0.15, 0.3)
    sides = boxes((radius, fork, 1.4 * radius), [(0, s * 0.6 * radius, -0.8 * radius) for s in (-1, 1)])
    top = box((radius, 1.2 * radius + fork, fork), (0, 0, -fork / 2))
    return [sides, top, *moved(wheel(dice, radius), (radius * 0.3, 0, -1.5 * radius))]


def star_base(dice: Dice, reach: float, height: float) -> Pieces:
    """Arms in a star about z, from z = 0 down, on casters or bare."""
    count, thick = dice.whole(3, 6), reach * dice.between(0.06, 0.14)
    path = [(0, 0, 0), (0.5 * reach, 0, -0.4 * height), (reach, 0, -height + thick)]
    arm = [tube(path, thick * np.array([1.0, 0.8, 0.5]))]
    if dice.chance(0.6):
        arm += moved(wheel(dice, reach * 0.14), (reach, 0, -height))
    return around(arm, count, dice.between(0, 1))


def wheels(dice: Dice, width: float, depth: float, radius: float) -> Pieces:
    """Four wheels or casters below z = 0."""
    if dice.chance(0.5):
        return [piece for part in caster(dice, radius) for piece in at(part, corners(width, depth))]
    spots = corners(width, depth, -radius)
    return [piece for part in wheel(dice, radius) for piece in at(part, spots)]
