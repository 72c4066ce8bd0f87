"""Ray casting on the CPU by Embree: which triangle a ray meets first, and whether anything is in its way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .arrays import BoolArray, Float32Array, FloatArray, IntArray
from .bounds import bounds_of
from .topology import without_gaps


@dataclass(frozen=True, eq=False)
class Hits:
    """What each ray met first.

    Attributes:
        face: (N,) index of the triangle, -1 for none.
        distance: (N,) in lengths of the direction; infinite where nothing was met.
        weights: (N, 3) barycentric weights of the triangle's corners.
    """

    face: IntArray
    distance: Float32Array
    weights: Float32Array

    def only(self, keep: BoolArray) -> Hits:
        """Those of some of the rays."""
        return Hits(self.face[keep], self.distance[keep], self.weights[keep])

    def joined(self, other: Hits) -> Hits:
        """Those of these rays, then of others."""
        names = ("face", "distance", "weights")
        return Hits(*(np.concatenate([getattr(self, n), getattr(other, n)]) for n in names))


class Rays:
    """Casts rays at triangles. Embree works in float32, so it is given them centred and of unit size.

    Args:
        vertices: (V, 3); those that no face uses do not count.
        faces: (F, 3) vertex indices.

    Attributes:
        center: (3,) middle of the faces' bounding box.
        size: its diagonal; 1 where that is 0.
    """

    def __init__(self, vertices: FloatArray, faces: IntArray) -> None:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        used, corners = without_gaps(faces)
        points = vertices[used] if len(faces) else np.zeros((1, 3))
        lower, upper = bounds_of(points)
        self.center = (lower + upper) / 2
        self.size = float(np.linalg.norm(upper - lower)) or 1.0
        self._empty = not len(faces)
        self._scene: Any = EmbreeScene()
        if not self._empty:
            # Kept, for the scene does not own it. Embreex takes its time for each number that it is given:
            # shared corners save half of it.
            self._mesh = TriangleMesh(self._scene, self._local(points), corners.astype(np.int32))

    def first(self, origins: FloatArray, directions: FloatArray) -> tuple[IntArray, FloatArray]:
        """First triangle that each ray meets, from either side.

        Args:
            origins: (N, 3).
            directions: (N, 3), or (3,) for all.

        Returns:
            (N,) triangle, -1 for none, and (N,) distance in lengths of the direction, infinite for none.
        """
        face, distance, _, _ = self._met(origins, directions)
        return face, distance.astype(np.float64)

    def hits(self, origins: ArrayLike, directions: ArrayLike) -> Hits:
        """As `first`, with the place on the triangle."""
        face, distance, u, v = self._met(origins, directions)
        weights = (
            np.zeros((len(face), 3), dtype=np.float32) if self._empty else np.stack([1 - u - v, u, v], 1)
        )
        return Hits(face, distance, weights)

    def _met(
        self, origins: ArrayLike, directions: ArrayLike
    ) -> tuple[IntArray, Float32Array, Float32Array, Float32Array]:
        """(N,) face, distance, and weights of the triangle's last two corners."""
        start = self._local(origins)
        if self._empty:
            nothing = np.zeros(len(start), dtype=np.float32)
            return np.full(len(start), -1, dtype=np.int32), nothing + np.inf, nothing, nothing
        found = self._scene.run(start, _towards(directions, start), query="INTERSECT", output=True)
        face = found["primID"]
        distance = np.where(face >= 0, found["tfar"], np.float32(np.inf)) * np.float32(self.size)
        return face, distance, found["u"], found["v"]

    def blocked(self, origins: ArrayLike, directions: ArrayLike, reach: float | None = None) -> BoolArray:
        """(N,) whether each ray meets a triangle within `reach` lengths of its direction, or anywhere."""
        start = self._local(origins)
        if self._empty:
            return np.zeros(len(start), dtype=np.bool_)
        limit = np.full(len(start), np.inf if reach is None else reach / self.size, dtype=np.float32)
        found = self._scene.run(start, _towards(directions, start), dists=limit, query="OCCLUDED")
        return np.asarray(found >= 0)

    def _local(self, points: ArrayLike) -> Float32Array:
        values = np.asarray(points, dtype=np.result_type(points, np.float32))
        moved = (values - self.center.astype(values.dtype)) * values.dtype.type(1 / self.size)
        return np.ascontiguousarray(moved, dtype=np.float32)


def _towards(directions: ArrayLike, start: Float32Array) -> Float32Array:
    if np.shape(directions) != start.shape:  # asked first, for broadcasting takes as long as a hundred rays
        directions = np.broadcast_to(directions, start.shape)
    return np.ascontiguousarray(directions, dtype=np.float32)
