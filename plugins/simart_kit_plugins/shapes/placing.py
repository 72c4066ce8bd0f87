"""Moving, turning and copying of surfaces."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray, unit
from simart_kit.kinematics import rotation as by_vector

from .primitives import Pieces

X, Y, Z = 0, 1, 2


def rotation(axis: ArrayLike, angle: float) -> FloatArray:
    """(3, 3) turn by an angle [rad] about an axis through 0, right-handed."""
    matrix = by_vector(angle * unit(np.asarray(axis, dtype=np.float64)))
    # Quarter turns keep faces exactly along the axes.
    return np.round(matrix, 15)


def moved(pieces: Iterable[FloatArray], offset: ArrayLike) -> Pieces:
    """Shifted by (3,)."""
    step = np.asarray(offset, dtype=np.float64)
    return [piece + step for piece in pieces]


def turned(pieces: Iterable[FloatArray], matrix: FloatArray, about: ArrayLike = (0.0, 0.0, 0.0)) -> Pieces:
    """Multiplied by a (3, 3) matrix about a point."""
    center = np.asarray(about, dtype=np.float64)
    return [(piece - center) @ matrix.T + center for piece in pieces]


def pointed(piece: FloatArray, axis: int) -> FloatArray:
    """With what ran along +z along +x, +y or +z instead; the other axes follow in their cycle."""
    return np.roll(piece, axis + 1, axis=-1)


def mirrored(pieces: Iterable[FloatArray], axis: int = X) -> Pieces:
    """Reflected at the plane through 0 across an axis."""
    flip = np.ones(3)
    flip[axis] = -1
    return [piece * flip for piece in pieces]


def at(piece: FloatArray, places: ArrayLike) -> Pieces:
    """A copy at each of (N, 3) places."""
    points = np.asarray(places, dtype=np.float64)
    return [np.asarray(piece + points[:, None, None]).reshape(-1, 3, 3)]


def around(pieces: Iterable[FloatArray], count: int, start: float = 0.0) -> Pieces:
    """`count` copies, evenly turned about z, the first by `start` [rad]."""
    kept = list(pieces)
    turns = (rotation((0, 0, 1), start + k * 2 * np.pi / count) for k in range(count))
    return [piece for matrix in turns for piece in turned(kept, matrix)]


def corners(width: float, depth: float, height: float = 0.0) -> FloatArray:
    """(4, 3) corners of a level rectangle about the z axis."""
    return np.array([[x * width / 2, y * depth / 2, height] for x in (-1, 1) for y in (-1, 1)])
