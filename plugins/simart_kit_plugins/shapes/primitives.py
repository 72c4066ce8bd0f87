"""Surfaces as (F, 3, 3) triangles: boxes, lofts, tubes and sheets. Up is +Z; lengths have no unit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray, units

from .outlines import SQUARE, ngon

Pieces = list[FloatArray]
"""Surfaces that move as one."""

Stage = tuple[float, float, float]
"""Width along x and y, and height, of one section of a loft."""


def sheet(points: FloatArray) -> FloatArray:
    """(2 (M - 1) (N - 1), 3, 3) triangles between neighbours of (M, N, 3) points."""
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
    return np.stack([a, c, b, a, d, c], axis=-2).reshape(-1, 3, 3)


_HALVES = np.array([[[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5]], [[-0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]])
_UNIT_BOX = np.concatenate(
    [
        np.insert(_HALVES[:, :: 1 if (side > 0) != (axis == 1) else -1], axis, side, axis=2)
        for axis in range(3)
        for side in (-0.5, 0.5)
    ]
)


def box(size: ArrayLike, center: ArrayLike = (0.0, 0.0, 0.0)) -> FloatArray:
    """Box with edges along the axes."""
    return _UNIT_BOX * np.asarray(size, dtype=np.float64) + np.asarray(center, dtype=np.float64)


def boxes(sizes: ArrayLike, centers: ArrayLike) -> FloatArray:
    """Boxes of sizes (3,) or (N, 3) about (N, 3) centers, as one surface."""
    middles = np.asarray(centers, dtype=np.float64)[:, None, None]
    edges = np.asarray(sizes, dtype=np.float64).reshape(-1, 1, 1, 3)
    return np.asarray(_UNIT_BOX * edges + middles).reshape(-1, 3, 3)


def between(low: ArrayLike, high: ArrayLike) -> FloatArray:
    """Box between two opposite corners."""
    lower, upper = np.asarray(low, dtype=np.float64), np.asarray(high, dtype=np.float64)
    return box(upper - lower, (lower + upper) / 2)


def loft(outline: FloatArray, stages: Sequence[Stage] | FloatArray) -> FloatArray:
    """Skin through copies of an outline, from the first to the last stage.

    Args:
        outline: (K, 2) corners of a closed polygon about 0, as wide as 1.
        stages: (M, 3) width along x, width along y, height of each copy.
    """
    steps = np.asarray(stages, dtype=np.float64)
    ring = np.concatenate([outline, outline[:1]])
    points = np.zeros((len(steps), len(ring), 3))
    points[..., :2] = ring * steps[:, None, :2]
    points[..., 2] = steps[:, 2:]
    return sheet(points)


def prism(outline: FloatArray, size: ArrayLike) -> FloatArray:
    """Closed prism of this size about 0, its outline across z."""
    if outline is SQUARE:
        return box(size)
    x, y, z = np.asarray(size, dtype=np.float64).tolist()
    return loft(outline, [(0, 0, -z / 2), (x, y, -z / 2), (x, y, z / 2), (0, 0, z / 2)])


def vessel(outline: FloatArray, size: ArrayLike, wall: float, flare: float = 1.0) -> FloatArray:
    """Open container that stands on z = 0, with an inner and an outer skin; `flare` widens its mouth."""
    x, y, z = np.asarray(size, dtype=np.float64).tolist()
    top_x, top_y = x * flare, y * flare
    skin = 2 * wall
    return loft(
        outline,
        [
            (0, 0, 0),
            (x, y, 0),
            (top_x, top_y, z),
            (max(top_x - skin, 0), max(top_y - skin, 0), z),
            (max(x - skin, 0), max(y - skin, 0), min(wall, z)),
            (0, 0, min(wall, z)),
        ],
    )


def open_box(size: ArrayLike, wall: float) -> FloatArray:
    """Vessel with flat sides, all of rectangles."""
    x, y, z = np.asarray(size, dtype=np.float64).tolist()
    wall = min(wall, 0.45 * x, 0.45 * y, 0.9 * z)
    inside = np.array([x - 2 * wall, y - 2 * wall, z - wall])
    outer = _UNIT_BOX[:10] * [x, y, z] + [0, 0, z / 2]
    inner = _UNIT_BOX[:10, ::-1] * inside + [0, 0, (z + wall) / 2]
    level = _UNIT_BOX[10:] * [1, 1, 0]
    rims = [level * [x, wall, 1] + [0, s * (y - wall) / 2, z] for s in (-1, 1)]
    rims += [level * [wall, inside[1], 1] + [s * (x - wall) / 2, 0, z] for s in (-1, 1)]
    return np.concatenate([outer, inner, *rims])


def revolve(profile: ArrayLike, sides: int = 16) -> FloatArray:
    """Surface of revolution about z of a (K, 2) profile of radius and height."""
    line = np.asarray(profile, dtype=np.float64)
    return loft(ngon(sides), np.column_stack([2 * line[:, 0], 2 * line[:, 0], line[:, 1]]))


def cylinder(radius: float, height: float, sides: int = 12) -> FloatArray:
    """Closed cylinder about z, its middle at 0."""
    return prism(ngon(sides), (2 * radius, 2 * radius, height))


def torus(ring: float, thickness: float, sides: int = 20, height: float | None = None) -> FloatArray:
    """Ring about z of radius `ring`; `thickness` and `height` are the half axes of its section."""
    angle = np.linspace(0, 2 * np.pi, 9)
    rise = thickness if height is None else height
    return revolve(np.column_stack([ring + thickness * np.cos(angle), rise * np.sin(angle)]), sides)


def superquadric(size: ArrayLike, polar: float = 1.0, around: float = 1.0, rows: int = 8) -> FloatArray:
    """Box (exponents near 0), ellipsoid (1) or octahedron (2) of this size about 0."""
    up = np.linspace(-np.pi / 2, np.pi / 2, rows + 1)
    turn = np.linspace(0, 2 * np.pi, 2 * rows, endpoint=False)
    outline = 0.5 * np.column_stack([_power(np.cos(turn), around), _power(np.sin(turn), around)])
    x, y, z = np.asarray(size, dtype=np.float64).tolist()
    width = _power(np.cos(up), polar)
    return loft(outline, np.column_stack([x * width, y * width, z / 2 * _power(np.sin(up), polar)]))


def tube(path: ArrayLike, radius: float | FloatArray, sides: int = 6) -> FloatArray:
    """Closed tube along (K, 3) points; one radius, or (K,) of them."""
    line = np.asarray(path, dtype=np.float64)
    along = units(np.gradient(line, axis=0), otherwise=(0.0, 0.0, 1.0))
    reference = np.eye(3)[np.abs(along).mean(axis=0).argmin()]
    across = units(np.cross(along, reference), otherwise=(1.0, 0.0, 0.0))
    other = np.cross(along, across)
    section = 2 * np.concatenate([ngon(sides), ngon(sides)[:1]])
    width = np.broadcast_to(radius, len(line))[:, None, None]
    skin = section[None, :, :1] * across[:, None] + section[None, :, 1:] * other[:, None]
    rings = line[:, None] + width * skin
    ends = [np.broadcast_to(line[end], (1, *rings.shape[1:])) for end in (0, -1)]
    return sheet(np.concatenate([ends[0], rings, ends[1]]))


def rod(start: ArrayLike, end: ArrayLike, radius: float, sides: int = 6) -> FloatArray:
    """Straight tube."""
    return tube(np.array([start, end], dtype=np.float64), radius, sides)


def _power(values: FloatArray, exponent: float) -> FloatArray:
    return np.asarray(np.sign(values) * np.abs(values) ** exponent)
