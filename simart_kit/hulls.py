"""Convex hulls of points that may be flat, few or many."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from .arrays import FloatArray, IntArray, frozen_floats
from .asset import ConvexMesh
from .farthest import farthest
from .topology import without_gaps
from .triangles import crosses

MIN_THICKNESS = 0.002  # [m] of the hull of something flat
_FLAT = 1e-12  # of the cube of its size: what a hull holds at least
_PLANE = 1e-6  # of how far points reach: what is thinner is flat to who reads 32-bit numbers
_MANY_POINTS, _MANY_DIRECTIONS = 20_000, 1024
_GOLDEN_ANGLE = np.pi * (3.0 - np.sqrt(5.0))


def hull_of(points: FloatArray) -> ConvexMesh | None:
    """The convex hull of (N, 3) points with outward triangles; None when they lie in a plane.

    Of very many points only the farthest in some hundred directions are asked: round shapes lose a percent.
    """
    from scipy.spatial import ConvexHull, QhullError

    if len(points) > _MANY_POINTS:
        points = points[outermost(points, _MANY_DIRECTIONS)]
    try:
        hull = ConvexHull(points)
    except QhullError:
        return None
    used, corners = without_gaps(hull.simplices)
    vertices = np.asarray(points, dtype=np.float64)[used]
    if min(float(np.ptp(vertices @ axis)) for axis in _principal_axes(vertices)) < _PLANE * _reach(vertices):
        return None
    inward = np.einsum("ni,ni->n", crosses(vertices[corners]), hull.equations[:, :3]) < 0
    return ConvexMesh(vertices, np.where(inward[:, None], corners[:, ::-1], corners))


def hull_corners(points: FloatArray) -> tuple[FloatArray, float] | None:
    """(C, 3) corners and the volume [m^3] of the hull of (N, 3) points; None when they lie in a plane.

    What is asked for again and again, of which nobody wants the faces; many times as fast as `hull_of`.
    """
    import manifold3d

    body = manifold3d.Manifold.hull_points(points)
    found = float(body.volume())
    box = body.bounding_box()
    if found <= _FLAT * math.dist(box[:3], box[3:]) ** 3:
        return None
    return np.asarray(body.to_mesh64().vert_properties[:, :3]), found


def convex_hull(points: FloatArray, max_vertices: int = 64, thickness: float = MIN_THICKNESS) -> ConvexMesh:
    """A convex shape around (N, 3) points, for simulators.

    Args:
        points: [m]; may lie in a plane, on a line or in one place.
        max_vertices: rounder hulls keep only their farthest vertices in as many fixed directions; at least 8.
        thickness: extent that it has at least in every direction [m].
    """
    thickness = max(thickness, 4 * _PLANE * _reach(points))
    hull = hull_of(_thickened(points, thickness))
    assert hull is not None  # thick in three directions
    if len(hull.vertices) <= max_vertices:
        return hull
    fewer = hull_of(_thickened(hull.vertices[outermost(hull.vertices, max_vertices)], thickness))
    assert fewer is not None
    return fewer


def volume(shape: ConvexMesh) -> float:
    """Signed volume inside outward triangles [m^3]."""
    a, b, c = (shape.vertices - shape.vertices.mean(axis=0))[shape.faces.T]
    return float(np.einsum("ni,ni->", a, crosses(np.stack([np.zeros_like(a), b, c], axis=1))) / 6)


@cache
def sphere_directions(count: int) -> FloatArray:
    """(N, 3) unit directions evenly over a sphere: a Fibonacci spiral."""
    step = np.arange(count) + 0.5
    z = 1 - 2 * step / count
    ring = np.sqrt(1 - z**2)
    turn = _GOLDEN_ANGLE * step
    return frozen_floats(np.column_stack([ring * np.cos(turn), ring * np.sin(turn), z]))


def outermost(points: FloatArray, count: int) -> IntArray:
    """Indices of the (N, 3) points that lie farthest along six axes and over a sphere, `count` at most."""
    sphere = sphere_directions(count - 6)
    directions = np.concatenate([np.eye(3), -np.eye(3), sphere])
    return np.unique(farthest(points, directions))


def _thickened(points: FloatArray, thickness: float) -> FloatArray:
    """The points, doubled apart along those of their principal axes in which they are thinner."""
    for axis in _principal_axes(points):
        lacking = thickness - float(np.ptp(points @ axis))
        if lacking > 0:
            offset = axis * (lacking / 2)
            points = np.concatenate([points - offset, points + offset])
    return points


def _principal_axes(points: FloatArray) -> FloatArray:
    """(3, 3) unit rows, along the first of which (N, 3) points spread least."""
    return np.asarray(np.linalg.eigh(np.cov(points - points.mean(axis=0), rowvar=False, bias=True))[1].T)


def _reach(points: FloatArray) -> float:
    return float(np.abs(points).max())
