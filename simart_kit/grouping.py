"""Boxes that lie close together, in few groups."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray
from .hulls import MIN_THICKNESS

_MOST_CANDIDATES = 512


def grouped(boxes: list[FloatArray], most: int) -> list[list[int]]:
    """Indices of (2, 3) boxes in `most` groups or fewer, joining those that grow least by it."""
    groups, bounds = _candidates(np.array(boxes))
    growth = np.array([_growth(bounds, i) for i in range(len(groups))])
    for _ in range(len(groups) - most):
        one, two = sorted(int(i) for i in np.unravel_index(growth.argmin(), growth.shape))
        groups[one] += groups[two]
        groups[two] = []
        bounds[one] = _union(bounds[one], bounds[two])
        growth[one] = growth[:, one] = np.where(np.isinf(growth[one]), np.inf, _growth(bounds, one))
        growth[two] = growth[:, two] = np.inf
    return [sorted(group) for group in groups if group]


def _candidates(boxes: FloatArray) -> tuple[list[list[int]], FloatArray]:
    """The largest boxes, each with the smaller ones that have their middle nearest to its own."""
    from scipy.spatial import cKDTree

    size = np.linalg.norm(boxes[:, 1] - boxes[:, 0], axis=1)
    order = np.argsort(-size, kind="stable")
    large, small = np.sort(order[:_MOST_CANDIDATES]), np.sort(order[_MOST_CANDIDATES:])
    groups, bounds = [[int(i)] for i in large], boxes[large].copy()
    nearest = np.asarray(cKDTree(boxes[large].mean(axis=1)).query(boxes[small].mean(axis=1))[1])
    for box, group in zip(small.tolist(), nearest.tolist(), strict=True):
        groups[group].append(box)
        bounds[group] = _union(bounds[group], boxes[box])
    return groups, bounds


def _growth(bounds: FloatArray, index: int) -> FloatArray:
    """(N,) volume that joining each of (N, 2, 3) boxes with one of them adds [m^3]; infinite for itself."""
    joined = _volumes(_union(bounds, bounds[index]))
    growth = joined - _volumes(bounds) - _volumes(bounds[index])
    growth[index] = np.inf
    return np.asarray(growth)


def _union(one: FloatArray, two: FloatArray) -> FloatArray:
    return np.stack(
        [np.minimum(one[..., 0, :], two[..., 0, :]), np.maximum(one[..., 1, :], two[..., 1, :])], axis=-2
    )


def _volumes(bounds: FloatArray) -> FloatArray:
    return np.asarray(np.maximum(bounds[..., 1, :] - bounds[..., 0, :], MIN_THICKNESS).prod(axis=-1))
