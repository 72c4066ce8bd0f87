"""What defines a `VqNano`: a strict JSON table, from which every size of the network follows."""

from __future__ import annotations

import math
from typing import Literal, Self

from pydantic import Field, model_validator

from ..vqvae.config import Cells, CodebookConfig


class VqNanoConfig(CodebookConfig):
    """Sizes, representation and loss of a `VqNano`; the defaults are those of the shipped weights."""

    grid: str = Field(
        default="16x8x8",
        pattern=r"^[1-9][0-9]*x[1-9][0-9]*x[1-9][0-9]*$",
        description="Tokens along x, y and z: blocks of voxels.",
    )
    codebook_size: int = Field(default=8192, ge=2, description="Codes, with the reserved one of mode zero.")
    codebook_update: Literal["loss", "ema"] = Field(
        default="ema", description="Entries follow a gradient, or the running mean of what they stand for."
    )
    contexts: Literal[1, 8] = Field(
        default=8, description="Codebooks: one, or one for each way that the cells beside a cell may be."
    )
    candidates: int = Field(
        default=16, ge=1, description="Codes that encoding tries for a cell; 1 is the nearest, untried."
    )
    beta: float = Field(default=2.5, ge=0, description="Weight of the commitment loss.")
    dice_weight: float = Field(default=0.25, ge=0, description="Weight of the dice loss beside the BCE.")
    token_channels: int = Field(default=64, gt=0, description="Length of a token's vector.")
    channels: int = Field(default=128, gt=0, description="Channels of a block between layers.")
    neighbour_channels: int = Field(
        default=24, gt=0, description="Channels that a block shows its neighbours."
    )
    hidden_channels: int = Field(default=256, gt=0, description="Channels inside the perceptrons.")
    encoder_layers: int = Field(default=2, ge=0, description="Layers before the codebook.")
    decoder_layers: int = Field(default=4, ge=0, description="Layers after the codebook.")

    @model_validator(mode="after")
    def _check_grid(self) -> Self:
        if any(self.resolution % cells for cells in self.cells):
            raise ValueError(f"grid {self.grid} does not divide {self.resolution} voxels an edge")
        if self.token_channels > self.block_voxels:
            raise ValueError(
                f"token_channels {self.token_channels} is more than the {self.block_voxels} voxels of a block"
            )
        return self

    @property
    def vector_length(self) -> int:
        """Length of a token's vector."""
        return self.token_channels

    @property
    def codebooks(self) -> int:
        """As many as there are contexts."""
        return self.contexts

    @property
    def block(self) -> Cells:
        """Voxels of a block along x, y and z."""
        x, y, z = self.cells
        return self.resolution // x, self.resolution // y, self.resolution // z

    @property
    def block_voxels(self) -> int:
        """Voxels of a block."""
        return math.prod(self.block)
