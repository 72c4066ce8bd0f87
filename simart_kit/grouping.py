"""Boxes that lie close together, in few groups."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray
from .bounds import bounds_of
from .hulls import MIN_THICKNESS

_MOST_CANDIDATES = 512


def grouped(boxes: list[FloatArray], most: int) -> list[list[int]]:
    """Indices of (2, 3) boxes in `most` groups or fewer, joining those that grow least by it."""
    corners = np.array(boxes)
    groups = gathered(corners, _MOST_CANDIDATES)
    bounds = np.array([bounds_of(corners[group].reshape(-1, 3)) for group in groups])
    growth = np.array([_growth(bounds, i) for i in range(len(groups))])
    for _ in range(len(groups) - most):
        one, two = sorted(int(i) for i in np.unravel_index(growth.argmin(), growth.shape))
        groups[one] += groups[two]
        groups[two] = []
        bounds[one] = _union(bounds[one], bounds[two])
        growth[one] = growth[:, one] = np.where(np.isinf(growth[one]), np.inf, _growth(bounds, one))
        growth[two] = growth[:, two] = np.inf
    return [sorted(group) for group in groups if group]


def gathered(boxes: FloatArray, most: int, alone: int = 0) -> list[list[int]]:
    """Indices of (N, 2, 3) boxes in `most` groups or fewer: smaller ones go where the nearest large one is.

    Args:
        boxes: lowest and highest corners.
        most: groups, each around one of the largest boxes.
        alone: how many of these, the largest ones, stay by themselves; fewer than `most`.
    """
    from scipy.spatial import cKDTree

    order = np.argsort(-np.linalg.norm(boxes[:, 1] - boxes[:, 0], axis=1), kind="stable")
    leads, small = np.sort(order[alone:most]), np.sort(order[most:])
    groups = {int(i): [int(i)] for i in np.sort(order[:most])}
    if len(small):
        nearest = cKDTree(boxes[leads].mean(axis=1)).query(boxes[small].mean(axis=1))[1]
        for box, lead in zip(small.tolist(), leads[nearest].tolist(), strict=True):
            groups[lead].append(box)
    return list(groups.values())


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
