"""The sparse 3D VQ-VAE: voxels to codes, codes to voxels, and both at once for training."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn

from .cells import occupied_cells, require_cells, require_grid, voxels_of_cells
from .config import VqvaeConfig
from .decoder import Decoder
from .encoder import Encoder
from .losses import Losses, losses
from .quantiser import Quantiser
from .space_to_depth import depth_to_space, space_to_depth


@dataclass(frozen=True, eq=False)
class Encoded:
    """A batch of grids as codes.

    Attributes:
        codes: (B, X, Y, Z) int64. Cells without geometry are 0 in mode zero (and no other cell is), -1 in
            mode force-sparse, and have a code as all others in mode dense.
        occupied: (B, X, Y, Z) bool, cells with at least one voxel on.
    """

    codes: Tensor
    occupied: Tensor


@dataclass(frozen=True, eq=False)
class Output:
    """What a training step needs.

    Attributes:
        logits: (B, 1, R, R, R); a voxel is on where its logit is above 0.
        codes: (B, X, Y, Z) int64, as in `Encoded`.
        occupied: (B, X, Y, Z) bool.
        features: (B, X, Y, Z, D) the encoder's vectors, detached; see `Quantiser.update`.
        losses: each term, and their weighted sum.
    """

    logits: Tensor
    codes: Tensor
    occupied: Tensor
    features: Tensor
    losses: Losses


class SparseVQVAE(nn.Module):
    """Encoder, quantiser and decoder of one config; the same seed gives the same initial weights.

    Source: SIMART, section "Sparse 3D VQ-VAE".
    """

    def __init__(self, config: VqvaeConfig, seed: int = 0) -> None:
        super().__init__()
        self.config = config
        with torch.random.fork_rng(devices=[]):  # the caller's random numbers go on as if nothing was drawn
            torch.default_generator.manual_seed(seed)
            self.encoder = Encoder(config)
            self.quantiser = Quantiser(config)
            self.decoder = Decoder(config)

    def forward(self, occupancy: Tensor) -> Output:
        """Encode, quantise and decode (B, 1, R, R, R) voxels (0 or 1, any type), with the losses.

        Changes nothing. After the optimiser's step, `quantiser.update(output.features, output.codes, ...)`
        moves running means and revives entries.
        """
        features, occupied = self.features(occupancy)
        quantised = self.quantiser(features, occupied)
        logits = self.decode_features(quantised.vectors)
        terms = losses(logits, occupancy, quantised.codebook_loss, quantised.commitment_loss, self.config)
        return Output(logits, quantised.codes, occupied, features.detach(), terms)

    @torch.no_grad()
    def encode(self, occupancy: Tensor) -> Encoded:
        """Codes of (B, 1, R, R, R) voxels (0 or 1, any type).

        Raises:
            BadInputError: the grid is of another shape.
        """
        features, occupied = self.features(occupancy)
        return Encoded(self.quantiser(features, occupied).codes, occupied)

    @torch.no_grad()
    def decode(self, codes: Tensor, occupied: Tensor | None = None) -> Tensor:
        """Logits (B, 1, R, R, R) of (B, X, Y, Z) codes.

        Args:
            codes: as `encode` gives them.
            occupied: (B, X, Y, Z) bool; if given, voxels outside these cells get the logit -inf, so that no
                geometry leaks into cells without a token.

        Raises:
            BadInputError: the codes are of another shape, or a code is not in the codebook.
        """
        require_cells("codes", codes, self.config)
        logits = self.decode_features(self.quantiser.lookup(codes))
        if occupied is None:
            return logits
        require_cells("occupied cells", occupied, self.config)
        return logits.masked_fill(~voxels_of_cells(occupied, self.config), -torch.inf)

    def features(self, occupancy: Tensor) -> tuple[Tensor, Tensor]:
        """(B, X, Y, Z, D) unquantised vectors of (B, 1, R, R, R) voxels, and the (B, X, Y, Z) occupied cells.

        Raises:
            BadInputError: the grid is of another shape.
        """
        require_grid(occupancy, self.config)
        latent = self.encoder(occupancy.to(self.encoder.input_layer.weight.dtype))
        features = space_to_depth(latent, self.config.cells, self.config.layout)
        return features, occupied_cells(occupancy, self.config)

    def first_stage_parameters(self) -> list[nn.Parameter]:
        """What stage 1 trains: what TRELLIS' weights lack, that is the codebook, and what meets it first."""
        return [*self.quantiser.parameters(), *self.decoder.input_layer.parameters()]

    def decode_features(self, vectors: Tensor) -> Tensor:
        """Logits (B, 1, R, R, R) of (B, X, Y, Z, D) vectors, quantised or not."""
        latent = depth_to_space(vectors, self.config.latent_edge, self.config.layout)
        logits: Tensor = self.decoder(latent)
        return logits
