"""One step of training: the gradient's, then the codebook's own."""

from __future__ import annotations

import torch
from torch import Tensor
from torch.nn.utils import clip_grad_norm_
from torch.optim import AdamW

from ..models import VoxelModel
from ..vqnano.model import BlockOutput
from ..vqvae.model import Output
from .config import TrainingConfig
from .optimiser import set_rate
from .sampling import torch_generator


class DivergedError(Exception):
    """A number that training goes on with is NaN or infinite; says which."""


def train_step(
    model: VoxelModel, optimiser: AdamW, voxels: Tensor, config: TrainingConfig, step: int
) -> tuple[Output | BlockOutput, int]:
    """Change the model by the step of this number.

    Args:
        model: changed in place, unless `DivergedError` is raised.
        optimiser: of the step's stage.
        voxels: (B, 1, R, R, R) 0 or 1.
        config: rate, clip, precision and seed.
        step: 0..steps-1.

    Returns:
        What the model gave before the step, and how many entries were revived.

    Raises:
        DivergedError: the loss or its gradient is not finite.
    """
    half = config.precision == "bf16"
    with torch.autocast(voxels.device.type, dtype=torch.bfloat16, enabled=half):
        output: Output | BlockOutput = model(voxels)
    optimiser.zero_grad()
    torch.autograd.backward(output.losses.total)
    trained = [parameter for group in optimiser.param_groups for parameter in group["params"]]
    norm = clip_grad_norm_(trained, config.gradient_clip)
    if not torch.isfinite(output.losses.total.detach() + norm):
        raise DivergedError("the loss or its gradient is not finite")
    set_rate(optimiser, config.rate(step))
    optimiser.step()
    draw = torch_generator(config.seed, step)
    return output, model.quantiser.update(output.features, output.codes, draw)


def check_weights(model: VoxelModel) -> None:
    """Raise DivergedError for a weight that is not finite: such a model cannot be loaded again."""
    for name, tensor in model.state_dict().items():
        if not torch.isfinite(tensor).all():
            raise DivergedError(f"{name} is not finite")
