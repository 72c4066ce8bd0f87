"""How much of the codebook is used."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from .config import CodebookConfig


@dataclass(frozen=True)
class Usage:
    """Use of the codes that stand for geometry; the reserved code of mode zero is not among them.

    Attributes:
        entries: how many there are.
        used: how many occurred.
        perplexity: how many equally frequent codes would have the same entropy; 0 when none occurred.
    """

    entries: int
    used: int
    perplexity: float


def count_codes(codes: Tensor, config: CodebookConfig) -> Tensor:
    """(entries,) int64 occurrences of each code in codes of any shape; counts of batches add up."""
    geometry = codes[codes >= config.first_code] - config.first_code
    return torch.bincount(geometry, minlength=config.codebook_size - config.first_code)


def usage(counts: Tensor) -> Usage:
    """Summarise (entries,) occurrences."""
    share = counts[counts > 0].double() / counts.sum()
    perplexity = torch.exp(-(share * share.log()).sum()).item() if len(share) else 0.0
    return Usage(len(counts), len(share), perplexity)
