"""Moving bodies that share no corner with others: whoever joins equal corners would weld the two together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray

from .objects import Body

# What shares a corner is made smaller by this share, about a place in its box where hardly anything has one.
_HAIR, _PLACE = 0.002, (0.57, 0.61, 0.53)
# Corners nearer than this are one [m].
_SAME = 1e-7


def apart(made: Sequence[Body]) -> list[Body]:
    """The bodies, each that shares a corner with one before it a hair smaller, on z = 0 again."""
    taken, bodies = set[tuple[int, ...]](), []
    for number, body in enumerate(made):
        own = _corners(body.triangles)
        if number and not taken.isdisjoint(own):
            points = body.triangles.reshape(-1, 3)
            still = points.min(axis=0) + _PLACE * np.ptp(points, axis=0)
            smaller = body.placed((1 - _HAIR) * np.eye(3), _HAIR * still)
            body = Body(body.name, body.label, smaller.surfaces, body.parent, body.motion)
            own = _corners(body.triangles)
        taken |= own
        bodies.append(body)
    level = np.array([0.0, 0.0, -min(float(body.triangles[..., 2].min()) for body in bodies)])
    return [body.placed(np.eye(3), level) for body in bodies]


def _corners(triangles: FloatArray) -> set[tuple[int, ...]]:
    rounded = np.unique(np.round(triangles.reshape(-1, 3) / _SAME).astype(np.int64), axis=0)
    return set(map(tuple, rounded.tolist()))
