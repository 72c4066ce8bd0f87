"""Moments of regions as 4x4 matrices, which add up over pieces.

A moment matrix is the integral of [x, 1] [x, 1]^T over a region: the last entry is its measure (volume or
area), the last column holds the first moments and the upper left block the second ones. It is the
pseudo-inertia matrix of Wensing, Kim and Slotine, "Linear Matrix Inequalities for Physically Consistent
Inertial Parameter Identification" (2018), which also shows what `inertia` relies on: an inertia tensor
belongs to a real body exactly when the covariance of its mass is positive.
"""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, IntArray
from .triangles import areas, unit_normals

# A body has at least this spread in every direction: [m], and as a share of its largest spread, squared.
_LEAST_SPREAD, _LEAST_RATIO = 1e-5, 1e-7


def simplex_moments(corners: FloatArray, measures: FloatArray) -> FloatArray:
    """(N, 4, 4) moments of simplices with uniform density 1.

    Args:
        corners: (N, K, 3); triangles have 3 corners, tetrahedra 4.
        measures: (N,) area or volume, signed if the simplex counts as a hole.
    """
    count = corners.shape[1]
    points = np.concatenate([corners, np.ones((*corners.shape[:2], 1))], axis=2)
    total = points.sum(axis=1)
    squares = np.einsum("nki,nkj->nij", points, points) + np.einsum("ni,nj->nij", total, total)
    return np.asarray(squares * (measures / (count * (count + 1)))[:, None, None])


def solid_moments(triangles: FloatArray) -> FloatArray:
    """(F, 4, 4) moments of the signed tetrahedra between the coordinates' origin and (F, 3, 3) triangles.

    Over a closed surface of outward triangles they add up to the moments of what it encloses.
    """
    volumes = np.einsum("ni,ni->n", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6
    return simplex_moments(np.pad(triangles, ((0, 0), (0, 1), (0, 0))), volumes)


def sheet_moments(triangles: FloatArray, thickness: FloatArray) -> FloatArray:
    """(F, 4, 4) moments of (F, 3, 3) triangles made (F,) thick [m], half of it on each side."""
    area, normals = areas(triangles), unit_normals(triangles)
    moments = simplex_moments(triangles, area * thickness)
    across = area * thickness**3 / 12
    moments[:, :3, :3] += across[:, None, None] * np.einsum("ni,nj->nij", normals, normals)
    return moments


def summed(moments: FloatArray, group: IntArray, count: int) -> FloatArray:
    """(count, 4, 4) sums of (N, 4, 4) moments over (N,) groups."""
    flat = moments.reshape(-1, 16)
    columns = [np.bincount(group, flat[:, i], count) for i in range(16)]
    return np.asarray(np.stack(columns, axis=1).reshape(count, 4, 4), dtype=np.float64)


def moved(moments: FloatArray, offset: FloatArray) -> FloatArray:
    """(..., 4, 4) moments of the region moved by (3,) [m]."""
    shift = np.eye(4)
    shift[:3, 3] = offset
    return np.asarray(shift @ moments @ shift.T)


def inertia(moments: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Centre (3,) [m] and inertia (3, 3) [m^2] about it, for a mass of 1 kg; the measure must be positive.

    The inertia is positive definite and obeys the triangle inequality, also for points and lines: those are
    given a spread of some micrometres.
    """
    measure = moments[3, 3]
    center = moments[:3, 3] / measure
    covariance = moments[:3, :3] / measure - np.outer(center, center)
    spread, axes = np.linalg.eigh(covariance)
    floor = max(_LEAST_SPREAD**2, _LEAST_RATIO * float(spread[-1]))
    if spread[0] < floor:
        covariance = (axes * np.maximum(spread, floor)) @ axes.T
    covariance = (covariance + covariance.T) / 2
    return center, np.trace(covariance) * np.eye(3) - covariance
