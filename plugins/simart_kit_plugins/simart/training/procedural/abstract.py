"""Compositions of curved, thin and turned solids: odd local geometry, as little like furniture as may be."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from ....shapes.dice import Dice
from ....shapes.outlines import ngon, rounded
from ....shapes.placing import mirrored, rotation
from ....shapes.primitives import Pieces, box, loft, prism, revolve, sheet, superquadric, torus, tube
from ....shapes.walls import hollow, smooth_wall


def composition(dice: Dice) -> list[Pieces]:
    """One to five parts, each a heap of solids, a mirror pair or a row."""
    return [_heap(dice) for _ in range(dice.whole(1, 5))]


def _heap(dice: Dice) -> Pieces:
    center = 0.22 * dice.normals(3)
    pieces = [solid(dice) + center + 0.12 * dice.normals(3) for _ in range(dice.whole(1, 3))]
    if dice.chance(0.25):
        pieces += mirrored(pieces)
    if dice.chance(0.15):
        one, step = 0.4 * solid(dice), 0.2 * dice.normals(3)
        pieces += [one + center + k * step for k in range(dice.whole(2, 6))]
    return pieces


def solid(dice: Dice) -> FloatArray:
    """A solid or sheet about 0, two thirds of them turned."""
    make = dice.pick((_block, _block, _slab, _turned, _quadric, _prism, _wire, _ring, _cloth, _shell))
    size = (0.1 + 0.9 * dice.units(3)) * dice.spread(0.2, 1.0)
    if dice.chance(0.4):
        size[dice.whole(0, 2)] *= dice.between(0.03, 0.3)
    return np.asarray(make(dice, size) @ random_turn(dice).T)


def random_turn(dice: Dice) -> FloatArray:
    """(3, 3) no turn, one about an axis, or any."""
    style, angle = dice.unit(), dice.between(0, 2 * np.pi)
    if style < 0.35:
        return np.eye(3)
    if style < 0.65:
        return rotation(np.eye(3)[dice.whole(0, 2)], angle)
    return rotation(dice.normals(3), angle)


def _block(dice: Dice, size: FloatArray) -> FloatArray:
    return box(size)


def _slab(dice: Dice, size: FloatArray) -> FloatArray:
    return prism(rounded(dice.between(0.05, 0.45)), size)


def _turned(dice: Dice, size: FloatArray) -> FloatArray:
    wall = smooth_wall(dice, dice.whole(3, 8), 0.2) * size[[0, 2]]
    return revolve(hollow(wall, 0.1 * size[0]) if dice.chance(0.5) else wall, dice.whole(6, 20))


def _quadric(dice: Dice, size: FloatArray) -> FloatArray:
    return superquadric(size, dice.between(0.1, 1.6), dice.between(0.1, 1.6), 10)


def _prism(dice: Dice, size: FloatArray) -> FloatArray:
    """A prism, cone or twisted column."""
    low, high = dice.between(0.2, 1.0), dice.between(0.0, 1.0)
    x, y, z = size.tolist()
    stages = [(0, 0, -z), (x * low, y * low, -z), (x * high, y * high, z), (0, 0, z)]
    return loft(ngon(dice.whole(3, 9)), stages)


def _wire(dice: Dice, size: FloatArray) -> FloatArray:
    """A bent or smooth tube, which may taper."""
    knots = np.cumsum(0.3 * dice.normals(dice.whole(2, 5), 3), axis=0)
    knots -= knots.mean(axis=0)
    if dice.chance(0.5):
        at = np.linspace(0, len(knots) - 1, 16)
        path = np.stack([np.interp(at, np.arange(len(knots)), line) for line in knots.T], axis=1)
        padded = np.pad(path, ((2, 2), (0, 0)), mode="edge")
        knots = np.stack([np.convolve(line, np.full(5, 0.2), mode="valid") for line in padded.T], axis=1)
    radius = dice.spread(0.008, 0.1)
    taper = np.linspace(1.0, dice.pick((1.0, 1.0, 0.3)), len(knots))
    return tube(knots, radius * taper, dice.whole(4, 10))


def _ring(dice: Dice, size: FloatArray) -> FloatArray:
    whole = torus(size[0], dice.between(0.03, 0.3) * size[0], 24, dice.between(0.05, 0.6) * size[0])
    return whole if dice.chance(0.7) else whole[: len(whole) * dice.whole(1, 7) // 8]


def _cloth(dice: Dice, size: FloatArray) -> FloatArray:
    """A wavy sheet, single or double."""
    x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9), indexing="ij")
    phase = 6 * dice.units(2)
    z = dice.between(0.05, 0.3) * (np.sin(2.5 * x + phase[0]) + np.sin(dice.between(1, 4) * y + phase[1]))
    points = 0.5 * np.stack([x, y, z], axis=-1) * size
    if dice.chance(0.5):
        return sheet(points)
    return np.concatenate([sheet(points), sheet(points + [0, 0, dice.between(0.02, 0.1)])])


def _shell(dice: Dice, size: FloatArray) -> FloatArray:
    """Part of a hollow box or cylinder, its wall thin."""
    x, y, z = size.tolist()
    outline = rounded(dice.between(0.02, 0.5))
    wall = dice.between(0.85, 0.97)
    return loft(
        outline,
        [
            (0, 0, 0),
            (x, y, 0),
            (x, y, z),
            (x * wall, y * wall, z),
            (x * wall, y * wall, z * 0.1),
            (0, 0, z * 0.1),
        ],
    )
