"""UsdPreviewSurface materials, as https://openusd.org/release/spec_usdpreviewsurface.html defines them."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import TYPE_CHECKING

from simart_kit.mesh import Image, VisualMaterial
from simart_kit.surfaces import Surface

from .looks import is_transparent, reads_colors

if TYPE_CHECKING:
    from pxr import Gf, Sdf, Usd, UsdShade

TEXTURES = "textures"


def define_look(
    stage: Usd.Stage, path: Sdf.Path, surfaces: list[Surface], directory: Path
) -> UsdShade.Material:
    """Author the one material of some surfaces at `path`; its textures are written into `directory`."""
    from pxr import UsdShade

    material = UsdShade.Material.Define(stage, path)
    shader = UsdShade.Shader.Define(stage, path.AppendChild("surface"))
    shader.CreateIdAttr("UsdPreviewSurface")
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    _set_factors(shader, surfaces[0])
    opacity = any(is_transparent(s) for s in surfaces)
    if surfaces[0].picture:
        file = write_texture(surfaces[0].picture, "base_color", directory)
        _connect_picture(shader, file, surfaces[0].material, opacity)
    elif reads_colors(surfaces[0]):
        _connect_colors(shader, opacity)
    if surfaces[0].uv is not None:
        _connect_detail(shader, surfaces[0], directory)
    return material


def write_texture(image: Image, slot: str, directory: Path) -> str:
    """Write an image under a name made from its bytes; return its path relative to `directory`."""
    name = f"{slot}_{hashlib.sha256(image.png).hexdigest()[:16]}.png"
    path = directory / TEXTURES / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(image.png)
    return f"./{TEXTURES}/{name}"


def _set_factors(shader: UsdShade.Shader, surface: Surface) -> None:
    from pxr import Gf, Sdf

    source, types = surface.material, Sdf.ValueTypeNames
    shader.CreateInput("diffuseColor", types.Color3f).Set(Gf.Vec3f(*source.base_color[:3]))
    shader.CreateInput("opacity", types.Float).Set(source.base_color[3])
    shader.CreateInput("metallic", types.Float).Set(source.metallic)
    shader.CreateInput("roughness", types.Float).Set(source.roughness)


def _connect_picture(shader: UsdShade.Shader, file: str, look: VisualMaterial, opacity: bool) -> None:
    """Read the base colour from its texture; the factor becomes the texture's scale."""
    from pxr import Gf, Sdf

    texture = _texture(shader, "base_color", file, "sRGB", Gf.Vec4f(*look.base_color))
    _connect(shader, "diffuseColor", texture, "rgb", Sdf.ValueTypeNames.Float3)
    # Renderers sort surfaces whose opacity is connected, so it is not for opaque ones.
    if opacity:
        _connect(shader, "opacity", texture, "a", Sdf.ValueTypeNames.Float)


def _connect_colors(shader: UsdShade.Shader, opacity: bool) -> None:
    """Read the base colour from the primvars that `geometry.define_surface` writes."""
    from pxr import Sdf

    color = _reader(shader, "display_color", "UsdPrimvarReader_float3", "displayColor")
    _connect(shader, "diffuseColor", color, "result", Sdf.ValueTypeNames.Float3)
    if opacity:
        alpha = _reader(shader, "display_opacity", "UsdPrimvarReader_float", "displayOpacity")
        _connect(shader, "opacity", alpha, "result", Sdf.ValueTypeNames.Float)


def _connect_detail(shader: UsdShade.Shader, surface: Surface, directory: Path) -> None:
    """Read roughness, metallic and normals from the textures that there are."""
    from pxr import Gf, Sdf

    source, types = surface.material, Sdf.ValueTypeNames
    if source.metallic_roughness_image:
        file = write_texture(source.metallic_roughness_image, "metallic_roughness", directory)
        scale = Gf.Vec4f(1.0, source.roughness, source.metallic, 1.0)
        texture = _texture(shader, "metallic_roughness", file, "raw", scale)
        _connect(shader, "roughness", texture, "g", types.Float)
        _connect(shader, "metallic", texture, "b", types.Float)
    if source.normal_image:
        file = write_texture(source.normal_image, "normal", directory)
        texture = _texture(shader, "normal", file, "raw", Gf.Vec4f(2.0, 2.0, 2.0, 1.0))
        # The image stores -1..1 as 0..1.
        texture.CreateInput("bias", types.Float4).Set(Gf.Vec4f(-1.0, -1.0, -1.0, 0.0))
        shader.CreateInput("normal", types.Normal3f)
        _connect(shader, "normal", texture, "rgb", types.Float3)


def _texture(
    shader: UsdShade.Shader, name: str, file: str, color_space: str, scale: Gf.Vec4f
) -> UsdShade.Shader:
    """A UsdUVTexture beside `shader` that reads the primvar `st`."""
    from pxr import Sdf, UsdShade

    types = Sdf.ValueTypeNames
    texture = UsdShade.Shader.Define(shader.GetPrim().GetStage(), shader.GetPath().ReplaceName(name))
    texture.CreateIdAttr("UsdUVTexture")
    texture.CreateInput("file", types.Asset).Set(Sdf.AssetPath(file))
    texture.CreateInput("sourceColorSpace", types.Token).Set(color_space)
    texture.CreateInput("scale", types.Float4).Set(scale)
    for side in ("wrapS", "wrapT"):
        texture.CreateInput(side, types.Token).Set("repeat")
    texture.CreateInput("st", types.Float2)
    coordinates = _reader(shader, "texture_coordinates", "UsdPrimvarReader_float2", "st")
    _connect(texture, "st", coordinates, "result", types.Float2)
    return texture


def _reader(shader: UsdShade.Shader, name: str, node: str, primvar: str) -> UsdShade.Shader:
    """A primvar reader beside `shader`; textures share one."""
    from pxr import Sdf, UsdShade

    reader = UsdShade.Shader.Define(shader.GetPrim().GetStage(), shader.GetPath().ReplaceName(name))
    reader.CreateIdAttr(node)
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set(primvar)
    return reader


def _connect(
    shader: UsdShade.Shader, name: str, source: UsdShade.Shader, output: str, kind: Sdf.ValueTypeName
) -> None:
    shader.GetInput(name).ConnectToSource(source.CreateOutput(output, kind))
