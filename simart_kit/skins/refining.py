"""A decimated skin on smaller triangles: what it is like within a large one, vertices do not tell."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..topology import edges
from ..triangles import lengths

# How long sides are left, in radii of the surroundings that relief goes by, and of skins so coarse that each
# of their triangles would come apart into more than so many.
_LONGEST, _LONGEST_OF_COARSE, _MANY = 1.0, 0.5, 10
# So many times as long as the middle one, some side of a triangle is where flat places were decimated.
_UNEVEN = 4.0
_COARSE = 2.0  # so many times as long as asked for are sides that are cut although they are alike
_MOST = 1_000_000  # triangles, about: of more none is cut
# By how many of a triangle's sides are cut, from the first on: the smaller triangles, of its corners 0, 1 and
# 2 and the middles 3, 4 and 5 of the sides that begin there.
_SPLITS = {
    1: ((0, 3, 2), (3, 1, 2)),
    2: ((0, 3, 4), (3, 1, 4), (0, 4, 2)),
    3: ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)),
}


@dataclass(frozen=True, eq=False)
class Refined:
    """Triangles, each a part of one of those that there were.

    Attributes:
        places: (V, 3), first those that there were.
        faces: (N, 3) places.
        source: (N,) the triangle that each is a part of.
        weights: (N, 3, 3) where its corners are, as weights of its source's corners.
    """

    places: FloatArray
    faces: IntArray
    source: IntArray
    weights: FloatArray

    def of(self, some: BoolArray) -> Refined:
        """Those of (N,) triangles."""
        return Refined(self.places, self.faces[some], self.source[some], self.weights[some])

    @property
    def shares(self) -> FloatArray:
        """(N,) of its source's area that each has."""
        one, other, third = self.weights.transpose(1, 2, 0)
        return np.asarray(np.abs(np.einsum("kn,kn->n", one, np.cross(other, third, axis=0))))

    def on_sources(self, label: IntArray, areas: FloatArray) -> IntArray:
        """(F,) the label that most of each source has, of (N,) labels of triangles with (N,) areas."""
        count, most = int(self.source.max()) + 1, int(label.max()) + 1
        if count == len(label):
            return label
        pairs, pair = np.unique(self.source * most + label, return_inverse=True)
        source, its = np.divmod(pairs[np.argsort(np.bincount(pair, areas), kind="stable")], most)
        result = np.zeros(count, dtype=np.int64)
        result[source] = its  # the last of each is the largest
        return result


def longest_side(places: FloatArray, faces: IntArray, radius: float) -> float:
    """How long a skin's sides may be left for relief to show, in the unit of the places.

    Args:
        places: (V, 3).
        faces: (F, 3) places.
        radius: of the surroundings that relief goes by.
    """
    fine = _LONGEST_OF_COARSE * radius
    many = _estimated(_sides(_whole(places, faces)) / fine) > _MANY * len(faces)
    return fine if many else _LONGEST * radius


def refined(places: FloatArray, faces: IntArray, longest: float) -> Refined:
    """Cut triangles of unlike size, or large ones, until no side is longer; two that share one cut it alike.

    Args:
        places: (V, 3).
        faces: (F, 3) places; each is a corner of one.
        longest: side, in the unit of the places.
    """
    now = _whole(places, faces)
    side = _sides(now)
    alike = side.max() < _UNEVEN * np.median(side) and _middle(side.mean(axis=1)) < _COARSE * longest
    if alike or _estimated(side / longest) > _MOST:
        return now
    left = list[Refined]()
    while (long := _sides(now) > longest).any():
        some = np.asarray(long.any(axis=1))
        left.append(now.of(~some))  # sides are not cut by one of the two alone, so these stay as they are
        now = _halved(now.of(some), long[some])
    faces, source, weights = (
        np.concatenate([getattr(part, of) for part in (*left, now)]) for of in ("faces", "source", "weights")
    )
    return Refined(now.places, faces, source, weights)


def _whole(places: FloatArray, faces: IntArray) -> Refined:
    """Triangles as they are."""
    every = len(faces)
    return Refined(places, faces, np.arange(every), np.broadcast_to(np.eye(3), (every, 3, 3)))


def _sides(now: Refined) -> FloatArray:
    """(N, 3) lengths of the sides that begin at each corner."""
    a, b, c = (now.places.take(corner, axis=0) for corner in now.faces.T)
    return np.stack([lengths(b - a), lengths(c - b), lengths(a - c)], axis=1)


def _middle(side: FloatArray) -> float:
    """The side of the triangle in the middle of the surface, by (F,) sides of triangles much alike."""
    ordered = np.sort(side)
    covered = np.cumsum(ordered**2)
    return float(ordered[np.searchsorted(covered, covered[-1] / 2)])


def _estimated(sides: FloatArray) -> float:
    """About how many triangles there will be, by (F, 3) sides as multiples of the longest that is left."""
    halvings = np.ceil(np.log2(np.maximum(sides, 1.0)))
    return float(np.exp2(halvings.max(axis=1) + halvings.min(axis=1)).sum())


def _halved(now: Refined, long: BoolArray) -> Refined:
    """The sides that (N, 3) marks, some of each triangle, cut in their middles."""
    _, first, middle = np.unique(edges(now.faces)[long], return_index=True, return_inverse=True)
    ends = np.stack([now.faces, now.faces[:, [1, 2, 0]]], axis=2)[long][first]
    middles = np.full(long.shape, -1)
    middles[long] = len(now.places) + middle.reshape(-1)
    cut = long.sum(axis=1)
    parts = []
    for sides, split in _SPLITS.items():
        some = np.flatnonzero(cut == sides)
        # Of two sides the first is the one after that which stays.
        begin = (np.argmin(long[some], axis=1) + 1) % 3 if sides == 2 else np.argmax(long[some], axis=1)
        turn = (begin[:, None] + np.arange(3)) % 3
        corner, middle = (np.take_along_axis(of[some], turn, axis=1) for of in (now.faces, middles))
        weight = np.take_along_axis(now.weights[some], turn[:, :, None], axis=1)
        corner = np.hstack([corner, middle])
        weight = np.concatenate([weight, (weight + weight[:, [1, 2, 0]]) / 2], axis=1)
        parts += [(corner[:, one], now.source[some], weight[:, one]) for one in split]
    faces, source, weights = (np.concatenate(column) for column in zip(*parts, strict=True))
    return Refined(np.concatenate([now.places, now.places[ends].mean(axis=1)]), faces, source, weights)
