"""UsdPreviewSurface materials as ours."""

from __future__ import annotations

import io
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from simart_kit import BadInputError, Image, VisualMaterial
from simart_kit.arrays import ByteArray, FloatArray, IntArray

from .folder import inside
from .materials import COLORED, PLAIN, Palette

if TYPE_CHECKING:
    from PIL.Image import Image as Picture


@dataclass(frozen=True, eq=False)
class Texture:
    """A UsdUVTexture.

    Attributes:
        picture: opened by Pillow.
        channel: which output is read, such as "rgb" or "g".
        scale: (4,) factor on it.
        texture_set: primvar that its coordinates come from.
    """

    picture: Picture
    channel: str
    scale: tuple[float, ...]
    texture_set: str


class Looks:
    """Reads materials as meshes ask for them.

    Args:
        root: folder that textures must lie in.
        palette: gets the materials.

    Attributes:
        warnings: what had to be left out.
    """

    def __init__(self, root: Path, palette: Palette) -> None:
        self.palette = palette
        self.warnings: list[str] = []
        self._root = root
        self._read: dict[str, tuple[int, str]] = {}
        self._pictures: dict[str, Picture | None] = {}

    def of_faces(self, prim: Any, count: int) -> tuple[IntArray, str, bool]:
        """(count,) material of each polygon, the primvar of texture coordinates, and whether any is bound."""
        from pxr import UsdShade

        whole, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
        index, texture_set = self._index(whole)
        result, bound = np.full(count, index), bool(whole)
        for subset in UsdShade.MaterialBindingAPI(prim).GetMaterialBindSubsets():
            material, _ = UsdShade.MaterialBindingAPI(subset.GetPrim()).ComputeBoundMaterial()
            faces = np.array(subset.GetIndicesAttr().Get() or [], dtype=np.int64)
            if len(faces) and (faces.min() < 0 or faces.max() >= count):
                raise BadInputError(f"{subset.GetPath()} names faces that its mesh does not have")
            result[faces], of_subset = self._index(material)
            texture_set, bound = texture_set or of_subset, True
        return result, texture_set, bound

    def plain(self, color: FloatArray) -> int:
        """A material of one linear colour."""
        red, green, blue = (float(v) for v in np.clip(np.nan_to_num(color[:3]), 0.0, 1.0))
        return self.palette.add(replace(PLAIN, name="display_color", base_color=(red, green, blue, 1.0)))

    def colored(self) -> int:
        """The material of meshes with vertex colours."""
        return self.palette.add(COLORED)

    def _index(self, material: Any) -> tuple[int, str]:
        if not material:
            return self.palette.add(PLAIN), ""
        path = str(material.GetPath())
        if path not in self._read:
            visual, texture_set = self._material(material)
            self._read[path] = self.palette.add(visual), texture_set
        return self._read[path]

    def _material(self, material: Any) -> tuple[VisualMaterial, str]:
        name = material.GetPrim().GetName()
        shader, *_ = material.ComputeSurfaceSource()
        if not shader or shader.GetShaderId() != "UsdPreviewSurface":
            self.warnings.append(f"material '{name}' is left out: it is no UsdPreviewSurface")
            return replace(PLAIN, name=name), ""
        color = self._input(shader, "diffuseColor", (0.18, 0.18, 0.18))
        opacity = self._input(shader, "opacity", 1.0)
        metallic = self._input(shader, "metallic", 0.0)
        roughness = self._input(shader, "roughness", 0.5)
        normal = self._input(shader, "normal", None)
        see_through = _textured(opacity) and opacity.channel == "a" and _textured(color)
        alpha = 1.0 if _textured(opacity) else float(opacity)
        factor = color.scale[:3] if _textured(color) else color
        red, green, blue = (float(v) for v in factor)
        visual = VisualMaterial(
            name,
            (red, green, blue, alpha),
            1.0 if _textured(metallic) else float(metallic),
            1.0 if _textured(roughness) else float(roughness),
            self.palette.picture(color.picture, name, see_through) if _textured(color) else None,
            self._metallic_roughness(name, metallic, roughness),
            self.palette.picture(normal.picture, name) if _textured(normal) else None,
        )
        sets = [t.texture_set for t in (color, roughness, metallic, normal) if _textured(t)]
        return visual, next((s for s in sets if s), "")

    def _metallic_roughness(self, name: str, metallic: Any, roughness: Any) -> Image | None:
        """One picture with roughness in green and metallic in blue, as glTF packs them."""
        textures = [t for t in (roughness, metallic) if _textured(t)]
        if not textures:
            return None
        if all(t.picture is textures[0].picture for t in textures) and [t.channel for t in textures] == [
            "g",
            "b",
        ]:
            return self.palette.picture(textures[0].picture, name)
        size = textures[0].picture.size
        planes = [np.full(size[::-1], 255, dtype=np.uint8) for _ in range(3)]
        for plane, texture in ((1, roughness), (2, metallic)):
            if _textured(texture):
                planes[plane] = _channel(texture, size)
        return self.palette.image(Image.from_pixels(np.stack(planes, axis=-1)).png)

    def _input(self, shader: Any, name: str, default: Any) -> Any:
        """The value of a shader's input, or the Texture that feeds it."""
        from pxr import Usd, UsdShade

        source = shader.GetInput(name)
        attributes = UsdShade.Utils.GetValueProducingAttributes(source) if source else []
        if not attributes:
            return default
        attribute = attributes[0]
        base, kind = UsdShade.Utils.GetBaseNameAndType(attribute.GetName())
        if kind != UsdShade.AttributeType.Output:
            value = attribute.Get(Usd.TimeCode.EarliestTime())
            return default if value is None else value
        node = UsdShade.Shader(attribute.GetPrim())
        if node.GetShaderId() != "UsdUVTexture":
            self.warnings.append(f"{node.GetPath()} is left out: it is no UsdUVTexture")
            return default
        return self._texture(node, base) or self._input(node, "fallback", default)

    def _texture(self, node: Any, channel: str) -> Texture | None:
        file = self._input(node, "file", None)
        picture = self._picture(file) if file else None
        if picture is None:
            return None
        scale = tuple(float(v) for v in self._input(node, "scale", (1.0, 1.0, 1.0, 1.0)))
        return Texture(picture, channel, scale, self._texture_set(node))

    def _texture_set(self, node: Any) -> str:
        from pxr import UsdShade

        source = node.GetInput("st")
        attributes = UsdShade.Utils.GetValueProducingAttributes(source) if source else []
        reader = UsdShade.Shader(attributes[0].GetPrim()) if attributes else None
        if reader and reader.GetShaderId() == "UsdTransform2d":
            self.warnings.append(f"{reader.GetPath()} is ignored: texture transforms are not read")
            return ""
        return str(self._input(reader, "varname", "")) if reader else ""

    def _picture(self, file: Any) -> Picture | None:
        """Read from the folder or the package; a picture that is missing or damaged is a warning."""
        from PIL import Image as Pillow
        from pxr import Ar

        place = file.resolvedPath
        if place not in self._pictures:
            self._pictures[place] = None
            outer = place
            while Ar.IsPackageRelativePath(outer):
                outer = Ar.SplitPackageRelativePathOuter(outer)[0]
            if place and inside(self._root, outer) is None:
                raise BadInputError(f"it refers to '{file.path}', which is outside its folder: copy it there")
            try:
                asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(place)) if place else None
                if asset is None:
                    raise FileNotFoundError("it is not there")
                with asset:
                    self._pictures[place] = Pillow.open(io.BytesIO(asset.GetBuffer()))
            except (OSError, Pillow.DecompressionBombError) as error:
                self.warnings.append(f"texture '{file.path}' is left out: {error}")
        return self._pictures[place]


def _textured(value: Any) -> bool:
    return isinstance(value, Texture)


def _channel(texture: Texture, size: tuple[int, int]) -> ByteArray:
    """(H, W) of the channel that a texture's output names, red for the others."""
    pixels = np.asarray(texture.picture.convert("RGBA").resize(size))
    return np.asarray(pixels[..., "rgba".find(texture.channel) if len(texture.channel) == 1 else 0])
