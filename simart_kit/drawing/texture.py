"""Textures: colours at UV coordinates, averaged over what a pixel covers."""

from __future__ import annotations

import numpy as np

from ..arrays import ByteArray, Float32Array
from ..kept import kept
from ..mesh import Image
from ..srgb import decoded


class Texture:
    """A picture that repeats, with smaller versions of itself for points that cover many of its pixels."""

    def __init__(self, image: Image) -> None:
        self._levels = {0: image.pixels}
        self.translucent = bool(image.pixels[..., 3].min() < 255)

    def sample(self, uv: Float32Array, width: Float32Array) -> Float32Array:
        """(N, 4) linear RGBA at (N, 2) coordinates, averaged over (N,) widths in UV units."""
        texels = np.maximum(width * max(self._levels[0].shape[:2]), 1e-6)
        level = np.clip(np.rint(np.log2(texels)), 0, 12).astype(np.int32)
        result = np.zeros((len(uv), 4), dtype=np.float32)
        for number in np.unique(level):
            at = np.flatnonzero(level == number)
            result[at] = _bilinear(self._level(int(number)), uv[at])
        return result

    def _level(self, number: int) -> ByteArray:
        # Threads that draw at once may make a level twice, of the same pixels.
        if number not in self._levels:
            larger = self._level(number - 1)
            self._levels[number] = _halved(larger) if min(larger.shape[:2]) > 1 else larger
        return self._levels[number]


@kept
def texture(image: Image) -> Texture:
    """The texture of an image, whose smaller versions all pictures of it share."""
    return Texture(image)


def _bilinear(pixels: ByteArray, uv: Float32Array) -> Float32Array:
    height, width = pixels.shape[:2]
    # Fractions first: large coordinates of repeated textures would lose their digits in float32.
    x = (uv[:, 0] - np.floor(uv[:, 0])) * width - np.float32(0.5)
    y = (np.ceil(uv[:, 1]) - uv[:, 1]) * height - np.float32(0.5)
    left, top = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    across, down = (x - left).astype(np.float32)[:, None], (y - top).astype(np.float32)[:, None]
    flat = pixels.reshape(-1, 4)
    columns = (left % width, (left + 1) % width)
    result = np.zeros((len(uv), 4), dtype=np.float32)
    for row, share in ((top % height * width, 1 - down), ((top + 1) % height * width, down)):
        result += decoded(flat.take(row + columns[0], axis=0)) * ((1 - across) * share)
        result += decoded(flat.take(row + columns[1], axis=0)) * (across * share)
    return result


def _halved(pixels: ByteArray) -> ByteArray:
    """Each two by two pixels averaged; an odd last row or column is left out."""
    height, width = pixels.shape[0] // 2 * 2, pixels.shape[1] // 2 * 2
    blocks = pixels[:height, :width].astype(np.uint16)
    total = blocks[::2, ::2] + blocks[1::2, ::2] + blocks[::2, 1::2] + blocks[1::2, 1::2]
    return ((total + 2) // 4).astype(np.uint8)
