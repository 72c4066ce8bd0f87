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
from .kept import kept
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
    shown = np.flatnonzero(linear[..., 3].ravel())
    picture = np.full(
        linear.shape, (0, 0, 0, 0) if background is None else (*background, 255), dtype=np.uint8
    )
    picture.reshape(-1, 4)[shown] = encoded(_over(linear.reshape(-1, 4).take(shown, axis=0), background))
    return picture


def face_ids(mesh: Mesh, camera: Camera, width: int, height: int) -> IntArray:
    """(height, width) int32 index of the face seen in the middle of each pixel, -1 for none."""
    mesh = with_normals(mesh)
    caster, look = Rays(mesh.vertices, mesh.faces), Appearance(mesh)
    frame = Frame(camera, width, height)
    tops = range(0, height, _ROWS_AT_ONCE)
    bands = [range(top, min(top + _ROWS_AT_ONCE, height)) for top in tops]
    return np.concatenate([_ids(caster, look, PixelRays.single(frame, rows)) for rows in bands])


def isometric_view(mesh: Mesh, size: int = 252, side: Side = "left", caster: Rays | None = None) -> ByteArray:
    """(size, size, 3) RGB picture on white along the diagonal from the front and above.

    This is the input picture of SIMART (252 x 252); `side` says from which side of the front, and `caster` is
    that of `render`.
    """
    return render(mesh, isometric(mesh.bounds, side), size, size, caster=caster)[..., :3]


@kept
def rest_caster(asset: Asset) -> Rays:
    """Casts rays at an asset's mesh at rest: a third of the time that a small picture of it takes."""
    return Rays(asset.mesh.vertices, asset.mesh.faces)


def write_preview(asset: Asset, path: Path) -> Path:
    """Write the PNG picture of an asset in three poses; see `preview`."""
    from .drawing.preview import preview_png

    path.write_bytes(preview_png(asset))
    return path


def _over(linear: FloatArray, background: Color | None) -> FloatArray:
    """(N, 4) linear RGBA of (N, 4) premultiplied ones before a background, or none."""
    color, opacity = linear[:, :3], linear[:, 3:]
    if background is None:
        return np.concatenate([color / np.maximum(opacity, 1e-6), opacity], axis=1)
    color = color + (1 - opacity) * srgb_to_linear(np.array(background) / 255.0)
    return np.concatenate([color, np.ones_like(opacity)], axis=1)


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
