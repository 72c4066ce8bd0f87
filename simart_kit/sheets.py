"""Open sheets as thin boards, one for each flat patch."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .arrays import FloatArray, IntArray, sums_by, units
from .bounds import bounds_by
from .grouping import gathered
from .pieces import Piece, hulled, piece_of, solid_body
from .rims import rim
from .rough_sheets import walls
from .topology import connected, neighbours, occurring, stable_order, without_gaps
from .triangles import areas, crosses, unit_normals

SHEET = 0.004
"""Thickness of the board that a patch of an open sheet becomes [m]."""

# Least cosine in a flat patch, the next one where there would be more boards than this.
_FLAT_PATCHES = tuple(float(np.cos(np.radians(angle))) for angle in (15.0, 30.0, 45.0, 60.0))
_MANY_BOARDS = 400
_MOST_PATCHES = 64
LEAST_BOARDS = 8
"""Boards that even a small sheet beside large ones may have."""

_SPLINTERED = 250  # patches: a rough sheet has more
_CRUMB, _ROUGH = 1e-3, 0.04  # of a sheet: what no smooth one comes apart into, and how much of it does so


def boards(vertices: FloatArray, faces: IntArray, middle: FloatArray, most: int) -> list[Piece]:
    """Boards for the flat patches of a sheet, on the side of `middle`: outside, nothing stands out.

    Args:
        vertices: (V, 3) [m].
        faces: (F, 3).
        middle: (3,) of the sheet [m].
        most: boards; where there are more patches, smaller ones share the hull of those around a larger one.
    """
    found = (walls(vertices, faces, SHEET) if _is_rough(vertices, faces) else None) or []
    if found:
        return found
    patch, triangles = _flat_patches(vertices, faces), vertices[faces]
    inward, area = _inwards(triangles, patch, middle), areas(triangles)
    looks = np.asarray(inward.any(axis=1))
    order, _ = stable_order(patch.astype(np.int64))
    split = np.split(order, np.cumsum(np.bincount(patch))[:-1])
    for group in gathered(bounds_by(triangles, patch), most, most // 2):
        some = np.concatenate([split[label] for label in group if looks[label]] or [order[:0]])
        if len(group) > 1 and len(some):
            found.append(_shared(triangles[some], inward[patch[some]], float(area[some].sum())))
        elif len(some):
            found.append(_board(vertices, faces[some], inward[group[0]]))
    return found or [hulled(vertices[occurring(faces)])]


def _inwards(triangles: FloatArray, patch: IntArray, middle: FloatArray) -> FloatArray:
    """(P, 3) from each patch to the other side of its board; zeros if it looks no way.

    Args:
        triangles: (F, 3, 3) [m].
        patch: (F,) that each lies in.
        middle: (3,) of the sheet [m].
    """
    normal = units(sums_by(crosses(triangles), patch))
    centre = sums_by(triangles.mean(axis=1), patch) / np.bincount(patch)[:, None]
    inward = np.einsum("pi,pi->p", normal, middle - centre)
    outside = (np.abs(inward) < SHEET / 2) | (inward < 0)
    return np.asarray(np.where(outside, -SHEET, SHEET)[:, None] * normal)


def _shared(triangles: FloatArray, inward: FloatArray, area: float) -> Piece:
    """One hull around boards of patches: (F, 3, 3) triangles with the (F, 3) ways through their boards."""
    whole = hulled(np.concatenate([triangles, triangles + inward[:, None]]).reshape(-1, 3))
    return replace(whole, volume=min(SHEET * area, whole.hull_volume))


def _is_rough(vertices: FloatArray, faces: IntArray) -> bool:
    """Whether much of a sheet lies in very many patches too small to be walls, bevels or curves."""
    patch = _patches(vertices, faces, _FLAT_PATCHES[0])
    size = np.bincount(patch, areas(vertices[faces]))
    return len(size) > _SPLINTERED and bool(size[size < _CRUMB * size.sum()].sum() > _ROUGH * size.sum())


def _board(vertices: FloatArray, faces: IntArray, step: FloatArray) -> Piece:
    """The prism between a patch and itself moved by (3,) `step`."""
    used, corners = without_gaps(faces)
    points, count = vertices[used], len(used)
    one, two = rim(corners).T
    sides = np.concatenate(
        [np.column_stack([two, one, one + count]), np.column_stack([two, one + count, two + count])]
    )
    solid = np.concatenate([corners, corners[:, ::-1] + count, sides])
    both = np.concatenate([points, points + step])
    body = solid_body(both, solid)
    return hulled(both) if body is None else piece_of(body)


def _flat_patches(vertices: FloatArray, faces: IntArray) -> IntArray:
    """(F,) flat patch of each face; of a rough sheet, less flat ones without which there are too many."""
    for flat in _FLAT_PATCHES:
        patch = _patches(vertices, faces, flat)
        if int(patch.max()) < _MANY_BOARDS:
            break
    return patch


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
