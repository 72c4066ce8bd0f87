"""Collision shapes of USD as points, and the inertia that simulators take from them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray
from ..errors import BadInputError
from ..hulls import hull_of
from ..moments import inertia, solid_moments
from .round_shapes import box_corners, capsule_points, cylinder_points, sphere_points

if TYPE_CHECKING:
    from pxr import Usd

_ORDER = {"X": [2, 0, 1], "Y": [1, 2, 0], "Z": [0, 1, 2]}  # of coordinates, when z becomes an axis


def shape_points(prim: Usd.Prim) -> FloatArray:
    """(N, 3) corners of a shape in its own coordinates, or points on a round one.

    Raises:
        BadInputError: it is of a type that is not read.
    """
    from pxr import UsdGeom

    if prim.IsA(UsdGeom.Mesh):
        points = UsdGeom.Mesh(prim).GetPointsAttr().Get()
        return np.array([] if points is None else points, dtype=np.float64).reshape(-1, 3)
    if prim.IsA(UsdGeom.Cube):
        return box_corners(np.full(3, UsdGeom.Cube(prim).GetSizeAttr().Get() / 2))
    if prim.IsA(UsdGeom.Sphere):
        return sphere_points(UsdGeom.Sphere(prim).GetRadiusAttr().Get())
    for schema, points_of in ((UsdGeom.Cylinder, cylinder_points), (UsdGeom.Capsule, capsule_points)):
        if prim.IsA(schema):
            shape = schema(prim)
            points = points_of(shape.GetRadiusAttr().Get(), shape.GetHeightAttr().Get() / 2)
            return points[:, _ORDER[str(shape.GetAxisAttr().Get())]]
    raise BadInputError(f"{prim.GetPath()}: collision shapes of type {prim.GetTypeName()} are not read")


def uniform_inertia(shapes: Iterable[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Centre (3,) [m] and inertia (3, 3) about it [m^2] of 1 kg spread evenly over hulls of (N, 3) points.

    Without a shape of any volume both are zero.
    """
    hulls = [hull for points in shapes if len(points) > 3 and (hull := hull_of(points)) is not None]
    if not hulls:
        return np.zeros(3), np.zeros((3, 3))
    return inertia(np.sum([solid_moments(hull.vertices[hull.faces]).sum(axis=0) for hull in hulls], axis=0))
