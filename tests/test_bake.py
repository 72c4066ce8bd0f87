"""Vertex colours and tints as textures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from simart_kit.asset import Asset
from simart_kit.bake import bake_colors, loses_colors, textured_surfaces
from simart_kit.mesh import VisualMaterial
from simart_kit.surfaces import Surface, asset_surfaces
from simart_kit.testing.meshes import cabinet_asset, static_asset


def painted(low: int, high: int, factor: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)) -> Asset:
    """A box with a random colour a vertex, each channel in low..high."""
    asset = static_asset()
    colors = np.random.default_rng(1).integers(low, high + 1, (8, 4))
    mesh = replace(asset.mesh, uv=None, colors=colors, materials=(VisualMaterial("paint", factor),))
    return replace(asset, mesh=mesh)


def only(asset: Asset) -> Surface:
    """The single surface of an asset, before baking."""
    ((surface,),) = asset_surfaces(asset).values()
    return surface


def sampled(surface: Surface, weights: np.ndarray) -> np.ndarray:
    """(F, 4) texture of a surface at (F, 3) barycentric weights, by the bilinear filter of OpenGL."""
    assert surface.uv is not None
    assert surface.material.base_color_image is not None
    pixels = surface.material.base_color_image.pixels.astype(float)
    uv = np.einsum("fi,fij->fj", weights, surface.uv[surface.faces])
    height, width = pixels.shape[:2]
    x, y = uv[:, 0] * width - 0.5, (1 - uv[:, 1]) * height - 0.5
    column, row = np.floor(x + 1e-9).astype(int), np.floor(y + 1e-9).astype(int)
    right, down = (x - column)[:, None], (y - row)[:, None]
    next_column, next_row = np.minimum(column + 1, width - 1), np.minimum(row + 1, height - 1)
    top = pixels[row, column] * (1 - right) + pixels[row, next_column] * right
    bottom = pixels[next_row, column] * (1 - right) + pixels[next_row, next_column] * right
    return top * (1 - down) + bottom * down


def blended(surface: Surface, weights: np.ndarray) -> np.ndarray:
    """(F, 4) vertex colours at (F, 3) barycentric weights."""
    assert surface.colors is not None
    return np.einsum("fi,fij->fj", weights, surface.colors[surface.faces].astype(float))


def test_filtering_the_texture_gives_back_linear_interpolation() -> None:
    surface = only(painted(86, 170))  # the fourth texel of a cell cannot leave 0..255
    baked = bake_colors(surface)
    rng = np.random.default_rng(2)
    for _ in range(20):
        weights = rng.dirichlet((1.0, 1.0, 1.0), len(surface.faces))
        np.testing.assert_allclose(sampled(baked, weights), blended(surface, weights), atol=1e-6)


@pytest.mark.parametrize("corner", [0, 1, 2])
def test_corners_have_their_own_color_however_far_apart_colors_are(corner: int) -> None:
    surface = only(painted(0, 255))
    weights = np.eye(3)[np.full(len(surface.faces), corner)]
    np.testing.assert_allclose(sampled(bake_colors(surface), weights), blended(surface, weights), atol=1e-6)


def test_one_bright_corner_blends_as_exactly_as_three_dark_ones() -> None:
    asset = painted(0, 0)
    colors = np.tile([0, 0, 0, 255], (8, 1))
    colors[3, :3] = 255
    surface = only(replace(asset, mesh=replace(asset.mesh, colors=colors)))
    weights = np.full((12, 3), 1 / 3)
    np.testing.assert_allclose(sampled(bake_colors(surface), weights), blended(surface, weights), atol=1e-6)


def test_faces_keep_their_order_and_shape() -> None:
    surface = only(painted(0, 255))
    baked = bake_colors(surface)
    np.testing.assert_array_equal(baked.vertices[baked.faces], surface.vertices[surface.faces])
    np.testing.assert_array_equal(baked.normals[baked.faces], surface.normals[surface.faces])
    np.testing.assert_array_equal(baked.source_faces, surface.source_faces)
    assert baked.colors is None


def test_a_color_costs_one_cell_however_many_faces_have_it() -> None:
    asset = cabinet_asset(textured=False)
    colors = np.tile([10, 200, 30, 255], (len(asset.mesh.vertices), 1))
    groups = textured_surfaces(replace(asset, mesh=replace(asset.mesh, colors=colors)))
    before = asset_surfaces(asset)
    for part, (surface,) in groups.items():
        image = surface.material.base_color_image
        assert image is not None
        assert image.pixels.shape == (2, 2, 4)
        assert len(np.unique(image.pixels.reshape(-1, 4), axis=0)) == 1
        assert len(surface.vertices) == len(before[part][0].vertices)


def test_a_factor_multiplies_colors_in_linear_light() -> None:
    asset = painted(255, 255, (0.5, 1.0, 0.0, 0.25))
    gray = np.full((8, 4), 255)
    gray[:, :3] = 188  # linear 0.5029
    ((surface,),) = textured_surfaces(replace(asset, mesh=replace(asset.mesh, colors=gray))).values()
    image = surface.material.base_color_image
    assert image is not None
    # IEC 61966-2-1: linear 0.5029 * 0.5 is 0.2514, which is 137 of 255.
    np.testing.assert_array_equal(image.pixels[0, 0], [137, 188, 0, 255])
    assert surface.material.base_color == (1.0, 1.0, 1.0, 0.25)


def test_a_factor_tints_a_picture_once_for_all_parts() -> None:
    asset = cabinet_asset()
    look = replace(asset.mesh.materials[0], base_color=(0.5, 0.5, 0.5, 1.0))
    groups = textured_surfaces(replace(asset, mesh=replace(asset.mesh, materials=(look,))))
    looks = {id(surface.material) for group in groups.values() for surface in group}
    assert len(looks) == 1
    material = groups["door"][0].material
    assert material.base_color == (1.0, 1.0, 1.0, 1.0)
    assert material.base_color_image is not None
    # (200, 120, 40) is linear (0.5776, 0.1878, 0.0212); half of it is 0.2888 and so on.
    np.testing.assert_array_equal(material.base_color_image.pixels[0, 0], [146, 86, 26, 255])


def test_white_colors_need_no_texture() -> None:
    ((surface,),) = textured_surfaces(painted(255, 255, (0.2, 0.4, 0.6, 1.0))).values()
    assert surface.material.base_color_image is None
    assert surface.material.base_color == (0.2, 0.4, 0.6, 1.0)
    assert surface.uv is None


def test_transparent_colors_stay_transparent() -> None:
    asset = painted(0, 255)
    image = bake_colors(only(asset)).material.base_color_image
    assert image is not None
    assert set(asset.mesh.colors[:, 3]) <= set(image.pixels[..., 3].ravel())


def test_colors_beside_a_picture_are_dropped_and_told() -> None:
    asset = static_asset()
    asset = replace(asset, mesh=replace(asset.mesh, colors=np.full((8, 4), 90)))
    ((surface,),) = textured_surfaces(asset).values()
    assert surface.colors is None
    assert surface.material is asset.mesh.materials[0]
    assert loses_colors(only(asset))
    assert not loses_colors(only(static_asset()))
    assert not loses_colors(only(painted(0, 255)))


def test_a_picture_without_coordinates_is_not_used() -> None:
    asset = static_asset()
    ((surface,),) = textured_surfaces(replace(asset, mesh=replace(asset.mesh, uv=None))).values()
    assert surface.material.base_color_image is None


def test_nothing_to_bake_is_an_error() -> None:
    with pytest.raises(ValueError, match="part 'body' has no vertex colours"):
        bake_colors(only(static_asset()))
