"""Rotations for USD, whose joints turn about X, Y or Z and whose inertia is diagonal."""

from __future__ import annotations

import math
from itertools import permutations
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import FloatArray, Mat3, Vec3

if TYPE_CHECKING:
    from pxr import Gf


def turn_x_to(axis: Vec3) -> Gf.Quatf:
    """The shortest rotation that takes +X to a unit axis; half a turn about Z when that is -X."""
    from pxr import Gf

    x, y, z = axis
    across = y * y + z * z
    real = 1 + x if x > 0 else across / (1 - x)  # the same, and exact near -X too, where Gf.Rotation is not
    length = math.hypot(real, y, z)
    if not length:
        return Gf.Quatf(0.0, 0.0, 0.0, 1.0)
    return Gf.Quatf(real / length, 0.0, 0.0 - z / length, 0.0 + y / length)  # no -0 in the text


def principal_axes(inertia: Mat3) -> tuple[FloatArray, FloatArray]:
    """Moments and axes of a symmetric inertia tensor.

    Args:
        inertia: (3, 3) [kg*m^2].

    Returns:
        (3,) moments and (3, 3) rotation with the axes as columns, `axes @ diag(moments) @ axes.T` being the
        tensor; of the 24 rotations that do this, one close to the identity.
    """
    moments, vectors = np.linalg.eigh(np.array(inertia))
    size = np.abs(vectors).tolist()
    orders = [list(order) for order in permutations(range(3))]
    order = max(orders, key=lambda columns: sum(row[c] for row, c in zip(size, columns, strict=True)))
    axes = vectors[:, order]
    # The best order has |diagonal| sum above 1, and a reflection's trace is at most 1: this is a rotation.
    return moments[order], axes * np.where(np.diag(axes) < 0, -1.0, 1.0)


def quaternion(rotation: FloatArray) -> Gf.Quatf:
    """A (3, 3) rotation as a unit quaternion with a real part that is not negative."""
    from pxr import Gf

    # Gf multiplies row vectors, so its matrices are the transposes of ours.
    quat = Gf.Matrix3d(*rotation.T.ravel().tolist()).ExtractRotation().GetQuat().GetNormalized()
    return Gf.Quatf(quat if quat.GetReal() >= 0 else -quat)
