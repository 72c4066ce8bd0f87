"""Voxels <-> token cells: which tokens have geometry, and which voxels a token speaks of."""

from __future__ import annotations

from torch import Tensor
from torch.nn.functional import interpolate, max_pool3d

from simart_kit.errors import BadInputError

from .config import CodebookConfig, VqvaeConfig
from .space_to_depth import depth_to_space, space_to_depth


def occupied_cells(occupancy: Tensor, config: VqvaeConfig) -> Tensor:
    """(B, 1, R, R, R) voxels to (B, X, Y, Z) bool: tokens with at least one voxel on.

    Taken from the input grid, not from the encoder, so that a reader of the tokens can tell it from geometry.
    """
    latent = max_pool3d(occupancy.float(), config.voxels_per_latent_cell)
    return space_to_depth(latent, config.cells, config.layout).amax(-1) > 0


def voxels_of_cells(occupied: Tensor, config: VqvaeConfig) -> Tensor:
    """(B, X, Y, Z) bool tokens to (B, 1, R, R, R) bool: the voxels that those tokens cover."""
    latent_cells = config.latent_edge**3 // occupied[0].numel()
    tokens = occupied.unsqueeze(-1).expand(*occupied.shape, latent_cells)
    latent = depth_to_space(tokens, config.latent_edge, config.layout)
    return interpolate(latent.float(), scale_factor=config.voxels_per_latent_cell, mode="nearest") > 0


def require_grid(occupancy: Tensor, config: CodebookConfig) -> None:
    """Raise BadInputError for voxels that are not (B, 1, R, R, R) of the config's resolution."""
    edge, shape = config.resolution, tuple(occupancy.shape)
    if len(shape) != 5 or shape[1:] != (1, edge, edge, edge):
        raise BadInputError(f"voxel grid of shape {shape}: this model reads (B, 1, {edge}, {edge}, {edge})")


def require_cells(what: str, array: Tensor, config: CodebookConfig) -> None:
    """Raise BadInputError for an array, named `what`, that is not (B, X, Y, Z) of the config's tokens."""
    if array.ndim != 4 or array.shape[1:] != config.cells:
        x, y, z = config.cells
        raise BadInputError(f"{what} of shape {tuple(array.shape)}: this model reads (B, {x}, {y}, {z})")
