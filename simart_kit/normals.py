"""Vertex normals for meshes that come without: smooth over curves, sharp at creases."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .arrays import FloatArray, IntArray
from .mesh import Mesh

CREASE_ANGLE = np.deg2rad(35.0)


def with_normals(mesh: Mesh, crease: float = CREASE_ANGLE) -> Mesh:
    """The mesh with `normals`; vertices on a crease are split, faces keep their order.

    A corner's normal is the area-weighted mean of the faces around its position that lie within
    `crease` [rad] of the corner's own face. Meshes that have normals come back as they are.
    """
    if mesh.normals is not None:
        return mesh
    corner_normals = _corner_normals(mesh, crease)
    corners = mesh.faces.ravel()
    # Corners of one vertex that agree to 1e-3 share it again.
    keys = np.column_stack([corners, np.round(corner_normals * 1000).astype(np.int64)])
    _, first, vertex = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    source = corners[first]
    return replace(
        mesh,
        vertices=mesh.vertices[source],
        faces=vertex.reshape(-1, 3),
        normals=corner_normals[first],
        uv=None if mesh.uv is None else mesh.uv[source],
        colors=None if mesh.colors is None else mesh.colors[source],
    )


def weld(vertices: FloatArray, tolerance: float) -> IntArray:
    """(V,) ids such that vertices in one cell of a `tolerance` grid share an id."""
    # A floor: a quotient of subnormal numbers would overflow.
    cells = np.round((vertices - vertices.min(axis=0)) / max(tolerance, 1e-12)).astype(np.int64)
    _, ids = np.unique(cells, axis=0, return_inverse=True)
    return ids.reshape(-1).astype(np.int32)


def _corner_normals(mesh: Mesh, crease: float) -> FloatArray:
    """(3F, 3) unit normals, a corner each."""
    corner, face = _corner_face_pairs(weld(mesh.vertices, mesh.diagonal * 1e-7)[mesh.faces])
    normals, own = mesh.face_normals, corner // 3
    near = np.einsum("ij,ij->i", normals[own], normals[face]) >= np.cos(crease)
    keep = near | (own == face)
    corner, weighted = corner[keep], (normals * mesh.face_areas[:, None])[face[keep]]
    count = 3 * len(mesh.faces)
    total = np.column_stack([np.bincount(corner, weighted[:, axis], count) for axis in range(3)])
    length = np.linalg.norm(total, axis=1, keepdims=True)
    up = np.broadcast_to([0.0, 0.0, 1.0], total.shape)  # a face without area has no better one
    return np.where(length > 0, total / np.where(length > 0, length, 1.0), up)


def _corner_face_pairs(positions: IntArray) -> tuple[IntArray, IntArray]:
    """Every (corner, face) where the face has a corner at the same position; positions are (F, 3) ids."""
    flat = positions.ravel()
    order = np.argsort(flat, kind="stable")
    counts = np.bincount(flat)
    starts = np.cumsum(counts) - counts
    reach = counts[flat]
    corner = np.repeat(np.arange(len(flat)), reach)
    within = np.arange(len(corner)) - np.repeat(np.cumsum(reach) - reach, reach)
    face = order[np.repeat(starts[flat], reach) + within] // 3
    return corner, face
