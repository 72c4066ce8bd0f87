"""Pieces with a floor and walls all around that are open above, and what stands around them."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

from .casting import first_met, grid
from .scene import Scene

_DEEP = 0.12  # a tub is at least this deep, as a share of its width
_ALL = 0.95  # share of rays within a tub that meet its walls and its floor
_BELOW = 0.15  # of its depth, how far below its rim the walls are felt for
_BESIDE = 0.05  # of the object's diagonal: what stands nearer to a tub encloses it
_SIDES = np.array([[1.0, 0, 0], [-1.0, 0, 0], [0, 1.0, 0], [0, -1.0, 0]])


def is_tub(scene: Scene, piece: int) -> bool:
    """Whether a piece has a floor and walls all around, and is open above."""
    box = scene.boxes[piece]
    others = [i for i in range(scene.count) if i != piece]
    level = box.upper[2] - _BELOW * box.size[2]
    starts = np.column_stack([points := grid(box, 6, 0.7), np.full(len(points), level)])

    def met(way: FloatArray) -> tuple[FloatArray, FloatArray]:
        labels, far = first_met(scene, starts, way, others)
        return np.asarray(labels >= 0, dtype=np.float64), far

    if np.mean([met(way)[0] for way in _SIDES]) < _ALL or met(np.array([0, 0, 1.0]))[0].mean() > 1 - _ALL:
        return False
    floor, depth = met(np.array([0, 0, -1.0]))
    return bool(floor.mean() > _ALL and np.median(depth) > _DEEP * box.size[:2].min())


def enclosing(scene: Scene, piece: int) -> list[tuple[float, ...]]:
    """Ways to the sides in which something stands close along a tub."""
    box, found = scene.boxes[piece], list[tuple[float, ...]]()
    for way in _SIDES:
        axis = int(np.abs(way).argmax())
        starts = np.tile(box.center, (9, 1))
        starts[:, 1 - axis] += np.linspace(-0.4, 0.4, 9) * box.size[1 - axis]
        starts[:, axis] = box.upper[axis] if way[axis] > 0 else box.lower[axis]
        if (first_met(scene, starts, way, [piece])[1] < _BESIDE).mean() > 0.5:
            found.append(tuple(way.tolist()))
    return found
