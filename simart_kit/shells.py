"""A surface as shells: connected pieces, each known to be closed or open.

A piece is closed when its boundary vanishes: every edge is walked as often one way as the other. That is what
the divergence theorem needs, and it holds for surfaces that touch themselves, too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .bounds import bounds_of
from .topology import connected, edges, stable_order, touching, unique_rows, weld, without_gaps
from .triangles import areas

WELD_TOLERANCE = 1e-6, 1e-12  # of the diagonal, and [m] at least
_FLAT = 1e-7  # volume / area^1.5 of a closed piece that encloses nothing, such as the two sides of a sheet


@dataclass(frozen=True, eq=False)
class Shells:
    """A surface cut into pieces, for analysis: coincident vertices are one, repeated faces are left out.

    Attributes:
        vertices: (V, 3) [m].
        faces: (F, 3) vertex indices; wound consistently within a closed shell.
        face_shell: (F,) shell of each triangle, 0..S-1.
        closed: (S,) whether the shell bounds a volume.
    """

    vertices: FloatArray
    faces: IntArray
    face_shell: IntArray
    closed: BoolArray

    @property
    def triangles(self) -> FloatArray:
        """(F, 3, 3) corner positions [m]."""
        return np.asarray(self.vertices[self.faces])

    @property
    def count(self) -> int:
        """Number of shells."""
        return len(self.closed)

    @property
    def areas(self) -> FloatArray:
        """(S,) area of each shell [m^2]."""
        return np.asarray(np.bincount(self.face_shell, areas(self.triangles), self.count))

    def split(self) -> list[IntArray]:
        """Indices of the faces of each shell."""
        order = np.argsort(self.face_shell, kind="stable")
        return np.split(order, np.cumsum(np.bincount(self.face_shell, minlength=self.count))[:-1])

    def points(self) -> list[FloatArray]:
        """(N, 3) vertices of each shell [m]."""
        corners = self.face_shell[:, None].astype(np.int64) * len(self.vertices) + self.faces
        pairs = np.sort(corners, axis=None)
        pairs = pairs[np.diff(pairs, prepend=-1) > 0]
        shell, vertex = np.divmod(pairs, max(len(self.vertices), 1))
        return np.split(self.vertices[vertex], np.searchsorted(shell, np.arange(1, self.count)))


def signed_volumes(triangles: FloatArray) -> FloatArray:
    """(F,) volumes between triangles (F, 3, 3) and the origin; a closed surface holds their sum."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = triangles.transpose(1, 2, 0)
    return np.asarray((ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6)


def find_shells(vertices: FloatArray, faces: IntArray) -> Shells:
    """Cut the surface of (F, 3) faces into shells.

    First pieces that hang together by edges with exactly two faces: boards that only touch stay apart, and
    faces that are wound against their neighbours are turned. What is not closed by itself is put together
    again by shared vertices, since solids that share a wall are closed only together.
    """
    if not len(faces):
        return Shells(vertices, faces, np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.bool_))
    points, corners = _welded(vertices, faces)
    edge, way = edges(corners), np.where(corners < corners[:, [1, 2, 0]], 1, -1)
    sheet, flip = _sheets(edge, way)
    corners = np.where(flip[:, None], corners[:, ::-1], corners)
    way = np.where(flip[:, None], -way, way)
    alone = (_closed(edge, way, sheet) & _bounding(points[corners], sheet))[sheet]
    rest = np.flatnonzero(~alone)
    group = touching(corners[rest])
    together = (_closed(edge[rest], way[rest], group) & _bounding(points[corners[rest]], group))[group]
    sides = np.flatnonzero(~together)
    once = sides[unique_rows(np.sort(corners[rest[sides]], axis=1))[0]]  # a sheet with two sides is one
    kept = np.sort(np.r_[np.flatnonzero(together), once])
    label = np.r_[sheet[alone], sheet.max(initial=-1) + 1 + group[kept]]
    _, shell = without_gaps(label)
    closed = np.zeros(int(shell.max(initial=-1)) + 1, dtype=bool)
    closed[shell] = np.r_[alone[alone], together[kept]]
    faces = corners[np.r_[np.flatnonzero(alone), rest[kept]]]
    return Shells(points, faces, shell.astype(np.int32), closed)


def _welded(vertices: FloatArray, faces: IntArray) -> tuple[FloatArray, IntArray]:
    """Points and (F, 3) faces on them, without degenerate faces and those that repeat an earlier one."""
    used, compact = without_gaps(faces)
    points = vertices[used]
    relative, least = WELD_TOLERANCE
    lower, upper = bounds_of(points)
    ids = weld(points, max(relative * float(np.linalg.norm(upper - lower)), least))
    first = np.zeros(int(ids.max()) + 1, dtype=np.int64)
    first[ids[::-1]] = np.arange(len(ids))[::-1]  # the last one written stays: the first of each
    corners = ids[compact]
    a, b, c = corners.T
    corners = corners[(a != b) & (b != c) & (c != a)]
    turn = corners.argmin(axis=1)
    same = np.take_along_axis(corners, (turn[:, None] + np.arange(3)) % 3, axis=1)
    return points[first], corners[np.sort(unique_rows(same)[0])]


def _sheets(edge: IntArray, way: IntArray) -> tuple[IntArray, BoolArray]:
    """(F,) label of faces joined by edges with exactly two faces, and which to turn so that they agree.

    Every face stands twice in a graph, as it is and turned; an edge joins the copies that agree. In an
    orientable sheet the two copies of a face end up in different components, and one of those is chosen:
    the one that turns fewer faces.
    """
    count = len(edge)
    order, _ = stable_order(edge.ravel())
    uses = np.bincount(edge.ravel())
    starts = (np.cumsum(uses) - uses)[uses == 2]
    one, two = order[starts], order[starts + 1]
    against = np.where(way.ravel()[one] == way.ravel()[two], count, 0)
    one, two = one // 3, two // 3
    cover = connected(2 * count, np.r_[one, one + count], np.r_[two + against, two + count - against])
    as_is, turned = cover[:count], cover[count:]
    sheet = without_gaps(np.minimum(as_is, turned))[1]
    flip = as_is > turned
    mostly = 2 * np.bincount(sheet, flip) > np.bincount(sheet)
    return sheet, np.asarray((flip ^ mostly[sheet]) & (as_is != turned))


def _closed(edge: IntArray, way: IntArray, label: IntArray) -> BoolArray:
    """(S,) whether the (F, 3) edges of a label's faces are walked as often one way as the other."""
    count, span = int(label.max(initial=-1)) + 1, int(edge.max(initial=-1)) + 1
    order, ordered = stable_order((label[:, None] * span + edge).ravel())
    new = np.ones(len(ordered), dtype=np.bool_)
    new[1:] = ordered[1:] != ordered[:-1]
    start = np.flatnonzero(new)
    unbalanced = np.add.reduceat(way.ravel()[order], start) != 0
    return np.asarray(np.bincount(ordered[start[unbalanced]] // max(span, 1), minlength=count) == 0)


def _bounding(triangles: FloatArray, label: IntArray) -> BoolArray:
    """(S,) whether the (F, 3, 3) triangles of a label enclose anything, if they are closed."""
    count = int(label.max(initial=-1)) + 1
    volume = np.bincount(label, signed_volumes(triangles), count)
    area = np.bincount(label, areas(triangles), count)
    return np.asarray(np.abs(volume) > _FLAT * area**1.5)
