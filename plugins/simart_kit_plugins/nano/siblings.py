"""Parts of one shape are one kind of thing: they are as sure as they are on average."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

from .cloud import Cloud

# Extents and areas of siblings differ by no more than this share; sampling alone gives some.
_ALIKE = 0.12


def shared_certainty(cloud: Cloud, parts: Sequence[IntArray], certainty: FloatArray) -> FloatArray:
    """(P,) mean certainty of the parts that are shaped alike, which for most is their own.

    Four legs of a stool do not make a door of one of them; four wheels turn if three surely do.

    Args:
        cloud: of the object.
        parts: the pieces of each part.
        certainty: (P,) of each by itself, 0..1.
    """
    if not parts:
        return certainty
    shape = np.array([_shape(cloud, pieces) for pieces in parts])
    larger = np.maximum(shape[:, None], shape[None])
    apart = np.abs(shape[:, None] - shape[None]) / np.maximum(larger, 1e-9)
    # Of a thin part the thickness is mostly noise: it is compared with the part's length.
    apart[..., :3] = np.abs(shape[:, None, :3] - shape[None, :, :3]) / np.maximum(larger[..., 2:3], 1e-9)
    same = (apart <= _ALIKE).all(axis=2)
    return np.asarray(same @ certainty / same.sum(axis=1))


def _shape(cloud: Cloud, pieces: IntArray) -> FloatArray:
    """(4,) of its box the shorter level side, the height, and the longest side; and the area."""
    inside = np.isin(cloud.piece, pieces)
    x, y, z = np.ptp(cloud.points[inside], axis=0)
    level = sorted((x, y))
    return np.array([level[0], z, max(level[1], z), float(cloud.area[inside].sum())])
