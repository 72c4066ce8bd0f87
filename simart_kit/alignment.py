"""How an object stands against the axes: turned about the vertical, and leaning a little."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, frozen_floats
from .kept import kept
from .kinematics import rotation
from .mesh import Mesh

_QUARTER = np.pi / 2
_BINS = 90  # of a degree
# Share of the upright surface in one bin; and of a rough skin, whose flat sides lean this way and that, in
# that one and as many bins on either side of it.
_CRISP, _ROUGH, _AROUND = 0.25, 0.5, 3
# What stands along the axes and opens, stands ajar: so much of the surface that does so leads.
_STRAIGHT = 1 / 3
_MOST = np.deg2rad(5.0)  # a larger lean is how the object is made
_NEAR = np.cos(np.deg2rad(10.0))  # of what leans so, in a rough skin too
_SCALES = np.deg2rad([4.0, 2.0, 1.0, 0.5])  # within which a lean is looked for, ever closer
_EXACT, _ABOUT = np.deg2rad([0.25, 5.0])  # off it, of faces that lean exactly so, and of a rough skin's


@kept
def straight_from_asset(mesh: Mesh) -> FloatArray:
    """(3, 3) rotation after which most of the object's faces follow the axes, if that is told.

    About the vertical by an eighth of a turn at most, see `yaw`, and then by a slight lean, as of a scan; the
    identity where it stands straight.
    """
    turn = rotation(np.array([0.0, 0.0, -yaw(mesh)]))
    return frozen_floats(_levelling(mesh.face_normals @ turn.T, mesh.face_areas) @ turn)


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


def _levelling(normals: FloatArray, areas: FloatArray) -> FloatArray:
    """(3, 3) slight rotation that brings most of (F, 3) normals that are near the axes to them; else none.

    Upright faces and level ones have to lean alike, and little of either may stand straight.
    """
    nearest = np.abs(normals).argmax(axis=1)
    along = np.take_along_axis(normals, nearest[:, None], axis=1)[:, 0]
    near = np.abs(along) > _NEAR
    axes, outward = np.eye(3)[nearest[near]], normals[near] * np.sign(along[near])[:, None]
    weights = areas[near] / areas.sum()
    off = outward - axes
    lean = _common(axes, off, weights)
    told = _leans_exactly(lean, axes, off, weights) or _leans_on_average(lean, axes, off, weights)
    if not told or np.linalg.norm(lean) > _MOST:
        return np.eye(3)
    level = rotation(-lean)  # by what holds for small turns alone: what is left is much smaller
    return rotation(-_common(axes, outward @ level.T - axes, weights)) @ level


def _common(axes: FloatArray, off: FloatArray, weights: FloatArray) -> FloatArray:
    """(3,) small turn by which (N, 3) directions are off (N, 3) axes, at best; outliers count less."""
    lean = np.zeros(3)
    for scale in _SCALES:
        left = np.linalg.norm(off - np.cross(lean, axes), axis=1)
        heed = weights / (1 + (left / scale) ** 2)
        # Least squares: the cross product of an axis and its way is the turn, but for what is about the axis.
        lean = heed @ np.cross(axes, off) / np.maximum(heed @ (1 - axes), 1e-9)
    return lean


def _leans_exactly(lean: FloatArray, axes: FloatArray, off: FloatArray, weights: FloatArray) -> bool:
    """Whether much of the surface leans just so, and little of what would, upright or level, is straight."""
    moved = np.cross(lean, axes)
    told = np.linalg.norm(moved, axis=1) > _EXACT
    leaning = told & (np.linalg.norm(off - moved, axis=1) < _EXACT)
    straight = told & (np.linalg.norm(off, axis=1) < _EXACT)
    for kind in (axes[:, 2] == 0, axes[:, 2] == 1):
        if weights[straight & kind].sum() >= _STRAIGHT * weights[leaning & kind].sum():
            return False
    return bool(weights[leaning].sum() >= _CRISP)


def _leans_on_average(lean: FloatArray, axes: FloatArray, off: FloatArray, weights: FloatArray) -> bool:
    """Whether a rough skin leans so: most of it about so, and the middle of its upright and level faces."""
    moved = np.cross(lean, axes)
    about = np.linalg.norm(off - moved, axis=1) < _ABOUT
    if np.linalg.norm(lean) < np.deg2rad(1.0) or weights[about].sum() < _ROUGH:
        return False
    told = np.linalg.norm(moved, axis=1) > np.linalg.norm(lean) / 2
    for kind in (told & (axes[:, 2] == 0), told & (axes[:, 2] == 1)):
        shares = (off[kind] * moved[kind]).sum(axis=1) / (moved[kind] ** 2).sum(axis=1)
        order = np.argsort(shares)
        half = np.searchsorted(np.cumsum(weights[kind][order]), weights[kind].sum() / 2)
        if not kind.any() or shares[order][half] < 0.5:
            return False
    return True
