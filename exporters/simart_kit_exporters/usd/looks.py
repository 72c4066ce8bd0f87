"""Where a surface takes its colour from, and the colours that USD wants."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.mesh import VisualMaterial
from simart_kit.srgb import decoded
from simart_kit.surfaces import Surface


def by_material(surfaces: Iterable[Surface]) -> dict[VisualMaterial, list[Surface]]:
    """The surfaces of every material, in order of first use."""
    result: dict[VisualMaterial, list[Surface]] = {}
    for surface in surfaces:
        result.setdefault(surface.material, []).append(surface)
    return result


def reads_colors(surface: Surface) -> bool:
    """Whether the base colour comes from the vertices."""
    return surface.colors is not None and surface.picture is None


def is_transparent(surface: Surface) -> bool:
    """Whether light passes through any of the surface."""
    return surface.material.base_color[3] < 1 or surface.translucent


def linear_colors(surface: Surface) -> FloatArray:
    """(V, 4) linear RGBA, 0..1, of a surface with vertex colours, times its material's base colour."""
    assert surface.colors is not None
    return np.asarray(decoded(surface.colors) * np.array(surface.material.base_color))
