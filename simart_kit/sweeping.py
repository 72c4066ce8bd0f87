"""How far something moves before it passes through something: paths of surface points, as rays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .asset import Joint
from .bounds import bounds_of, triangle_bounds
from .kinematics import moved_by
from .rays import Rays
from .shells import find_shells, signed_volumes
from .triangles import areas, unit_normals

Motion = Callable[[float], FloatArray]
"""Position [rad | m] -> (4, 4) motion of the moving surface from where it rests."""

POINTS = 600  # sampled on either surface
BLOCKED = 0.03  # share of points that may pass through before the motion counts as blocked: modelling slop
_DEEP = 0.003  # of the moving part's size: shallower crossings are surfaces that graze
_SUNK = 6.0  # times that: what rests no deeper in a surface, and comes out of it, was modelled carelessly
_MOST_HITS = 6  # faces that a point may meet in one step
_OPPOSITE = -0.5  # cosine between faces that are the two sides of a board
_STEP = 1e-6  # of the size
# Both ways of all axes, and a little off them: rays along a wall's plane would slip through its edge.
_WAYS = np.concatenate([np.eye(3), -np.eye(3)]) + 0.01 * np.array([0.3, -0.5, 0.7])
_ALONG = 0.3  # sine of the angle up to which a point moves along its own surface


class Sweep:
    """A moving surface and what stays.

    Args:
        vertices: (V, 3) of both, at rest.
        moving: (F, 3) vertex indices of the faces that move, F > 0.
        still: (G, 3) those of the faces that do not.
        seed: of the sampling.
        holes: whether what stands in the other at rest has a hole there, modelled or not: rods in sleeves,
            and leaves that are sunk a little in a frame which closes nothing.
    """

    def __init__(
        self, vertices: FloatArray, moving: IntArray, still: IntArray, seed: int = 0, *, holes: bool = False
    ) -> None:
        rng = np.random.default_rng(seed)
        mine, others = vertices[moving], vertices[still]
        lower, upper = bounds_of(mine.reshape(-1, 3))
        reach = float(np.linalg.norm(upper - lower))
        lows, highs = triangle_bounds(others)
        near = ((highs >= lower - reach) & (lows <= upper + reach)).all(axis=1)
        still = still[near]
        self._deep = _DEEP * reach
        self._still, self._moving = _Surface(vertices, still), _Surface(vertices, moving)
        self._mine = _Samples.of(mine, self._still, rng)
        self._others = _Samples.of(others[near], self._moving, rng)
        self._holes = holes

    def blocked(self, motion: Motion, stops: FloatArray) -> FloatArray:
        """(K,) share of points that have passed through the other surface on the way to each stop.

        Args:
            motion: the movement.
            stops: (K,) positions away from 0, in order [rad | m].
        """
        mine = _Paths(self._still, self._mine, self._deep, self._moving if self._holes else None)
        others = _Paths(self._moving, self._others, self._deep, self._still if self._holes else None)
        shares = np.zeros(len(stops))
        for step, stop in enumerate(stops):
            posed = motion(float(stop))
            # Seen from the moving surface, the still points move the other way.
            most = max(mine.advance(posed), others.advance(np.asarray(np.linalg.inv(posed))))
            shares[step] = most / max(len(self._mine.points), 1)
        return shares

    def free(self, motion: Motion, limit: float, steps: int = 30) -> float:
        """Farthest free position between 0 and `limit`, in whole steps [rad | m]."""
        stops = limit * np.arange(1, steps + 1) / steps
        clear = self.blocked(motion, stops) <= BLOCKED
        if clear.all():
            return limit
        count = int(clear.argmin())
        return float(stops[count - 1]) if count else 0.0


def free_range(joint: Joint, sweep: Sweep, steps: int) -> tuple[float, float]:
    """How far a joint can go to either side within its limits [rad | m].

    Args:
        joint: with limits.
        sweep: of what it moves, and all else, in its frame.
        steps: stops on the way to each limit.

    Raises:
        ValueError: the joint has no limits.
    """
    if joint.limits is None:
        raise ValueError(f"joint '{joint.name}' has no limits")
    motion = partial(moved_by, joint)
    lower, upper = (
        sweep.free(motion, end, steps) if end else 0.0 for end in (joint.limits.lower, joint.limits.upper)
    )
    return lower, upper


class _Surface:
    """Faces to run into: connected pieces, of which those that are closed have an inside."""

    def __init__(self, vertices: FloatArray, faces: IntArray) -> None:
        shells = find_shells(vertices, faces)
        triangles = shells.triangles
        self.rays = Rays(shells.vertices, shells.faces)
        self.step = _STEP * self.rays.size  # off a face, lest a ray meet it again
        self.normals = unit_normals(triangles)
        volumes = np.bincount(shells.face_shell, signed_volumes(triangles), shells.count)
        self.pieces = shells.face_shell
        # Wound inward, it may be the inside of a wall: then both ways count.
        self._solid = (shells.closed & (volumes > 0))[shells.face_shell]

    def entered(self, faces: IntArray, hits: FloatArray, ways: FloatArray) -> BoolArray:
        """Whether (N, 3) ways through faces, met at (N, 3) hits, do not just lead out of a solid, or past it.

        A flat outline that was filled to and fro closes nothing: beyond it there is no solid to come out of.
        """
        outward = np.einsum("ni,ni->n", self.normals[faces], ways) > 0
        solid = self._solid[faces]
        beyond = self._comes_out(faces, hits, ways) | self._comes_out(faces, hits, -self.normals[faces])
        return np.asarray(~solid | (~outward & beyond))

    def _comes_out(self, faces: IntArray, hits: FloatArray, ways: FloatArray) -> BoolArray:
        """Whether (N, 3) ways, behind a face, do not miss its piece or enter it again first."""
        ways = ways / np.maximum(np.linalg.norm(ways, axis=1, keepdims=True), 1e-30)
        nexts, _ = self.rays.first(hits + self.step * ways, ways)
        enters = np.einsum("ni,ni->n", self.normals[nexts], ways) < 0
        return np.asarray((nexts >= 0) & ~((self.pieces[nexts] == self.pieces[faces]) & enters))

    def encloses(self, points: FloatArray) -> BoolArray:
        """Whether (N, 3) points are enclosed by one connected piece on all six sides."""
        met = self._around(points, 1)[:, 0]
        return np.asarray((met == met[0]).all(axis=0) & (met[0] >= 0))

    def filled(self, places: FloatArray, ways: FloatArray, near: float) -> BoolArray:
        """Whether one connected piece encloses what is beside (N, 3) places, before and behind on these ways.

        Another piece may be between, as where a rod ends in a knob.
        """
        found = np.zeros(len(places), dtype=bool)
        along = 1.5 * near * ways / np.maximum(np.linalg.norm(ways, axis=1, keepdims=True), 1e-30)
        for side in near * np.concatenate([np.eye(3), -np.eye(3)]):
            left = np.flatnonzero(~found)
            if not len(left):
                break
            both = np.concatenate([places[left] + side + along[left], places[left] + side - along[left]])
            met = self._around(both, 2)
            inside = [(met == one).any(axis=1).all(axis=0) & (one >= 0) for one in met[0]]
            found[left] = np.any(inside, axis=0).reshape(2, -1).all(axis=0)
        return found

    def _around(self, points: FloatArray, count: int) -> IntArray:
        """(6, count, N) pieces that are met first from (N, 3) points along both ways of all axes, or -1."""
        met = np.full((count, 6 * len(points)), -1, dtype=np.int64)
        ways, going = np.repeat(_WAYS, len(points), axis=0), np.arange(6 * len(points))
        start = np.tile(points, (6, 1))
        for row in met:
            faces, distance = self.rays.first(start, ways)
            there = faces >= 0
            start = (start + (distance + self.step)[:, None] * ways)[there]
            ways, going = ways[there], going[there]
            row[going] = self.pieces[faces[there]]
        return met.reshape(count, 6, len(points)).transpose(1, 0, 2)


@dataclass(frozen=True, eq=False)
class _Samples:
    """Points of a surface.

    Attributes:
        points: (N, 3) at rest.
        normals: (N, 3) of unit length.
    """

    points: FloatArray
    normals: FloatArray

    @classmethod
    def of(cls, triangles: FloatArray, other: _Surface, rng: np.random.Generator) -> _Samples:
        """Of (F, 3, 3) triangles; what lies inside the other at rest, as knuckles do, only leaves it."""
        faces, points = sample_faces(triangles, POINTS, rng)
        outside = ~other.encloses(points)
        return cls(points[outside], unit_normals(triangles[faces[outside]]))


class _Paths:
    """Points on their way, and which of them have gone deep through a surface.

    One that comes out again before it was deep has grazed an edge, and is as free as before; but one that
    comes out on the far side is through something thin.
    """

    def __init__(self, target: _Surface, samples: _Samples, deep: float, own: _Surface | None) -> None:
        points = samples.points
        self._target, self._points, self._deep = target, points, deep
        self._own = own  # of the points, where what slides on in what it fills at rest is not stopped
        self._flat, self._normals = np.zeros(len(points), dtype=bool), samples.normals
        self._fits = np.zeros(len(points), dtype=bool)  # within what its own surface fills at rest
        self._now, self._lead = points, 1.0
        self._within = np.full(len(points), -1, dtype=np.int64)  # piece that a point is in, -1 for none
        self._passed = np.zeros(len(points), dtype=bool)
        self._hit = np.zeros_like(points)
        self._normal = np.zeros_like(points)
        self._sense = np.zeros(len(points))

    def advance(self, pose: FloatArray) -> int:
        """Move to a (4, 4) pose; returns how many points have passed through so far."""
        if not len(self._points):
            return 0
        start, self._now = self._now, move(pose, self._points)
        way = self._now - start
        if self._own is not None:
            speed = np.einsum("ni,ni->n", way, self._normals @ pose[:3, :3].T)
            self._flat = np.abs(speed) < _ALONG * np.linalg.norm(way, axis=1)
        # A point that touches at rest starts a little way off the surface; every later step of it starts a
        # little way back, lest a surface just where two steps meet be missed.
        length = np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-30)
        start = start + self._lead * way * np.minimum(0.03 * self._deep / length, 0.5)
        self._lead = -1.0
        going: IntArray = np.flatnonzero(~self._passed)
        for _ in range(_MOST_HITS):
            if not len(going):
                break
            going, start = self._meet(going, start, way)
        depth = np.abs(np.einsum("ij,ij->i", self._now - self._hit, self._normal))
        self._passed |= (self._within >= 0) & ~self._fits & (depth > self._deep)
        return int(self._passed.sum())

    def _meet(self, going: IntArray, start: FloatArray, way: FloatArray) -> tuple[IntArray, FloatArray]:
        """Take (G,) points to the next face on their way; which of them go on, and (N, 3) where from."""
        faces, distance = self._target.rays.first(start[going], (self._now - start)[going])
        met = distance <= 1.0
        going, faces, distance = going[met], faces[met], distance[met, None]
        if not len(going):
            return going, start
        target, rest, within = self._target, self._now[going] - start[going], self._within[going]
        hit, normal = start[going] + rest * distance, target.normals[faces]
        sense = np.sign(np.einsum("ni,ni->n", normal, way[going]))
        enters = within < 0
        enters[enters] = target.entered(faces[enters], hit[enters], way[going][enters])
        leaves = (within == target.pieces[faces]) & (sense * self._sense[going] < 0)
        depth = np.abs(np.einsum("ni,ni->n", hit - self._hit[going], self._normal[going]))
        through = np.einsum("ni,ni->n", normal, self._normal[going]) < _OPPOSITE
        self._passed[going] |= leaves & ~self._fits[going] & (through | (depth > self._deep))
        self._within[going[leaves]] = -1
        inside = going[enters]
        self._within[inside], self._sense[inside] = target.pieces[faces[enters]], sense[enters]
        self._hit[inside], self._normal[inside] = hit[enters], normal[enters]
        self._fits[inside] = False
        if self._own is not None:
            sunk = np.abs(np.einsum("ni,ni->n", hit - self._points[going], normal)) < _SUNK * self._deep
            may_fit = enters & (self._flat[going] | ((sense > 0) & sunk))
            self._fits[going[may_fit]] = self._own.filled(hit[may_fit], way[going][may_fit], self._deep)
        length = np.maximum(np.linalg.norm(rest, axis=1, keepdims=True), 1e-30)
        start = start.copy()
        start[going] = hit + rest * np.minimum(target.step / length, 1.0)
        return going, start


def sample_surface(triangles: FloatArray, count: int, rng: np.random.Generator) -> FloatArray:
    """(N, 3) points spread over triangles by area, N = count, or 0 where there is no surface."""
    return sample_faces(triangles, count, rng)[1]


def sample_faces(triangles: FloatArray, count: int, rng: np.random.Generator) -> tuple[IntArray, FloatArray]:
    """(N,) triangles chosen by area and (N, 3) a point on each, N = count, or 0 where there is no surface."""
    area = areas(triangles)
    if not area.sum() > 0:
        return np.zeros(0, dtype=np.int64), np.zeros((0, 3))
    # Evenly spaced in cumulated area: no large face is missed by chance.
    places = (np.arange(count) + rng.random(count)) / count
    chosen = np.searchsorted(np.cumsum(area) / area.sum(), places).clip(max=len(triangles) - 1)
    start, edges = triangles[chosen, 0], triangles[chosen, 1:] - triangles[chosen, :1]
    u, v = rng.random((2, count, 1))
    folded = u + v > 1
    u, v = np.where(folded, 1 - u, u), np.where(folded, 1 - v, v)
    return chosen, np.asarray(start + u * edges[:, 0] + v * edges[:, 1])


def move(matrix: FloatArray, points: FloatArray) -> FloatArray:
    """(N, 3) points moved by a (4, 4) transform."""
    return np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3])
