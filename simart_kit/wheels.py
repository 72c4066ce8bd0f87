"""Wheels: what turns without end and stands on the ground rolls, and so needs a round shape."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray
from .asset import Asset, ConvexMesh
from .fitting import cylinder_along
from .hulls import hull_of, volume
from .moments import solid_moments
from .primitive_meshes import pose, primitive_shape
from .primitives import Primitive

_LEVEL = 0.2  # how far an axle may point up or down
_ON_GROUND = 0.05  # of its diameter that a wheel may end above the lowest point of the object
_CENTRED = 0.05  # of its diameter that its middle may lie beside the axle
_ROUND = 0.93  # share of the circle around it that its outline fills: ten sides
_FILLED = 0.5  # share of the cylinder around it that its hull fills: a tyre is rounded, and a hub stands out


def wheels(asset: Asset) -> dict[str, ConvexMesh]:
    """The cylinder that each wheel rolls on, by name of its part.

    It is as large as the wheel, and so wide that it holds as much as the wheel's hull: spokes and hollow rims
    count as full, while convex pieces of them would make a polygon that bumps along. A part is a wheel if its
    joint turns without end about a level axis through its middle, it is round about that, and it reaches the
    ground.

    Args:
        asset: at rest, on level ground.
    """
    ground = float(asset.mesh.bounds[0, 2])
    found = {}
    for joint in asset.joints:
        if joint.kind != "continuous" or abs(joint.axis[2]) > _LEVEL:
            continue
        points = asset.mesh.points_of(asset.face_part == asset.part_index(joint.child))
        shape = _rolling(points, np.array(joint.origin), np.array(joint.axis), ground)
        if shape is not None:
            found[joint.child] = shape
    return found


def _rolling(points: FloatArray, origin: FloatArray, axis: FloatArray, ground: float) -> ConvexMesh | None:
    """The cylinder about an axle that (N, 3) points roll on; None where they are not round on the ground."""
    hull = hull_of(points)
    if hull is None:
        return None
    around = cylinder_along(hull, axis)
    diameter, asset_T_wheel = around.size[0], around.asset_T_shape
    away = asset_T_wheel[:3, 3] - origin
    beside = float(np.linalg.norm(away - (away @ axis) * axis))
    stands = float(points[:, 2].min()) - ground <= _ON_GROUND * diameter
    filled = volume(hull) / around.volume
    if (
        not stands
        or beside > _CENTRED * diameter
        or filled < _FILLED
        or _outline(hull, asset_T_wheel) < _ROUND
    ):
        return None
    held = solid_moments(hull.vertices[hull.faces] - origin).sum(axis=0)
    middle = origin + (held[:3, 3] / held[3, 3] @ axis) * axis
    size = (diameter, diameter, filled * around.size[2])
    return primitive_shape(Primitive("cylinder", size, pose(asset_T_wheel[:3, :3], middle)))


def _outline(hull: ConvexMesh, asset_T_wheel: FloatArray) -> float:
    """Share of the circle around it that a hull fills, seen along its axle."""
    from scipy.spatial import ConvexHull

    flat = (hull.vertices - asset_T_wheel[:3, 3]) @ asset_T_wheel[:3, :2]
    return float(ConvexHull(flat).volume / (np.pi * np.square(flat).sum(axis=1).max()))
