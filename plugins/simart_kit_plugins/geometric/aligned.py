"""The object's faces in a frame whose axes follow them, one unit across."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from simart_kit.alignment import straight_from_asset
from simart_kit.arrays import FloatArray, IntArray
from simart_kit.kept import kept
from simart_kit.mesh import Mesh
from simart_kit.rays import Rays


@dataclass(frozen=True, eq=False)
class Aligned:
    """Faces in the aligned frame, whatever pieces they are grouped into.

    Attributes:
        vertices: (V, 3); the object's diagonal is 1.
        faces: (F, 3) vertex indices.
        from_asset: (3, 3) rotation, mostly about the vertical.
        size: diagonal of the object [m].
        origin: (3,) point of the asset frame that is the aligned frame's origin [m].
    """

    vertices: FloatArray
    faces: IntArray
    from_asset: FloatArray
    size: float
    origin: FloatArray

    @cached_property
    def triangles(self) -> FloatArray:
        """(F, 3, 3) corners."""
        return np.asarray(self.vertices[self.faces])

    @cached_property
    def rays(self) -> Rays:
        """All faces, for casting."""
        return Rays(self.vertices, self.faces)

    @cached_property
    def face_areas(self) -> FloatArray:
        """(F,) area of each face."""
        return np.asarray(np.linalg.norm(self._crosses, axis=1) / 2)

    @cached_property
    def normals(self) -> FloatArray:
        """(F, 3) unit normals, zero where a face has no area."""
        return self._crosses / np.maximum(2 * self.face_areas[:, None], 1e-30)

    @cached_property
    def _crosses(self) -> FloatArray:
        edges = self.triangles[:, 1:] - self.triangles[:, :1]
        return np.cross(edges[:, 0], edges[:, 1])


@kept
def aligned(mesh: Mesh) -> Aligned:
    """The faces of a mesh in the aligned frame; whoever looks at its pieces shares them."""
    turn = straight_from_asset(mesh)
    origin = mesh.bounds.mean(axis=0)
    vertices = (mesh.vertices - origin) @ turn.T / mesh.diagonal
    return Aligned(vertices, mesh.faces, turn, mesh.diagonal, origin)
