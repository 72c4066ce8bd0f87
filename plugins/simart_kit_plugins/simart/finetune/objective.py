"""The loss of a batch: only where a token counts is it scored, for the vocabulary is the largest layer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import torch
from torch import Tensor, nn
from torch.nn.functional import cross_entropy

from .adapters import plain_model
from .choices import Rows, losses
from .kinds import COORDINATE, KINDS
from .packing import Batch

if TYPE_CHECKING:
    from transformers import PreTrainedModel


@dataclass(frozen=True, eq=False)
class Losses:
    """What a batch gave.

    Attributes:
        total: weighted sum of the losses, to be divided by the step's weights.
        sums: (len(KINDS),) sums of the losses of the model's own choices, by kind.
        counts: (len(KINDS),) their numbers.
        right: (len(KINDS),) how many of them the model would have chosen.
    """

    total: Tensor
    sums: Tensor
    counts: Tensor
    right: Tensor


class Objective(nn.Module):
    """A model and its loss as one module, so that what shards a module's weights sees all of its use.

    Args:
        model: Qwen3-VL, or one with adapters.
        rows: of the vocabulary, where a token is compared with those alone that the grammar would allow;
            None: with all.
        always_see: run the vision tower for batches without pictures too. Processes that share weights
            need it: each must take part when the tower's gradients are summed.
    """

    def __init__(self, model: PreTrainedModel, rows: Rows | None = None, always_see: bool = False) -> None:
        super().__init__()
        self._rows = rows
        self.model = model
        self._always_see = always_see

    def forward(self, batch: Batch) -> Losses:
        """Losses of a batch on the model's device."""
        inner = plain_model(self.model)
        hidden = inner.model(
            input_ids=batch.ids,
            position_ids=batch.positions,
            pixel_values=batch.pixels,
            image_grid_thw=batch.patches,
            use_cache=False,
        ).last_hidden_state
        wanted = (batch.weights > 0) | (batch.kinds >= 0)
        targets, kinds = batch.targets[wanted], batch.kinds[wanted]
        if self._rows is None:
            logits = inner.lm_head(hidden[wanted]).float()
            each = cross_entropy(logits, targets, reduction="none")
            right = logits.detach().argmax(dim=-1) == targets
        else:
            allowed = batch.cells.allowed(batch.kinds == COORDINATE)
            head = inner.lm_head.weight
            each, right = losses(hidden[wanted], head, targets, kinds, allowed, self._rows)
        total = (each * batch.weights[wanted]).sum()
        if self._always_see and batch.pixels is None:
            total = total + 0 * _blank_seen(inner)
        return Losses(total, *(_by_kind(values, kinds) for values in (each, torch.ones_like(each), right)))


def _by_kind(values: Tensor, kinds: Tensor) -> Tensor:
    return torch.stack([values.detach()[kinds == kind].float().sum() for kind in range(len(KINDS))])


def _blank_seen(inner: PreTrainedModel) -> Tensor:
    """A number that depends on all weights of the vision tower."""
    tower = inner.model.visual
    config = tower.config
    side = config.spatial_merge_size
    size = config.in_channels * config.temporal_patch_size * config.patch_size**2
    device = next(tower.parameters()).device
    patches = torch.tensor([[1, side, side]], device=device)
    seen = tower(torch.zeros(side * side, size, device=device), grid_thw=patches)
    outputs: list[Tensor] = [seen.pooler_output, *seen.deepstack_features]
    return torch.stack([output.sum() for output in outputs]).sum()
