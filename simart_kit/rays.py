"""First hits of rays on triangles, by embree."""

from __future__ import annotations

from typing import Any

import numpy as np

from .arrays import FloatArray, IntArray

_CHUNK = 1 << 18  # rays a call: embreex copies its inputs


class Rays:
    """Triangles that rays can be cast at.

    Args:
        triangles: (F, 3, 3) corners.
    """

    def __init__(self, triangles: FloatArray) -> None:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        self._scene: Any = EmbreeScene()
        if len(triangles):
            # The scene does not keep the mesh object alive by itself.
            self._mesh = TriangleMesh(self._scene, np.ascontiguousarray(triangles, dtype=np.float32))
        self._empty = not len(triangles)

    def first(self, origins: FloatArray, directions: FloatArray) -> tuple[IntArray, FloatArray]:
        """First triangle that each ray meets, from either side.

        Args:
            origins: (N, 3).
            directions: (N, 3), or (3,) for all.

        Returns:
            (N,) triangle, -1 for none, and (N,) distance in lengths of the direction, infinite for none.
        """
        directions = np.broadcast_to(directions, origins.shape)
        faces = np.full(len(origins), -1, dtype=np.int32)
        distances = np.full(len(origins), np.inf)
        for start in range(0, 0 if self._empty else len(origins), _CHUNK):
            part = slice(start, start + _CHUNK)
            found = self._scene.run(
                np.ascontiguousarray(origins[part], dtype=np.float32),
                np.ascontiguousarray(directions[part], dtype=np.float32),
                output=True,
            )
            faces[part] = found["primID"]
            distances[part] = np.where(found["primID"] >= 0, found["tfar"], np.inf)
        return faces, distances
