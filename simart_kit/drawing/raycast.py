"""Ray casting on the CPU by Embree: which face a ray meets first, and whether anything is in its way."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arrays import BoolArray, FloatArray, IntArray

Float32Array = NDArray[np.float32]
"""Rays and samples: Embree's own precision, and half the memory."""


@dataclass(frozen=True, eq=False)
class Hits:
    """What each ray met first.

    Attributes:
        face: (N,) index of the face, -1 for none.
        distance: (N,) along the unit direction [m]; undefined where nothing was met.
        weights: (N, 3) barycentric weights of the face's corners.
    """

    face: IntArray
    distance: Float32Array
    weights: Float32Array


class Caster:
    """Casts rays at triangles. Embree works in float32, so it is given the mesh centred and of unit size.

    Args:
        vertices: (V, 3) [m].
        faces: (F, 3).
    """

    def __init__(self, vertices: FloatArray, faces: IntArray) -> None:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        used = vertices[faces.ravel()] if len(faces) else np.zeros((1, 3))
        lower, upper = used.min(axis=0), used.max(axis=0)
        self.center = (lower + upper) / 2
        self.size = float(np.linalg.norm(upper - lower)) or 1.0
        self._empty = len(faces) == 0
        self._scene: Any = EmbreeScene()
        if not self._empty:
            indices = np.ascontiguousarray(faces, dtype=np.int32)
            # Kept, for the scene does not own it.
            self._mesh = TriangleMesh(self._scene, self._local(vertices), indices)

    def first(self, origins: ArrayLike, directions: ArrayLike) -> Hits:
        """The first face that each ray meets, from either side: (N, 3) origins [m] and unit directions."""
        start = self._local(origins)
        if self._empty:
            nothing = np.zeros((len(start), 3), dtype=np.float32)
            return Hits(np.full(len(start), -1, dtype=np.int32), nothing[:, 0], nothing)
        found = self._scene.run(start, _packed(directions), query="INTERSECT", output=True)
        u, v = found["u"], found["v"]
        distance = found["tfar"] * np.float32(self.size)
        return Hits(found["primID"], distance, np.stack([1 - u - v, u, v], axis=1))

    def blocked(self, origins: ArrayLike, directions: ArrayLike, reach: float | None = None) -> BoolArray:
        """(N,) whether each ray meets a face within `reach` [m], or anywhere."""
        start = self._local(origins)
        if self._empty:
            return np.zeros(len(start), dtype=np.bool_)
        limit = np.full(len(start), np.inf if reach is None else reach / self.size, dtype=np.float32)
        found = self._scene.run(start, _packed(directions), dists=limit, query="OCCLUDED")
        return np.asarray(found >= 0)

    def _local(self, points: ArrayLike) -> Float32Array:
        values = np.asarray(points, dtype=np.result_type(points, np.float32))
        return _packed((values - self.center.astype(values.dtype)) * values.dtype.type(1 / self.size))


def _packed(values: ArrayLike) -> Float32Array:
    return np.ascontiguousarray(values, dtype=np.float32)
