"""How likely a point belongs to each part, from points known to lie on the parts (their seeds)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import BoolArray, Float32Array, FloatArray, IntArray
from ..topology import weld

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

# A part this much less likely than the nearest one counts as impossible.
_LEAST_RATIO = 1e-3
# Distances that differ by less than this are equal, relative to sigma; so are places of seeds.
_SAME = 1e-6
# How far gaps between the seeds of different parts are measured [sigma].
_FAR = 10.0


@dataclass(frozen=True, eq=False)
class PartSeeds:
    """Seeds of several parts.

    Attributes:
        points: (S, 3) seeds of all parts, one part after the other [m].
        part: (S,) part of each seed, 0..count-1.
        count: number of parts; each has a seed.
        sigma: standard deviation of the Gaussian kernel [m].
    """

    points: FloatArray
    part: IntArray
    count: int
    sigma: float

    @cached_property
    def all_parts(self) -> cKDTree:
        """Finds the nearest of all seeds."""
        from scipy.spatial import cKDTree

        return cKDTree(self.points)

    @cached_property
    def each_part(self) -> tuple[cKDTree, ...]:
        """Find the nearest seed of each part."""
        from scipy.spatial import cKDTree

        return tuple(cKDTree(self.points[self.part == part]) for part in range(self.count))

    @cached_property
    def own(self) -> tuple[cKDTree, ...]:
        """Find the nearest seed of each part that no other part has, of all its seeds if it has none such."""
        from scipy.spatial import cKDTree

        place = weld(self.points, self.sigma * _SAME)
        pairs = np.unique(place.astype(np.int64) * self.count + self.part)
        shared = np.bincount(pairs // self.count)[place] > 1
        mine = [self.part == part for part in range(self.count)]
        return tuple(
            cKDTree(self.points[alone] if (alone := seeds & ~shared).any() else self.points[seeds])
            for seeds in mine
        )

    @cached_property
    def gaps(self) -> FloatArray:
        """(P, S) how far each seed has it to the nearest one of each part [m], at most `_FAR` sigma."""
        far = _FAR * self.sigma
        found = [tree.query(self.points, distance_upper_bound=far, workers=-1)[0] for tree in self.each_part]
        return np.asarray(np.minimum(np.stack(found), far))

    def probabilities(self, points: FloatArray) -> Float32Array:
        """(N, P) chance of each part at (N, 3) points [m], each row summing to 1: P ~ exp(-d^2 / 2 sigma^2).

        A part is measured only where it can matter: the nearest seed of all tells by the triangle inequality
        how near any seed of another part may be.
        """
        nearest, seed = (np.asarray(found) for found in self.all_parts.query(points, workers=-1))
        reach = np.sqrt(nearest**2 + 2 * self.sigma**2 * np.log(1 / _LEAST_RATIO))
        likely = np.zeros((len(points), self.count), dtype=np.float32)
        likely[np.arange(len(points)), self.part[seed]] = 1
        # A gap cut off there may be as near as any.
        slack = np.minimum((nearest + reach) * (1 + _SAME), _FAR * self.sigma)
        for part, tree in enumerate(self.each_part):
            near = np.flatnonzero((self.gaps[part][seed] <= slack) & (self.part[seed] != part))
            if len(near):
                bound = float(reach[near].max()) * (1 + _SAME)
                distance = tree.query(points[near], distance_upper_bound=bound, workers=-1)[0]
                ratio = np.exp((nearest[near] ** 2 - distance**2) / (2 * self.sigma**2))
                likely[near, part] = np.where(ratio < _LEAST_RATIO, 0, ratio)
        likely /= likely.sum(axis=1, keepdims=True)
        return likely

    def nearest_part(self, points: FloatArray, allowed: BoolArray) -> IntArray:
        """(N,) the part whose seeds are nearest to (N, 3) points [m], out of (N, P) those allowed.

        Where several are equally near, as in a cell that two parts share, the nearest seed that only one of
        them has decides; then the lower number.
        """
        chosen = allowed.argmax(axis=1)
        open_ = np.flatnonzero(allowed.sum(axis=1) != 1)
        distance = self._distances(self.each_part, points[open_], allowed[open_])
        tied = distance <= distance.min(axis=1, keepdims=True, initial=np.inf) + self.sigma * _SAME
        chosen[open_] = tied.argmax(axis=1)
        several = np.flatnonzero(tied.sum(axis=1) > 1)
        open_, tied = open_[several], tied[several]
        chosen[open_] = self._distances(self.own, points[open_], tied).argmin(axis=1)
        return np.asarray(chosen)

    def _distances(self, trees: Sequence[cKDTree], points: FloatArray, wanted: BoolArray) -> FloatArray:
        """(N, P) distance to the trees [m] where wanted (N, P), infinite elsewhere."""
        distance = np.full(wanted.shape, np.inf)
        for part, tree in enumerate(trees):
            rows = np.flatnonzero(wanted[:, part])
            if len(rows):
                distance[rows, part] = tree.query(points[rows], workers=-1)[0]
        return distance
