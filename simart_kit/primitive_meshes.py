"""Primitives as the convex meshes that stand for them where a format has no primitive."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .arrays import FloatArray, IntArray, frozen_floats, frozen_ints
from .asset import ConvexMesh
from .primitives import Primitive

_SIDES = 32  # of a cylinder: 64 vertices, which simulators take
_BOX = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])


def primitive_shape(primitive: Primitive) -> ConvexMesh:
    """The shape of a primitive: a mesh of 64 vertices at most, whose corners lie on the exact surface."""
    vertices, faces = _unit_mesh(primitive.kind)
    rotation, middle = primitive.asset_T_shape[:3, :3], primitive.asset_T_shape[:3, 3]
    return ConvexMesh((vertices * primitive.size) @ rotation.T + middle, faces, primitive)


def pose(rotation: FloatArray, middle: FloatArray) -> FloatArray:
    """(4, 4) pose of a (3, 3) rotation and a (3,) middle."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation, middle
    return matrix


@lru_cache
def _unit_mesh(kind: str) -> tuple[FloatArray, IntArray]:
    """Vertices and outward triangles of a primitive of size 1."""
    from scipy.spatial import ConvexHull

    points = {"box": lambda: _BOX, "cylinder": _cylinder, "sphere": _sphere}[kind]()
    hull = ConvexHull(points)
    a, b, c = (points[hull.simplices[:, i]] for i in range(3))
    inward = np.einsum("ni,ni->n", np.cross(b - a, c - a), hull.equations[:, :3]) < 0
    faces = np.where(inward[:, None], hull.simplices[:, ::-1], hull.simplices)
    return frozen_floats(points), frozen_ints(faces)


def _cylinder() -> FloatArray:
    turn = 2 * np.pi * np.arange(_SIDES) / _SIDES
    ring = np.column_stack([np.cos(turn), np.sin(turn)]) / 2
    return np.concatenate([np.column_stack([ring, np.full(_SIDES, z)]) for z in (-0.5, 0.5)])


def _sphere() -> FloatArray:
    """(42, 3) corners of an icosahedron and the middles of its edges, on the sphere."""
    golden = (1 + np.sqrt(5)) / 2
    corners = np.array(
        [np.roll([0.0, x, y * golden], turn) for turn in range(3) for x in (-1, 1) for y in (-1, 1)]
    )
    one, two = np.triu_indices(12, 1)
    edge = np.linalg.norm(corners[one] - corners[two], axis=1) < 2.1
    points = np.concatenate([corners, corners[one[edge]] + corners[two[edge]]])
    return np.asarray(points / np.linalg.norm(points, axis=1, keepdims=True) / 2)
