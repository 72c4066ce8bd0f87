"""The blocks of TRELLIS' sparse-structure VAE; attribute names are those of its published weights."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn.functional import layer_norm, silu


class ChannelNorm(nn.LayerNorm):
    """Layer norm over the channels of each voxel, in float32 whatever the input's type.

    Source: TRELLIS, `ChannelLayerNorm32` (eps 1e-5).
    """

    def forward(self, x: Tensor) -> Tensor:
        """(B, C, X, Y, Z) to the same shape and type."""
        channels_last = x.movedim(1, -1).float()
        normed = layer_norm(channels_last, self.normalized_shape, self.weight, self.bias, self.eps)
        return normed.movedim(-1, 1).to(x.dtype)


class ResBlock(nn.Module):
    """Two times norm, SiLU and 3x3x3 convolution beside a skip connection; starts as the skip alone."""

    def __init__(self, channels: int, out_channels: int) -> None:
        super().__init__()
        self.norm1 = ChannelNorm(channels, eps=1e-5)
        self.norm2 = ChannelNorm(out_channels, eps=1e-5)
        self.conv1 = nn.Conv3d(channels, out_channels, 3, padding=1)
        self.conv2 = nn.Conv3d(out_channels, out_channels, 3, padding=1)
        nn.init.zeros_(self.conv2.weight)
        if self.conv2.bias is not None:
            nn.init.zeros_(self.conv2.bias)
        same = channels == out_channels
        self.skip_connection = nn.Identity() if same else nn.Conv3d(channels, out_channels, 1)

    def forward(self, x: Tensor) -> Tensor:
        """(B, C, X, Y, Z) to (B, C', X, Y, Z)."""
        hidden = self.conv1(silu(self.norm1(x)))
        hidden = self.conv2(silu(self.norm2(hidden)))
        skipped: Tensor = self.skip_connection(x)
        return torch.add(skipped, hidden)


class Downsample(nn.Module):
    """Half the edge by a strided 2x2x2 convolution."""

    def __init__(self, channels: int, out_channels: int) -> None:
        super().__init__()
        self.conv = nn.Conv3d(channels, out_channels, 2, stride=2)

    def forward(self, x: Tensor) -> Tensor:
        """(B, C, X, Y, Z) to (B, C', X/2, Y/2, Z/2)."""
        halved: Tensor = self.conv(x)
        return halved


class Upsample(nn.Module):
    """Twice the edge: a 3x3x3 convolution gives each cell its eight children, side by side in channels."""

    def __init__(self, channels: int, out_channels: int) -> None:
        super().__init__()
        self.conv = nn.Conv3d(channels, 8 * out_channels, 3, padding=1)

    def forward(self, x: Tensor) -> Tensor:
        """(B, C, X, Y, Z) to (B, C', 2X, 2Y, 2Z)."""
        return pixel_shuffle_3d(self.conv(x))


def pixel_shuffle_3d(x: Tensor) -> Tensor:
    """(B, 8C, X, Y, Z) to (B, C, 2X, 2Y, 2Z): channel 8c + 4i + 2j + k moves to the offset (i, j, k)."""
    b, c, X, Y, Z = x.shape
    children = x.reshape(b, c // 8, 2, 2, 2, X, Y, Z)
    return children.permute(0, 1, 5, 2, 6, 3, 7, 4).reshape(b, c // 8, 2 * X, 2 * Y, 2 * Z)
