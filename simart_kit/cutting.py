"""Cutting solids into convex pieces along the planes of their own faces: what is cut stays exact.

Furniture is made of planes. A carcass in one shell comes apart into its boards, each of which is the surface
to the last digit, where voxels would blur it. The next cut is the one that leaves least of hulls that are not
filled, in the piece whose hull holds most that is not solid.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .arrays import FloatArray
from .kept import kept
from .pieces import Piece, piece_of
from .topology import neighbours
from .triangles import unit_normals

WORK = 240_000
"""Faces that may be cut for half of the parts, as often as they are: what bounds the time, alike anywhere."""

_MOST_PLANES = 16
_MANY_FACES = 500  # from which on only half as many planes are tried
_SHAVING = 1e-6  # of a piece's volume: less is rounding
_PATIENCE, _VERY_LOOSE = 2, 10  # times the least that a hull may hold besides its solid
_BESIDE = 10  # times what a tight hull holds besides its solid: a cut just beside a face is no gain
_CUT = 0.4  # times what a whole shell's hull may hold besides it
_TIE = 1e-6  # of a piece's hull: cuts that differ by less are alike, and the first is taken


def cut(
    pieces: Sequence[Piece], most: int, tight: float, least: float, work: int = WORK
) -> tuple[list[Piece], int]:
    """Cut pieces until their hulls are tight; returns what they became, in their order, and the work done.

    Args:
        pieces: those without a body stay as they are.
        most: pieces in all; more than this come back only if there were more.
        tight: a hull is when it holds less than so many times the solid in it,
        least: or less than this besides it [m^3].
        work: see `WORK`.
    """
    groups = [[piece] for piece in pieces]
    done: set[int] = set()  # identities of pieces that no cut helps
    spent = 0
    while spent < work:
        room = most - sum(map(len, groups))
        loose = [
            (-piece.excess, g, i)
            for g, group in enumerate(groups)
            for i, piece in enumerate(group)
            if is_loose(piece, tight if len(group) == 1 else cut_tight(tight), least)
            and id(piece) not in done
        ]
        if not loose or room < 1:
            break
        _, g, i = min(loose)
        piece = groups[g][i]
        parts, faces = _best_cut(piece, room + 1, cut_tight(tight), least)
        spent += faces
        if parts:
            groups[g][i : i + 1] = parts
        else:
            done.add(id(piece))
    return [piece for group in groups for piece in group], spent


def cut_tight(tight: float) -> float:
    """How tight pieces of a cut have to be where whole shells have to be `tight`: laths on boards count."""
    return 1 + _CUT * (tight - 1)


def is_loose(piece: Piece, tight: float, least: float) -> bool:
    """Whether a piece can be cut and its hull holds too much besides it."""
    return piece.body is not None and piece.excess > least and piece.hull_volume > tight * piece.volume


def _best_cut(piece: Piece, most: int, tight: float, least: float) -> tuple[list[Piece], int]:
    """What the best cut leaves, `most` pieces at most, none if no cut gains anything; and the faces cut.

    From a ring, the first cut through the middle gains nothing, but the next ones do: what is very loose is
    cut even so.
    """
    assert piece.body is not None
    spent = 0
    slack = _PATIENCE * least if piece.excess > _VERY_LOOSE * least else 0.0
    for parted, bound in ((_along_faces, 0.0), (_halved, slack)):
        best: list[Piece] = []
        lowest, some = 2 * piece.hull_volume + bound, parted(piece)
        for parts in some:
            cost = least * (len(parts) - 1) + sum(_cost(part, tight) for part in parts)
            if 0 < len(parts) <= most and cost < lowest - _TIE * piece.hull_volume:
                best, lowest = parts, cost
        spent += len(some) * int(piece.body.num_tri())
        if best:
            return best, spent
    return [], spent


@kept
def _along_faces(piece: Piece) -> list[list[Piece]]:
    """What each cut along a face leaves; it is asked again when shapes are to be tighter."""
    return [_apart(piece, normal, offset) for normal, offset in _planes(piece)]


@kept
def _halved(piece: Piece) -> list[list[Piece]]:
    """What each cut through the middle leaves."""
    assert piece.body is not None
    lower, upper = np.reshape(piece.body.bounding_box(), (2, 3))
    return [_apart(piece, axis, float((lower + upper) @ axis / 2)) for axis in np.eye(3)]


def _cost(piece: Piece, tight: float) -> float:
    """[m^3] of the hull, twice where that is not tight. What a tight one holds besides weighs more yet."""
    if piece.hull_volume > tight * piece.volume:
        return 2 * piece.hull_volume
    return piece.hull_volume + _BESIDE * max(piece.excess, 0.0)


def _apart(piece: Piece, normal: FloatArray, offset: float) -> list[Piece]:
    """The connected pieces on both sides of a plane, without the films that earlier cuts left on faces."""
    assert piece.body is not None
    sides = piece.body.split_by_plane(tuple(normal.tolist()), offset)
    parts = [part for side in sides for part in side.decompose()]
    return [piece_of(part) for part in parts if part.volume() > _SHAVING * piece.volume]


def _planes(piece: Piece) -> list[tuple[FloatArray, float]]:
    """Planes worth cutting along: of faces at concave edges, the longest first."""
    assert piece.body is not None
    mesh = piece.body.to_mesh64()
    vertices, faces = np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)
    normals = unit_normals(vertices[faces])
    lower, upper = vertices.min(axis=0), vertices.max(axis=0)
    size = float(np.linalg.norm(upper - lower))
    _, one, two = neighbours(faces)
    middle = vertices[faces].mean(axis=1)
    # Seen from one face, the other's middle lies above its plane: the edge between them is concave.
    height = np.einsum("ei,ei->e", normals[one], middle[two] - middle[one])
    concave = height > 1e-5 * size
    shared = _shared_length(vertices, faces[one[concave]], faces[two[concave]])
    beside = np.concatenate([one[concave], two[concave]])
    weight = np.concatenate([shared, shared])
    planes = np.column_stack(
        [normals[beside], np.einsum("ei,ei->e", normals[beside], vertices[faces[beside, 0]])]
    )
    most = _MOST_PLANES if len(faces) < _MANY_FACES else _MOST_PLANES // 2
    return [(plane[:3], float(plane[3])) for plane in _heaviest(planes, weight, size, most)]


def _shared_length(vertices: FloatArray, one: FloatArray, two: FloatArray) -> FloatArray:
    """(E,) length of the edge that each pair of (E, 3) faces shares [m]."""
    shared = (one[:, :, None] == two[:, None, :]).any(axis=2)
    ends = np.where(shared[:, :, None], vertices[one], np.nan)
    return np.asarray(np.linalg.norm(np.nanmax(ends, axis=1) - np.nanmin(ends, axis=1), axis=1))


def _heaviest(planes: FloatArray, weight: FloatArray, size: float, most: int) -> FloatArray:
    """The (N, 4) planes, those that agree taken together, with the most weight first."""
    if not len(planes):
        return planes
    lead = np.argmax(np.abs(planes[:, :3]) > 1e-3, axis=1)
    planes = planes * np.sign(np.take_along_axis(planes, lead[:, None], axis=1))
    keys = np.round(planes / np.array([1e-3, 1e-3, 1e-3, 1e-4 * size]))
    _, first, label = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    total = np.bincount(label.ravel(), weight)
    order = np.argsort(-np.round(total / total.max(), 6), kind="stable")
    return np.asarray(planes[first[order[:most]]])
