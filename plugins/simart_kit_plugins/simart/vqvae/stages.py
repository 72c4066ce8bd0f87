"""The paper's two-stage training: what each stage trains."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from torch import nn

if TYPE_CHECKING:
    from ..models import VoxelModel


def stage_parameters(model: VoxelModel, stage: Literal[1, 2]) -> list[nn.Parameter]:
    """Parameters that an optimiser of this stage gets.

    The paper says "two-stage" and no more. Read here as: stage 1 trains what the weights that the model
    starts from lack, stage 2 all. With codebook_update "ema" the entries are no parameters and follow
    `Quantiser.update` in both stages.
    """
    return list(model.parameters()) if stage == 2 else model.first_stage_parameters()
