"""Latent cells to voxels: the decoder of TRELLIS' sparse-structure VAE."""

from __future__ import annotations

from torch import Tensor, nn

from .blocks import ChannelNorm, ResBlock, Upsample
from .config import VqvaeConfig


class Decoder(nn.Module):
    """The encoder's mirror: from the latent edge up to one logit a voxel; occupied where it is above 0."""

    def __init__(self, config: VqvaeConfig) -> None:
        super().__init__()
        levels = config.channels[::-1]
        self.input_layer = nn.Conv3d(config.latent_channels, levels[0], 3, padding=1)
        self.middle_block = nn.Sequential(
            *(ResBlock(levels[0], levels[0]) for _ in range(config.middle_blocks))
        )
        self.blocks = nn.ModuleList()
        for level, channels in enumerate(levels):
            self.blocks.extend(ResBlock(channels, channels) for _ in range(config.blocks_per_level))
            if channels_above := levels[level + 1 : level + 2]:
                self.blocks.append(Upsample(channels, channels_above[0]))
        self.out_layer = nn.Sequential(
            ChannelNorm(levels[-1], eps=1e-5), nn.SiLU(), nn.Conv3d(levels[-1], 1, 3, padding=1)
        )

    def forward(self, latent: Tensor) -> Tensor:
        """(B, C, L, L, L) latent cells to (B, 1, R, R, R) logits."""
        hidden = self.middle_block(self.input_layer(latent))
        for block in self.blocks:
            hidden = block(hidden)
        logits: Tensor = self.out_layer(hidden)
        return logits
