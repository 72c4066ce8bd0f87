"""A batch of texts in a model's memory, to which each member may add as many tokens as it has at hand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, cast

import torch
from torch import Tensor, nn
from transformers import Cache, DynamicCache

from simart_kit.arrays import Float32Array

# Columns beyond the longest text before the memory is packed anew.
_SLACK = 1.5


class Stream:
    """Keys and values of what a batch has read so far.

    Members add runs of different length, so columns of the memory may be holes, which a mask hides. Places of
    tokens are counted by member, hence holes change nothing; now and then they are squeezed out.
    """

    def __init__(self, model: nn.Module) -> None:
        """Begin with an empty memory.

        Args:
            model: a Qwen3-VL for conditional generation, or one wrapped in adapters, in evaluation mode.
        """
        self._model = model
        self._cache: Cache = DynamicCache()
        self._mask = torch.zeros(0, 0)
        self._next = torch.zeros(0)
        self._lengths: list[int] = []

    @property
    def columns(self) -> int:
        """Tokens that each member has room for now, holes included."""
        return self._mask.shape[1]

    def read(self, inputs: Mapping[str, Tensor]) -> Float32Array:
        """Read prompts of different lengths, padded on the left.

        Args:
            inputs: input_ids and attention_mask, both (B, P), and with pictures pixel_values, image_grid_thw
                and mm_token_type_ids.

        Returns:
            (B, 1, V) logits of the token behind each prompt.
        """
        self._mask = inputs["attention_mask"]
        self._lengths = self._mask.sum(dim=1).tolist()
        positions = _positions(self._model, inputs)
        self._next = positions.amax(dim=(0, 2)) + 1
        pictures = {key: value for key, value in inputs.items() if key.startswith(("pixel_", "image_"))}
        return self._forward(inputs["input_ids"], positions, pictures, 1)

    def add(self, runs: Sequence[Sequence[int]], keep: int = 1) -> Float32Array:
        """Add a run of at least one token to each member, in one pass through the model.

        Args:
            runs: token ids for each member.
            keep: of how many tokens at the end of each run the logits are wanted.

        Returns:
            (B, keep, V) logits of the tokens that follow; those of a shorter run stand at the end.
        """
        longest, device = max(map(len, runs)), self._mask.device
        # On the left, so that all runs end in the last column.
        ids = torch.tensor([[0] * (longest - len(run)) + list(run) for run in runs], device=device)
        lengths = torch.tensor([len(run) for run in runs], device=device)
        place = torch.arange(longest, device=device) - (longest - lengths)[:, None]
        self._mask = torch.cat([self._mask, (place >= 0).to(self._mask.dtype)], dim=1)
        positions = (self._next[:, None] + place.clamp(min=0))[None].expand(3, -1, -1)
        self._next = self._next + lengths
        self._lengths = [length + len(run) for length, run in zip(self._lengths, runs, strict=True)]
        return self._forward(ids, positions, {}, keep)

    def take_back(self, counts: Sequence[int]) -> None:
        """Forget the last tokens of each member, of those that the last pass added."""
        if not any(counts):
            return
        self._lengths = [length - count for length, count in zip(self._lengths, counts, strict=True)]
        taken = torch.tensor(counts, device=self._mask.device)
        column = torch.arange(self.columns - 1, -1, -1, device=self._mask.device)
        self._mask = self._mask * (column >= taken[:, None]).to(self._mask.dtype)
        self._next = self._next - taken

    def keep(self, rows: Sequence[int]) -> None:
        """Forget all members but these, and pack the memory where holes take too much of it."""
        if len(rows) < len(self._mask):
            chosen = torch.tensor(rows, device=self._mask.device)
            cast(Any, self._cache).batch_select_indices(chosen)
            self._mask, self._next = self._mask[chosen], self._next[chosen]
            self._lengths = [self._lengths[row] for row in rows]
        if self.columns > _SLACK * max(self._lengths):
            self._pack(max(self._lengths))

    def _pack(self, columns: int) -> None:
        """Move what members have read to the last columns, in its order, and drop the others."""
        order = torch.argsort(self._mask, dim=1, stable=True)[:, -columns:]
        self._mask = self._mask.gather(1, order)
        for layer in cast(Any, self._cache).layers:
            index = order[:, None, :, None].expand(-1, layer.keys.shape[1], -1, layer.keys.shape[3])
            layer.keys, layer.values = layer.keys.gather(2, index), layer.values.gather(2, index)

    def _forward(
        self, ids: Tensor, positions: Tensor, pictures: Mapping[str, Tensor], keep: int
    ) -> Float32Array:
        output = self._model(
            input_ids=ids,
            attention_mask=self._mask,
            position_ids=positions,
            past_key_values=self._cache,
            use_cache=True,
            logits_to_keep=keep,
            **pictures,
        )
        return cast(Float32Array, output.logits.float().cpu().numpy())


def _positions(model: nn.Module, inputs: Mapping[str, Tensor]) -> Tensor:
    """(3, B, P) places of a prompt's tokens in time, height and width; text counts the same in all three."""
    mask = inputs["attention_mask"]
    if "image_grid_thw" in inputs:
        # A model that is wrapped in adapters has this somewhere inside.
        inner = next(module for module in model.modules() if hasattr(module, "get_rope_index"))
        positions, _ = cast(Any, inner).get_rope_index(
            inputs["input_ids"], inputs["mm_token_type_ids"], inputs["image_grid_thw"], attention_mask=mask
        )
        return cast(Tensor, positions)
    return (mask.long().cumsum(dim=1) - 1).clamp(min=0)[None].expand(3, -1, -1)
