"""The solids that shells stand for: closed ones exactly, nearly closed ones capped, sheets as thin boards."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from .arrays import FloatArray, IntArray, units
from .bounds import bounds_of
from .grouping import gathered
from .hulls import hull_of, volume
from .pieces import Piece, hulled, piece_of, simpler, solid_body
from .rims import holes, rim
from .sheets import LEAST_BOARDS, SHEET, boards
from .shells import Shells, signed_volumes
from .triangles import areas

if TYPE_CHECKING:
    from manifold3d import Manifold

MOST_PIECES = 1024
"""Shells of a surface that are looked at one by one, and patches of its sheets: a few milliseconds each."""

_THIN_WALLED = 0.5  # of its hull: a capped solid below this has walls, and is not a filled box
_LID = 0.1  # of its area that caps may have for a solid to be closed at all
_BOARD, _SLENDERNESS = 0.01, 0.015  # [m], and of the square root of its area: what a sheet stands for at most
_LENS = 1.5  # times the board that an open shell stands for: a hull below this is what the shell is


def pieces_of(shells: Shells, most: int = MOST_PIECES) -> list[Piece]:
    """Solids for shells; a sheet gives one for each of its flat patches.

    Thousands of shells, as leaves and needles are, would take seconds: beyond `most`, smaller ones share the
    hull of those that lie around the same larger one, and the patches of sheets do, too.

    Args:
        shells: of a surface.
        most: shells to look at one by one, and about so many patches of sheets.
    """
    found, split, points = list[Piece](), shells.split(), shells.points()
    solid, area = _solids(shells), shells.areas
    open_area = max(float(area[~shells.closed].sum()), 1e-300)
    filled = np.flatnonzero([len(some) > 0 for some in points])
    boxes = np.array([bounds_of(points[index]) for index in filled]).reshape(-1, 2, 3)
    for group in gathered(boxes, most, most // 2):
        index, *others = filled[group].tolist()
        if others:
            together = hulled(np.concatenate([points[i] for i in (index, *others)]))
            held = min(float(solid[[index, *others]].sum()), together.hull_volume)
            found.append(replace(together, volume=held))
            continue
        patches = max(int(most * area[index] / open_area), LEAST_BOARDS)
        faces = shells.faces[split[index]]
        found += _pieces(shells.vertices, faces, points[index], bool(shells.closed[index]), patches)
    return found


def _solids(shells: Shells) -> FloatArray:
    """(S,) volume that each shell holds if it is closed, or that a board of it has [m^3]."""
    held = np.bincount(shells.face_shell, signed_volumes(shells.triangles), shells.count)
    return np.asarray(np.where(shells.closed, np.abs(held), SHEET * shells.areas))


def _pieces(
    vertices: FloatArray, faces: IntArray, points: FloatArray, closed: bool, patches: int
) -> list[Piece]:
    hull = hull_of(points)
    if hull is None:
        return boards(vertices, faces, points.mean(axis=0), patches)
    body = solid_body(vertices, faces) if closed else None
    if body is not None:
        return [piece_of(simpler(body))]
    area = float(areas(vertices[faces]).sum())
    board = min(_BOARD, _SLENDERNESS * np.sqrt(area)) * area
    if volume(hull) < _LENS * board:
        return [hulled(points)]
    capped = _capped(vertices, faces, area)
    return [piece_of(simpler(capped))] if capped else boards(vertices, faces, points.mean(axis=0), patches)


def _capped(vertices: FloatArray, faces: IntArray, area: float) -> Manifold | None:
    """The solid of an open shell whose holes are small, or that has walls once they are closed."""
    loops = holes(rim(faces))
    if loops is None:
        return None
    lids = [_lid(vertices, loop) for loop in loops]
    body = solid_body(vertices, np.concatenate([faces, *lids]))
    if body is None:
        return None
    covered = sum(float(areas(vertices[lid]).sum()) for lid in lids)
    walled = SHEET * (area + covered) < 2 * body.volume() < 2 * _THIN_WALLED * body.hull().volume()
    return body if covered < _LID * area or walled else None


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
