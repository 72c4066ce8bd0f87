"""The linear start of the small model: principal components of blocks, and back."""

from __future__ import annotations

from collections.abc import Iterable

import torch
from torch import Tensor

from .blocks import block_view
from .model import VqNano

# Blocks whose components are taken: many more than a block has voxels.
_BLOCKS = 1 << 17
# From the reconstructed 0..1 of a voxel to its logit: 0 is -3 and 1 is +3.
_SLOPE = 6.0


@torch.no_grad()
def fit_components(model: VqNano, batches: Iterable[Tensor]) -> None:
    """Make the linear maps of encoder and decoder those of the principal components of occupied blocks.

    Random maps never use most of a codebook. The first component has a standard deviation of 1.

    Args:
        model: changed in place.
        batches: (B, 1, R, R, R) voxels; read until there are enough blocks.
    """
    mean, covariance = _moments(model, batches)
    variance, directions = torch.linalg.eigh(covariance)
    kept = directions.flip(1)[:, : model.config.vector_length].float()
    scale = variance[-1].clamp(min=1e-12).rsqrt().item()
    encoder, decoder = model.encoder.components, model.decoder.components
    encoder.weight.copy_(scale * kept.T)
    encoder.bias.copy_(-scale * (mean.float() @ kept))
    decoder.weight.copy_(_SLOPE / scale * kept)
    decoder.bias.copy_(_SLOPE * (mean.float() - 0.5))


def _moments(model: VqNano, batches: Iterable[Tensor]) -> tuple[Tensor, Tensor]:
    """(n,) mean and (n, n) covariance of the voxels of occupied blocks; float64."""
    size = model.config.block_voxels
    total = torch.zeros(size, dtype=torch.float64)
    squares = torch.zeros(size, size, dtype=torch.float64)
    count = 0
    for batch in batches:
        blocks = block_view(batch > 0, model.config.cells).flatten(4)
        found = blocks[blocks.any(-1)].float()
        total += found.sum(0).double().cpu()
        squares += (found.T @ found).double().cpu()
        count += len(found)
        if count >= _BLOCKS:
            break
    mean = total / max(count, 1)
    return mean, squares / max(count, 1) - torch.outer(mean, mean)
