"""The object as pieces in a frame whose axes follow its faces, one unit across."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.bounds import bounds_by, bounds_of
from simart_kit.mesh import Mesh
from simart_kit.rays import Rays

from .aligned import Aligned, aligned

# Directions that something may open to, as rows (u, v, w): u across, v up, w outward. The last opens upward.
FACINGS: dict[str, FloatArray] = {
    "front": np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]),
    "back": np.array([[-1.0, 0, 0], [0, 0, 1], [0, 1, 0]]),
    "left": np.array([[0, -1.0, 0], [0, 0, 1], [-1, 0, 0]]),
    "right": np.array([[0, 1.0, 0], [0, 0, 1], [1, 0, 0]]),
    "top": np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1]]),
}


@dataclass(frozen=True, eq=False)
class Box:
    """An axis-aligned box.

    Attributes:
        lower: (3,) corner.
        upper: (3,) corner.
    """

    lower: FloatArray
    upper: FloatArray

    @cached_property
    def _corners(self) -> tuple[list[float], list[float]]:
        """The corners as plain numbers, many times as quick to compare one by one."""
        return self.lower.tolist(), self.upper.tolist()

    @classmethod
    def around(cls, boxes: Sequence[Box]) -> Box:
        """The box of some boxes, of one at least."""
        return cls(np.min([box.lower for box in boxes], axis=0), np.max([box.upper for box in boxes], axis=0))

    @property
    def size(self) -> FloatArray:
        """(3,) extents."""
        return self.upper - self.lower

    @property
    def center(self) -> FloatArray:
        """(3,) middle."""
        return (self.lower + self.upper) / 2

    def turned(self, facing: FloatArray) -> Box:
        """The box along the axes of a facing (a signed permutation)."""
        corners = np.stack([facing @ self.lower, facing @ self.upper])
        return Box(corners.min(axis=0), corners.max(axis=0))

    def lies_in(self, other: Box, margin: float, share: float = 0.0) -> bool:
        """Whether the rectangle of its first two axes lies in that of another.

        Args:
            other: the larger one.
            margin: how far it may stick out.
            share: of its own width that it may stick out to the sides, and of its height up and down.
        """
        (x, y, _), (far_x, far_y, _) = self._corners
        (other_x, other_y, _), (other_far_x, other_far_y, _) = other._corners
        across, up = max(margin, share * (far_x - x)), max(margin, share * (far_y - y))
        return (
            x >= other_x - across
            and far_x <= other_far_x + across
            and y >= other_y - up
            and far_y <= other_far_y + up
        )

    def overlap(self, other: Box, margin: float) -> bool:
        """Whether the boxes come within `margin` of each other."""
        (x, y, z), (far_x, far_y, far_z) = self._corners
        (other_x, other_y, other_z), (other_far_x, other_far_y, other_far_z) = other._corners
        return (
            x - margin <= other_far_x
            and other_x - margin <= far_x
            and y - margin <= other_far_y
            and other_y - margin <= far_y
            and z - margin <= other_far_z
            and other_z - margin <= far_z
        )


@dataclass(frozen=True, eq=False)
class Scene:
    """Faces in the aligned frame, grouped into pieces.

    Attributes:
        surface: the faces.
        labels: (F,) piece of each face, 0..count-1.
        count: number of pieces.
    """

    surface: Aligned
    labels: IntArray
    count: int

    @property
    def vertices(self) -> FloatArray:
        """(V, 3); the object's diagonal is 1."""
        return self.surface.vertices

    @property
    def faces(self) -> IntArray:
        """(F, 3) vertex indices."""
        return self.surface.faces

    @property
    def triangles(self) -> FloatArray:
        """(F, 3, 3) corners."""
        return self.surface.triangles

    @property
    def rays(self) -> Rays:
        """All faces, for casting."""
        return self.surface.rays

    @property
    def face_areas(self) -> FloatArray:
        """(F,) area of each face."""
        return self.surface.face_areas

    @property
    def normals(self) -> FloatArray:
        """(F, 3) unit normals, zero where a face has no area."""
        return self.surface.normals

    @property
    def size(self) -> float:
        """Diagonal of the object [m]."""
        return self.surface.size

    @cached_property
    def bounds(self) -> FloatArray:
        """(count, 2, 3) lower and upper corner of each piece."""
        return bounds_by(self.triangles, self.labels)

    @cached_property
    def boxes(self) -> tuple[Box, ...]:
        """The bounding box of each piece."""
        return tuple(Box(low, high) for low, high in self.bounds)

    @cached_property
    def box(self) -> Box:
        """The bounding box of everything."""
        return Box(*bounds_of(self.triangles.reshape(-1, 3)))

    @cached_property
    def areas(self) -> FloatArray:
        """(count,) surface of each piece."""
        return np.asarray(np.bincount(self.labels, self.face_areas, self.count), dtype=np.float64)

    def points_of(self, piece: int) -> FloatArray:
        """(N, 3) corners of the triangles of a piece, each as often as it is one."""
        return np.asarray(self.triangles[self.labels == piece].reshape(-1, 3))

    def rays_of(self, piece: int) -> Rays:
        """The faces of a piece, for casting."""
        if piece not in self._rays:
            self._rays[piece] = Rays(self.vertices, self.faces[self.labels == piece])
        return self._rays[piece]

    @cached_property
    def _rays(self) -> dict[int, Rays]:
        return {}

    def faces_of(self, pieces: IntArray | tuple[int, ...]) -> IntArray:
        """Indices of the faces of some pieces."""
        return np.flatnonzero(np.isin(self.labels, np.asarray(pieces)))

    def points_to_asset(self, points: FloatArray) -> FloatArray:
        """(N, 3) aligned points in the asset frame [m]."""
        return points * self.size @ self.surface.from_asset + self.surface.origin

    def vector_to_asset(self, vector: FloatArray) -> FloatArray:
        """(3,) aligned direction in the asset frame."""
        return vector @ self.surface.from_asset


def make_scene(mesh: Mesh, labels: IntArray) -> Scene:
    """Put a mesh and its (F,) labels 0..N-1 into the aligned frame."""
    return Scene(aligned(mesh), np.asarray(labels), int(labels.max()) + 1)
