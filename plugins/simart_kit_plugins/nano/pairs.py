"""How two pieces lie to each other: fixed numbers, of which the network makes its attention's biases."""

from __future__ import annotations

import torch
from torch import Tensor

from .scene import AREA, COLOR, FACING, HALF, MARGIN, MIDDLE, NEAR

# By differences: what is faster on long lists is wrong by 1e-3 where pieces are near.
_MODE = "donot_use_mm_for_euclid_dist"


@torch.no_grad()
def pair_numbers(own: Tensor, gap: Tensor) -> Tensor:
    """Numbers of all pairs; a quarter turn about z or a mirror changes none.

    Args:
        own: (B, S, PIECE_NUMBERS) of the pieces.
        gap: (B, S, S) least distance [sides of the object].

    Returns:
        (B, PAIR_NUMBERS, S, S), all about -1..1: near (3), middles apart (2), one above the other, how much
        of each box is in the other's (2), alike in shape, color and direction, one larger than the other,
        and whether they are the same.
    """
    middle, half = own[..., MIDDLE], own[..., HALF]
    apart = _distances(middle)
    low, high = middle - half - MARGIN, middle + half + MARGIN
    shared = torch.minimum(high[:, :, None], high[:, None]) - torch.maximum(low[:, :, None], low[:, None])
    within = shared.clamp(min=0).prod(-1) / (high - low).prod(-1)[..., None]
    above = middle[..., 2]
    area = own[..., AREA]
    alike = [
        torch.exp(-8 * _distances(half)),
        torch.exp(-8 * _distances(own[..., COLOR])),
        _distances(own[..., FACING]),
    ]
    same = torch.eye(own.shape[1], device=own.device).expand(len(own), -1, -1)
    return torch.stack(
        [
            *(torch.exp(-gap / reach) for reach in NEAR),
            apart,
            torch.exp(-8 * apart),
            above[:, :, None] - above[:, None],
            within,
            within.transpose(1, 2),
            *alike,
            area[:, :, None] - area[:, None],
            same,
        ],
        dim=1,
    )


def _distances(rows: Tensor) -> Tensor:
    """(B, S, S) between all (B, S, K)."""
    return torch.cdist(rows, rows, compute_mode=_MODE)
