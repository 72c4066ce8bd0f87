"""Models for tests of voxel tokens: one that loses nothing, and small ones with random weights."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import torch
from simart_kit_plugins.simart.tokens import TokenGrid
from simart_kit_plugins.simart.vqvae.checkpoint import save_checkpoint
from simart_kit_plugins.simart.vqvae.config import VqvaeConfig
from simart_kit_plugins.simart.vqvae.model import SparseVQVAE

torch.set_num_threads(1)

FINGERPRINT = "0123456789abcdef"


@dataclass(frozen=True)
class DictionaryConfig:
    cells: tuple[int, int, int] = (8, 8, 8)
    codebook_size: int = 4096
    resolution: int = 64
    mode: str = "zero"


@dataclass(frozen=True)
class Codes:
    codes: torch.Tensor
    occupied: torch.Tensor


class Dictionary:
    """A model that remembers every block of voxels it meets and gives it the next free code: lossless."""

    def __init__(self, config=DictionaryConfig()):
        self.config = config
        self.blocks = [None]
        self.code_of = {}

    def encode(self, occupancy):
        blocks = self._blocks(occupancy[:, 0].numpy().astype(bool))
        codes = np.zeros(blocks.shape[:4], dtype=np.int64)
        for place in zip(*np.nonzero(blocks.any(axis=-1)), strict=True):
            key = blocks[place].tobytes()
            if key not in self.code_of:
                self.code_of[key] = len(self.blocks)
                self.blocks.append(blocks[place].copy())
            codes[place] = self.code_of[key]
        assert len(self.blocks) <= self.config.codebook_size
        return Codes(torch.from_numpy(codes), torch.from_numpy(codes > 0))

    def decode(self, codes, occupied):
        x, y, z = (self.config.resolution // cells for cells in self.config.cells)
        grids = np.zeros((len(codes), 1, *(self.config.resolution,) * 3), dtype=np.float32) - 1
        for b, i, j, k in torch.nonzero(occupied).tolist():
            block = self.blocks[int(codes[b, i, j, k])].reshape(x, y, z)
            grids[b, 0, i * x : i * x + x, j * y : j * y + y, k * z : k * z + z] = block * 2.0 - 1
        return torch.from_numpy(grids)

    def _blocks(self, grids):
        """(B, X, Y, Z, N) the voxels of each cell."""
        shape = [len(grids)]
        for cells in self.config.cells:
            shape += [cells, self.config.resolution // cells]
        blocks = grids.reshape(shape).transpose(0, 1, 3, 5, 2, 4, 6)
        return blocks.reshape(len(grids), *self.config.cells, -1)


def use_dictionary(patch, folder, model=None):
    """Let every folder of a model hold the dictionary; its fingerprint is that of the file written here."""
    model = model or Dictionary()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "model.safetensors").write_bytes(b"dictionary")
    patch.setattr("simart_kit_plugins.simart.vqvae.checkpoint.load_checkpoint", lambda folder: model)
    patch.setattr("simart_kit_plugins.simart.default_model.default_model_folder", lambda: folder)
    return model


def tiny_config(**changes):
    """A network at 64^3 voxels that takes a tenth of a second."""
    base = {"channels": (1, 2, 4), "blocks_per_level": 0, "middle_blocks": 0, "latent_channels": 1}
    return VqvaeConfig(**(base | changes))


def tiny_model(**changes):
    return SparseVQVAE(tiny_config(**changes), seed=1).eval()


def tiny_folder(folder, **changes):
    """A checkpoint with random weights."""
    return save_checkpoint(tiny_model(**changes), folder)


GRID = TokenGrid()
