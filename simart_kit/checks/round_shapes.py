"""Points on boxes, cylinders and spheres that bound them as their corners do."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray

_AROUND = 32


def box_corners(half: FloatArray) -> FloatArray:
    """(8, 3) corners of a box about 0 with (3,) half sizes [m]."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return np.asarray(signs * half)


def cylinder_points(radius: float, half_height: float) -> FloatArray:
    """(64, 3) points on both rims of a cylinder about z [m]."""
    angles = np.linspace(0, 2 * np.pi, _AROUND, endpoint=False)
    ring = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    rims = [np.column_stack([ring, np.full(_AROUND, z)]) for z in (-half_height, half_height)]
    return np.concatenate(rims)


def capsule_points(radius: float, half_height: float) -> FloatArray:
    """(N, 3) points on a capsule about z [m]; `half_height` is that of its cylinder."""
    points = sphere_points(radius)
    points[:, 2] += np.where(points[:, 2] < 0, -half_height, half_height)
    return np.concatenate([points, cylinder_points(radius, half_height)])


def sphere_points(radius: float) -> FloatArray:
    """(N, 3) points on a sphere about 0 [m], its six poles among them."""
    angles = np.linspace(0, 2 * np.pi, _AROUND, endpoint=False)
    rings = [
        np.column_stack([np.cos(angles) * np.cos(h), np.sin(angles) * np.cos(h), np.full(_AROUND, np.sin(h))])
        for h in np.linspace(-np.pi / 2, np.pi / 2, 9)
    ]
    return np.asarray(radius * np.concatenate(rings))
