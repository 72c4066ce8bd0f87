"""One step of the optimiser: a batch of every lane of this process."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import torch
from torch import Tensor

from .machine import average_gradients
from .objective import Losses, Objective
from .packing import Batch
from .plan import FinetunePlan

if TYPE_CHECKING:
    from accelerate import Accelerator
    from torch.optim import AdamW


class DivergedError(Exception):
    """A loss or a gradient is not finite."""


def train_step(
    objective: Objective,
    optimiser: AdamW,
    taken: Sequence[Batch],
    plan: FinetunePlan,
    accelerator: Accelerator,
) -> tuple[Tensor, float]:
    """Change the weights once; the loss is the weighted mean over the batches of all processes.

    Returns:
        Sums over all processes: loss, weight, tokens, then losses, counts and hits by kind; and the norm of
        the gradient before it was clipped.

    Raises:
        DivergedError: the loss or the gradient is not finite; the weights are as they were.
    """
    own = torch.tensor(float(sum(batch.weights.sum() for batch in taken)), device=accelerator.device)
    weight = accelerator.reduce(own.clone(), reduction="sum").clamp(min=1e-9)
    found: list[Tensor] = []
    for batch in taken:
        with accelerator.autocast():
            losses = objective(batch.to(accelerator.device))
        # Gradients are averaged over the processes, so that their sum needs the number of them.
        accelerator.backward(losses.total * (accelerator.num_processes / weight))
        found.append(_sums(losses, batch))
    sums = accelerator.reduce(torch.stack(found).sum(dim=0), reduction="sum").cpu()
    if not plan.fsdp and accelerator.num_processes > 1:
        average_gradients(objective, accelerator)
    trained = [p for p in objective.parameters() if p.requires_grad]
    measured = torch.nn.utils.clip_grad_norm_(trained, plan.gradient_clip)
    norm = float(measured.full_tensor() if hasattr(measured, "full_tensor") else measured)
    if not math.isfinite(norm) or not math.isfinite(float(sums[0])):
        raise DivergedError("the loss is not finite")
    optimiser.step()
    optimiser.zero_grad(set_to_none=True)
    return sums, norm


def agreed(asked: bool, accelerator: Accelerator) -> bool:
    """Whether any process was asked to stop."""
    if accelerator.num_processes == 1:
        return asked
    votes = torch.tensor(float(asked), device=accelerator.device)
    return bool(accelerator.reduce(votes, reduction="sum") > 0)


def _sums(losses: Losses, batch: Batch) -> Tensor:
    head = torch.stack([losses.total.detach(), batch.weights.sum().to(losses.total.device)])
    tokens = torch.tensor([float(batch.tokens)], device=losses.total.device)
    return torch.cat(
        [head.double(), tokens.double(), losses.sums.double(), losses.counts.double(), losses.right.double()]
    )
