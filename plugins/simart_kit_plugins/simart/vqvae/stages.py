"""The paper's two-stage training: what each stage trains."""

from __future__ import annotations

from typing import Literal

from torch import nn

from .model import SparseVQVAE


def stage_parameters(model: SparseVQVAE, stage: Literal[1, 2]) -> list[nn.Parameter]:
    """Parameters that an optimiser of this stage gets.

    The paper says "two-stage" and no more. Read here as: stage 1 trains what TRELLIS' weights lack, that is
    the codebook, the zero token, and the decoder's first layer, which meets them; stage 2 all.
    With codebook_update "ema" the entries are no parameters and follow `Quantiser.update` in both stages.
    """
    if stage == 2:
        return list(model.parameters())
    return [*model.quantiser.parameters(), *model.decoder.input_layer.parameters()]
