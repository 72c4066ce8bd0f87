"""How well codes stand for grids: read with the mask of cells without a token, and by the decoder alone.

Both are needed to be fair. A token string names the cells that have a token, so whoever reads one knows that
all others are empty: with that mask, no model can put a voxel there. This is what the product does, and it
hides what a zero token is for. The decoder alone gets the codes and nothing else; in the cells without one it
has the zero token (mode zero) or zeros (force-sparse), and what it makes of these is part of the result. The
paper names no mask. In mode dense every cell has a token, so that both are the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor

from simart_kit.arrays import BoolArray, FloatArray
from simart_kit.bench.reconstruction import Reconstruction, score_reconstruction

from ..models import VoxelModel
from ..training.grids import Grids
from ..vqvae.usage import Usage, count_codes, usage
from .coding import Coding

_AT_ONCE = 8


@dataclass(frozen=True)
class Scores:
    """Means over grids; see `Reconstruction` for the units.

    Attributes:
        mse: of probabilities, over all voxels; 0..1.
        cd_squared: chamfer distance in the paper's sense [square of the cube's side].
        iou: of voxels; 0..1.
        nothing: number of grids of which no voxel came back; each has the CD of a lost object.
    """

    mse: float
    cd_squared: float
    iou: float
    nothing: int


@dataclass(frozen=True, eq=False)
class Judgement:
    """What a model makes of some grids.

    Attributes:
        masked: cells without a token are empty.
        alone: the decoder decides about all cells.
        each_alone: (N,) `cd_squared` of each grid by the decoder alone.
        lost_alone: (N,) bool, grids of which it gave no voxel.
        usage: of the codebook, over all grids.
    """

    masked: Scores
    alone: Scores
    each_alone: FloatArray
    lost_alone: BoolArray
    usage: Usage


def judge(model: VoxelModel, grids: Grids, coding: Coding) -> Judgement:
    """Turn each grid into codes, decode these, and score what comes back.

    Args:
        model: decodes; on any device.
        grids: each with at least one voxel on.
        coding: grids to codes.
    """
    masked: list[tuple[Reconstruction, bool]] = []
    alone: list[tuple[Reconstruction, bool]] = []
    counts = torch.zeros(model.config.codebook_size - model.config.first_code, dtype=torch.int64)
    for truth, voxels in _batches(grids, next(model.parameters()).device):
        codes, seen = coding(voxels)
        counts += count_codes(codes.cpu(), model.config)
        bare = _scored(truth, model.decode(codes))
        alone += bare
        masked += bare if bool(seen.all()) else _scored(truth, model.decode(codes, seen))
    each = np.array([score.cd_squared for score, _ in alone])
    lost = np.array([nothing for _, nothing in alone])
    return Judgement(_means(masked), _means(alone), each, lost, usage(counts))


def _batches(grids: Grids, device: torch.device) -> Iterator[tuple[BoolArray, Tensor]]:
    """(B, R, R, R) grids and the same as (B, 1, R, R, R) on the device."""
    for first in range(0, len(grids), _AT_ONCE):
        truth = grids.occupancy(range(first, min(first + _AT_ONCE, len(grids))))
        yield truth, torch.from_numpy(truth)[:, None].to(device)


def _scored(truth: BoolArray, logits: Tensor) -> list[tuple[Reconstruction, bool]]:
    """The score of each grid, and whether no voxel of it came back."""
    chances = logits.sigmoid()[:, 0].float().cpu().numpy()
    pairs = zip(truth, chances, strict=True)
    return [(score_reconstruction(true, chance), not (chance > 0.5).any()) for true, chance in pairs]


def _means(scored: list[tuple[Reconstruction, bool]]) -> Scores:
    table = np.array([(score.mse, score.cd_squared, score.iou) for score, _ in scored])
    mse, cd, iou = table.mean(axis=0).tolist()
    return Scores(mse, cd, iou, sum(nothing for _, nothing in scored))
