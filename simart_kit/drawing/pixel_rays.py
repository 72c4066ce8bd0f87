"""The rays of a picture: one through each pixel, more where faces meet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, Float32Array, FloatArray, IntArray
from ..camera import Camera
from ..rays import Hits, Rays

# Where the four rays of a pixel pass: a turned 2 x 2 grid smooths upright and level edges best.
SUBPIXELS = np.array([[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]])


@dataclass(frozen=True)
class Frame:
    """A picture to be: camera and size [pixels]."""

    camera: Camera
    width: int
    height: int


@dataclass(frozen=True, eq=False)
class PixelRays:
    """Rays through pixels of some rows of a picture.

    Attributes:
        frame: the picture.
        rows: of it.
        pixel: (N,) index of each ray's pixel, row by row from the first of `rows`.
        number: (N,) which of its pixel's rays it is.
        origins: (N, 3) [m].
        directions: (N, 3) unit.
    """

    frame: Frame
    rows: range
    pixel: IntArray
    number: IntArray
    origins: Float32Array
    directions: Float32Array

    @classmethod
    def single(cls, frame: Frame, rows: range) -> PixelRays:
        """One ray through the middle of each pixel."""
        pixel = np.arange(len(rows) * frame.width)
        return cls._through(frame, rows, pixel, np.zeros_like(pixel), np.array([[0.5, 0.5]]))

    @classmethod
    def adaptive(cls, frame: Frame, rows: range, caster: Rays, surface: IntArray) -> tuple[PixelRays, Hits]:
        """One ray a pixel, and four where a neighbour shows another of the (F,) `surface` ids of faces.

        Returns:
            The rays, and what they meet.
        """
        single = cls.single(frame, rows)
        hits = caster.hits(single.origins, single.directions)
        shown = np.where(hits.face >= 0, surface[hits.face], -1).reshape(len(rows), frame.width)
        border = _borders(shown).ravel()
        edges, rest = np.flatnonzero(border), np.flatnonzero(~border)
        pixel = np.repeat(edges, len(SUBPIXELS))
        number = np.tile(np.arange(len(SUBPIXELS)), len(edges))
        several = cls._through(frame, rows, pixel, number, SUBPIXELS[number])
        met = caster.hits(several.origins, several.directions)
        return single.only(rest).joined(several), hits.only(~border).joined(met)

    @classmethod
    def _through(
        cls, frame: Frame, rows: range, pixel: IntArray, number: IntArray, within: FloatArray
    ) -> PixelRays:
        corner = np.stack([pixel % frame.width, pixel // frame.width + rows.start], axis=1)
        origins, directions = frame.camera.rays(corner + within, frame.width, frame.height)
        return cls(frame, rows, pixel, number, origins.astype(np.float32), directions.astype(np.float32))

    def only(self, keep: IntArray) -> PixelRays:
        """Some of the rays, by index."""
        pixel, number = self.pixel.take(keep), self.number.take(keep)
        origins, directions = (values.take(keep, axis=0) for values in (self.origins, self.directions))
        return PixelRays(self.frame, self.rows, pixel, number, origins, directions)

    def joined(self, other: PixelRays) -> PixelRays:
        """The rays of both, which have the same frame and rows."""
        names = ("pixel", "number", "origins", "directions")
        both = (np.concatenate([getattr(self, n), getattr(other, n)]) for n in names)
        return PixelRays(self.frame, self.rows, *both)

    def at(self, rays: IntArray, distance: Float32Array) -> Float32Array:
        """(M, 3) points of some rays at (M,) distances [m]."""
        return np.asarray(self.origins[rays] + distance[:, None] * self.directions[rays])

    def beyond(self, hits: Hits, on: IntArray, step: float) -> PixelRays:
        """The rays `on`, from where they leave the surface that they met."""
        origins = self.at(on, hits.distance[on] + np.float32(step))
        return PixelRays(self.frame, self.rows, self.pixel[on], self.number[on], origins, self.directions[on])

    def widths(self, distance: Float32Array) -> Float32Array:
        """(N,) width of the picture's share that each ray stands for, at its distance [m]."""
        camera = self.frame.camera
        result = np.where(self.number > 0, np.float32(0.5), np.float32(1.0))
        result *= np.float32(camera.view_height / self.frame.height)
        return np.asarray(result * (distance / np.float32(camera.distance)) if camera.perspective else result)

    def pixel_means(self, values: Float32Array) -> FloatArray:
        """(R, W, K) mean of (N, K) values over the rays of each pixel."""
        shape = (len(self.rows), self.frame.width)
        count = shape[0] * shape[1]
        total = np.bincount(self.pixel, minlength=count)
        sums = [np.bincount(self.pixel, column, count) for column in values.T]
        return np.stack([s / total for s in sums], axis=-1).reshape(*shape, -1)


def _borders(shown: IntArray) -> BoolArray:
    """(H, W) pixels with another value among their four neighbours."""
    result = np.zeros(shown.shape, dtype=np.bool_)
    beside = shown[:, 1:] != shown[:, :-1]
    result[:, 1:] |= beside
    result[:, :-1] |= beside
    below = shown[1:] != shown[:-1]
    result[1:] |= below
    result[:-1] |= below
    return result
