"""Walls of a rough sheet, as generators of shapes leave them: flat boards where it is flat on the whole.

Faces of such a surface look all ways, and boards that follow each of them are hundreds. Those whose
surroundings look the same way and that lie in one plane, give or take the roughness, are one wall.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray, unit
from .cutting import cut
from .hulls import sphere_directions
from .mending import mended
from .pieces import Piece, piece_of
from .rims import outlines, rim
from .straightening import straight_runs
from .topology import connected, neighbours, without_gaps
from .triangles import areas, chunks, crosses

if TYPE_CHECKING:
    from manifold3d import Manifold

_ROUNDS = 6  # of evening out which way faces look
_ALIKE = float(np.cos(np.radians(30.0)))  # least cosine between faces of a wall
_WAYS, _SPHERE = 64, 256  # ways that faces may look, and those that are tried
_LEVEL = 0.005  # of the sheet's diagonal: how far faces lie off the plane of their wall at most
_WALL, _SPECK = 1e-3, 5e-4  # of the sheet: what a wall is at least, and what may be left out
_MOSTLY = 0.5  # of the sheet that walls have to be
_MOST, _TIGHT = 64, 1.25  # cuts of the boards, and times its board: what a hull may hold, they are not exact
_JOINED = 0.03  # of the sheet's boards: what a shape may hold besides its own, they are not exact
_RAGGED = 1.0  # times the length of an edge: teeth of an outline that are cut off


def walls(vertices: FloatArray, faces: IntArray, thickness: float) -> list[Piece] | None:
    """Boards for the walls of a sheet, and straight runs of what is between them; None where it has no walls.

    Args:
        vertices: (V, 3) [m].
        faces: (F, 3), wound alike.
        thickness: of the boards, inwards [m].
    """
    corners = vertices[faces]
    area, outward = areas(corners), _outward(corners, thickness)
    level = max(_LEVEL * float(np.linalg.norm(np.ptp(corners, axis=(0, 1)))), thickness)
    wall = _walls(corners, faces, level)
    size = np.bincount(wall + 1, area)
    if size[1:].sum() < _MOSTLY * area.sum():
        return None
    tooth = _RAGGED * float(np.sqrt(area.mean()))
    boards = [
        _board(vertices, faces[wall == label], outward, thickness, _WALL * area.sum(), tooth)
        for label in range(len(size) - 1)
    ]
    pieces = [piece_of(part) for board in boards for part in board.decompose()]
    least = _SPECK * thickness * float(area.sum())
    cuts, _ = cut(pieces, _MOST + len(pieces), _TIGHT, least)
    found = [replace(piece, volume=piece.hull_volume, body=None) for piece in cuts if piece.volume > least]
    for rest in _together(faces, np.flatnonzero(wall < 0)):
        if area[rest].sum() > _SPECK * area.sum():
            found += straight_runs(corners[rest], thickness)
    return mended(found, len(found), np.inf, _JOINED * thickness * float(area.sum()))


def _outward(corners: FloatArray, thickness: float) -> float:
    """1.0 where (F, 3, 3) triangles are wound to look out of what they go around, else -1.0."""
    cross, middle = crosses(corners), corners.mean(axis=(0, 1))
    height = np.einsum("ni,ni->", cross, corners.mean(axis=1) - middle) / np.linalg.norm(cross, axis=1).sum()
    return -1.0 if height < -thickness / 2 else 1.0


def _walls(corners: FloatArray, faces: IntArray, level: float) -> IntArray:
    """(F,) wall of each face, 0.. from the largest; -1 for faces of none."""
    area, cross = areas(corners), crosses(corners)
    least, found = _WALL * area.sum(), list[IntArray]()

    def sizeable(patches: Iterable[IntArray]) -> list[IntArray]:
        """Those that are large enough for a wall, and not crumpled."""
        large = [patch for patch in patches if area[patch].sum() >= least]
        return [patch for patch in large if np.linalg.norm(cross[patch].sum(axis=0)) >= area[patch].sum()]

    every = np.arange(len(faces))
    waiting = sizeable(_together(faces, every, _ways(_evened(cross, faces), area)))
    while waiting:
        patch = waiting.pop()
        inside = _in_plane(corners[patch], cross[patch], area[patch], level)
        flat = sizeable(_together(faces, patch[inside]))
        found += flat
        if flat:  # what lies before or behind it may be a wall of its own
            waiting += sizeable(_together(faces, patch[~inside]))
    wall = np.full(len(faces), -1)
    for label, patch in enumerate(sorted(found, key=lambda patch: -float(area[patch].sum()))):
        wall[patch] = label
    return wall


def _in_plane(corners: FloatArray, cross: FloatArray, area: FloatArray, level: float) -> BoolArray:
    """Which of (N, 3, 3) triangles lie in the plane that most of them share."""
    height = corners @ unit(cross.sum(axis=0))
    middle = height.mean(axis=1)
    order = np.argsort(middle, kind="stable")
    usual = middle[order[np.searchsorted(np.cumsum(area[order]), area.sum() / 2)]]
    return np.asarray(np.abs(height - usual).max(axis=1) <= level)


def _evened(cross: FloatArray, faces: IntArray) -> FloatArray:
    """(F, 3) unit directions that the surroundings of faces look."""
    _, one, two = neighbours(faces)
    for _ in range(_ROUNDS):
        around = np.zeros_like(cross)
        for axis in range(3):
            around[:, axis] = np.bincount(one, cross[two, axis], len(faces))
            around[:, axis] += np.bincount(two, cross[one, axis], len(faces))
        cross = cross + around / 3
    return np.asarray(cross / np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), 1e-300))


def _ways(directions: FloatArray, area: FloatArray) -> IntArray:
    """(F,) which of a few ways each face looks, those that most of the surface looks first; -1 for none."""
    way, sphere = np.full(len(directions), -1), sphere_directions(_SPHERE)
    nearest = np.concatenate(
        [(directions[some] @ sphere.T).argmax(axis=1) for some in chunks(len(directions))]
    )
    alike = (sphere @ sphere.T >= _ALIKE).astype(np.float64)
    for label in range(_WAYS):
        left = np.flatnonzero(way < 0)
        if not len(left):
            break
        lead = sphere[int((alike @ np.bincount(nearest[left], area[left], _SPHERE)).argmax())]
        for _ in range(2):  # towards the middle of those that look so
            around = left[directions[left] @ lead >= _ALIKE]
            lead = unit((directions[around] * area[around, None]).sum(axis=0)) if len(around) else lead
        way[left[directions[left] @ lead >= _ALIKE]] = label
    return way


def _together(faces: IntArray, some: IntArray, kind: IntArray | None = None) -> list[IntArray]:
    """Those of some (F, 3) faces, by index, that hang together by edges and are of one (F,) kind."""
    if not len(some):
        return []
    _, one, two = neighbours(faces[some])
    same = slice(None) if kind is None else kind[some[one]] == kind[some[two]]
    label = connected(len(some), one[same], two[same])
    order = np.argsort(label, kind="stable")
    return np.split(some[order], np.flatnonzero(np.diff(label[order])) + 1)


def _board(
    vertices: FloatArray, faces: IntArray, outward: float, thickness: float, least: float, tooth: float
) -> Manifold:
    """The board behind a wall, in its plane, with an outline without small holes and teeth."""
    import manifold3d

    used, corners = without_gaps(faces)
    points, cross = vertices[used], crosses(vertices[faces])
    normal = outward * unit(cross.sum(axis=0))
    across = unit(np.cross(normal, np.eye(3)[np.abs(normal).argmin()]))
    frame = np.array([across, np.cross(normal, across), normal])
    weights = np.linalg.norm(cross, axis=1)
    height = float((points[corners].mean(axis=1) @ normal) @ weights / weights.sum())
    ways = [points[way] @ frame[:2].T for way in outlines(rim(corners))]
    ways = [way for way in ways if abs(_area(way)) > least]  # not around single faces that look elsewhere
    outline = manifold3d.CrossSection(ways, manifold3d.FillRule.NonZero)
    board = outline.simplify(tooth).extrude(thickness)
    return board.transform(np.column_stack([frame.T, normal * (height - thickness)]))


def _area(way: FloatArray) -> float:
    """Signed, within a closed way of (N, 2) points [m^2]."""
    following = np.roll(way, -1, axis=0)
    return float(way[:, 0] @ following[:, 1] - way[:, 1] @ following[:, 0]) / 2
