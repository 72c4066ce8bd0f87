"""Polygons: their areas, which way they face, and whether they enclose a solid from outside."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import FloatArray, IntArray
from ..topology import weld
from ..triangles import crosses


@dataclass(frozen=True, eq=False)
class Faces:
    """Polygons of a mesh, whose indices are in range.

    Attributes:
        points: (V, 3).
        counts: (F,) corners of each face, 3 or more.
        indices: (N,) points of the corners, face after face.
        clockwise: whether a face is seen from outside when its corners run clockwise.
    """

    points: FloatArray
    counts: IntArray
    indices: IntArray
    clockwise: bool

    @cached_property
    def triangles(self) -> tuple[IntArray, IntArray]:
        """(T, 3) points of the fans that faces are made of, outward; and (T,) the face of each."""
        starts = np.cumsum(self.counts) - self.counts
        owners = np.repeat(np.arange(len(self.counts)), self.counts - 2)
        step = np.arange(len(owners)) - np.repeat(
            np.cumsum(self.counts - 2) - (self.counts - 2), self.counts - 2
        )
        first = starts[owners]
        corners = np.stack(
            [self.indices[first], self.indices[first + step + 1], self.indices[first + step + 2]]
        )
        return (corners[::-1].T if self.clockwise else corners.T), owners

    @cached_property
    def normals(self) -> FloatArray:
        """(F, 3) outward normals, twice as long as the areas."""
        corners, owners = self.triangles
        found = np.zeros((len(self.counts), 3))
        np.add.at(found, owners, crosses(self.points[corners]))
        return found

    @cached_property
    def areas(self) -> FloatArray:
        """(F,) areas."""
        return np.asarray(0.5 * np.linalg.norm(self.normals, axis=1))

    @cached_property
    def squared_size(self) -> float:
        """Squared diagonal of the points' box."""
        return float(np.square(np.ptp(self.points, axis=0)).sum())

    def share_against(self, corner_normals: FloatArray) -> float:
        """Share of the area of faces that (N, 3) normals of their corners point away from, 0..1."""
        starts = np.cumsum(self.counts) - self.counts
        along = np.einsum("ij,ij->i", np.add.reduceat(corner_normals, starts), self.normals)
        return float(self.areas[along < 0].sum() / max(self.areas.sum(), 1e-300))


def is_wound_inwards(faces: Faces) -> bool:
    """Whether a closed mesh encloses a negative volume; open ones have no inside."""
    ids = weld(faces.points, 1e-6 * faces.squared_size**0.5)
    corners = ids[faces.triangles[0]].astype(np.int64)
    solid = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    if not solid.any() or not _is_closed(corners[solid]):
        return False
    tips = faces.points[faces.triangles[0][solid]] - faces.points.mean(axis=0)
    volume = float(np.einsum("ij,ij->", crosses(tips), tips[:, 0]) / 6)
    return volume < -1e-9 * math.pow(faces.squared_size, 1.5)


def _is_closed(corners: IntArray) -> bool:
    """Whether each edge of (T, 3) triangles is walked as often one way as the other."""
    start, end = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    count = int(corners.max()) + 1
    forth, back = np.sort(start * count + end), np.sort(end * count + start)
    return bool((forth == back).all())
