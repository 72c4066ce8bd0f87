"""The tensors of a model as it ships: weights in half precision, codebooks in 8 bits, nothing of training."""

from __future__ import annotations

from collections.abc import Mapping

import torch
from torch import Tensor

ENTRIES, STEP = "quantiser.entries", "quantiser.entries_step"
# What only a training step reads; it starts anew from the entries.
TRAINING_STATE = ("quantiser.ema_count", "quantiser.ema_sum", "quantiser.idle_steps")
_LARGEST = 127


def compacted(tensors: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """The state_dict of a model in its compact form.

    The entries become int8, with the (D,) float32 value of a step of each channel beside them.
    """
    kept = {name: tensor for name, tensor in tensors.items() if name not in TRAINING_STATE}
    entries = kept.pop(ENTRIES).float()
    step = (entries.abs().amax(dim=0) / _LARGEST).clamp(min=torch.finfo(torch.float32).tiny)
    small = {name: t.half() if t.is_floating_point() else t for name, t in kept.items()}
    return {**small, ENTRIES: torch.round(entries / step).to(torch.int8), STEP: step}


def expanded(tensors: Mapping[str, Tensor], like: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """The reverse: tensors with the names and types of a model's state_dict.

    Args:
        tensors: what `compacted` gave.
        like: a state_dict of the model's config; its values are not read.
    """
    entries = tensors[ENTRIES].float() * tensors[STEP].float()
    fresh = {
        "quantiser.ema_count": torch.ones(len(entries)),
        "quantiser.ema_sum": entries,
        "quantiser.idle_steps": torch.zeros(len(entries), dtype=torch.int64),
    }
    found = {**tensors, ENTRIES: entries, **fresh}
    return {name: found[name].to(tensor.dtype) for name, tensor in like.items()}
