"""The optimiser of a stage: what it moves, how fast, and its state as named tensors."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.optim import AdamW

from ..models import VoxelModel
from ..vqvae.stages import stage_parameters
from .config import Stage, TrainingConfig

_STATE = ("step", "exp_avg", "exp_avg_sq")


def stage_optimiser(model: VoxelModel, stage: Stage, config: TrainingConfig) -> AdamW:
    """A fresh optimiser of a stage's parameters; all others of the model are frozen, which saves their time.

    The weight decay is for convolution weights: it would pull codes that a batch does not use to 0.
    """
    model.requires_grad_(False)
    parameters = [parameter.requires_grad_(True) for parameter in stage_parameters(model, stage)]
    codes = set(map(id, model.quantiser.parameters()))
    decayed = [p for p in parameters if p.ndim > 1 and id(p) not in codes]
    others = [p for p in parameters if p.ndim <= 1 or id(p) in codes]
    groups = [
        {"params": decayed, "weight_decay": config.weight_decay},
        {"params": others, "weight_decay": 0.0},
    ]
    optimiser = AdamW(groups, lr=config.learning_rate)
    for parameter in parameters:  # as the first step would, so that every state has the same names
        optimiser.state[parameter] = {
            "step": torch.tensor(0.0),
            "exp_avg": torch.zeros_like(parameter),
            "exp_avg_sq": torch.zeros_like(parameter),
        }
    return optimiser


def set_rate(optimiser: AdamW, rate: float) -> None:
    """Set the learning rate of all parameters."""
    for group in optimiser.param_groups:
        group["lr"] = rate


def optimiser_tensors(model: VoxelModel, optimiser: AdamW) -> dict[str, Tensor]:
    """The state by name, such as `exp_avg.decoder.input_layer.bias`; the tensors are the optimiser's own."""
    return {
        f"{kind}.{name}": optimiser.state[parameter][kind]
        for name, parameter in _trained(model, optimiser)
        for kind in _STATE
    }


@torch.no_grad()
def load_optimiser_tensors(model: VoxelModel, optimiser: AdamW, tensors: dict[str, Tensor]) -> None:
    """Put a state that `optimiser_tensors` named into an optimiser of the same stage."""
    for name, own in optimiser_tensors(model, optimiser).items():
        own.copy_(tensors[name])


def _trained(model: VoxelModel, optimiser: AdamW) -> list[tuple[str, nn.Parameter]]:
    return [(name, p) for name, p in model.named_parameters() if p in optimiser.state]
