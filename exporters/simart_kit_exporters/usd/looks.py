"""Where a surface takes its colour from, and the colours that USD wants."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.mesh import VisualMaterial
from simart_kit.srgb import srgb_to_linear
from simart_kit.surfaces import Surface


def by_material(surfaces: Iterable[Surface]) -> dict[VisualMaterial, list[Surface]]:
    """The surfaces of every material, in order of first use."""
    result: dict[VisualMaterial, list[Surface]] = {}
    for surface in surfaces:
        result.setdefault(surface.material, []).append(surface)
    return result


def reads_picture(surface: Surface) -> bool:
    """Whether the base colour comes from a texture."""
    return surface.uv is not None and surface.material.base_color_image is not None


def reads_colors(surface: Surface) -> bool:
    """Whether the base colour comes from the vertices."""
    return surface.colors is not None and not reads_picture(surface)


def is_transparent(surface: Surface) -> bool:
    """Whether light passes through any of the surface."""
    alphas = [surface.material.base_color[3] * 255]
    if reads_picture(surface):
        assert surface.material.base_color_image is not None
        alphas.append(surface.material.base_color_image.pixels[..., 3].min())
    elif surface.colors is not None:
        alphas.append(surface.colors[:, 3].min())
    return min(alphas) < 255


def linear_colors(surface: Surface) -> FloatArray:
    """(V, 4) linear RGBA, 0..1, of a surface with vertex colours, times its material's base colour."""
    assert surface.colors is not None
    values = surface.colors / 255.0
    values[:, :3] = srgb_to_linear(values[:, :3])
    return np.asarray(values * np.array(surface.material.base_color))
