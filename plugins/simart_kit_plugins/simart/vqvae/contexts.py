"""Which codebook is a cell's own: what the cells beside it tell of its geometry costs no code."""

from __future__ import annotations

import torch
from torch import Tensor
from torch.nn.functional import pad


def contexts(picked: Tensor, count: int) -> Tensor:
    """(K,) int64 codebooks 0..count-1 of the K cells that (B, X, Y, Z) marks as having a token.

    Of 8, two bits say which of the two cells beside it along y have a token, and the third whether both
    along z have. Where tokens are is known before any code is read. Of all ways to make eight contexts of
    the six cells beside a cell that were tried, this one left the least error.
    """
    if count == 1:
        return torch.zeros(int(picked.sum()), dtype=torch.int64, device=picked.device)
    around = pad(picked, (1, 1, 1, 1))
    before, behind = around[:, :, :-2, 1:-1][picked], around[:, :, 2:, 1:-1][picked]
    below, above = around[:, :, 1:-1, :-2][picked], around[:, :, 1:-1, 2:][picked]
    return 4 * (below & above).long() + 2 * before.long() + behind.long()
