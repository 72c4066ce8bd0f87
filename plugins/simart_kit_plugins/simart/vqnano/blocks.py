"""Grids of voxels <-> blocks of voxels, one a token; and which blocks touch each other."""

from __future__ import annotations

from itertools import product

import torch
from torch import Tensor
from torch.nn.functional import pad

from ..vqvae.config import Cells

# The block itself is among them, in the middle.
NEIGHBOURS = tuple(product((-1, 0, 1), repeat=3))


def block_view(voxels: Tensor, cells: Cells) -> Tensor:
    """(B, 1, R, R, R) to (B, X, Y, Z, x, y, z): the voxels of each block, without a copy."""
    count, edge = len(voxels), voxels.shape[-1]
    x, y, z = cells
    split = voxels.reshape(count, x, edge // x, y, edge // y, z, edge // z)
    return split.permute(0, 1, 3, 5, 2, 4, 6)


def grid_of_blocks(blocks: Tensor, picked: Tensor, edge: int, fill: float) -> Tensor:
    """(K, x*y*z) values of the blocks that (B, X, Y, Z) marks, to (B, 1, R, R, R); `fill` everywhere else."""
    x, y, z = picked.shape[1:]
    grid = blocks.new_full((len(picked), 1, edge, edge, edge), fill)
    view = block_view(grid, (x, y, z))
    view[picked] = blocks.reshape(-1, *view.shape[4:])
    return grid


def neighbour_rows(picked: Tensor) -> Tensor:
    """(B, X, Y, Z) bool with K blocks marked, to (K, 27) int64: the rows of the blocks around each.

    Rows count the marked blocks in C order. K stands for a block that is not marked or lies outside.
    """
    count = int(picked.sum())
    rows = torch.full(picked.shape, count, dtype=torch.int64, device=picked.device)
    rows[picked] = torch.arange(count, device=picked.device)
    around = pad(rows, (1, 1) * 3, value=count)
    sizes = picked.shape[1:]
    shifted = [
        around[:, 1 + i : 1 + i + sizes[0], 1 + j : 1 + j + sizes[1], 1 + k : 1 + k + sizes[2]][picked]
        for i, j, k in NEIGHBOURS
    ]
    return torch.stack(shifted, dim=1)


def places(picked: Tensor) -> Tensor:
    """(K, 3) int64 numbers of the marked cells of (B, X, Y, Z): x, then X + y, then X + Y + z."""
    x, y, _ = picked.shape[1:]
    return torch.nonzero(picked)[:, 1:] + torch.tensor([0, x, x + y], device=picked.device)
