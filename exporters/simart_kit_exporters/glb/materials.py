"""Materials: glTF's metallic-roughness model is the one that assets have."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from simart_kit.mesh import Image, VisualMaterial
from simart_kit.surfaces import Surface

from .builder import Builder, Json

Look = tuple[VisualMaterial, bool]
"""A material, and whether the backs of its faces are drawn."""


def add_materials(builder: Builder, surfaces: Mapping[Look, list[Surface]]) -> dict[Look, int]:
    """Add the material of each look of some surfaces; returns their indices."""
    return {look: builder.add("materials", _material(builder, look, g)) for look, g in surfaces.items()}


def by_look(surfaces: Iterable[Surface], two_sided: set[str]) -> dict[Look, list[Surface]]:
    """The surfaces of each look, in order of first use; `two_sided` are names of parts."""
    result: dict[Look, list[Surface]] = {}
    for surface in surfaces:
        result.setdefault((surface.material, surface.part in two_sided), []).append(surface)
    return result


def has_texture(surface: Surface) -> bool:
    """Whether texture coordinates are read."""
    source = surface.material
    images = (source.base_color_image, source.metallic_roughness_image, source.normal_image)
    return surface.uv is not None and any(images)


def visible_colors(surface: Surface) -> bool:
    """Whether there are vertex colours that are not plain white."""
    return surface.colors is not None and bool((surface.colors != 255).any())


def _material(builder: Builder, look: Look, surfaces: list[Surface]) -> Json:
    source, two_sided = look
    shown = any(has_texture(surface) for surface in surfaces)

    def textured(name: str, image: Image | None) -> Json:
        return {name: {"index": builder.add_texture(image)}} if image and shown else {}

    result: Json = {
        "name": source.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": np.clip(source.base_color, 0.0, 1.0).tolist(),
            "metallicFactor": float(np.clip(source.metallic, 0.0, 1.0)),
            "roughnessFactor": float(np.clip(source.roughness, 0.0, 1.0)),
            **textured("baseColorTexture", source.base_color_image),
            **textured("metallicRoughnessTexture", source.metallic_roughness_image),
        },
        **textured("normalTexture", source.normal_image),
        **_alpha(source, surfaces),
    }
    if two_sided:
        result["doubleSided"] = True
    return result


def _alpha(source: VisualMaterial, surfaces: list[Surface]) -> Json:
    """How light passes. Holes are cut, which needs no sorting; what is half-transparent is blended."""
    colors = any(s.colors is not None and s.colors[:, 3].min() < 255 for s in surfaces)
    if colors or source.base_color[3] < 1.0:
        return {"alphaMode": "BLEND"}
    picture = surfaces[0].picture
    if picture is None or not surfaces[0].translucent:
        return {}
    alpha = picture.pixels[..., 3]
    return {"alphaMode": "MASK" if np.isin(alpha, (0, 255)).all() else "BLEND"}
