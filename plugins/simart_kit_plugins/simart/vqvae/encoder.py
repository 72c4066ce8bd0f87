"""Voxels to latent cells: the encoder of TRELLIS' sparse-structure VAE."""

from __future__ import annotations

from torch import Tensor, nn

from .blocks import ChannelNorm, Downsample, ResBlock
from .config import VqvaeConfig


class Encoder(nn.Module):
    """Convolutions from the input's edge down to the latent edge.

    The output layer has the 2 x latent channels (mean, log-variance) of the published weights. The latent is
    the mean; the other half is kept for an identity mapping of names and shapes and has no gradient.
    """

    def __init__(self, config: VqvaeConfig) -> None:
        super().__init__()
        self.input_layer = nn.Conv3d(1, config.channels[0], 3, padding=1)
        self.blocks = nn.ModuleList()
        for level, channels in enumerate(config.channels):
            self.blocks.extend(ResBlock(channels, channels) for _ in range(config.blocks_per_level))
            if channels_below := config.channels[level + 1 : level + 2]:
                self.blocks.append(Downsample(channels, channels_below[0]))
        deepest = config.channels[-1]
        self.middle_block = nn.Sequential(*(ResBlock(deepest, deepest) for _ in range(config.middle_blocks)))
        self.out_layer = nn.Sequential(
            ChannelNorm(deepest, eps=1e-5),
            nn.SiLU(),
            nn.Conv3d(deepest, 2 * config.latent_channels, 3, padding=1),
        )

    def forward(self, occupancy: Tensor) -> Tensor:
        """(B, 1, R, R, R) 0 or 1 to (B, C, L, L, L) latent means."""
        hidden = self.input_layer(occupancy)
        for block in self.blocks:
            hidden = block(hidden)
        mean: Tensor = self.out_layer(self.middle_block(hidden)).chunk(2, dim=1)[0]
        return mean
