"""Token sequences with their pictures, and how they become the tensors of one batch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from simart_kit.arrays import Float32Array, IntArray

from .pixels import Patches

if TYPE_CHECKING:
    from torch import Tensor

IGNORED = -100
"""Label of a token that is not in the loss, as transformers has it."""

Side = Literal["left", "right"]


@dataclass(frozen=True, eq=False, slots=True)
class TokenSequence:
    """What the model reads of one object, without padding.

    Attributes:
        ids: (T,) token ids, one <|image_pad|> for each visual token.
        labels: (T,) the same ids where they are in the loss, else `IGNORED`.
        weights: (T,) share of each token in the loss, 0 on the prompt.
        patches: of its picture, or None.
    """

    ids: IntArray
    labels: IntArray
    weights: Float32Array
    patches: Patches | None = None

    def __len__(self) -> int:
        return len(self.ids)


def model_inputs(sequences: Sequence[TokenSequence], pad: int, image: int, side: Side) -> dict[str, Tensor]:
    """One batch for `Qwen3VLForConditionalGeneration`.

    Args:
        sequences: B of them; some, all or none with a picture.
        pad: id that fills up; the attention mask is 0 there.
        image: id of <|image_pad|>.
        side: where the filling stands, left to generate and right to train.

    Returns:
        `input_ids`, `attention_mask` and `mm_token_type_ids` (B, T) int64, the last 1 on visual tokens;
        and if there is a picture `pixel_values` (N, D) float32 and `image_grid_thw` (pictures, 3) int64.
    """
    import torch

    ids = padded([sequence.ids for sequence in sequences], pad, side)
    ones = [np.ones(len(sequence), dtype=np.int64) for sequence in sequences]
    visual = [(sequence.ids == image).astype(np.int64) for sequence in sequences]
    batch = {
        "input_ids": ids,
        "attention_mask": padded(ones, 0, side),
        "mm_token_type_ids": padded(visual, 0, side),
    }
    pictures = [sequence.patches for sequence in sequences if sequence.patches is not None]
    if pictures:
        batch["pixel_values"] = torch.from_numpy(np.concatenate([picture.values for picture in pictures]))
        batch["image_grid_thw"] = torch.tensor([picture.grid for picture in pictures], dtype=torch.int64)
    return batch


def model_targets(sequences: Sequence[TokenSequence], side: Side) -> dict[str, Tensor]:
    """`labels` (B, T) int64, `IGNORED` on the filling too, and `loss_weights` (B, T) float32, 0 there."""
    return {
        "labels": padded([sequence.labels for sequence in sequences], IGNORED, side),
        "loss_weights": padded([sequence.weights for sequence in sequences], 0, side),
    }


def padded(rows: Sequence[IntArray | Float32Array], fill: int, side: Side) -> Tensor:
    """(B, T) tensor of rows of different lengths: int64 of whole numbers, else float32."""
    import torch

    whole = all(np.issubdtype(row.dtype, np.integer) for row in rows)
    width = max(len(row) for row in rows)
    table = np.full((len(rows), width), fill, dtype=np.int64 if whole else np.float32)
    for number, row in enumerate(rows):
        start = width - len(row) if side == "left" else 0
        table[number, start : start + len(row)] = row
    return torch.from_numpy(table)
