"""How an object is turned about the vertical: the direction that its upright faces follow."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray
from .mesh import Mesh

_QUARTER = np.pi / 2
_BINS = 90  # of a degree
# Share of the upright surface in one bin; and of a rough skin, whose flat sides lean this way and that, in
# that one and as many bins on either side of it.
_CRISP, _ROUGH, _AROUND = 0.25, 0.5, 3
# What stands along the axes and opens, stands ajar: so much of the surface that does so leads.
_STRAIGHT = 1 / 3


def yaw(mesh: Mesh) -> float:
    """Turn of the object's upright faces against the axes [rad], in (-pi/4, pi/4].

    The fullest one-degree bin of directions, modulo a quarter turn, or of a rough skin the fullest seven side
    by side; 0 where no direction stands out, or much of a surface that is not rough follows the axes.
    """
    normals, areas = mesh.face_normals, mesh.face_areas
    upright = np.abs(normals[:, 2]) < 0.2
    if areas[upright].sum() < 0.05 * areas.sum():
        return 0.0
    turns, weights = np.arctan2(normals[upright, 1], normals[upright, 0]), areas[upright]
    histogram, edges = np.histogram(
        _wrapped(turns), bins=_BINS, range=(-_QUARTER / 2, _QUARTER / 2), weights=weights
    )
    histogram = histogram / weights.sum()
    crisp = histogram.max() >= _CRISP
    if not crisp:
        histogram = np.sum([np.roll(histogram, by) for by in range(-_AROUND, _AROUND + 1)], axis=0)
        if histogram.max() < _ROUGH:
            return 0.0
    middle = (edges[:-1] + edges[1:])[histogram.argmax()] / 2
    for reach in np.deg2rad([1.5] if crisp else [_AROUND, _AROUND]):
        off = _wrapped(turns - middle)
        near = np.abs(off) < reach
        middle = middle + np.average(off[near], weights=weights[near])
    found = float(_wrapped(middle))
    little = abs(found) < np.deg2rad(0.5 if crisp else 1.0)
    return 0.0 if little or (crisp and _stands_straight(turns, weights, found)) else found


def _stands_straight(turns: FloatArray, weights: FloatArray, found: float) -> bool:
    """Whether much follows the axes too, where more of the faces' turns [rad] are another one."""
    along, askew = (weights[np.abs(_wrapped(turns - by)) < np.deg2rad(0.5)].sum() for by in (0.0, found))
    return bool(along >= _STRAIGHT * askew)


def _wrapped(turns: FloatArray) -> FloatArray:
    """Turns [rad] modulo a quarter, around 0."""
    return np.mod(turns + _QUARTER / 2, _QUARTER) - _QUARTER / 2
