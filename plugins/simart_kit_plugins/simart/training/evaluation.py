"""How well a model rebuilds grids that it reads as codes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice

import numpy as np
import torch
from torch import Tensor

from simart_kit.arrays import BoolArray
from simart_kit.bench.reconstruction import Reconstruction, score_reconstruction
from simart_kit.errors import BadInputError

from ..models import VoxelModel
from ..vqvae.usage import Usage, count_codes, usage


@dataclass(frozen=True)
class Evaluation:
    """Means over grids; see `Reconstruction` for the units.

    Attributes:
        count: number of grids.
        iou: intersection over union of voxels; 0..1.
        mse: of probabilities, over all voxels; 0..1.
        cd: chamfer distance of occupied voxels [side of the cube].
        cd_squared: the same in the paper's sense [square of that side].
        usage: of the codebook, over all grids.
    """

    count: int
    iou: float
    mse: float
    cd: float
    cd_squared: float
    usage: Usage


def evaluate(model: VoxelModel, occupancies: Iterable[BoolArray], batch_size: int = 8) -> Evaluation:
    """Encode each grid to codes, decode these alone, and score what comes back.

    Cells without a token stay empty, as for whoever reads a token string; in mode dense all cells have one.

    Args:
        model: on any device.
        occupancies: (R, R, R) bool grids with at least one voxel on.
        batch_size: grids at once.

    Raises:
        BadInputError: there is no grid, or one is empty or of another resolution.
    """
    scores: list[Reconstruction] = []
    counts = torch.zeros(model.config.codebook_size - model.config.first_code, dtype=torch.int64)
    device = next(model.parameters()).device
    remaining = iter(occupancies)
    while batch := list(islice(remaining, batch_size)):
        voxels = torch.from_numpy(np.stack(batch))[:, None].to(device)
        codes, chances = _rebuilt(model, voxels)
        counts += count_codes(codes.cpu(), model.config)
        scores += [score_reconstruction(t, p) for t, p in zip(batch, chances.cpu().numpy(), strict=True)]
    if not scores:
        raise BadInputError("there is no grid to evaluate the model on")
    told = [(score.iou, score.mse, score.cd, score.cd_squared) for score in scores]
    iou, mse, cd, squared = np.mean(told, axis=0).tolist()
    return Evaluation(len(scores), iou, mse, cd, squared, usage(counts))


def _rebuilt(model: VoxelModel, voxels: Tensor) -> tuple[Tensor, Tensor]:
    """Codes (B, X, Y, Z) of (B, 1, R, R, R) voxels, and (B, R, R, R) probabilities from the codes alone."""
    encoded = model.encode(voxels)
    seen = None if model.config.mode == "dense" else encoded.occupied
    return encoded.codes, model.decode(encoded.codes, seen).sigmoid()[:, 0]
