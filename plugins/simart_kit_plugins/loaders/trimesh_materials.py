"""trimesh's materials and colours as ours."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from simart_kit import VisualMaterial
from simart_kit.arrays import ByteArray

from .materials import COLORED, PLAIN, Palette

if TYPE_CHECKING:
    from PIL.Image import Image as Picture


def material_index(palette: Palette, visual: Any, colored: bool) -> int:
    """Index in the palette of how a geometry looks.

    Args:
        palette: of the file.
        visual: trimesh's TextureVisuals, or None.
        colored: whether the geometry has colours of its own.
    """
    material = getattr(visual, "material", None)
    textured = getattr(visual, "uv", None) is not None
    if hasattr(material, "baseColorTexture"):
        return palette.add(_from_pbr(palette, material, textured))
    if hasattr(material, "diffuse") and _is_from_file(material):
        return palette.add(_from_mtl(palette, material, textured))
    return palette.add(COLORED if colored else PLAIN)


def rgba(colors: ArrayLike | None, count: int) -> ByteArray | None:
    """(count, 4) bytes of RGB(A) values, by their type 0..1, 0..255 or 0..65535; None if they do not fit.

    The numbers are taken as they stand. glTF says that its colours are linear light; the tools that write
    coloured meshes in practice, trimesh among them, store what should be seen.
    """
    values = np.asarray(colors if colors is not None else [])
    if values.ndim != 2 or values.shape[0] != count or values.shape[1] not in (3, 4):
        return None
    if values.dtype == np.uint16:
        values = np.asarray(values / 257.0)
    elif values.dtype.kind == "f" and np.nanmax(values, initial=0.0) <= 1.0:
        values = values * 255.0
    if values.shape[1] == 3:
        values = np.column_stack([values, np.full(count, 255)])
    result: ByteArray = np.clip(np.round(np.nan_to_num(values)), 0, 255).astype(np.uint8)
    return result


def _from_pbr(palette: Palette, material: Any, textured: bool) -> VisualMaterial:
    """glTF, and DAE: missing factors are 1, as glTF says."""
    name = str(material.name or "material")
    see_through = material.alphaMode in ("BLEND", "MASK")

    def image(picture: Picture | None, alpha: bool = False) -> Any:
        return palette.picture(picture, name, alpha) if textured else None

    factor = material.baseColorFactor
    red, green, blue, alpha = (1.0, 1.0, 1.0, 1.0) if factor is None else (float(v) / 255 for v in factor)
    return VisualMaterial(
        name,
        (red, green, blue, alpha if see_through else 1.0),
        1.0 if material.metallicFactor is None else float(material.metallicFactor),
        1.0 if material.roughnessFactor is None else float(material.roughnessFactor),
        image(material.baseColorTexture, see_through),
        image(material.metallicRoughnessTexture),
        image(material.normalTexture),
    )


def _from_mtl(palette: Palette, material: Any, textured: bool) -> VisualMaterial:
    """MTL: `Kd` is linear as Blender reads it, and a picture replaces it, for many files leave it black."""
    name = str(material.name)
    image = palette.picture(material.image, name, alpha=True) if textured else None
    values = material.kwargs
    color = (1.0, 1.0, 1.0) if image else _numbers(values.get("kd"), PLAIN.base_color[:3])
    (alpha,) = _numbers(values.get("d"), (1.0,))
    (metallic,) = _numbers(values.get("pm"), (0.0,))
    shine = (2.0 / (max(float(material.glossiness), 0.0) + 2.0)) ** 0.25  # Blinn-Phong exponent
    (roughness,) = _numbers(values.get("pr"), (shine if "ns" in values else PLAIN.roughness,))
    red, green, blue = color
    return VisualMaterial(name, (red, green, blue, alpha), metallic, roughness, image)


def _is_from_file(material: Any) -> bool:
    """Whether it stands in the file: trimesh invents a grey picture for UVs without one, of no format."""
    picture = material.image
    return bool(material.kwargs) or (picture is not None and picture.format is not None)


def _numbers(values: Any, default: tuple[float, ...]) -> tuple[float, ...]:
    """As many numbers as `default` has, clipped to 0..1; the default where the file says something else."""
    try:
        numbers = np.atleast_1d(np.asarray(values, dtype=np.float64))
    except (TypeError, ValueError):
        return default
    if numbers.shape != (len(default),) or not np.isfinite(numbers).all():
        return default
    return tuple(float(v) for v in np.clip(numbers, 0.0, 1.0))
