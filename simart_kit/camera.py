"""Cameras: where rays start, and where points land in a picture."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, Vec3, frozen_floats, unit, vec3
from .bounds import box_corners

Side = Literal["left", "right"]
ISOMETRIC_ELEVATION = float(np.arctan(1 / np.sqrt(2)))
"""Elevation at which the three axes of a cube are foreshortened alike: 35.26 degrees [rad]."""


@dataclass(frozen=True)
class Camera:
    """Looks from one point at another, +Z up in the picture (+Y when it looks straight up or down).

    Attributes:
        position: (3,) the eye; of an orthographic camera, a point on the plane that rays start from [m].
        target: (3,) point in the middle of the picture [m].
        view_height: height of the picture at the target's distance [m].
        perspective: False for an orthographic camera.
    """

    position: Vec3
    target: Vec3
    view_height: float
    perspective: bool = True

    @property
    def distance(self) -> float:
        """From eye to target [m]."""
        return float(np.linalg.norm(np.subtract(self.target, self.position)))

    @cached_property
    def axes(self) -> FloatArray:
        """(3, 3) rows: unit directions right, up and forward of the picture."""
        return frozen_floats(_axes(unit(np.subtract(self.target, self.position))))

    def rays(self, pixels: FloatArray, width: int, height: int) -> tuple[FloatArray, FloatArray]:
        """Rays through points of the picture.

        Args:
            pixels: (N, 2) column and row; (0, 0) is the outer corner of the top left pixel.
            width: of the picture [pixels].
            height: of the picture [pixels].

        Returns:
            (N, 3) origins [m] and (N, 3) unit directions.
        """
        right, up, forward = self.axes
        step = self.view_height / height
        offset = (pixels[:, :1] - width / 2) * (step * right) + (height / 2 - pixels[:, 1:]) * (step * up)
        if not self.perspective:
            return np.array(self.position) + offset, np.broadcast_to(forward, offset.shape)
        directions = offset + self.distance * forward
        directions /= np.sqrt(np.einsum("ij,ij->i", directions, directions))[:, None]
        return np.broadcast_to(np.array(self.position), offset.shape), directions

    def project(self, points: ArrayLike, width: int, height: int) -> FloatArray:
        """(N, 2) column and row of (N, 3) points before the camera [m]; the inverse of `rays`."""
        local = (np.asarray(points, dtype=np.float64) - np.array(self.position)) @ self.axes.T
        shrink = local[:, 2:] / self.distance if self.perspective else 1.0
        columns_rows = local[:, :2] * [1, -1] / shrink * (height / self.view_height)
        return np.asarray(columns_rows + [width / 2, height / 2])


def isometric(bounds: FloatArray, side: Side = "left") -> Camera:
    """Orthographic view of a box along a diagonal, from the front (-Y) and above, for a square picture.

    Args:
        bounds: (2, 3) lower and upper corner [m].
        side: "left" (eye at -X) or "right".
    """
    azimuth = np.deg2rad(45.0 if side == "right" else -45.0)
    return framed(box_corners(bounds), azimuth, ISOMETRIC_ELEVATION, perspective=False)


def framed(
    points: FloatArray,
    azimuth: float,
    elevation: float,
    *,
    aspect: float = 1.0,
    perspective: bool = True,
    margin: float = 0.08,
) -> Camera:
    """The closest camera of a direction that has all points in the picture.

    Args:
        points: (N, 3) [m].
        azimuth: of the eye about +Z, 0 in front (-Y), positive towards +X [rad].
        elevation: of the eye above the ground [rad].
        aspect: width of the picture by its height.
        perspective: a long lens (24 degrees high), else orthographic.
        margin: share of the picture that stays free at each border.
    """
    to_eye = np.array([np.sin(azimuth), -np.cos(azimuth), 0.0]) * np.cos(elevation)
    axes = _axes(-(to_eye + [0.0, 0.0, np.sin(elevation)]))
    x, y, z = axes @ np.asarray(points, dtype=np.float64).T
    middle, free = (z.min() + z.max()) / 2, 1.0 - 2.0 * margin
    size = max(np.ptp(x), np.ptp(y), np.ptp(z), 1e-6)
    if perspective:
        tangent = np.tan(np.deg2rad(12.0))
        center_x, depth_x = _apex(x, z, tangent * aspect * free)
        center_y, depth_y = _apex(y, z, tangent * free)
        distance = middle - min(depth_x, depth_y, z.min() - 1e-3 * size)
        view_height = 2 * tangent * distance
    else:
        center_x, center_y = (x.min() + x.max()) / 2, (y.min() + y.max()) / 2
        view_height = max(np.ptp(y), np.ptp(x) / aspect, 1e-6 * size) / free
        distance = 2 * size
    target = np.array([center_x, center_y, middle]) @ axes
    return Camera(vec3(target - distance * axes[2]), vec3(target), float(view_height), perspective)


def _apex(across: FloatArray, depth: FloatArray, tangent: float) -> tuple[float, float]:
    """Position across, and depth, of the eye whose field of view just holds all points."""
    right, left = np.max(across - tangent * depth), np.max(-across - tangent * depth)
    return float(right - left) / 2, float(-(right + left) / (2 * tangent))


def _axes(forward: FloatArray) -> FloatArray:
    reference = np.array([0.0, 0.0, 1.0]) if abs(forward[2]) < 0.9999 else np.array([0.0, 1.0, 0.0])
    right = unit(np.cross(forward, reference))
    return np.stack([right, np.cross(right, forward), forward])
