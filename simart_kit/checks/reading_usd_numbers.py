"""Transforms and attributes of USD as arrays and numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import FloatArray

if TYPE_CHECKING:
    from pxr import Gf, Usd


def moved(world_T_prim: FloatArray, points: FloatArray) -> FloatArray:
    """(N, 3) points in the world [m] of (N, 3) ones in a prim's coordinates."""
    return np.asarray(points @ world_T_prim[:3, :3].T + world_T_prim[:3, 3])


def unscaled(world_T_prim: FloatArray) -> FloatArray:
    """(3, 3) rotation of a (4, 4) transform whose scale is the same in all directions."""
    linear = world_T_prim[:3, :3]
    return np.asarray(linear / np.cbrt(abs(np.linalg.det(linear))))


def rotation(quaternion: Gf.Quatf) -> FloatArray:
    """(3, 3) rotation; the null quaternion, which is USD's fallback, is none."""
    w, (x, y, z) = quaternion.GetReal(), quaternion.GetImaginary()
    norm = math.sqrt(w * w + x * x + y * y + z * z)
    if norm == 0:
        return np.eye(3)
    w, x, y, z = w / norm, x / norm, y / norm, z / norm
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def number(prim: Usd.Prim, attribute: str) -> float:
    """A finite number; 0 where there is none."""
    value = prim.GetAttribute(attribute).Get() if prim.HasAttribute(attribute) else None
    return float(value) if value is not None and math.isfinite(value) else 0.0
