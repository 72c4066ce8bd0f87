"""Vertex normals for meshes that come without: smooth over curves, sharp at creases."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .arrays import UP, FloatArray, IntArray, sums_by, units
from .mesh import Mesh
from .topology import unique_rows, weld

CREASE_ANGLE = np.deg2rad(35.0)
_MOST_FACES = 256  # around a position; neighbours in a fuller fan differ too little for smoothing to show
_CORNERS_AT_ONCE = 1 << 16


def with_normals(mesh: Mesh, crease: float = CREASE_ANGLE) -> Mesh:
    """The mesh with `normals`; vertices on a crease are split, faces keep their order.

    A corner's normal is the area-weighted mean of the faces around its position that lie within
    `crease` [rad] of the corner's own face; at a crease where very many faces meet, it is its own face's.
    Meshes that have normals come back as they are.
    """
    if mesh.normals is not None:
        return mesh
    normals = units(_corner_sums(mesh, crease), otherwise=UP)  # a face without area has no better one
    corners = mesh.faces.ravel().astype(np.int64)
    # Corners of one vertex that agree to 1e-3 share it again: a number for each vertex and rounded normal.
    rounded = np.round(normals * 1000).astype(np.int64) @ np.array([2001**2, 2001, 1])
    first, vertex = unique_rows((corners * 2001**3 + rounded)[:, None])
    return replace(mesh.on_vertices(corners[first], vertex.reshape(-1, 3)), normals=normals[first])


def _corner_sums(mesh: Mesh, crease: float) -> FloatArray:
    """(3F, 3) sum of the area-weighted normals that each corner shares."""
    position = weld(mesh.vertices, mesh.diagonal * 1e-7)[mesh.faces].ravel()
    face = np.arange(len(position)) // 3
    weighted = mesh.face_normals * mesh.face_areas[:, None]
    sums = sums_by(weighted[face], position)
    # Faces within half the crease of a direction are within the crease of each other: no pairs to look at.
    slant = np.einsum("ij,ij->i", units(sums)[position], mesh.face_normals[face])
    creased = np.bincount(position, slant < np.cos(crease / 2)) > 0
    crowded = np.bincount(position) > _MOST_FACES
    shared = sums[position]
    alone = np.flatnonzero((creased & crowded)[position])
    shared[alone] = weighted[face[alone]]
    faces_at = _FacesAt(position)
    few = np.flatnonzero((creased & ~crowded)[position])
    for start in range(0, len(few), _CORNERS_AT_ONCE):
        corners = few[start : start + _CORNERS_AT_ONCE]
        row, other = faces_at(position[corners])
        own = face[corners][row]
        near = np.einsum("ij,ij->i", mesh.face_normals[own], mesh.face_normals[other]) >= np.cos(crease)
        near |= own == other
        shared[corners] = sums_by(weighted[other[near]], row[near])
    return shared


class _FacesAt:
    """Looks up the faces around positions.

    Args:
        position: (3F,) id of every corner's.
    """

    def __init__(self, position: IntArray) -> None:
        self._face = np.argsort(position, kind="stable") // 3
        self._count = np.bincount(position)
        self._start = np.cumsum(self._count) - self._count

    def __call__(self, positions: IntArray) -> tuple[IntArray, IntArray]:
        """Every pair of (N,) positions and a face around it: index of the former, and the face."""
        count = self._count[positions]
        row = np.repeat(np.arange(len(positions)), count)
        within = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
        return row, self._face[self._start[positions][row] + within]
