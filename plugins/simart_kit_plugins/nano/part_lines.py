"""The joint candidates of a part of a cloud, and what speaks for each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray

from .candidates import Candidates, candidates
from .cloud import Cloud
from .evidence import TOUCHING, evidence
from .line_places import Details

# Farther from the rest than this is far [sides of the object].
_FAR = 1.0
# Pieces smaller than this share of a part's largest one are details: its handles, or hinges on what holds it.
_SMALL = 0.25
# So many pieces of a part, and so many beside it, are looked at for pins that it turns about.
_PINS = 6


@dataclass(frozen=True, eq=False)
class PartLines:
    """A part among the rest.

    Attributes:
        own: (N, 3) points of the part.
        rest: (M, 3) points of all else.
        gap: (N,) from each point of the part to the nearest of the rest, at most `_FAR`.
        found: its candidates.
        details: its small pieces, and those of the rest.
    """

    own: FloatArray
    rest: FloatArray
    gap: FloatArray
    found: Candidates
    details: Details

    def evidence(self) -> FloatArray:
        """(C, COUNT) numbers for each candidate."""
        return evidence(self.found, self.own, self.rest, self.gap, self.details)


def part_lines(cloud: Cloud, inside: BoolArray) -> PartLines:
    """The candidates of the part that (N,) `inside` points are of; some are, some are not."""
    from scipy.spatial import cKDTree

    own, rest = cloud.points[inside], cloud.points[~inside]
    gap = np.minimum(np.asarray(cKDTree(rest).query(own)[0]), _FAR)
    area = np.asarray(np.bincount(cloud.piece, cloud.area, cloud.count), dtype=np.float64)
    small = area < _SMALL * area[np.unique(cloud.piece[inside])].max()
    pins = _pins(cloud, inside, small[cloud.piece], area)
    found = candidates(own, cloud.normals[inside], own[gap < TOUCHING], pins)
    return PartLines(own, rest, gap, found, _details(cloud, inside, small))


def _pins(cloud: Cloud, inside: BoolArray, small: BoolArray, area: FloatArray) -> list[FloatArray]:
    """(K, 3) points each of the part's pieces, and of small ones that it touches: the largest of either.

    Args:
        cloud: of the object.
        inside: (N,) points of the part.
        small: (N,) points of small pieces.
        area: (S,) of each piece.
    """
    from scipy.spatial import cKDTree

    own = np.unique(cloud.piece[inside])
    beside = np.zeros(0, dtype=own.dtype)
    if (~inside & small).any():
        gap = np.asarray(cKDTree(cloud.points[inside]).query(cloud.points[~inside & small])[0])
        beside = np.unique(cloud.piece[~inside & small][gap < TOUCHING])
    largest = [sorted(some.tolist(), key=lambda piece: -area[piece])[:_PINS] for some in (own, beside)]
    return [cloud.points[cloud.piece == piece] for some in largest for piece in some]


def _details(cloud: Cloud, inside: BoolArray, small: BoolArray) -> Details:
    own = np.unique(cloud.piece[inside])
    parts = own[small[own]]
    grips = [_middle(cloud.points[cloud.piece == piece]) for piece in parts]
    grip = np.mean(grips, axis=0) if grips else _middle(cloud.points[inside])
    return Details(grip, cloud.points[~inside & small[cloud.piece]])


def _middle(points: FloatArray) -> FloatArray:
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2)
