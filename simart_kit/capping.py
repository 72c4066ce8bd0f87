"""Closes shells that lack little: small holes get a cap, so that what they bound can be told."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray
from .shells import Shells
from .topology import connected, unique_rows, without_gaps
from .triangles import areas, crosses

_OPEN = 0.05  # share of the surface that a shell's holes may miss, for it to count as closed


def capped(shells: Shells, least: float) -> Shells:
    """The shells with caps over the holes of those that are nearly closed.

    A shell's area vectors add up to those of the missing caps; nearly closed is one that misses less than
    5 % of its area. A hole gets a fan of triangles about the middle of its rim.

    Args:
        shells: of a part.
        least: mean thickness below which a shell stays open [m]: it is a sheet drawn with two sides.
    """
    missing = np.zeros((shells.count, 3))
    np.add.at(missing, shells.face_shell, crosses(shells.triangles) / 2)
    nearly = ~shells.closed & (np.linalg.norm(missing, axis=1) < _OPEN * shells.areas)
    if not nearly.any():
        return shells
    points, faces, label = _fans(shells, nearly)
    fuller = replace(
        shells,
        vertices=np.concatenate([shells.vertices, points]),
        faces=np.concatenate([shells.faces, faces]),
        face_shell=np.concatenate([shells.face_shell, label]).astype(np.int32),
    )
    kept = nearly & (2 * np.abs(_volumes(fuller)) > least * fuller.areas)
    kept &= np.bincount(label, areas(fuller.vertices[faces]), shells.count) < _OPEN * shells.areas
    chosen = np.r_[np.ones(len(shells.faces), dtype=bool), kept[label]]
    return replace(
        fuller,
        faces=fuller.faces[chosen],
        face_shell=fuller.face_shell[chosen],
        closed=shells.closed | kept,
    )


def _fans(shells: Shells, chosen: BoolArray) -> tuple[FloatArray, IntArray, IntArray]:
    """New points, (N, 3) faces that close the chosen shells, and the (N,) shell of each."""
    start, end, label = _rims(shells, chosen)
    corners, compact = without_gaps(np.column_stack([start, end]))
    rim = connected(len(corners), compact[:, 0], compact[:, 1])[compact[:, 0]]
    _, rim = without_gaps(rim)
    middle = np.zeros((int(rim.max(initial=-1)) + 1, 3))
    for axis in range(3):
        middle[:, axis] = np.bincount(rim, shells.vertices[start][:, axis]) / np.bincount(rim)
    return middle, np.column_stack([end, start, len(shells.vertices) + rim]), label


def _rims(shells: Shells, chosen: BoolArray) -> tuple[IntArray, IntArray, IntArray]:
    """Directed edges of the chosen shells that nothing walks back: starts, ends, and the shell of each."""
    used = chosen[shells.face_shell]
    faces, label = shells.faces[used].astype(np.int64), np.repeat(shells.face_shell[used], 3)
    start, end = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    low, high = np.minimum(start, end), np.maximum(start, end)
    first, which = unique_rows(np.column_stack([label, low, high]))
    balance = np.bincount(which, np.where(start < end, 1, -1), len(first)).astype(np.int64)
    repeated = np.repeat(np.arange(len(first)), np.abs(balance))
    low, high, shell = low[first][repeated], high[first][repeated], label[first][repeated]
    forward = balance[repeated] > 0
    return np.where(forward, low, high), np.where(forward, high, low), shell


def _volumes(shells: Shells) -> FloatArray:
    """(S,) signed volume of each shell, right where it is closed [m^3]."""
    triangles = shells.triangles
    signed = np.einsum("ni,ni->n", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6
    return np.asarray(np.bincount(shells.face_shell, signed, shells.count))
