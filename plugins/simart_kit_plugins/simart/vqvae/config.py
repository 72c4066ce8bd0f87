"""What defines a sparse VQ-VAE: a strict JSON table, from which every size of the network follows."""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from ...tables import Table

Mode = Literal["zero", "force-sparse", "dense"]
Layout = Literal["spatial", "flat-view"]
Cells = tuple[int, int, int]
_Count = Annotated[int, Field(gt=0)]


class CodebookConfig(Table):
    """What all voxel models have in common: the token grid, the codebook and the weights of the losses."""

    resolution: int = Field(default=64, gt=0, description="Voxels along an edge of the cubic input grid.")
    grid: str = Field(
        default="8x8x8",
        pattern=r"^[1-9][0-9]*x[1-9][0-9]*x[1-9][0-9]*$",
        description="Tokens along x, y and z, such as 8x8x8 or 16x8x8.",
    )
    mode: Mode = Field(
        default="zero",
        description="Empty cells become code 0 (zero), are filled with zeros (force-sparse), "
        "or are quantised as all others (dense).",
    )
    codebook_size: int = Field(default=4096, ge=2, description="Codes, with the reserved one of mode zero.")
    codebook_update: Literal["loss", "ema"] = Field(
        default="loss", description="Entries follow a gradient, or the running mean of what they stand for."
    )
    ema_decay: float = Field(default=0.999, gt=0, lt=1, description="Share of the running mean kept a step.")
    revive_after: int = Field(
        default=200, ge=0, description="Steps without use after which an entry is replaced; 0 is never."
    )
    beta: float = Field(default=0.25, ge=0, description="Weight of the commitment loss.")
    dice_weight: float = Field(default=0.0, ge=0, description="Weight of the dice loss beside the BCE.")

    @property
    def cells(self) -> Cells:
        """Tokens along x, y and z."""
        x, y, z = map(int, self.grid.split("x"))
        return x, y, z

    @property
    @abstractmethod
    def vector_length(self) -> int:
        """Length D of a token's vector."""

    @property
    def codebooks(self) -> int:
        """Number of codebooks; a cell's surroundings say which is its own."""
        return 1

    @property
    def first_code(self) -> int:
        """The lowest code that stands for geometry: 1 where code 0 is reserved for emptiness."""
        return 1 if self.mode == "zero" else 0


class VqvaeConfig(CodebookConfig):
    """Sizes, representation and loss of a `SparseVQVAE`; the defaults are the paper's full-size model.

    Source: SIMART, section "Sparse 3D VQ-VAE" and its appendix; the torso is TRELLIS' sparse-structure VAE.
    """

    channels: tuple[_Count, ...] = Field(
        default=(32, 128, 512), min_length=1, description="Channels of each level; each halves the edge."
    )
    blocks_per_level: int = Field(default=2, ge=0, description="Residual blocks of each level.")
    middle_blocks: int = Field(default=2, ge=0, description="Residual blocks at the coarsest level.")
    latent_channels: int = Field(default=8, gt=0, description="Channels of the latent grid.")
    layout: Layout = Field(
        default="spatial",
        description="Latent cells of a token: spatial neighbours, or a run of memory as in foreign models.",
    )

    @model_validator(mode="after")
    def _check_sizes(self) -> Self:
        if self.resolution % self.voxels_per_latent_cell:
            raise ValueError(
                f"resolution {self.resolution} cannot be halved {len(self.channels) - 1} times, "
                f"once between each of the {len(self.channels)} levels"
            )
        if any(self.latent_edge % cells for cells in self.cells):
            raise ValueError(f"grid {self.grid} does not divide the {self.latent_edge}^3 latent cells")
        return self

    @property
    def voxels_per_latent_cell(self) -> int:
        """Voxels along an edge of a latent cell."""
        return 1 << (len(self.channels) - 1)

    @property
    def latent_edge(self) -> int:
        """Latent cells along an edge of the cube; 16 at full size."""
        return self.resolution // self.voxels_per_latent_cell

    @property
    def vector_length(self) -> int:
        """Length of a token's vector; 64 for 8x8x8 and 32 for 16x8x8 at full size."""
        return self.latent_channels * self.latent_edge**3 // math.prod(self.cells)
