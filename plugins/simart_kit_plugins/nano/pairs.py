"""How two pieces lie to each other: fixed numbers, of which the network makes its attention's biases."""

from __future__ import annotations

import torch
from torch import Tensor

from .scene import AREA, COLOR, FACING, FAR, HALF, MARGIN, MIDDLE, NEAR, REACH, WITHIN

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


@torch.no_grad()
def mutual_numbers(numbers: Tensor) -> Tensor:
    """The same for either order of two pieces: (B, PAIR_NUMBERS, S, S) of `pair_numbers`.

    The larger of both; of how much of each box is in the other's, the smaller as well.
    """
    other = numbers.transpose(2, 3)
    mutual = torch.maximum(numbers, other)
    mutual[:, WITHIN + 1] = torch.minimum(numbers[:, WITHIN], other[:, WITHIN])
    return mutual


@torch.no_grad()
def rivalry(own: Tensor, gap: Tensor, there: Tensor) -> Tensor:
    """How much farther a piece is from another than from what looks like that other one.

    Of a handle among drawers, which are alike, the own drawer has 0, and those beside it more.

    Args:
        own: (B, S, PIECE_NUMBERS) of the pieces.
        gap: (B, S, S) least distance [sides of the object].
        there: (B, S) bool, which pieces exist.

    Returns:
        (B, RIVALRY_NUMBERS, S, S), by least distances and by those of middles: the larger and the smaller of
        the two that a pair has.
    """
    unlike = 1 - torch.exp(-8 * _distances(own[..., HALF]) - 4 * _distances(own[..., COLOR]))
    unlike = unlike.masked_fill(~there[:, None], torch.inf)
    found = []
    for distance, most in ((gap, REACH), (_distances(own[..., MIDDLE]), FAR)):
        farther = torch.empty_like(distance)
        for piece in range(distance.shape[1]):
            here = distance[:, piece]
            others = here[:, None] + most * unlike
            others[:, :, piece] = torch.inf
            farther[:, piece] = here - torch.minimum(others.amin(2), here)
        farther = farther / most
        found += [
            torch.maximum(farther, farther.transpose(1, 2)),
            torch.minimum(farther, farther.transpose(1, 2)),
        ]
    return torch.stack(found, dim=1)


def _distances(rows: Tensor) -> Tensor:
    """(B, S, S) between all (B, S, K)."""
    return torch.cdist(rows, rows, compute_mode=_MODE)
