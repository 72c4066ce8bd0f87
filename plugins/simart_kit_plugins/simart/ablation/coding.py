"""Grids to codes: as a model encodes them, or without the code that stands for emptiness."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import torch
from torch import Tensor

from ..models import VoxelModel, build_model
from ..training.grids import Grids
from ..vqvae.quantiser import NO_TOKEN
from ..vqvae.usage import count_codes

# (B, 1, R, R, R) voxels to (B, X, Y, Z) codes, and the (B, X, Y, Z) bool cells that have a token.
Coding = Callable[[Tensor], tuple[Tensor, Tensor]]
# Grids that tell which code stands for emptiness, and how many of them at once.
_MOST, _AT_ONCE = 256, 8
# Share of the empty cells that the codes of emptiness have to cover.
_NEARLY_ALL = 0.99


@dataclass(frozen=True)
class Emptiness:
    """What a model without zero token makes of empty cells.

    Attributes:
        code: that most of them have; a force-sparse sequence leaves it out.
        share: of the empty cells that have it; 0..1.
        codes: number of codes, the most frequent ones, that 99 % of the empty cells have.
        geometry: share of the occupied cells that have it too, and are lost with it; 0..1.
    """

    code: int
    share: float
    codes: int
    geometry: float


def coding(model: VoxelModel) -> Coding:
    """The model's own."""

    def encode(voxels: Tensor) -> tuple[Tensor, Tensor]:
        encoded = model.encode(voxels)
        dense = model.config.mode == "dense"
        return encoded.codes, torch.ones_like(encoded.occupied) if dense else encoded.occupied

    return encode


def coding_without(model: VoxelModel, code: int) -> Coding:
    """That of a dense model, without the cells that have this code."""

    def encode(voxels: Tensor) -> tuple[Tensor, Tensor]:
        codes = model.encode(voxels).codes
        kept = codes != code
        return codes.masked_fill(~kept, NO_TOKEN), kept

    return encode


def as_force_sparse(model: VoxelModel) -> VoxelModel:
    """A model with the weights of a dense one, that decodes cells without a token as force-sparse ones do."""
    sparse = build_model(model.config.model_copy(update={"mode": "force-sparse"}))
    sparse.load_state_dict(model.state_dict())
    return sparse.to(next(model.parameters()).device)


def emptiness(model: VoxelModel, grids: Grids) -> Emptiness | None:
    """Which codes of a dense model stand for emptiness, by the first 256 grids; None if no cell is empty."""
    device = next(model.parameters()).device
    empty = torch.zeros(model.config.codebook_size, dtype=torch.int64)
    full = torch.zeros_like(empty)
    count = min(_MOST, len(grids))
    for first in range(0, count, _AT_ONCE):
        rows = range(first, min(first + _AT_ONCE, count))
        encoded = model.encode(torch.from_numpy(grids.occupancy(rows))[:, None].to(device))
        codes, occupied = encoded.codes.cpu(), encoded.occupied.cpu()
        empty += count_codes(codes[~occupied], model.config)
        full += count_codes(codes[occupied], model.config)
    if not empty.any():
        return None
    code = int(empty.argmax())
    covered = empty.sort(descending=True).values.cumsum(0) / empty.sum()
    several = int((covered < _NEARLY_ALL).sum()) + 1
    return Emptiness(code, (empty[code] / empty.sum()).item(), several, (full[code] / full.sum()).item())
