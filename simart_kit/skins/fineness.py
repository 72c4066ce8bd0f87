"""Whether a surface is meshed finely enough to be cut by relief, and shells alike."""

from __future__ import annotations

import numpy as np

from ..arrays import IntArray
from ..mesh import Mesh

RADIUS = 0.022  # of the surroundings that relief goes by, as a share of the longest side
_SHELLS = 12  # a skin has so many at most
# So many patches, most of them of few faces, tell the noise of a decimated one.
_PATCHES, _CRUMB, _CRUMBS = 64, 4, 0.6
_LARGE = 5.0  # times the middle one, one in a thousand of its triangles
_UNEVEN = 1.25  # so many times as coarse one of them is as another at most


def coarseness(mesh: Mesh, kept: IntArray) -> float:
    """Side of the middle triangle by surface, in radii of the surroundings."""
    areas = np.sort(mesh.face_areas[kept])
    middle = areas[np.searchsorted(np.cumsum(areas), areas.sum() / 2)]
    return float(np.sqrt(middle * 4 / np.sqrt(3)) / (RADIUS * np.ptp(mesh.bounds, axis=0).max()))


def is_fine(mesh: Mesh, kept: IntArray) -> bool:
    """Whether triangles that are small against the surroundings make up most of some faces' surface."""
    return coarseness(mesh, kept) < 1


def is_rough(mesh: Mesh, kept: IntArray, patch: IntArray) -> bool:
    """Whether most of (K,) patches that creases bound are crumbs, and flat places of larger triangles.

    A decimated skin is like that, and no noise on triangles of a size.
    """
    size = np.bincount(patch)
    size = size[size > 0]
    if len(size) <= _PATCHES or float((size < _CRUMB).mean()) <= _CRUMBS:
        return False
    middle, large = np.quantile(mesh.face_areas[kept], [0.5, 0.999])
    return bool(large > _LARGE * middle)


def are_shells(mesh: Mesh, kept: IntArray, label: IntArray) -> bool:
    """Whether (K,) few labels of the `kept` faces are as finely meshed as each other: shells of one skin."""
    shells = np.flatnonzero(np.bincount(label, minlength=1))
    if not 1 < len(shells) <= _SHELLS:
        return False
    coarse = [coarseness(mesh, kept[label == shell]) for shell in shells]
    return max(coarse) < min(1, _UNEVEN * min(coarse))
