"""How far pieces are from each other: exact distances of their points to the other's triangles."""

from __future__ import annotations

from collections.abc import Callable, Sequence, Set
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from simart_kit.arrays import BoolArray, FloatArray, IntArray
from simart_kit.bounds import triangle_bounds

from .scene import Scene

T = TypeVar("T", bound=np.generic)
TOUCH = 0.004  # of the diagonal: closer than this, a handle sits on its panel
HOLDS = 0.001  # closer than this, a wall holds a shelf

_MOST_POINTS, _MOST_TRIANGLES = 300, 4000
_CHUNK = 1 << 16


@dataclass(frozen=True, eq=False)
class _Surface:
    """A piece's (F, 3, 3) triangles, their corners and middles, and the (F, 3) corners of their boxes."""

    triangles: FloatArray
    points: FloatArray
    lower: FloatArray
    upper: FloatArray


class Contacts:
    """Distances between the pieces of a scene, worked out once each when asked for.

    Args:
        scene: the pieces.
        reach: distances are only searched up to here; larger ones count as infinite.
    """

    def __init__(self, scene: Scene, reach: float = 0.02) -> None:
        self._scene = scene
        self._reach = reach
        order = np.argsort(scene.labels, kind="stable")
        counts = np.bincount(scene.labels, minlength=scene.count)
        self._faces = np.split(order, np.cumsum(counts)[:-1])
        self._known: dict[tuple[int, int], float] = {}
        self._surfaces: dict[int, _Surface] = {}
        self._told: dict[tuple[int, int, float], bool] = {}
        self._around = _around(scene, reach)

    def gap(self, a: int, b: int) -> float:
        """Smallest distance between two pieces, infinite beyond reach."""
        key = (min(a, b), max(a, b))
        if key not in self._known:
            ways = (self._one_way(*pair, self._reach) for pair in (key, key[::-1]))
            self._known[key] = min(ways) if self.beside(*key) else np.inf
        return self._known[key]

    def within(self, a: int, b: int, distance: float) -> bool:
        """Whether two pieces come as near as that; many times as fast as `gap` where it is little."""
        if distance <= self._reach and not self.beside(a, b):
            return False
        key = (min(a, b), max(a, b), distance)
        if key[:2] in self._known:
            return self._known[key[:2]] <= distance
        if key not in self._told:
            ways = (self._one_way(*pair, distance) for pair in (key[:2], key[1::-1]))
            near = self._scene.boxes[a].overlap(self._scene.boxes[b], distance)
            self._told[key] = near and any(way <= distance for way in ways)
        return self._told[key]

    def beside(self, a: int, b: int) -> bool:
        """Whether the boxes of two pieces come within reach of each other."""
        return b in self._around[a]

    def touching(self, piece: int, gap: float) -> list[int]:
        """Other pieces within `gap`."""
        return [i for i in range(self._scene.count) if i != piece and self.within(piece, i, gap)]

    def _one_way(self, a: int, b: int, reach: float) -> float:
        """Points of a against triangles of b, both only where the other's box is near."""
        points, piece = self._surface(a).points, self._surface(b)
        points = _spread(points[self._near(b, points, points, reach)], _MOST_POINTS)
        near = np.flatnonzero(self._near(a, piece.lower, piece.upper, reach))
        triangles = piece.triangles[_spread(near, _MOST_TRIANGLES)]
        if not len(points) or not len(triangles):
            return np.inf
        nearest = smallest_distance(points, triangles, reach)
        return nearest if nearest <= reach else np.inf

    def _surface(self, piece: int) -> _Surface:
        if piece not in self._surfaces:
            triangles = self._scene.triangles[self._faces[piece]]
            points = np.concatenate([triangles.reshape(-1, 3), triangles.sum(axis=1) / 3])
            self._surfaces[piece] = _Surface(triangles, points, *triangle_bounds(triangles))
        return self._surfaces[piece]

    def _near(self, piece: int, lower: FloatArray, upper: FloatArray, reach: float) -> BoolArray:
        """(N,) which boxes, of corners (N, 3), come within reach of a piece's own."""
        box, near = self._scene.boxes[piece], np.ones(len(lower), dtype=np.bool_)
        for axis in range(3):
            near &= lower[:, axis] <= box.upper[axis] + reach
            near &= upper[:, axis] >= box.lower[axis] - reach
        return near


def _around(scene: Scene, reach: float) -> list[set[int]]:
    """Of each piece those, itself included, whose boxes come within reach of its own."""
    lower, upper = (np.array([getattr(box, end) for box in scene.boxes]) for end in ("lower", "upper"))
    near = np.ones((scene.count, scene.count), dtype=np.bool_)
    for axis in range(3):
        near &= lower[:, None, axis] - reach <= upper[None, :, axis]
    return [set(np.flatnonzero(row).tolist()) for row in near & near.T]


def hanging_on(start: Set[int], among: Sequence[int], joined: Callable[[int, int], bool]) -> set[int]:
    """The start, and those `among` pieces that are joined to it, or to what hangs on it."""
    found = set(start)
    newest = list(found)
    while newest:  # what is not joined to those found before has been asked already
        more = {i for i in among if i not in found and any(joined(i, j) for j in newest)}
        found |= more
        newest = [j for j in found if j in more]
    return found


def smallest_distance(points: FloatArray, triangles: FloatArray, reach: float) -> float:
    """Smallest distance between (N, 3) points and (M, 3, 3) triangles; exact where it is within `reach`.

    Only pairs whose spheres and boxes could hold the smallest distance are looked at closely.
    """
    from scipy.spatial.distance import cdist

    corners = _columns(triangles)
    centers = (corners[0] + corners[1] + corners[2]) / 3
    radii = np.sqrt(((corners - centers) ** 2).sum(axis=1).max(axis=0))
    to_center = cdist(points, centers.T)  # a centre lies on its triangle: an upper bound
    bound = min(float(to_center.min()), reach) + 1e-9
    # Found in one row, pairs come several times as fast as in two dimensions.
    near = np.divmod(np.flatnonzero(to_center <= radii + bound), len(triangles))
    point, triangle = _in_boxes(points, triangles, *near, bound)
    best = np.inf
    for start in range(0, len(point), _CHUNK):
        part = slice(start, start + _CHUNK)
        best = min(best, float(paired_distances(points[point[part]], triangles[triangle[part]]).min()))
    return best


def _in_boxes(
    points: FloatArray, triangles: FloatArray, point: IntArray, triangle: IntArray, margin: float
) -> tuple[IntArray, IntArray]:
    """Those of pairs (K,), (K,) whose point lies within the triangle's bounding box, widened by a margin."""
    lower, upper = triangle_bounds(triangles)
    for axis in range(3):
        at = points[:, axis].take(point)
        inside = (at >= (lower[:, axis] - margin).take(triangle)) & (
            at <= (upper[:, axis] + margin).take(triangle)
        )
        point, triangle = point[inside], triangle[inside]
    return point, triangle


def paired_distances(points: FloatArray, triangles: FloatArray) -> FloatArray:
    """(K,) distance of (K, 3) points to (K, 3, 3) triangles, each to its own.

    To the plane where the foot lies inside, else to the nearest edge.
    """
    point = np.ascontiguousarray(points.T)
    a, b, c = _columns(triangles)
    normal = _cross(b - a, c - a)
    length = np.sqrt(_dot(normal, normal))
    unit = normal / np.maximum(length, 1e-30)
    height = _dot(point - a, unit)
    inside = length > 1e-14
    nearest = np.full(len(points), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        edge, away = end - start, point - start
        inside &= _dot(away, _cross(unit, edge)) >= 0
        along = _dot(away, edge) / np.maximum(_dot(edge, edge), 1e-30)
        apart = away - np.clip(along, 0, 1) * edge
        nearest = np.minimum(nearest, np.sqrt(_dot(apart, apart)))
    return np.where(inside, np.abs(height), nearest)


def _columns(triangles: FloatArray) -> FloatArray:
    """(3, 3, M) of (M, 3, 3) triangles: corner, axis, triangle; several times as fast to work with."""
    return np.ascontiguousarray(triangles.transpose(1, 2, 0))


def _dot(one: FloatArray, other: FloatArray) -> FloatArray:
    """(K,) products of (3, K) vectors."""
    return np.asarray(one[0] * other[0] + one[1] * other[1] + one[2] * other[2])


def _cross(one: FloatArray, other: FloatArray) -> FloatArray:
    """(3, K) vectors at right angles to (3, K) vectors."""
    (x, y, z), (u, v, w) = one, other
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u])


def _spread(values: NDArray[T], most: int) -> NDArray[T]:
    """At most so many rows, evenly taken."""
    if len(values) <= most:
        return values
    return np.asarray(values[np.linspace(0, len(values) - 1, most).astype(int)])
