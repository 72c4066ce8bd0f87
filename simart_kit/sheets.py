"""Open sheets as thin boards, one for each flat patch."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, IntArray
from .pieces import Piece, hulled, piece_of, solid_body
from .rims import rim
from .rough_sheets import walls
from .topology import connected, neighbours, without_gaps
from .triangles import areas, crosses, unit_normals

SHEET = 0.004
"""Thickness of the board that a patch of an open sheet becomes [m]."""

# Least cosine in a flat patch, the next one where there would be more boards than this.
_FLAT_PATCHES = tuple(float(np.cos(np.radians(angle))) for angle in (15.0, 30.0, 45.0, 60.0))
_MOST_BOARDS = 400
_MOST_PATCHES = 64
_CRUMB, _ROUGH = 1e-3, 0.05  # of a sheet: what no smooth one comes apart into, and how much of it does so


def boards(vertices: FloatArray, faces: IntArray, middle: FloatArray) -> list[Piece]:
    """A board for each flat patch of a sheet, on the side of `middle`: outside, nothing stands out."""
    found = (walls(vertices, faces, SHEET) if _is_rough(vertices, faces) else None) or []
    if found:
        return found
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


def _is_rough(vertices: FloatArray, faces: IntArray) -> bool:
    """Whether much of a sheet lies in very many patches too small to be walls, bevels or curves."""
    patch = _patches(vertices, faces, _FLAT_PATCHES[0])
    size = np.bincount(patch, areas(vertices[faces]))
    return len(size) > _MOST_BOARDS and bool(size[size < _CRUMB * size.sum()].sum() > _ROUGH * size.sum())


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
