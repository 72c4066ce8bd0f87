"""The layer of both halves: a block looks at the blocks around it, then thinks for itself."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn.functional import gelu

from .blocks import NEIGHBOURS

# A residual branch starts next to nothing, so that a deep stack starts as what it is added to.
_SMALL = 0.02


class NeighbourLayer(nn.Module):
    """A sparse 3x3x3 convolution through few channels and a perceptron, both residual.

    Args:
        channels: of a block.
        shown: channels that a block shows its neighbours.
        hidden: channels inside the perceptron.
    """

    def __init__(self, channels: int, shown: int, hidden: int) -> None:
        super().__init__()
        self.show = nn.Sequential(nn.LayerNorm(channels), nn.Linear(channels, shown))
        self.look = nn.Linear(len(NEIGHBOURS) * shown, channels)
        self.norm = nn.LayerNorm(channels)
        self.widen, self.narrow = nn.Linear(channels, hidden), nn.Linear(hidden, channels)
        for layer in (self.look, self.narrow):
            nn.init.normal_(layer.weight, std=_SMALL)
            nn.init.zeros_(layer.bias)

    def forward(self, blocks: Tensor, rows: Tensor, empty: Tensor) -> Tensor:
        """(K, C) blocks to (K, C), by (K, 27) `neighbour_rows`.

        Args:
            blocks: those with a token.
            rows: of the blocks around each.
            empty: (1, C) what stands where there is no token.
        """
        shown = self.show(torch.cat([blocks, empty]))
        blocks = blocks + self.look(shown[rows].flatten(1))
        result: Tensor = blocks + self.narrow(gelu(self.widen(self.norm(blocks))))
        return result
