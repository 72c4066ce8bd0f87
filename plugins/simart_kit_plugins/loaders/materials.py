"""The looks of one file: every material and every picture is kept once."""

from __future__ import annotations

import hashlib
import io
from dataclasses import fields, replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit import Image, VisualMaterial
from simart_kit.asset import unique_names

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

PLAIN = VisualMaterial("default")
# Vertex colours multiply the material, so theirs is white.
COLORED = VisualMaterial("vertex_colors", (1.0, 1.0, 1.0, 1.0))


class Palette:
    """Collects the materials of a file.

    Attributes:
        warnings: a sentence for each picture that could not be read.
    """

    def __init__(self) -> None:
        self.warnings: list[str] = []
        self._materials: list[VisualMaterial] = []
        self._index: dict[object, int] = {}
        self._pictures: dict[tuple[int, bool], tuple[object, Image | None]] = {}
        self._images: dict[bytes, Image] = {}

    @property
    def materials(self) -> tuple[VisualMaterial, ...]:
        """All of them, by index, with unique names."""
        names = unique_names([m.name for m in self._materials])
        return tuple(replace(m, name=name) for m, name in zip(self._materials, names, strict=True))

    def add(self, material: VisualMaterial) -> int:
        """Index of a material; one that looks the same and has the same name is not added again."""
        key = tuple(id(v) if isinstance(v, Image) else v for v in _values(material))
        if key not in self._index:
            self._index[key] = len(self._materials)
            self._materials.append(material)
        return self._index[key]

    def picture(self, picture: Picture | None, name: str, alpha: bool = False) -> Image | None:
        """A Pillow picture as PNG, encoded once; None, and a warning, if it is damaged.

        Args:
            picture: as opened by Pillow, or None.
            name: of the material, for the warning.
            alpha: whether its opacity means anything; if not it is dropped.
        """
        if picture is None:
            return None
        key = (id(picture), alpha)
        if key not in self._pictures:
            self._pictures[key] = (picture, self._encoded(picture, name, alpha))  # held: ids are re-used
        return self._pictures[key][1]

    def image(self, png: bytes) -> Image:
        """The one Image of these PNG bytes."""
        return self._images.setdefault(hashlib.sha256(png).digest(), Image(png))

    def _encoded(self, picture: Picture, name: str, alpha: bool) -> Image | None:
        from PIL import Image as Pillow

        try:
            return self.image(as_png(picture, alpha))
        except (OSError, ValueError, SyntaxError, Pillow.DecompressionBombError) as error:
            self.warnings.append(f"a texture of material '{name}' is left out, it cannot be read: {error}")
            return None


def as_png(picture: Picture, alpha: bool) -> bytes:
    """8-bit PNG of a Pillow picture; the bytes of the source where it is one that may stay as it is."""
    stream = getattr(picture, "fp", None)  # what Pillow reads from, until it has decoded the picture
    source = stream.getvalue() if isinstance(stream, io.BytesIO) else b""
    picture.load()
    modes = ("RGB", "RGBA") if alpha else ("RGB",)
    # Bytes 24 and 28 of a PNG: bit depth and interlacing.
    if picture.format == "PNG" and picture.mode in modes and source[24:25] == b"\x08" and source[28] == 0:
        return source
    if picture.mode.startswith("I;16"):
        picture = _scaled_down(picture)
    see_through = alpha and (picture.mode in ("RGBA", "LA", "PA") or "transparency" in picture.info)
    return Image.from_pixels(np.asarray(picture.convert("RGBA" if see_through else "RGB"))).png


def _scaled_down(picture: Picture) -> Picture:
    """16-bit grey to 8-bit, which Pillow would clip."""
    from PIL import Image as Pillow

    return Pillow.fromarray((np.asarray(picture) // 257).astype(np.uint8))


def _values(material: VisualMaterial) -> list[object]:
    return [getattr(material, field.name) for field in fields(material)]
