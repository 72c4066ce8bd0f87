"""Surfaces of the shapes that URDF and MJCF know without a mesh file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .mesh_files import Triangles


def box(size: Sequence[float]) -> Triangles:
    """A box about the origin of (3,) edge lengths."""
    import trimesh

    return _triangles(trimesh.creation.box(extents=np.asarray(size)))


def cylinder(radius: float, length: float) -> Triangles:
    """A cylinder along z about the origin."""
    import trimesh

    return _triangles(trimesh.creation.cylinder(radius=radius, height=length))


def capsule(radius: float, length: float) -> Triangles:
    """A capsule along z about the origin; `length` is without its two caps."""
    import trimesh

    return _triangles(trimesh.creation.capsule(radius=radius, height=length))


def ellipsoid(radii: Sequence[float]) -> Triangles:
    """An ellipsoid about the origin of (3,) radii; a sphere has three equal ones."""
    import trimesh

    vertices, faces = _triangles(trimesh.creation.icosphere(subdivisions=3, radius=1.0))
    return vertices * np.asarray(radii), faces


def _triangles(mesh: Any) -> Triangles:
    return np.array(mesh.vertices, dtype=np.float64), np.array(mesh.faces, dtype=np.int32)
