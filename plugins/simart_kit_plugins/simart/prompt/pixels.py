"""A picture as the flat patches that the vision tower of Qwen3-VL reads. Needs numpy and pillow alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import ByteArray, Float32Array

_CHANNELS = 3


@dataclass(frozen=True, slots=True)
class PatchGrid:
    """How a vision tower cuts pictures up; values of its `vision_config`.

    Attributes:
        patch: side of a patch [pixels].
        merge: patches along a side of the square that becomes one visual token.
        frames: video frames in a patch; a picture is repeated.
    """

    patch: int = 16
    merge: int = 2
    frames: int = 2

    @property
    def cell(self) -> int:
        """Side of the square that becomes one visual token [pixels]."""
        return self.patch * self.merge

    def size(self, height: int, width: int) -> tuple[int, int]:
        """Height and width that a picture is resized to: the nearest multiples of a cell, 252 gives 256."""
        # round() takes halves to even, as the processor that the released models were trained with does.
        return max(round(height / self.cell), 1) * self.cell, max(round(width / self.cell), 1) * self.cell


@dataclass(frozen=True, eq=False, slots=True)
class Patches:
    """What a vision tower reads of one picture.

    Attributes:
        values: (N, 3 * frames * patch^2) float32, -1 black .. 1 white; patches of one visual token stand
            together, rows from the top.
        grid: (1, patches down, patches across), a row of `image_grid_thw`.
        tokens: number of visual tokens.
    """

    values: Float32Array
    grid: tuple[int, int, int]
    tokens: int


def patches(picture: ByteArray, cut: PatchGrid) -> Patches:
    """Resize an (H, W, 3) picture to whole cells (bicubic), normalise it to -1..1 and cut it up.

    The same numbers as `Qwen2VLImageProcessorPil` of transformers gives with mean and deviation 0.5, without
    the limits on the number of pixels, which would blow small pictures up.
    """
    height, width = cut.size(*picture.shape[:2])
    pixels = _resized(picture, height, width).astype(np.float32) / np.float32(127.5) - np.float32(1)
    rows, columns = height // cut.cell, width // cut.cell
    split = pixels.reshape(rows, cut.merge, cut.patch, columns, cut.merge, cut.patch, _CHANNELS)
    # (token row, token column, row and column in the token, channel, row and column in the patch)
    ordered = split.transpose(0, 3, 1, 4, 6, 2, 5)
    shape = (*ordered.shape[:5], cut.frames, *ordered.shape[5:])
    flat = np.broadcast_to(ordered[:, :, :, :, :, None], shape)
    values = flat.reshape(rows * columns * cut.merge**2, -1)
    return Patches(values, (1, height // cut.patch, width // cut.patch), rows * columns)


def _resized(picture: ByteArray, height: int, width: int) -> ByteArray:
    from PIL import Image

    if picture.shape[:2] == (height, width):
        return picture
    # A copy, because pillow cannot share read-only arrays of every layout.
    image = Image.fromarray(np.array(picture, dtype=np.uint8, order="C"))
    return np.asarray(image.resize((width, height), Image.Resampling.BICUBIC))
