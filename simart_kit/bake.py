"""Colours as one texture a surface: what OBJ, MJCF and other formats without vertex colours can show."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from .arrays import ByteArray, FloatArray, IntArray, frozen_bytes, frozen_floats, frozen_ints
from .asset import Asset
from .kept import kept
from .mesh import Image, VisualMaterial
from .srgb import tinted
from .surfaces import Surface, asset_surfaces
from .topology import unique_rows

Color = tuple[float, float, float, float]

# The corners of a triangle as texels of its cell: apex, right of it, below it.
_ROTATIONS = np.array([[0, 1, 2], [1, 2, 0], [2, 0, 1]], dtype=np.int32)


@kept
def textured_surfaces(asset: Asset) -> Mapping[str, tuple[Surface, ...]]:
    """The surfaces of every part with all of their colour in one texture, or in `base_color` alone.

    Vertex colours become a texture, unless there is one already (see `loses_colors`). Factors that tint a
    texture are multiplied into its pixels, which leaves `base_color` white with the factor's alpha.
    """
    looks = {m: m if asset.mesh.uv is None else _tinted_texture(m) for m in asset.mesh.materials}
    groups = asset_surfaces(asset)
    return {part: tuple(_one_texture(s, looks[s.material]) for s in group) for part, group in groups.items()}


def loses_colors(surface: Surface) -> bool:
    """Whether a texture hides vertex colours that are not plain white."""
    return bool(surface.picture and surface.colors is not None and (surface.colors != 255).any())


def bake_colors(surface: Surface) -> Surface:
    """The surface with its vertex colours as a texture; faces keep their order, vertices are split as needed.

    A cell of 2 x 2 texels holds the three colours of a triangle, and a fourth that completes the plane
    through them as far as 0..255 allows. Corners sit at texel centres, so bilinear filtering gives back
    linear interpolation between the corners and never reads a neighbouring cell.

    Raises:
        ValueError: the surface has no vertex colours.
    """
    if surface.colors is None:
        raise ValueError(f"part '{surface.part}' has no vertex colours to bake")
    corners = surface.colors[surface.faces]
    order = _least_clamped(corners)
    triples = np.take_along_axis(corners, order[:, :, None], axis=1)
    _, color = unique_rows(surface.colors.view(">u4").astype(np.int64))
    first, cell = unique_rows(np.take_along_axis(color[surface.faces], order, axis=1))
    cells = triples[first]

    texel = np.argsort(order, axis=1)
    one_color = (cells == cells[:, :1]).all(axis=(1, 2))
    texel[one_color[cell]] = 0
    place = cell[:, None] * 3 + texel
    used, faces = np.unique(surface.faces.astype(np.int64) * 3 * len(cells) + place, return_inverse=True)
    vertex, place = np.divmod(used, 3 * len(cells))

    pixels = _picture(cells)
    return replace(
        surface,
        material=replace(surface.material, base_color_image=_image(pixels)),
        vertices=frozen_floats(surface.vertices[vertex]),
        normals=frozen_floats(surface.normals[vertex]),
        uv=frozen_floats(_texel_centres(place, pixels.shape)),
        colors=None,
        faces=frozen_ints(faces.reshape(-1, 3)),
    )


def _tinted_texture(material: VisualMaterial) -> VisualMaterial:
    image, factor = material.base_color_image, material.base_color
    if image is None or factor[:3] == (1.0, 1.0, 1.0):
        return material
    return replace(material, base_color=_white(factor), base_color_image=_image(tinted(image.pixels, factor)))


def _one_texture(surface: Surface, material: VisualMaterial) -> Surface:
    if surface.picture:
        return replace(surface, material=material, colors=None)
    if material.base_color_image is not None:  # a picture without coordinates
        material = replace(material, base_color_image=None)
    if surface.colors is None or (surface.colors == 255).all():
        return replace(surface, material=material, colors=None, uv=None)
    colors = frozen_bytes(tinted(surface.colors, material.base_color))
    material = replace(material, base_color=_white(material.base_color))
    return bake_colors(replace(surface, material=material, colors=colors))


def _white(factor: Color) -> Color:
    return (1.0, 1.0, 1.0, factor[3])


def _least_clamped(corners: ByteArray) -> IntArray:
    """(F, 3) rotation of each face's (F, 3, 4) corners whose fourth texel leaves 0..255 least."""
    excess = []
    for rotation in _ROTATIONS:
        fourth = _fourth(corners[:, rotation])
        excess.append(np.abs(fourth - np.clip(fourth, 0, 255)).sum(axis=1))
    return np.asarray(_ROTATIONS[np.argmin(excess, axis=0)])


def _fourth(cells: ByteArray) -> IntArray:
    """(C, 4) colours that complete the planes through (C, 3, 4) apex, right and below; may leave 0..255."""
    apex, right, below = cells.astype(np.int32).transpose(1, 0, 2)
    return np.asarray(right + below - apex)


def _picture(cells: ByteArray) -> ByteArray:
    """(H, W, 4) picture of (C, 3, 4) cells, row by row from the top."""
    columns = int(np.ceil(np.sqrt(len(cells))))
    rows = -(-len(cells) // columns)
    fourth = np.clip(_fourth(cells), 0, 255).astype(np.uint8)
    texels = np.concatenate([cells, fourth[:, None]], axis=1)
    # Spare cells repeat the last one: black would darken the smaller mip levels.
    spare = np.repeat(texels[-1:], rows * columns - len(cells), axis=0)
    grid = np.concatenate([texels, spare]).reshape(rows, columns, 2, 2, 4)
    return grid.transpose(0, 2, 1, 3, 4).reshape(2 * rows, 2 * columns, 4)


def _texel_centres(place: IntArray, shape: tuple[int, ...]) -> FloatArray:
    """(N, 2) UV, origin bottom left, of texels numbered 3 a cell: apex, right, below."""
    height, width = shape[:2]
    cell, texel = np.divmod(place, 3)
    row, column = np.divmod(cell, width // 2)
    u = (2 * column + (texel == 1) + 0.5) / width
    v = 1.0 - (2 * row + (texel == 2) + 0.5) / height
    return np.column_stack([u, v])


def _image(rgba: ByteArray) -> Image:
    """A PNG with alpha only where some pixel needs it."""
    return Image.from_pixels(rgba if (rgba[..., 3] < 255).any() else rgba[..., :3])
