"""Encoder and decoder of the small model: a linear map of each block, and what its neighbours add to it."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn.functional import gelu

from .config import VqNanoConfig
from .layers import NeighbourLayer

# Occupied blocks have about a fifth of their voxels on; this centres them.
_SHARE_ON = 0.2


class BlockEncoder(nn.Module):
    """(K, n) voxels of blocks to (K, D) features: principal components, corrected by a network."""

    def __init__(self, config: VqNanoConfig) -> None:
        super().__init__()
        width, places = config.channels, sum(config.cells)
        self.components = nn.Linear(config.block_voxels, config.vector_length)
        self.widen = nn.Linear(config.block_voxels, config.hidden_channels)
        self.narrow = nn.Linear(config.hidden_channels, width)
        self.place = nn.Parameter(0.02 * torch.randn(places, width))
        self.empty = nn.Parameter(torch.zeros(1, width))
        self.layers = nn.ModuleList(
            NeighbourLayer(width, config.neighbour_channels, config.hidden_channels)
            for _ in range(config.encoder_layers)
        )
        self.norm, self.correction = nn.LayerNorm(width), nn.Linear(width, config.vector_length)
        nn.init.zeros_(self.correction.weight)
        nn.init.zeros_(self.correction.bias)

    def forward(self, voxels: Tensor, places: Tensor, rows: Tensor) -> Tensor:
        """(K, n) 0 or 1, (K, 3) `places` and (K, 27) `neighbour_rows`."""
        hidden = self.narrow(gelu(self.widen(voxels - _SHARE_ON))) + self.place[places].sum(1)
        for layer in self.layers:
            hidden = layer(hidden, rows, self.empty)
        features: Tensor = self.components(voxels) + self.correction(self.norm(hidden))
        return features.float()


class BlockDecoder(nn.Module):
    """(K, D) token vectors to (K, n) logits: the reverse map, corrected by a network."""

    def __init__(self, config: VqNanoConfig) -> None:
        super().__init__()
        width, places = config.channels, sum(config.cells)
        self.components = nn.Linear(config.vector_length, config.block_voxels)
        self.input_layer = nn.Linear(config.vector_length, width)
        self.place = nn.Parameter(0.02 * torch.randn(places, width))
        self.layers = nn.ModuleList(
            NeighbourLayer(width, config.neighbour_channels, config.hidden_channels)
            for _ in range(config.decoder_layers)
        )
        self.norm, self.widen = nn.LayerNorm(width), nn.Linear(width, config.hidden_channels)
        self.correction = nn.Linear(config.hidden_channels, config.block_voxels)
        nn.init.zeros_(self.correction.weight)
        nn.init.zeros_(self.correction.bias)

    def forward(self, vectors: Tensor, places: Tensor, rows: Tensor, empty: Tensor | None) -> Tensor:
        """(K, D) vectors, (K, 3) `places`, (K, 27) `neighbour_rows`, and the (D,) vector of emptiness.

        Without one, cells without a token are zeros to their neighbours.
        """
        hidden = self.input_layer(vectors) + self.place[places].sum(1)
        nothing = hidden.new_zeros(1, hidden.shape[1]) if empty is None else self.input_layer(empty[None])
        for layer in self.layers:
            hidden = layer(hidden, rows, nothing)
        logits: Tensor = self.components(vectors) + self.correction(gelu(self.widen(self.norm(hidden))))
        return logits.float()
