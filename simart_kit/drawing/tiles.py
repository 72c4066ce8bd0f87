"""Averages over small tiles of a picture that do not mix one surface with another."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, Float32Array, IntArray

TILE = 4
"""Side of a tile [pixels]; averages reach as far."""

Window = tuple[slice, slice]


def tile_means(
    values: Float32Array,
    pixel: IntArray,
    normal: Float32Array,
    position: Float32Array,
    width: int,
    tolerance: float,
) -> Float32Array:
    """Average the values of points over the tiles around their pixels, each along its own surface only.

    Args:
        values: (N, K) of points.
        pixel: (N,) index of the pixel of each, row by row.
        normal: (N, 3) unit.
        position: (N, 3) [m].
        width: of the picture [pixels].
        tolerance: how far from a pixel's plane its neighbours may lie [m].

    Returns:
        (N, K).
    """
    if not len(pixel):
        return values
    pixel, shape = _cropped(pixel, width)
    count = shape[0] * shape[1]
    points = np.bincount(pixel, minlength=count)

    def plane(column: Float32Array) -> Float32Array:
        mean = np.bincount(pixel, column, count) / np.maximum(points, 1)
        return mean.astype(np.float32).reshape(shape)

    normals, positions = [plane(c) for c in normal.T], [plane(c) for c in position.T]
    surfaces = _Surfaces(normals, positions, (points > 0).reshape(shape), tolerance)
    means = [plane(c) for c in values.T]
    for sign in (1, -1):  # twice, to either side: the window is not symmetric, and one pass leaves steps
        means = _pass(means, surfaces, sign)
    return np.stack([m.ravel().take(pixel) for m in means], axis=1)


def _cropped(pixel: IntArray, width: int) -> tuple[IntArray, tuple[int, int]]:
    """The same pixels of a picture `width` wide in the part of it that has any, and the shape of that."""
    row, column = np.divmod(pixel, width)
    row, column = row - row.min(), column - column.min()
    shape = int(row.max()) + 1, int(column.max()) + 1
    return row * shape[1] + column, shape


@dataclass(frozen=True, eq=False)
class _Surfaces:
    """Mean normal and position (3 arrays each) and presence of a surface, a value a pixel."""

    normal: list[Float32Array]
    position: list[Float32Array]
    present: BoolArray
    tolerance: float

    def same(self, here: Window, there: Window) -> BoolArray:
        """Whether pixels show the same surface: near one plane, and facing alike."""
        own = [n[here] for n in self.normal]
        alike = _dot(own, [n[there] for n in self.normal])
        away = _dot(own, [p[here] - p[there] for p in self.position])
        close = np.abs(away, out=away) < self.tolerance
        return np.asarray(self.present[here] & self.present[there] & (alike > 0.9) & close)


def _dot(one: list[Float32Array], other: list[Float32Array]) -> Float32Array:
    """Sums of products of three arrays each."""
    total = one[0] * other[0]
    total += one[1] * other[1]
    total += one[2] * other[2]
    return total


def _pass(values: list[Float32Array], surfaces: _Surfaces, sign: int) -> list[Float32Array]:
    weight = surfaces.present.astype(np.float32)
    total = [v.copy() for v in values]
    for down, across in itertools.product(range(-(TILE // 2), TILE // 2), repeat=2):
        if (down, across) == (0, 0):
            continue
        here, there = _overlap(weight.shape, sign * down, sign * across)
        same = surfaces.same(here, there).astype(np.float32)  # once: each sum below would do it again
        weight[here] += same
        for value, sum_ in zip(values, total, strict=True):
            sum_[here] += value[there] * same
    np.maximum(weight, 1, out=weight)
    return [np.asarray(t / weight, dtype=np.float32) for t in total]


def _overlap(shape: tuple[int, ...], down: int, across: int) -> tuple[Window, Window]:
    """Slices of a picture, and of the same picture moved, that cover the same pixels."""

    def pair(size: int, step: int) -> tuple[slice, slice]:
        length, start = max(size - abs(step), 0), max(0, -step)
        return slice(start, start + length), slice(start + step, start + step + length)

    rows, columns = pair(shape[0], down), pair(shape[1], across)
    return (rows[0], columns[0]), (rows[1], columns[1])
