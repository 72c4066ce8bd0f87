"""Boxes, cylinders and spheres that fit a convex piece so well that they can stand for it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .arrays import FloatArray, unit, vec3
from .asset import ConvexMesh
from .hulls import hull_of
from .hulls import volume as volume_in
from .primitive_meshes import pose, primitive_shape
from .primitives import Primitive
from .triangles import areas, unit_normals

FILLED = 0.95
"""Share of a primitive that a piece has to fill: bevels and facets are left."""

_CORNER = 0.005, 0.001  # how far a box's corner may stand out: of its diagonal, and [m] at least
_ALONG = 1e-4  # a box along the asset's axes is taken if it is larger than a turned one by no more than this
_ROUND = 16  # corners from which on a hull may fill a cylinder or sphere: of fewer it fills 0.91 at most
_SQUARE = 0.02  # cosine between two directions that count as perpendicular


def fitted(points: FloatArray, volume: float, filled: float = FILLED) -> ConvexMesh | None:
    """The primitive around (N, 3) points that is filled best; None where all are too loose.

    Args:
        points: [m].
        volume: of the solid that they bound [m^3]; what shells of it share may be counted twice.
        filled: share of the primitive that this has to be, above 0.93: few corners are not asked for less.
    """
    hull = hull_of(points)
    return fitted_to(hull, volume, filled) if hull is not None else None


def fitted_to(hull: ConvexMesh, volume: float, filled: float = FILLED) -> ConvexMesh | None:
    """The same around points of which the hull is known."""
    box, volume = _box(hull), min(volume, volume_in(hull))
    boxed = volume >= filled * box.volume and _corners_stand_out(box, hull) <= _slack(box)
    round_ones = [*_cylinders(hull, box), *_spheres(hull)] if len(hull.vertices) >= _ROUND else []
    fitting = [box] * boxed + [c for c in round_ones if volume >= filled * c.volume]
    return primitive_shape(min(fitting, key=lambda c: c.volume)) if fitting else None


def box_around(points: FloatArray) -> ConvexMesh:
    """The smallest box around (N, 3) points that do not lie in a plane, of those that are tried."""
    hull = hull_of(points)
    assert hull is not None
    return primitive_shape(_box(hull))


def aligned_box(lower: FloatArray, upper: FloatArray) -> ConvexMesh:
    """The box between two (3,) corners, along the asset's axes."""
    return primitive_shape(Primitive("box", vec3(upper - lower), pose(np.eye(3), (lower + upper) / 2)))


def cylinder_along(hull: ConvexMesh, axis: FloatArray) -> Primitive:
    """The cylinder around a hull along a (3,) unit axis."""
    x = unit(np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))]))
    return _cylinder(hull, np.column_stack([x, np.cross(axis, x), axis]))


def _box(hull: ConvexMesh) -> Primitive:
    """The smallest box along the asset's axes or the hull's largest faces."""
    boxes = [_box_along(rotation, hull.vertices) for rotation in (np.eye(3), _rotation(hull))]
    return boxes[0] if boxes[0].volume <= (1 + _ALONG) * boxes[1].volume else boxes[1]


def _box_along(rotation: FloatArray, points: FloatArray) -> Primitive:
    local = points @ rotation
    lower, upper = local.min(axis=0), local.max(axis=0)
    return Primitive("box", vec3(upper - lower), pose(rotation, rotation @ ((lower + upper) / 2)))


def _rotation(hull: ConvexMesh) -> FloatArray:
    """(3, 3) with the normal of the hull's largest face last, and of the largest that stands on it first."""
    triangles = hull.vertices[hull.faces]
    normals, area = unit_normals(triangles), areas(triangles)
    z = _largest(normals, area)
    upright = (np.abs(normals @ z) < _SQUARE) & (area > 0)
    if upright.any():
        x = _largest(normals[upright], area[upright])
    else:
        x = np.linalg.svd(hull.vertices - hull.vertices.mean(axis=0))[2][0]
    x = unit(np.cross(np.cross(z, x), z)) if abs(x @ z) < 1 - 1e-9 else unit(np.cross(z, np.roll(z, 1)))
    return np.column_stack([x, np.cross(z, x), z])


def _largest(normals: FloatArray, area: FloatArray) -> FloatArray:
    """(3,) unit direction in which most of the area looks, of triangles cut at will."""
    same = (normals @ normals.T > 1 - 1e-6) @ area
    return unit(normals[int(np.argmax(np.round(same / same.max(), 6)))])


def _corners_stand_out(box: Primitive, hull: ConvexMesh) -> float:
    """How far the farthest corner of a box lies outside the hull in it [m]."""
    triangles = hull.vertices[hull.faces]
    normals = unit_normals(triangles)
    offsets = np.einsum("fi,fi->f", normals, triangles[:, 0])
    corners = primitive_shape(box).vertices
    return float((corners @ normals.T - offsets).max(axis=1).max())


def _slack(box: Primitive) -> float:
    relative, least = _CORNER
    return max(relative * float(np.linalg.norm(box.size)), least)


def _cylinders(hull: ConvexMesh, box: Primitive) -> Iterator[Primitive]:
    """Cylinders around the hull along each axis of its box."""
    for axis in range(3):
        yield _cylinder(hull, np.roll(box.asset_T_shape[:3, :3], 2 - axis, axis=1))


def _cylinder(hull: ConvexMesh, rotation: FloatArray) -> Primitive:
    """The cylinder around the hull along the last column of a (3, 3) rotation."""
    local = hull.vertices @ rotation
    middle, radius = _round_center(local[:, :2])
    low, high = float(local[:, 2].min()), float(local[:, 2].max())
    size = (2 * radius, 2 * radius, high - low)
    return Primitive("cylinder", size, pose(rotation, rotation @ np.array([*middle, (low + high) / 2])))


def _spheres(hull: ConvexMesh) -> Iterator[Primitive]:
    middle, radius = _round_center(hull.vertices)
    yield Primitive("sphere", (2 * radius, 2 * radius, 2 * radius), pose(np.eye(3), middle))


def _round_center(points: FloatArray) -> tuple[FloatArray, float]:
    """Middle (D,) of the circle or sphere nearest to (N, D) points, least squares; the radius around all."""
    start = points.mean(axis=0)
    local = points - start
    rows = np.column_stack([2 * local, np.ones(len(local))])
    middle = np.linalg.lstsq(rows, (local**2).sum(axis=1), rcond=None)[0][:-1]
    return start + middle, float(np.linalg.norm(local - middle, axis=1).max())
