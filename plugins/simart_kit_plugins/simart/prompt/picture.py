"""Pictures of objects: rendered ones, and photos that a person gives."""

from __future__ import annotations

import io
import struct
import zlib
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import ByteArray, frozen_bytes
from simart_kit.errors import BadInputError
from simart_kit.mesh import Image
from simart_kit.render import isometric_view

if TYPE_CHECKING:
    from PIL.Image import Image as Pillow

    from simart_kit.mesh import Mesh

PICTURE_SIZE = 252
"""Side of the paper's pictures [pixels]."""
MAX_PIXELS = 80_000_000
MAX_BYTES = 256 * 2**20

_FORMATS = ("PNG", "JPEG", "WEBP")
_FORMAT_NAMES = "PNG, JPEG or WebP"
# What pillow raises for files that are no pictures, or damaged ones.
_UNREADABLE = (OSError, SyntaxError, ValueError, EOFError, struct.error, zlib.error)


def object_picture(mesh: Mesh, size: int = PICTURE_SIZE) -> ByteArray:
    """(size, size, 3) sRGB picture along the diagonal from the front left and above, white around it."""
    return isometric_view(mesh, size)


def read_picture(path: Path, size: int = PICTURE_SIZE) -> ByteArray:
    """A user's photo as (size, size, 3) sRGB: upright, its longer side fitted, padded with white.

    Transparent places become white, as the background of rendered pictures is.

    Raises:
        BadInputError: the file is missing or unreadable, no PNG, JPEG or WebP picture, damaged, or larger
            than `MAX_PIXELS` or `MAX_BYTES`.
    """
    from PIL import ImageOps

    image = _opened(_bytes(path), str(path))
    try:
        # A decoder may skip details that are not needed; for JPEG this saves most of the time and memory.
        image.draft("RGB", (2 * size, 2 * size))
        image.load()
        upright = _on_white(ImageOps.exif_transpose(image))
    except _UNREADABLE as error:
        raise BadInputError(f"{path}: the picture is damaged or cut off ({error})") from error
    return frozen_bytes(np.asarray(_square(upright, size)))


def png(picture: ByteArray) -> bytes:
    """An (H, W, 3) picture as a PNG file, the same bytes each time."""
    return Image.from_pixels(picture).png


def from_png(data: bytes, source: str = "the picture") -> ByteArray:
    """(H, W, 3) picture of a PNG file; raises BadInputError naming the source where it is none or damaged."""
    image = _opened(data, source, ("PNG",))
    try:
        image.load()
        return frozen_bytes(np.asarray(image.convert("RGB")))
    except _UNREADABLE as error:
        raise BadInputError(f"{source}: the picture is damaged or cut off ({error})") from error


def _bytes(path: Path) -> bytes:
    try:
        size = path.stat().st_size
        if size > MAX_BYTES:
            raise BadInputError(
                f"{path}: the file has {size / 2**20:.0f} MiB, at most {MAX_BYTES / 2**20:.0f} are read: "
                "save a smaller picture"
            )
        return path.read_bytes()
    except FileNotFoundError as error:
        raise BadInputError(f"{path}: there is no such picture file") from error
    except (OSError, ValueError) as error:  # the latter for a name that no file can have
        reason = getattr(error, "strerror", None) or error
        raise BadInputError(f"{path}: cannot be read ({reason})") from error


def _opened(data: bytes, source: str, formats: tuple[str, ...] = _FORMATS) -> Pillow:
    """A picture whose size is known and sound, not yet decoded."""
    import warnings

    from PIL import Image as Pictures

    try:
        with warnings.catch_warnings():
            # Our own limit is stricter than the one that pillow warns of.
            warnings.simplefilter("ignore", Pictures.DecompressionBombWarning)
            image = Pictures.open(io.BytesIO(data), formats=formats)
    except Pictures.DecompressionBombError as error:
        raise BadInputError(f"{source}: {_too_large(error)}") from error
    except _UNREADABLE as error:
        known = _FORMAT_NAMES if formats is _FORMATS else " or ".join(formats)
        raise BadInputError(f"{source}: this is no {known} picture; save it as one") from error
    if image.width * image.height > MAX_PIXELS:
        raise BadInputError(f"{source}: {_too_large(f'{image.width} x {image.height}')}")
    return image


def _too_large(found: object) -> str:
    return f"the picture has more than {MAX_PIXELS // 10**6} megapixels ({found}); save a smaller one"


def _square(image: Pillow, size: int) -> Pillow:
    """A picture in the middle of a white square whose side is the picture's longer one."""
    from PIL import Image as Pictures

    factor = size / max(image.size)
    width, height = (max(1, round(side * factor)) for side in image.size)
    fitted = image.resize((width, height), Pictures.Resampling.LANCZOS)
    square = Pictures.new("RGB", (size, size), (255, 255, 255))
    square.paste(fitted, ((size - width) // 2, (size - height) // 2))
    return square


def _on_white(image: Pillow) -> Pillow:
    """RGB of a picture of any mode."""
    from PIL import Image as Pictures

    if image.mode.startswith("I"):
        # 16 bits of grey; pillow would clip them to 8 bits instead of scaling.
        image = Pictures.fromarray((np.asarray(image) >> 8).astype(np.uint8))
    if not image.has_transparency_data:
        return image.convert("RGB")
    layer = image.convert("RGBA")
    white = Pictures.new("RGBA", layer.size, (255, 255, 255, 255))
    return Pictures.alpha_composite(white, layer).convert("RGB")
