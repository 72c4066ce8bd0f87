"""The loss of the paper's appendix, term by term, and the dice loss of TRELLIS beside it."""

from __future__ import annotations

from dataclasses import dataclass

from torch import Tensor
from torch.nn.functional import binary_cross_entropy_with_logits

from .config import CodebookConfig


@dataclass(frozen=True, eq=False)
class Losses:
    """Scalars; the terms are not weighted yet.

    Attributes:
        reconstruction: binary cross-entropy, mean over all voxels.
        dice: 1 - dice overlap, mean over the batch.
        codebook: pulls entries to what they stand for; 0 where a running mean does that.
        commitment: pulls the encoder to the entries it chose.
        total: reconstruction + dice_weight * dice + codebook + beta * commitment.
    """

    reconstruction: Tensor
    dice: Tensor
    codebook: Tensor
    commitment: Tensor
    total: Tensor


def losses(
    logits: Tensor, occupancy: Tensor, codebook: Tensor, commitment: Tensor, config: CodebookConfig
) -> Losses:
    """All terms and their weighted sum, from (B, 1, R, R, R) logits and 0-or-1 voxels."""
    logits, occupancy = logits.float(), occupancy.float()
    reconstruction = binary_cross_entropy_with_logits(logits, occupancy)
    dice = dice_loss(logits, occupancy)
    return weighted(reconstruction, dice, codebook, commitment, config)


def weighted(
    reconstruction: Tensor, dice: Tensor, codebook: Tensor, commitment: Tensor, config: CodebookConfig
) -> Losses:
    """The terms with their sum, weighted as the config says."""
    total = reconstruction + config.dice_weight * dice + codebook + config.beta * commitment
    return Losses(reconstruction, dice, codebook, commitment, total)


def dice_loss(logits: Tensor, occupancy: Tensor) -> Tensor:
    """1 - (2 sum(p t) + 1) / (sum(p) + sum(t) + 1) of each object, then the mean over objects.

    The sums are taken an object at a time, so that a small part counts as much as a large one.
    """
    chance, truth = logits.sigmoid().flatten(1), occupancy.flatten(1)
    overlap = 2 * (chance * truth).sum(1) + 1
    return (1 - overlap / (chance.sum(1) + truth.sum(1) + 1)).mean()


def mean_squared(a: Tensor, b: Tensor) -> Tensor:
    """Mean of (a - b)^2 over all elements of (N, D); 0 for no rows."""
    return (a - b).square().sum() / max(a.numel(), 1)
