"""Bounding boxes of points and of triangles, many times as fast as reducing along an axis of three."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, IntArray
from .topology import stable_order


def bounds_of(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Lower and upper corner (3,) of (N, 3) points, N > 0."""
    return np.array([c.min() for c in points.T]), np.array([c.max() for c in points.T])


def triangle_bounds(triangles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Lower and upper corners (F, 3) of each of the triangles (F, 3, 3)."""
    a, b, c = triangles.transpose(1, 0, 2)
    return np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)


def bounds_by(triangles: FloatArray, label: IntArray) -> FloatArray:
    """(L, 2, 3) lower and upper corner of the triangles (F, 3, 3) of each label; (F,) has each of 0..L-1."""
    order, ordered = stable_order(label.astype(np.int64))
    starts = np.flatnonzero(np.diff(ordered, prepend=-1))
    lower, upper = triangle_bounds(triangles)
    lowest = np.stack([np.minimum.reduceat(c.take(order), starts) for c in lower.T], axis=1)
    highest = np.stack([np.maximum.reduceat(c.take(order), starts) for c in upper.T], axis=1)
    return np.stack([lowest, highest], axis=1)


def box_corners(bounds: FloatArray) -> FloatArray:
    """(8, 3) corners of the box between the (2, 3) bounds."""
    x, y, z = np.asarray(bounds).T
    return np.stack(np.meshgrid(x, y, z), axis=-1).reshape(-1, 3)


def reaching(points: FloatArray, boxes: FloatArray) -> IntArray:
    """Indices of those of (M, K, 3) sets of points whose box shares space with one of (N, 2, 3) boxes."""
    lower, upper = points.min(axis=1)[:, None], points.max(axis=1)[:, None]
    return np.flatnonzero(((lower < boxes[:, 1]) & (boxes[:, 0] < upper)).all(axis=2).any(axis=1))


def sharing(box: FloatArray, boxes: FloatArray) -> IntArray:
    """Indices of the (N, 2, 3) boxes that share space with the (2, 3) box."""
    lower, upper = box
    return np.flatnonzero(((lower < boxes[:, 1]) & (boxes[:, 0] < upper)).all(axis=1))
