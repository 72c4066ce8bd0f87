"""AdamW over what is trained, and its state as named tensors."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.optim import AdamW

from .plan import FinetunePlan

_BETAS = (0.9, 0.95)
_STATE = ("step", "exp_avg", "exp_avg_sq")


def make_optimiser(module: nn.Module, plan: FinetunePlan) -> AdamW:
    """A fresh optimiser; only matrices of layers decay, since rows of embeddings are seldom used."""
    trained = [(name, p) for name, p in module.named_parameters() if p.requires_grad]
    decayed = [p for name, p in trained if p.ndim > 1 and not _is_table(name)]
    others = [p for name, p in trained if p.ndim <= 1 or _is_table(name)]
    groups = [
        {"params": decayed, "weight_decay": plan.weight_decay},
        {"params": others, "weight_decay": 0.0},
    ]
    filled = [group for group in groups if group["params"]]
    optimiser = AdamW(filled, lr=plan.learning_rate, betas=_BETAS, fused=True)
    for _, parameter in trained:  # as the first step would, so that every state has the same names
        optimiser.state[parameter] = {
            "step": torch.zeros((), dtype=torch.float32, device=parameter.device),
            "exp_avg": torch.zeros_like(parameter),
            "exp_avg_sq": torch.zeros_like(parameter),
        }
    return optimiser


def set_rate(optimiser: AdamW, rate: float) -> None:
    """Set the learning rate of all parameters."""
    for group in optimiser.param_groups:
        group["lr"] = rate


def trained_tensors(module: nn.Module, optimiser: AdamW) -> dict[str, Tensor]:
    """What training changes, this process's share of it: weights and moments by name."""
    tensors = {}
    for name, parameter in module.named_parameters():
        if parameter.requires_grad:
            tensors[f"weight.{name}"] = local(parameter)
            state = optimiser.state[parameter]
            tensors |= {f"{kind}.{name}": local(state[kind]) for kind in _STATE}
    return tensors


def local(tensor: Tensor) -> Tensor:
    """This process's share of a tensor, sharing its memory."""
    share = tensor.detach()
    return share.to_local() if hasattr(share, "to_local") else share


def _is_table(name: str) -> bool:
    return "embed" in name or "lm_head" in name or "token_adapter" in name
