"""How likely a point belongs to each part, from points known to lie on the parts (their seeds)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import BoolArray, Float32Array, FloatArray, IntArray
from ..topology import weld
from .cells import Cells, cells_of

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

# A part this much less likely than the nearest one counts as impossible.
_LEAST_RATIO = 1e-3
# Distances that differ by less than this are equal, relative to sigma; so are places of seeds.
_SAME = 1e-6
# Fewer questions than this are not worth a thread.
_FEW = 10_000


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

        return tuple(
            # Cut in the middle of space, not of the seeds, it answers a little faster.
            cKDTree(self.points[self.part == part], balanced_tree=False)
            for part in range(self.count)
        )

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

    def probabilities(self, points: FloatArray) -> Float32Array:
        """(N, P) chance of each part at (N, 3) points [m], each row summing to 1: P ~ exp(-d^2 / 2 sigma^2).

        A part is measured only where it can matter, and none where only one can.
        """
        if not len(points):
            return np.zeros((0, self.count), dtype=np.float32)
        cells = cells_of(points, self.sigma)
        possible, reach = self._possible(cells)
        open_ = possible & (possible.sum(axis=1, keepdims=True) > 1)
        likely: Float32Array = (possible & ~open_).astype(np.float32).take(cells.of_point, axis=0)
        nearest: FloatArray = np.full(len(points), np.inf)
        found: list[tuple[IntArray, FloatArray]] = []
        for tree, asked in zip(self.each_part, open_.T, strict=True):
            rows: IntArray = np.flatnonzero(asked.take(cells.of_point))
            distance = _distance(tree, points.take(rows, axis=0), reach[asked].max(initial=0.0))
            nearest[rows] = np.minimum(nearest.take(rows), distance)
            found.append((rows, distance))
        for part, (rows, distance) in enumerate(found):
            ratio = np.exp((nearest.take(rows) ** 2 - distance**2) / (2 * self.sigma**2))
            likely[rows, part] = np.where(ratio < _LEAST_RATIO, 0, ratio)
        likely /= np.einsum("ij->i", likely)[:, None]
        return likely

    def _possible(self, cells: Cells) -> tuple[BoolArray, FloatArray]:
        """(C, P) parts that may matter somewhere in each cell, and (C,) how near their seeds are then [m].

        By the triangle inequality: no distance differs from the center's by more than the cell's radius.
        """
        nearest = _distance(self.all_parts, cells.centers) + cells.radius
        reach = np.sqrt(nearest**2 + 2 * self.sigma**2 * np.log(1 / _LEAST_RATIO)) * (1 + _SAME)
        around = reach + cells.radius * (1 + _SAME)
        most = around.max()
        possible = np.zeros((len(around), self.count), dtype=np.bool_)
        for part, tree in enumerate(self.each_part):
            boxed = (cells.centers >= tree.mins - most) & (cells.centers <= tree.maxes + most)
            near = np.flatnonzero(boxed.all(axis=1))
            possible[near, part] = _distance(tree, cells.centers[near], most) <= around[near]
        return possible, reach

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
        if not len(several):
            return np.asarray(chosen)
        open_, tied = open_[several], tied[several]
        chosen[open_] = self._distances(self.own, points[open_], tied).argmin(axis=1)
        return np.asarray(chosen)

    def _distances(self, trees: Sequence[cKDTree], points: FloatArray, wanted: BoolArray) -> FloatArray:
        """(N, P) distance to the trees [m] where wanted (N, P), infinite elsewhere."""
        distance = np.full(wanted.shape, np.inf)
        for part, tree in enumerate(trees):
            rows = np.flatnonzero(wanted[:, part])
            if len(rows):
                distance[rows, part] = _distance(tree, points[rows])
        return distance


def _distance(tree: cKDTree, points: FloatArray, most: float = np.inf) -> FloatArray:
    """(N,) distance to the nearest seed of the tree [m], infinite where it is more than `most`."""
    workers = 1 if len(points) < _FEW else -1
    return np.asarray(tree.query(points, distance_upper_bound=most, workers=workers)[0])
