"""Discs of a rough skin, whose rims are not quite circles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray

_ROUND = 0.12  # by which its width and height may differ, and its rim be off, as a share of its radius
_RIM, _BINS = 0.75, 24  # share of the ways from its middle in which the rim is found
_THICK = 0.8  # of its diameter that it is thick at most


@dataclass(frozen=True, eq=False)
class Disc:
    """Something about as high as long, with a rim nearly all around.

    Attributes:
        axis: 0, 1 or 2, of the aligned frame.
        center: (3,) its middle.
        radius: of the rim [diagonals].
        ends: (2,) where it begins and ends along the axis.
    """

    axis: int
    center: FloatArray
    radius: float
    ends: FloatArray


def rough_disc(points: FloatArray, thick: float = _THICK) -> Disc | None:
    """The disc that (N, 3) points are of, roughly; None where they are of none.

    Args:
        points: its surface.
        thick: share of its diameter that it is thick at most.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    size, center = high - low, (low + high) / 2
    for axis in np.argsort(size).tolist():
        across = [other for other in range(3) if other != axis]
        wide = size[across]
        if wide.max() - wide.min() > _ROUND * wide.max() or size[axis] > thick * wide.max():
            continue
        radius = float(wide.mean()) / 2
        if rim_share(points[:, across] - center[across], radius) >= _RIM:
            return Disc(int(axis), center, radius, np.array([low[axis], high[axis]]))
    return None


def rim_share(offset: FloatArray, radius: float) -> float:
    """Share of the ways from the middle in which (N, 2) points about it reach about as far as a radius."""
    way = ((np.arctan2(offset[:, 1], offset[:, 0]) / (2 * np.pi) + 0.5) * _BINS).astype(np.int64) % _BINS
    reach = np.zeros(_BINS)
    np.maximum.at(reach, way, np.hypot(*offset.T))
    return float((np.abs(reach - radius) < _ROUND * radius).mean())
