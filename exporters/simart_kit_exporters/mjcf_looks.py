"""Materials and textures of MJCF."""

from __future__ import annotations

from collections.abc import Iterable

from simart_kit.asset import clean_name, unique_names
from simart_kit.mesh import VisualMaterial
from simart_kit.surfaces import Surface

from .mjcf_model import Model
from .obj_files import srgb_color, write_texture


def add_materials(model: Model, surfaces: Iterable[Surface]) -> dict[VisualMaterial, str]:
    """Add every material once, with its picture; returns their names."""
    looks = list(dict.fromkeys(surface.material for surface in surfaces))
    names = unique_names([clean_name(look.name, "material") for look in looks])
    for look, name in zip(looks, names, strict=True):
        _add_material(model, look, name)
    return dict(zip(looks, names, strict=True))


def _add_material(model: Model, look: VisualMaterial, name: str) -> None:
    import mujoco

    material = model.spec.add_material(
        name=name,
        rgba=srgb_color(look),
        metallic=look.metallic,
        roughness=look.roughness,
        specular=0.5 * (1.0 - look.roughness),
        shininess=1.0 - look.roughness,
    )
    if look.base_color_image is not None:
        texture = model.add_texture(write_texture(look.base_color_image, model.folder))
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = texture
