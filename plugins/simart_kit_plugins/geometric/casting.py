"""Rays through a scene that pass through some of its pieces."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

from .scene import Box, Scene

_MOST = 16  # pieces on a ray's way that are passed through
_BEYOND = 1e-4  # a ray goes on so far behind what it passes through


def first_met(
    scene: Scene, origins: FloatArray, direction: FloatArray, passing: Sequence[int] | IntArray = ()
) -> tuple[IntArray, FloatArray]:
    """(N,) piece that each ray meets first, -1 for none, and (N,) how far it is, infinite for none.

    Args:
        scene: the pieces.
        origins: (N, 3) in the aligned frame.
        direction: (3,) unit.
        passing: pieces that rays pass through.
    """
    origins = origins.copy()
    labels, total = np.full(len(origins), -1), np.zeros(len(origins))
    going = np.arange(len(origins))
    for _ in range(_MOST):
        faces, distance = scene.rays.first(origins[going], direction)
        piece = np.where(faces >= 0, scene.labels[faces], -1)
        total[going] += distance
        labels[going] = piece
        again = np.isin(piece, passing) & (piece >= 0)
        if not again.any():
            break
        going = going[again]
        origins[going] += distance[again, None] * direction
        labels[going] = _lying_there(scene, origins[going], direction, passing)
        going = going[labels[going] < 0]
        total[going] += _BEYOND
        origins[going] += _BEYOND * direction
    return labels, total


def _lying_there(
    scene: Scene, points: FloatArray, direction: FloatArray, passing: Sequence[int] | IntArray
) -> IntArray:
    """(N,) piece with a face where one is passed through, as boards that lie on each other have; else -1."""
    labels = np.full(len(points), -1)
    lower, upper = scene.bounds[:, 0] - _BEYOND, scene.bounds[:, 1] + _BEYOND
    near = ((points.min(axis=0) <= upper) & (points.max(axis=0) >= lower)).all(axis=1)
    near[np.asarray(passing, dtype=np.intp)] = False
    for piece in np.flatnonzero(near):
        there = ((points >= lower[piece]) & (points <= upper[piece])).all(axis=1) & (labels < 0)
        if there.any():
            _, distance = scene.rays_of(int(piece)).first(points[there] - _BEYOND * direction, direction)
            labels[np.flatnonzero(there)[distance <= 2 * _BEYOND]] = piece
    return labels


def cast(
    scene: Scene, axes: FloatArray, origins: FloatArray, direction: FloatArray, passing: tuple[int, ...] = ()
) -> tuple[IntArray, FloatArray]:
    """As `first_met`, for rays given in (u, v, w)."""
    return first_met(scene, origins @ axes, direction @ axes, passing)


def grid(box: Box, count: int, shrink: float) -> FloatArray:
    """(count^2, 2) points of a rectangle (u, v)."""
    steps = (np.arange(count) + 0.5) / count * 2 - 1
    u, v = np.meshgrid(steps, steps)
    return box.center[:2] + 0.5 * shrink * box.size[:2] * np.column_stack([u.ravel(), v.ravel()])
