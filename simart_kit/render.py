"""Pictures without a GPU or a display: ray casting on the CPU.

Rays through the pixels, four where surfaces meet, find what is seen. Its colour is texture times vertex
colour times material; its light is a key light with shadows, and a sky that corners see less of. Cut-outs
and glass let rays through. The same input gives the same bytes.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .arrays import ByteArray, FloatArray, IntArray
from .camera import Camera, Side, isometric
from .colors import Color
from .drawing.appearance import Appearance
from .drawing.lit_mesh import LAYERS, LitMesh
from .drawing.pixel_rays import Frame, PixelRays
from .mesh import Mesh
from .normals import with_normals
from .rays import Rays
from .srgb import encoded, srgb_to_linear

if TYPE_CHECKING:
    from .asset import Asset

WHITE: Color = (255, 255, 255)

_FAINT = 0.05  # opacity below which a surface counts as not there
_ROWS_AT_ONCE = 256


def render(
    mesh: Mesh,
    camera: Camera,
    width: int,
    height: int,
    *,
    paint: FloatArray | None = None,
    ground: float | None = None,
    background: Color | None = WHITE,
    caster: Rays | None = None,
) -> ByteArray:
    """(height, width, 4) RGBA picture of a mesh.

    Args:
        mesh: normals are computed when it has none.
        camera: where to look from.
        width: [pixels].
        height: [pixels].
        paint: (F, 4) sRGB colour 0..1 and strength 0..1 laid over each face.
        ground: height of a ground that shows only the shadow on it [m]; None for no ground.
        background: sRGB colour; None leaves the picture transparent where nothing is.
        caster: of the mesh's triangles, where there is one already, which saves time.
    """
    linear = LitMesh(with_normals(mesh), Frame(camera, width, height), paint, ground, caster).picture()
    color, opacity = linear[..., :3], linear[..., 3:]
    if background is None:
        color, alpha = color / np.maximum(opacity, 1e-6), opacity
    else:
        color = color + (1 - opacity) * srgb_to_linear(np.array(background) / 255.0)
        alpha = np.ones_like(opacity)
    return encoded(np.concatenate([color, alpha], axis=-1))


def face_ids(mesh: Mesh, camera: Camera, width: int, height: int) -> IntArray:
    """(height, width) int32 index of the face seen in the middle of each pixel, -1 for none."""
    mesh = with_normals(mesh)
    caster, look = Rays(mesh.vertices, mesh.faces), Appearance(mesh)
    frame = Frame(camera, width, height)
    tops = range(0, height, _ROWS_AT_ONCE)
    bands = [range(top, min(top + _ROWS_AT_ONCE, height)) for top in tops]
    return np.concatenate([_ids(caster, look, PixelRays.single(frame, rows)) for rows in bands])


def isometric_view(mesh: Mesh, size: int = 252, side: Side = "left") -> ByteArray:
    """(size, size, 3) RGB picture on white along the diagonal from the front and above.

    This is the input picture of SIMART (252 x 252); `side` says from which side of the front.
    """
    return render(mesh, isometric(mesh.bounds, side), size, size)[..., :3]


def write_preview(asset: Asset, path: Path) -> Path:
    """Write the PNG picture of an asset closed, half open and open; see `preview`."""
    from .drawing.preview import preview_png

    path.write_bytes(preview_png(asset))
    return path


def _ids(caster: Rays, look: Appearance, rays: PixelRays) -> IntArray:
    shape = (len(rays.rows), rays.frame.width)
    result = np.full(shape[0] * shape[1], -1, dtype=np.int32)
    for _ in range(LAYERS if look.translucent else 1):
        hits = caster.hits(rays.origins, rays.directions)
        met = np.flatnonzero(hits.face >= 0)
        opacity = look.colors(hits.face[met], hits.weights[met], np.zeros(len(met), np.float32))[:, 3]
        there, absent = met[opacity >= _FAINT], met[opacity < _FAINT]
        result[rays.pixel[there]] = hits.face[there]
        rays = rays.beyond(hits, absent, 1e-5 * caster.size)
    return result.reshape(shape)
