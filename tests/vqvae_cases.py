"""Small sparse VQ-VAEs and grids for the tests of simart/vqvae."""

import torch
from simart_kit_plugins.simart.vqvae.config import VqvaeConfig

# More threads than that only wait for each other on a shared machine.
torch.set_num_threads(1)


def small(**changes):
    """16^3 voxels, 4^3 latent cells, 2x2x2 tokens of 8 voxels an edge and 64 numbers."""
    base = {
        "resolution": 16,
        "channels": (4, 8, 16),
        "blocks_per_level": 1,
        "middle_blocks": 1,
        "grid": "2x2x2",
        "codebook_size": 9,
    }
    return VqvaeConfig(**(base | changes))


def generator(seed=0):
    return torch.Generator().manual_seed(seed)


def lively(model, seed=0):
    """Random weights in place of the zeros that make new residual blocks do nothing."""
    draw = generator(seed)
    with torch.no_grad():
        for parameter in model.parameters():
            parameter.copy_(torch.randn(parameter.shape, generator=draw) * 0.2)
    return model


def two_grids():
    """(2, 1, 16, 16, 16): a plate through 4 of the 8 tokens (x < 8), and a voxel in token (1, 0, 1)."""
    grids = torch.zeros(2, 1, 16, 16, 16)
    grids[0, 0, 3, 2:14, 2:14] = 1
    grids[1, 0, 9, 1, 15] = 1
    return grids


def two_grids_occupied():
    """(2, 2, 2, 2) bool: the tokens of 8^3 voxels that `two_grids` touches, read off its coordinates."""
    occupied = torch.zeros(2, 2, 2, 2, dtype=torch.bool)
    occupied[0, 0] = True
    occupied[1, 1, 0, 1] = True
    return occupied
