"""Boxes and areas of pieces and of sets of them, by which parts of one kind are told."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray

from .cloud import Cloud

# Extents and areas of what is alike differ by no more than this share; sampling alone gives some.
_ALIKE = 0.12


@dataclass(frozen=True, eq=False)
class PieceBoxes:
    """Around each of S pieces of an object.

    Attributes:
        lower: (S, 3) corners.
        upper: (S, 3).
        area: (S,) of what is in them.
    """

    lower: FloatArray
    upper: FloatArray
    area: FloatArray

    @classmethod
    def of(cls, cloud: Cloud) -> PieceBoxes:
        """Those of an object's pieces."""
        lower, upper = np.full((cloud.count, 3), np.inf), np.full((cloud.count, 3), -np.inf)
        np.minimum.at(lower, cloud.piece, cloud.points)
        np.maximum.at(upper, cloud.piece, cloud.points)
        return cls(lower, upper, np.bincount(cloud.piece, cloud.area, cloud.count).astype(float))

    def shapes(self, pieces: IntArray, sets: BoolArray) -> FloatArray:
        """(N, 4) of (N, P) sets of P pieces: the box's shorter level side, height, longest side; the area."""
        lower = np.where(sets[..., None], self.lower[pieces], np.inf).min(axis=1)
        upper = np.where(sets[..., None], self.upper[pieces], -np.inf).max(axis=1)
        x, y, z = (upper - lower).T
        longest = np.maximum(np.maximum(x, y), z)
        return np.column_stack([np.minimum(x, y), z, longest, sets @ self.area[pieces]])

    def shapes_of(self, parts: Sequence[IntArray]) -> FloatArray:
        """(P, 4) as of `shapes`, of parts by the pieces of each."""
        return np.concatenate([self.shapes(p, np.ones((1, len(p)), dtype=bool)) for p in parts])


def alike(one: FloatArray, other: FloatArray) -> BoolArray:
    """(N, M) whether (N, 4) and (M, 4) shapes, as of `PieceBoxes.shapes`, are alike."""
    larger = np.maximum(one[:, None], other[None])
    apart = np.abs(one[:, None] - other[None]) / np.maximum(larger, 1e-9)
    # Of a thin part the thickness is mostly noise: it is compared with the part's length.
    apart[..., :3] = np.abs(one[:, None, :3] - other[None, :, :3]) / np.maximum(larger[..., 2:3], 1e-9)
    return np.asarray((apart <= _ALIKE).all(axis=2))
