"""Light for pictures: a soft key light with shadows, and a sky that corners see less of.

Pixels of a tile look in different directions; averaging over a tile joins what they saw.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Float32Array, FloatArray, IntArray
from ..camera import Camera
from ..rays import Rays
from .appearance import normalized
from .tiles import TILE, tile_means

_SKY_RAYS = 2
_KEY_RAYS = 2
_SKY = np.array([0.60, 0.62, 0.65], np.float32)
_GROUND = np.array([0.44, 0.43, 0.42], np.float32)
_KEY = np.array([0.74, 0.72, 0.685], np.float32)
_BOUNCE = np.float32(0.22)  # what arrives from surfaces that hide the sky
_KEY_SPREAD = np.float32(0.10)


@dataclass(frozen=True, eq=False)
class Points:
    """Points of surfaces that a picture shows.

    Attributes:
        pixel: (N,) index of the pixel that shows it: row * width + column.
        number: (N,) 0 for a pixel's first ray, 1 for its second ...
        position: (N, 3) [m].
        flat: (N, 3) unit normals of the faces, towards the eye.
        smooth: (N, 3) unit normals for shading, towards the eye.
    """

    pixel: IntArray
    number: IntArray
    position: Float32Array
    flat: Float32Array
    smooth: Float32Array


@dataclass(frozen=True, eq=False)
class Lighting:
    """Where the light comes from.

    Attributes:
        caster: what throws shadows.
        key: (3,) unit direction to the key light.
        reach: how far a surface hides the sky from others [m].
    """

    caster: Rays
    key: Float32Array
    reach: float

    @classmethod
    def of(cls, caster: Rays, camera: Camera) -> Lighting:
        """The key light stands above and left of the camera, so that every view is lit alike."""
        right, _, forward = camera.axes
        back = -forward * [1.0, 1.0, 0.0]
        direction = 0.75 * back / max(float(np.linalg.norm(back)), 1e-9) - 0.45 * right + [0.0, 0.0, 0.95]
        key = (direction / np.linalg.norm(direction)).astype(np.float32)
        return cls(caster, key, 0.45 * caster.size)

    def on(self, points: Points, width: int, rows: range) -> Float32Array:
        """(N, 3) light that falls on points, linear; about 1 in the open.

        Args:
            points: their pixels count from the first of `rows`.
            width: of the picture [pixels].
            rows: of the picture that they lie in.
        """
        seen = self._seen(points, width, rows)
        seen = tile_means(seen, points.pixel, points.flat, points.position, width, 0.01 * self.caster.size)
        upward = (0.5 + 0.5 * points.smooth[:, 2:]).astype(np.float32)
        sky = _GROUND + (_SKY - _GROUND) * upward
        facing = np.maximum(points.smooth @ self.key, 0)[:, None]
        return np.asarray(sky * (_BOUNCE + (1 - _BOUNCE) * seen[:, :1]) + _KEY * facing * seen[:, 1:])

    def in_the_open(self, normal: FloatArray) -> Float32Array:
        """(3,) light on a surface that nothing hides."""
        sky = _GROUND + (_SKY - _GROUND) * np.float32(0.5 + 0.5 * normal[2])
        return np.asarray(sky + _KEY * max(float(self.key @ normal), 0.0), dtype=np.float32)

    def _seen(self, points: Points, width: int, rows: range) -> Float32Array:
        """(N, 2) share of the sky and of the key light that each point sees."""
        row, column = points.pixel // width + rows.start, points.pixel % width
        place = (points.number * TILE + row % TILE) * TILE + column % TILE
        start = points.position + points.flat * np.float32(2e-4 * self.caster.size)
        sphere = _sphere((int(place.max(initial=0)) + 1) * _SKY_RAYS).reshape(-1, _SKY_RAYS, 3)
        seen = np.zeros((len(start), 2), dtype=np.float32)
        first = points.number == 0
        for k in range(_SKY_RAYS):
            # A normal plus a point of the unit sphere is distributed with the cosine.
            on = np.flatnonzero(first | (k == 0))
            normal = points.flat.take(on, axis=0) * np.float32(1.001)
            towards = normalized(normal + sphere[:, k].take(place.take(on), axis=0))
            seen[on, 0] += ~self.caster.blocked(start.take(on, axis=0), towards, self.reach)
        lit = points.flat @ self.key > 0
        for k in range(_KEY_RAYS):
            on = np.flatnonzero(lit & (first | (k == 0)))
            towards = normalized(self.key + _KEY_SPREAD * sphere[:, k].take(place.take(on), axis=0))
            seen[on, 1] += ~self.caster.blocked(start.take(on, axis=0), towards)
        # A pixel's second to fourth rays send one ray each: together they see as much as the first.
        seen[first] /= np.array([_SKY_RAYS, _KEY_RAYS], dtype=np.float32)
        return seen


def _sphere(count: int) -> Float32Array:
    """(count, 3) points of the unit sphere, any first few of them spread evenly.

    The additive recurrence R2 of Martin Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences".
    """
    plastic = 1.32471795724474602596
    index = np.arange(1, count + 1)
    z, turn = 1 - 2 * (index / plastic % 1), 2 * np.pi * (index / plastic**2 % 1)
    radius = np.sqrt(1 - z * z)
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), z], axis=1).astype(np.float32)
