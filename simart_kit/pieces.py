"""Solids that convex shapes are to stand for."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .arrays import FloatArray, IntArray
from .asset import ConvexMesh
from .hulls import convex_hull, hull_corners, hull_of, volume
from .topology import without_gaps

if TYPE_CHECKING:
    from manifold3d import Manifold

# How far the surface of a solid may move, of its diagonal, where it still has more than so many faces.
_TOLERANCES = ((0.0005, 1200), (0.001, 1200), (0.002, 1200), (0.004, 3000), (0.006, 3000))
_LOST = 0.15  # of its volume that it may lose or gain so


@dataclass(frozen=True, eq=False)
class Piece:
    """A solid to be stood for by convex shapes.

    Attributes:
        points: (N, 3) that its convex hull is around [m].
        volume: of the solid [m^3].
        hull_volume: of the hull [m^3].
        body: the solid itself; None where it is taken for its hull.
    """

    points: FloatArray
    volume: float
    hull_volume: float
    body: Manifold | None

    @property
    def excess(self) -> float:
        """What the hull holds besides the solid [m^3]."""
        return self.hull_volume - self.volume

    @cached_property
    def hull(self) -> ConvexMesh | None:
        """The hull of its points; None when they lie in a plane."""
        return hull_of(self.points)

    @cached_property
    def lower(self) -> FloatArray:
        """(3,) lowest coordinates [m]."""
        return np.asarray(self.points.min(axis=0))

    @cached_property
    def upper(self) -> FloatArray:
        """(3,) highest coordinates [m]."""
        return np.asarray(self.points.max(axis=0))


def piece_of(body: Manifold) -> Piece:
    """The piece of a solid."""
    hull = body.hull()
    return Piece(np.asarray(hull.to_mesh64().vert_properties[:, :3]), body.volume(), hull.volume(), body)


def hulled(points: FloatArray) -> Piece:
    """The piece that fills the hull of (N, 3) points; it keeps only the corners of that."""
    found = hull_corners(points)
    corners = points if found is None else found[0]
    shape = convex_hull(corners, max(len(corners), 8))
    return Piece(corners, volume(shape), volume(shape), None)


def solid_body(vertices: FloatArray, faces: IntArray) -> Manifold | None:
    """The solid within closed (F, 3) faces, whichever way they are wound; None when there is none."""
    import manifold3d

    used, corners = without_gaps(faces)
    if not _closes(corners, len(used)):  # Manifold does not refuse all of these: some end the process
        return None
    for wound in (corners, corners[:, ::-1]):
        mesh = manifold3d.Mesh64(np.ascontiguousarray(vertices[used]), wound.astype(np.uint64))
        body = manifold3d.Manifold(mesh)
        if body.status() != manifold3d.Error.NoError:
            return None
        if body.volume() > 0:
            return body
    return None


def _closes(faces: IntArray, count: int) -> bool:
    """Whether each edge of (F, 3) faces between `count` points is walked one way as often as the other."""
    start, end = faces.ravel().astype(np.int64), faces[:, [1, 2, 0]].ravel().astype(np.int64)
    return np.array_equal(np.sort(start * count + end), np.sort(end * count + start))


def simpler(body: Manifold) -> Manifold:
    """A solid of many faces with fewer, its surface moved by little: what cutting costs is counted in faces.

    Tolerances grow only while there are still many: what is flat or finely curved stays all but exact. Where
    one takes much of the solid, as of thin walls, the last one that did not is kept.
    """
    size = float(np.linalg.norm(np.subtract(body.bounding_box()[3:], body.bounding_box()[:3])))
    solid = body.volume()
    for tolerance, many in _TOLERANCES:
        if body.num_tri() <= many:
            break
        fewer = body.simplify(tolerance * size)
        if abs(fewer.volume() - solid) > _LOST * solid:
            break
        body = fewer
    return body
