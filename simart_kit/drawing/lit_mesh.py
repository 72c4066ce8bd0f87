"""A lit mesh before a camera: colour and opacity of rows of pixels."""

from __future__ import annotations

import numpy as np

from ..arrays import Float32Array, FloatArray, IntArray
from ..mesh import Mesh
from ..rays import Hits, Rays
from .appearance import Appearance, look_alike, opaque_faces
from .lighting import Lighting, Points
from .pixel_rays import SUBPIXELS, Frame, PixelRays
from .tiles import TILE

LAYERS = 6
"""Surfaces that a ray may pass through."""
_RAYS_AT_ONCE = 1 << 19
_UP = np.array([0.0, 0.0, 1.0])


class LitMesh:
    """One mesh before one camera; renders a band of rows at a time, so that memory stays small.

    Args:
        mesh: with normals.
        frame: camera and size of the picture.
        paint: (F, 4) sRGB colour 0..1 and strength 0..1 laid over each face, or None.
        ground: height of a ground that shows only shadow [m], or None.
        caster: of the mesh's triangles, where there is one already.
    """

    def __init__(
        self,
        mesh: Mesh,
        frame: Frame,
        paint: FloatArray | None,
        ground: float | None,
        caster: Rays | None = None,
    ) -> None:
        self._frame, self._ground = frame, ground
        self._look = Appearance(mesh, paint)
        self._caster = Rays(mesh.vertices, mesh.faces) if caster is None else caster
        self._surface = look_alike(mesh, paint)
        opaque = opaque_faces(mesh)
        shadows = self._caster if opaque.all() else Rays(mesh.vertices, mesh.faces[opaque])
        self._lighting = Lighting.of(shadows, frame.camera)

    def picture(self) -> FloatArray:
        """(H, W, 4) linear premultiplied colour and opacity."""
        rows = max(TILE, _RAYS_AT_ONCE // (len(SUBPIXELS) * self._frame.width))
        tops = range(0, self._frame.height, rows)
        return np.concatenate([self._band(range(top, min(top + rows, self._frame.height))) for top in tops])

    def _band(self, rows: range) -> FloatArray:
        # Rows above and below are cast too, for light is averaged over tiles: bands then join without a seam.
        wide = range(max(0, rows.start - TILE), min(self._frame.height, rows.stop + TILE))
        first, hits = PixelRays.adaptive(self._frame, wide, self._caster, self._surface)
        result = np.zeros((len(first.pixel), 4), dtype=np.float32)
        rays, at = first, np.arange(len(first.pixel))
        for layer in range(LAYERS if self._look.translucent else 1):
            if layer:
                hits = self._caster.hits(rays.origins, rays.directions)
            result[at] += (1 - result[at, 3:]) * self._layer(rays, hits)
            on = np.flatnonzero((hits.face >= 0) & (result[at, 3] < 0.98))
            rays, at = rays.beyond(hits, on, 1e-5 * self._caster.size), at[on]
        return first.pixel_means(result)[rows.start - wide.start : rows.stop - wide.start]

    def _layer(self, rays: PixelRays, hits: Hits) -> Float32Array:
        """(N, 4) linear premultiplied colour and opacity of what the rays met."""
        met = np.flatnonzero(hits.face >= 0)
        floor, floor_at = self._on_ground(rays, hits)
        face, weights = hits.face[met], hits.weights[met]
        flat, smooth = self._look.normals(face, weights, rays.directions[met])
        up = np.broadcast_to(_UP.astype(np.float32), floor_at.shape)
        points = Points(
            np.concatenate([rays.pixel[met], rays.pixel[floor]]),
            np.concatenate([rays.number[met], rays.number[floor]]),
            np.concatenate([rays.at(met, hits.distance[met]), floor_at]),
            np.concatenate([flat, up]),
            np.concatenate([smooth, up]),
        )
        light = self._lighting.on(points, self._frame.width, rays.rows)
        rgba = self._look.colors(face, weights, rays.widths(hits.distance)[met])
        result = np.zeros((len(hits.face), 4), dtype=np.float32)
        result[met, :3] = _shoulder(rgba[:, :3] * light[: len(met)]) * rgba[:, 3:]
        result[met, 3] = rgba[:, 3]
        result[floor, 3] = self._shadow(light[len(met) :], floor_at)
        return result

    def _on_ground(self, rays: PixelRays, hits: Hits) -> tuple[IntArray, Float32Array]:
        """Rays that meet the ground near the mesh and nothing before it, and where (N, 3) [m]."""
        if self._ground is None:
            return np.zeros(0, dtype=np.int64), np.zeros((0, 3), dtype=np.float32)
        down = np.flatnonzero((hits.face < 0) & (rays.directions[:, 2] < -1e-6))
        distance = (np.float32(self._ground) - rays.origins[down, 2]) / rays.directions[down, 2]
        at = rays.at(down, distance)
        near = (distance > 0) & (self._from_center(at) < 1)
        return down[near], at[near]

    def _from_center(self, at: Float32Array) -> Float32Array:
        """(N,) distance of ground points from the mesh; shadows end at 1."""
        offset = at[:, :2] - self._caster.center[:2].astype(np.float32)
        return np.asarray(np.hypot(offset[:, 0], offset[:, 1]) / np.float32(1.3 * self._caster.size))

    def _shadow(self, light: Float32Array, at: Float32Array) -> Float32Array:
        """(N,) how much darker the ground is than in the open."""
        share = (light / self._lighting.in_the_open(_UP)).mean(axis=1)
        fade = np.clip(2 * (1 - self._from_center(at)), 0, 1)
        return np.asarray(np.clip(1 - share, 0, 1) * fade * np.float32(0.75))


def _shoulder(linear: Float32Array) -> Float32Array:
    """Light above 0.8 is compressed, so that bright surfaces keep their drawing."""
    return np.where(linear < 0.8, linear, 1 - 0.2 * np.exp(-(linear - 0.8) / np.float32(0.2)))
