"""Pulling one side of a convex shape in, so that it gives way to a neighbour there and nowhere else."""

from __future__ import annotations

import numpy as np

from .arrays import FloatArray, vec3
from .asset import ConvexMesh
from .convex_overlap import convex
from .hulls import convex_hull, hull_of
from .primitive_meshes import pose, primitive_shape
from .primitives import Primitive

_ALIGNED = 1 - 1e-6  # cosine from which a direction counts as a primitive's own axis
_LEFT = 0.5  # share of its diameter down to which what is round shrinks; it is cut where more has to go


def extent(shape: ConvexMesh, axis: FloatArray) -> float:
    """How long a shape is along a (3,) unit axis [m]."""
    lower, upper = convex(shape).extent(axis[None])
    return float(upper[0] - lower[0])


def pulled_in(shape: ConvexMesh, axis: FloatArray, amount: float) -> ConvexMesh:
    """The shape without what lies within `amount` [m] of its farthest end along a (3,) unit axis.

    A box or a cylinder that ends flat there stays one, and so does a sphere, or a cylinder's side, which
    shrinks all around, if half of it is left.
    """
    if amount <= 0:
        return shape
    if shape.primitive is not None:
        shorter = _shorter(shape.primitive, axis, amount)
        if shorter is not None:
            return primitive_shape(shorter)
    return _clipped(shape, axis, float(convex(shape).extent(axis[None])[1][0]) - amount)


def _shorter(primitive: Primitive, axis: FloatArray, amount: float) -> Primitive | None:
    """The primitive without its end along an axis; None when it is none any more."""
    own = axis @ primitive.asset_T_shape[:3, :3]
    along = int(np.argmax(np.abs(own)))
    round_ = primitive.kind == "sphere" or (primitive.kind == "cylinder" and abs(own[2]) < 1e-3)
    if round_:
        size = np.array(primitive.size) - 2 * amount * np.array([1, 1, primitive.kind == "sphere"])
        left = size[0] >= _LEFT * primitive.size[0]
        return Primitive(primitive.kind, vec3(size), primitive.asset_T_shape) if left else None
    if abs(own[along]) < _ALIGNED or (primitive.kind == "cylinder" and along != 2):
        return None
    rotation, middle = primitive.asset_T_shape[:3, :3], primitive.asset_T_shape[:3, 3]
    size = np.array(primitive.size)
    size[along] -= amount
    shift = rotation[:, along] * (-np.sign(own[along]) * amount / 2)
    return Primitive(primitive.kind, vec3(size), pose(rotation, middle + shift))


def _clipped(shape: ConvexMesh, axis: FloatArray, end: float) -> ConvexMesh:
    """What of a convex mesh lies no farther along an axis than `end` [m]."""
    height = shape.vertices @ axis - end
    ends = shape.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    low, high = ends[(height[ends[:, 0]] <= 0) & (height[ends[:, 1]] > 0)].T
    share = (height[low] / (height[low] - height[high]))[:, None]
    cut = shape.vertices[low] + share * (shape.vertices[high] - shape.vertices[low])
    kept = np.concatenate([shape.vertices[height <= 0], cut])
    hull = hull_of(kept)
    if hull is None:
        return shape
    most = max(len(shape.vertices), 64)
    return hull if len(hull.vertices) <= most else convex_hull(kept, most)
