"""A picture of an object with some of its faces in a strong colour and the rest pale."""

from __future__ import annotations

import io

import numpy as np

from ..arrays import BoolArray, ByteArray, FloatArray
from ..camera import Camera, framed
from ..mesh import Mesh
from ..rays import Rays
from ..render import WHITE, render
from ..submesh import submesh
from .pixel_rays import Frame, PixelRays

SIZE = 640
"""Width and height of the picture [pixels]."""
_MARK = (0.93, 0.33, 0.04)
_PALE = (0.86, 0.87, 0.89)
_MARKED, _PALED = 0.82, 0.72  # strength of the paint: some of the own look stays
_ELEVATION = np.deg2rad(26.0)
_AZIMUTHS = np.deg2rad([-35.0, 35.0, 145.0, -145.0])
_LOOK = 96  # [pixels] of the small pictures that views are chosen by
_HIDDEN = 0.35  # of the part's own outline: where less of it is seen, it shines through
_THROUGH = 0.45


def highlight_png(mesh: Mesh, faces: BoolArray) -> bytes:
    """PNG of a mesh with the (F,) faces marked, from the first side that shows about as much of them as any.

    Where other faces hide most of them, they shine through.
    """
    from PIL import Image

    whole, alone = Rays(mesh.vertices, mesh.faces), Rays(mesh.vertices, mesh.faces[faces])
    cameras = [framed(mesh.vertices[mesh.faces.ravel()], azimuth, _ELEVATION) for azimuth in _AZIMUTHS]
    counts = [_seen(whole, alone, faces, camera) for camera in cameras]
    most = max(seen for seen, _ in counts)
    best = next(i for i, (seen, _) in enumerate(counts) if 1.15 * seen >= most)
    seen, outline = counts[best]
    pixels = render(mesh, cameras[best], SIZE, SIZE, paint=_paint(faces), background=WHITE, caster=whole)
    if seen < _HIDDEN * outline:
        pixels = _shining_through(pixels, mesh, faces, cameras[best])
    buffer = io.BytesIO()
    Image.fromarray(pixels[..., :3]).save(buffer, "PNG")
    return buffer.getvalue()


def _paint(faces: BoolArray) -> FloatArray:
    """(F, 4) colour and strength."""
    return np.where(faces[:, None], np.array([*_MARK, _MARKED]), np.array([*_PALE, _PALED]))


def _seen(whole: Rays, alone: Rays, faces: BoolArray, camera: Camera) -> tuple[int, int]:
    """Pixels in which the faces are seen, and in which they would be without the others."""
    frame = Frame(camera, _LOOK, _LOOK)
    rays = PixelRays.single(frame, range(_LOOK))
    first, own = (caster.hits(rays.origins, rays.directions).face for caster in (whole, alone))
    return int(faces[first[first >= 0]].sum()), int((own >= 0).sum())


def _shining_through(pixels: ByteArray, mesh: Mesh, faces: BoolArray, camera: Camera) -> ByteArray:
    part = submesh(mesh, faces)
    paint = np.tile([*_MARK, _MARKED], (len(part.faces), 1))
    over = render(part, camera, SIZE, SIZE, paint=paint, background=None).astype(np.float64)
    strength = _THROUGH * over[..., 3:] / 255.0
    mixed = pixels[..., :3] * (1 - strength) + over[..., :3] * strength
    return np.rint(mixed).astype(np.uint8)
