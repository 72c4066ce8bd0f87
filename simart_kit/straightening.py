"""Bent rods and wires as straight ones: a hull fills the bend that a cut would have to find.

What is thin all along, as wire baskets, grids and frames of tubes are, comes apart by its faces alone: they
run from bend to bend. No solid is cut, which makes hundreds of wires a matter of tenths of a second.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .arrays import FloatArray, IntArray
from .hulls import hull_corners
from .pieces import Piece
from .triangles import areas

_SPARSE = 10.0  # times its solid: what the hull of bent rods holds at least; that of a carcass holds less
_STRAIGHT = 1.5  # times its solid: what the hull of a straight run holds at most
_GAIN = 0.7  # of a hull that the hulls of its halves may hold together, or else it stays whole
_THICK = 4  # times the volume behind a unit of its surface: the diameter of a rod
_MOST_HALVINGS, _MOST_RUNS = 8, 2048  # of a piece, of all


def straightened(pieces: Sequence[Piece], faces: int) -> list[Piece]:
    """The pieces, with those that are thin and bent as their straight runs.

    Args:
        pieces: solids.
        faces: up to which a piece stays as it is: few are better cut.
    """
    bent = [_is_bent(piece, faces) for piece in pieces]
    halvings = min(int(np.log2(_MOST_RUNS / max(sum(bent), 1))), _MOST_HALVINGS)
    found = list[Piece]()
    for piece, comes_apart in zip(pieces, bent, strict=True):
        found += _thin(piece, halvings) if comes_apart and halvings > 0 else [piece]
    return found


def _is_bent(piece: Piece, faces: int) -> bool:
    """Whether a piece of more than so many faces fills little of its hull."""
    if piece.body is None or piece.hull_volume <= _SPARSE * piece.volume:
        return False
    return int(piece.body.num_tri()) > faces


def _thin(piece: Piece, halvings: int) -> list[Piece]:
    """The straight runs of a piece with a body; itself where it is none of several."""
    assert piece.body is not None
    mesh = piece.body.to_mesh64()
    vertices, faces = np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)
    triangles = vertices[faces]
    depth = piece.volume / float(areas(triangles).sum())
    found = _parted(triangles, areas(triangles), depth, halvings)
    return found if sum(run.hull_volume for run in found) <= _STRAIGHT * piece.volume else [piece]


def straight_runs(triangles: FloatArray, depth: float) -> list[Piece]:
    """Hulls around the straight runs of (F, 3, 3) triangles with so much solid behind them [m]."""
    return _parted(triangles, areas(triangles), depth, _MOST_HALVINGS)


def _parted(triangles: FloatArray, area: FloatArray, depth: float, halvings: int) -> list[Piece]:
    """Hulls around (F, 3, 3) triangles: one, or those of their halves where these hold much less.

    Args:
        triangles: [m].
        area: (F,) of them [m^2].
        depth: of the solid behind the surface, on average [m].
        halvings: at most.
    """
    solid = depth * float(area.sum())
    points = triangles.reshape(-1, 3)
    corners, size = hull_corners(points) or (points, solid)
    whole = [Piece(corners, min(solid, size), size, None)]
    if size <= _STRAIGHT * solid or not halvings or len(triangles) < 2:
        return whole
    halves = [_parted(triangles[i], area[i], depth, halvings - 1) for i in _halves(triangles, area, depth)]
    found = [run for half in halves for run in half]
    return found if max(solid, sum(run.hull_volume for run in found)) < _GAIN * size else whole


def _halves(triangles: FloatArray, area: FloatArray, depth: float) -> tuple[IntArray, IntArray]:
    """(F, 3, 3) triangles parted across an axis, where their boxes, weighted by area, are least."""
    least, thick = np.inf, _THICK * depth
    middles, lower, upper = triangles.mean(axis=1), triangles.min(axis=1), triangles.max(axis=1)
    for axis in range(3):
        order = np.argsort(middles[:, axis], kind="stable")
        back = order[::-1]
        cost = _grown(lower[order], upper[order], area[order], thick)[:-1]
        cost += _grown(lower[back], upper[back], area[back], thick)[-2::-1]
        first = int(cost.argmin()) + 1
        if cost[first - 1] < least:
            least, halves = float(cost[first - 1]), (order[:first], order[first:])
    return halves


def _grown(lower: FloatArray, upper: FloatArray, area: FloatArray, thick: float) -> FloatArray:
    """(F,) volume of the box, `thick` at least, around the first so many boxes, times their area."""
    size = np.maximum.accumulate(upper) - np.minimum.accumulate(lower)
    return np.asarray(np.maximum(size, thick).prod(axis=1) * np.cumsum(area))
