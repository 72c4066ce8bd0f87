"""Token counts of objects: of the whole, and summed over its parts as in the paper's table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch

from simart_kit.arrays import BoolArray

from ..models import VoxelModel
from ..token_counts import TokenCounts, token_counts
from ..training.grids import Grids, objects_of
from .coding import coding_without

Cells = tuple[int, int, int]


@dataclass(frozen=True)
class Lengths:
    """Sums over objects.

    Attributes:
        objects: number of objects.
        parts: number of their parts; an object without labels is its own part.
        whole: of the whole objects.
        summed: of all parts.
        forced: whether `force_sparse` is what a trained model keeps; else it repeats the occupied cells.
    """

    objects: int
    parts: int
    whole: TokenCounts
    summed: TokenCounts
    forced: bool


def lengths(grids: Grids, cells: Cells, kept: BoolArray | None) -> Lengths:
    """Token counts of all objects.

    Args:
        grids: each object's whole, then its parts, if any.
        cells: tokens along x, y and z.
        kept: (N, X, Y, Z) cells that a model without zero token keeps; None without such a model.
    """
    objects = objects_of(grids.names)
    counts = [_counts(grids, row, cells, kept) for row in range(len(grids))]
    parts = [row for rows in objects for row in rows[1:] or rows]
    return Lengths(
        len(objects),
        len(parts),
        _sum([counts[rows[0]] for rows in objects]),
        _sum([counts[row] for row in parts]),
        kept is not None,
    )


def cells_kept(model: VoxelModel, grids: Grids, code: int) -> BoolArray:
    """(N, X, Y, Z) cells whose code is not this one, in the codes of a dense model."""
    device, encode = next(model.parameters()).device, coding_without(model, code)
    kept = [
        encode(torch.from_numpy(grids.occupancy([row]))[:, None].to(device))[1].cpu().numpy()
        for row in range(len(grids))
    ]
    return np.concatenate(kept)


def _counts(grids: Grids, row: int, cells: Cells, kept: BoolArray | None) -> TokenCounts:
    x, y, z = cells
    edge = grids.resolution
    blocks = grids.occupancy([row]).reshape(x, edge // x, y, edge // y, z, edge // z)
    occupied = np.asarray(blocks.any(axis=(1, 3, 5)))
    return token_counts(occupied, force_kept=None if kept is None else kept[row])


def _sum(counts: Sequence[TokenCounts]) -> TokenCounts:
    total = counts[0]
    for more in counts[1:]:
        total = total + more
    return total
