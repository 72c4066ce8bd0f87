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
        labels[going[again]] = -1
        total[going[again]] += _BEYOND
        going = going[again]
        origins[going] += (distance[again] + _BEYOND)[:, None] * direction
    return labels, total


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
