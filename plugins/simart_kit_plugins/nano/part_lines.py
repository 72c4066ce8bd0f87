"""The joint candidates of a part of a cloud, and what speaks for each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray

from .candidates import Candidates, candidates
from .cloud import Cloud
from .evidence import TOUCHING, evidence

# Farther from the rest than this is far [sides of the object].
_FAR = 1.0


@dataclass(frozen=True, eq=False)
class PartLines:
    """A part among the rest.

    Attributes:
        own: (N, 3) points of the part.
        rest: (M, 3) points of all else.
        gap: (N,) from each point of the part to the nearest of the rest, at most `_FAR`.
        found: its candidates.
    """

    own: FloatArray
    rest: FloatArray
    gap: FloatArray
    found: Candidates

    def evidence(self) -> FloatArray:
        """(C, COUNT) numbers for each candidate."""
        return evidence(self.found, self.own, self.rest, self.gap)


def part_lines(cloud: Cloud, inside: BoolArray) -> PartLines:
    """The candidates of the part that (N,) `inside` points are of; some are, some are not."""
    from scipy.spatial import cKDTree

    own, rest = cloud.points[inside], cloud.points[~inside]
    gap = np.minimum(np.asarray(cKDTree(rest).query(own)[0]), _FAR)
    return PartLines(own, rest, gap, candidates(own, cloud.normals[inside], own[gap < TOUCHING]))
