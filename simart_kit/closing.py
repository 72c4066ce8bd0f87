"""The solids that shells stand for: closed ones exactly, nearly closed ones capped, sheets as thin boards."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from .arrays import FloatArray, IntArray, units
from .hulls import convex_hull, hull_of, volume
from .shells import Shells
from .topology import connected, neighbours, without_gaps
from .triangles import areas, crosses, unit_normals

if TYPE_CHECKING:
    from manifold3d import Manifold

SHEET = 0.004
"""Thickness of the board that a patch of an open sheet becomes [m]."""

_THIN_WALLED = 0.5  # of its hull: a capped solid below this has walls, and is not a filled box
_LID = 0.1  # of its area that caps may have for a solid to be closed at all
_BOARD, _SLENDERNESS = 0.01, 0.1  # [m], and of the square root of its area: what a sheet stands for at most
_LENS = 1.5  # times the board that an open shell stands for: a hull below this is what the shell is
# Least cosine in a flat patch, the next one where there would be more boards than this.
_FLAT_PATCHES = tuple(float(np.cos(np.radians(angle))) for angle in (15.0, 30.0, 45.0, 60.0))
_MOST_BOARDS = 400
_MOST_PATCHES = 64


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
    """The piece that fills the hull of (N, 3) points."""
    shape = convex_hull(points, max(len(points), 8))
    return Piece(points, volume(shape), volume(shape), None)


def pieces_of(shells: Shells) -> list[Piece]:
    """Solids for all shells, in their order; a sheet gives one for each of its flat patches."""
    found = []
    for index, (faces, points) in enumerate(zip(shells.split(), shells.points(), strict=True)):
        if len(points):
            corners = shells.faces[faces]
            found += _pieces(shells.vertices, corners, points, closed=bool(shells.closed[index]))
    return found


def solid_body(vertices: FloatArray, faces: IntArray) -> Manifold | None:
    """The solid within closed (F, 3) faces, whichever way they are wound; None when there is none."""
    import manifold3d

    used, corners = without_gaps(faces)
    for wound in (corners, corners[:, ::-1]):
        mesh = manifold3d.Mesh64(np.ascontiguousarray(vertices[used]), wound.astype(np.uint64))
        body = manifold3d.Manifold(mesh)
        if body.status() != manifold3d.Error.NoError:
            return None
        if body.volume() > 0:
            return body
    return None


def _pieces(vertices: FloatArray, faces: IntArray, points: FloatArray, closed: bool) -> list[Piece]:
    hull = hull_of(points)
    if hull is None:
        return _sheet(vertices, faces, points.mean(axis=0))
    body = solid_body(vertices, faces) if closed else None
    if body is not None:
        return [piece_of(body)]
    area = float(areas(vertices[faces]).sum())
    board = min(_BOARD, _SLENDERNESS * np.sqrt(area)) * area
    if volume(hull) < _LENS * board:
        return [hulled(points)]
    capped_body = _capped(vertices, faces, area)
    return [piece_of(capped_body)] if capped_body else _sheet(vertices, faces, points.mean(axis=0))


def _capped(vertices: FloatArray, faces: IntArray, area: float) -> Manifold | None:
    """The solid of an open shell whose holes are small, or that has walls once they are closed."""
    loops = _loops(_rim(faces))
    if loops is None:
        return None
    lids = [_lid(vertices, loop) for loop in loops]
    body = solid_body(vertices, np.concatenate([faces, *lids]))
    if body is None:
        return None
    small = sum(float(areas(vertices[lid]).sum()) for lid in lids) < _LID * area
    return body if small or body.volume() < _THIN_WALLED * body.hull().volume() else None


def _loops(rim: IntArray) -> list[IntArray] | None:
    """The corners of each hole, in the order that closes it; None where holes touch."""
    following = dict(rim[:, ::-1].tolist())
    if len(following) != len(rim) or set(following) != set(following.values()):
        return None
    loops = []
    while following:
        corner, found = next(iter(following)), []
        while corner in following:
            found.append(corner)
            corner = following.pop(corner)
        loops.append(np.array(found))
    return loops


def _lid(vertices: FloatArray, loop: IntArray) -> IntArray:
    """(F, 3) faces over a hole, seen along the way that it looks."""
    import manifold3d

    local = vertices[loop] - vertices[loop].mean(axis=0)
    normal = np.cross(local, np.roll(local, -1, axis=0)).sum(axis=0)
    length = float(np.linalg.norm(normal))
    if length < 1e-12:
        return np.array([(loop[0], loop[i], loop[i + 1]) for i in range(1, len(loop) - 1)])
    across = units(np.cross(normal, np.eye(3)[np.abs(normal).argmin()])[None])[0]
    flat = np.column_stack([local @ across, local @ np.cross(normal / length, across)])
    return np.asarray(loop[np.asarray(manifold3d.triangulate([flat]), dtype=np.int64)])


def _rim(faces: IntArray) -> IntArray:
    """(E, 2) edges that are walked one way only, as they are walked."""
    ways = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
    count = int(faces.max()) + 1
    there, back = ways @ [count, 1], ways @ [1, count]
    return np.asarray(ways[~np.isin(there, back)])


def _sheet(vertices: FloatArray, faces: IntArray, middle: FloatArray) -> list[Piece]:
    """A board for each flat patch of a sheet, on the side of `middle`: outside, nothing stands out."""
    found = []
    for patch in _flat_patches(vertices, faces):
        corners = faces[patch]
        normal = crosses(vertices[corners]).sum(axis=0)
        length = float(np.linalg.norm(normal))
        if length == 0:
            continue
        normal /= length
        inward = float(normal @ (middle - vertices[corners].mean(axis=(0, 1))))
        flat_enough = abs(inward) < SHEET / 2
        step = -normal * SHEET if flat_enough or inward < 0 else normal * SHEET
        found.append(_board(vertices, corners, step))
    return found or [hulled(vertices[np.unique(faces)])]


def _board(vertices: FloatArray, faces: IntArray, step: FloatArray) -> Piece:
    """The prism between a patch and itself moved by (3,) `step`."""
    used, corners = without_gaps(faces)
    points, count = vertices[used], len(used)
    one, two = _rim(corners).T
    sides = np.concatenate(
        [np.column_stack([two, one, one + count]), np.column_stack([two, one + count, two + count])]
    )
    solid = np.concatenate([corners, corners[:, ::-1] + count, sides])
    both = np.concatenate([points, points + step])
    body = solid_body(both, solid)
    return hulled(both) if body is None else piece_of(body)


def _flat_patches(vertices: FloatArray, faces: IntArray) -> list[IntArray]:
    """The faces of each flat patch; of a rough sheet, the less flat ones without which there are too many."""
    for flat in _FLAT_PATCHES:
        patch = _patches(vertices, faces, flat)
        if int(patch.max()) < _MOST_BOARDS:
            break
    order = np.argsort(patch, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(patch[order])) + 1)


def _patches(vertices: FloatArray, faces: IntArray, flat: float) -> IntArray:
    """(F,) labels of connected faces that look the same way, the largest faces first."""
    triangles = vertices[faces]
    normals, area = unit_normals(triangles), areas(triangles)
    way = np.full(len(faces), -1)
    for label in range(_MOST_PATCHES):
        left = np.flatnonzero(way < 0)
        if not len(left):
            break
        lead = left[int(area[left].argmax())]
        way[left[normals[left] @ normals[lead] >= flat]] = label
        way[lead] = label
    _, one, two = neighbours(faces)
    same = way[one] == way[two]
    return connected(len(faces), one[same], two[same])
