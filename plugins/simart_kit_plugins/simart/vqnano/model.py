"""The small voxel model: the interface of `SparseVQVAE` at a hundredth of its cost."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn.functional import binary_cross_entropy_with_logits

from ..vqvae.cells import require_cells, require_grid
from ..vqvae.losses import Losses, weighted
from ..vqvae.model import Encoded
from ..vqvae.quantiser import Quantiser
from .blocks import block_view, grid_of_blocks, neighbour_rows, places
from .config import VqNanoConfig
from .halves import BlockDecoder, BlockEncoder
from .search import best_codes

# Logit of voxels in cells without a token.
_OFF = -30.0


@dataclass(frozen=True, eq=False)
class BlockOutput:
    """What a training step needs: see `Output`.

    Attributes:
        block_logits: (K, n) of the cells with a token.
        picked: (B, X, Y, Z) bool, those cells.
        codes: (B, X, Y, Z) int64.
        occupied: (B, X, Y, Z) bool.
        features: (K, D) the encoder's vectors, detached.
        losses: each term, and their weighted sum.
    """

    block_logits: Tensor
    picked: Tensor
    codes: Tensor
    occupied: Tensor
    features: Tensor
    losses: Losses

    @property
    def logits(self) -> Tensor:
        """(B, 1, R, R, R), made when asked for: few steps are logged."""
        edge = round((self.block_logits.shape[1] * self.picked[0].numel()) ** (1 / 3))
        return grid_of_blocks(self.block_logits, self.picked, edge, _OFF)


class VqNano(nn.Module):
    """Encoder, quantiser and decoder over the blocks that have geometry; see `SparseVQVAE` for the terms.

    A block of 4x8x8 voxels (8x8x8 in that grid) is a token. Its principal components are quantised; networks
    on both sides see the blocks around it. Nothing is computed for empty blocks, and nothing decoded in them.
    """

    def __init__(self, config: VqNanoConfig, seed: int = 0) -> None:
        super().__init__()
        self.config = config
        with torch.random.fork_rng(devices=[]):  # the caller's random numbers go on as if nothing was drawn
            torch.default_generator.manual_seed(seed)
            self.encoder = BlockEncoder(config)
            self.quantiser = Quantiser(config)
            self.decoder = BlockDecoder(config)

    def forward(self, occupancy: Tensor) -> BlockOutput:
        """Encode, quantise and decode (B, 1, R, R, R) voxels (0 or 1, any type), with the losses."""
        blocks, occupied, picked = self._blocks(occupancy)
        truth = blocks[picked].float()
        features = self.encoder(truth, places(picked), neighbour_rows(picked))
        quantised = self.quantiser.quantise(features, picked)
        logits = self._decode(quantised.vectors, picked)
        reconstruction = binary_cross_entropy_with_logits(logits, truth)
        dice = _dice(logits.sigmoid(), truth, torch.nonzero(picked)[:, 0], len(picked))
        terms = weighted(
            reconstruction, dice, quantised.codebook_loss, quantised.commitment_loss, self.config
        )
        codes = self.quantiser.on_grid(quantised.codes, picked)
        return BlockOutput(logits.detach(), picked, codes, occupied, features.detach(), terms)

    @torch.no_grad()
    def encode(self, occupancy: Tensor) -> Encoded:
        """Codes of (B, 1, R, R, R) voxels (0 or 1, any type).

        Raises:
            BadInputError: the grid is of another shape.
        """
        blocks, occupied, picked = self._blocks(occupancy)
        truth = blocks[picked]
        features = self.encoder(truth.float(), places(picked), neighbour_rows(picked))
        codes = best_codes(self, truth, features, picked)
        return Encoded(self.quantiser.on_grid(codes, picked), occupied)

    @torch.no_grad()
    def decode(self, codes: Tensor, occupied: Tensor | None = None) -> Tensor:
        """Logits (B, 1, R, R, R) of (B, X, Y, Z) codes.

        Args:
            codes: as `encode` gives them.
            occupied: (B, X, Y, Z) bool; if given, voxels outside these cells get the logit -inf. Voxels of
                cells without a token are off in any case.

        Raises:
            BadInputError: the codes are of another shape, or a code is not in the codebook.
        """
        require_cells("codes", codes, self.config)
        picked = codes >= self.config.first_code
        logits = self._decode(self.quantiser.entries_of(codes, picked), picked)
        if occupied is None:
            return grid_of_blocks(logits, picked, self.config.resolution, _OFF)
        require_cells("occupied cells", occupied, self.config)
        seen = picked & occupied
        return grid_of_blocks(logits[occupied[picked]], seen, self.config.resolution, -torch.inf)

    def features(self, occupancy: Tensor) -> tuple[Tensor, Tensor]:
        """(B, X, Y, Z, D) unquantised vectors of (B, 1, R, R, R) voxels, and the (B, X, Y, Z) occupied cells.

        Raises:
            BadInputError: the grid is of another shape.
        """
        blocks, occupied, picked = self._blocks(occupancy)
        vectors = self.encoder(blocks[picked].float(), places(picked), neighbour_rows(picked))
        features = vectors.new_zeros(*picked.shape, self.config.vector_length)
        return features.index_put((picked,), vectors), occupied

    def first_stage_parameters(self) -> list[nn.Parameter]:
        """What stage 1 trains: all but the encoder, whose principal components the codebook starts from."""
        return [*self.quantiser.parameters(), *self.decoder.parameters()]

    def _blocks(self, occupancy: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """(B, X, Y, Z, n) bool blocks of (B, 1, R, R, R) voxels; which are occupied, which get a token."""
        require_grid(occupancy, self.config)
        blocks = block_view(occupancy > 0, self.config.cells).flatten(4)
        occupied = blocks.any(-1)
        return blocks, occupied, torch.ones_like(occupied) if self.config.mode == "dense" else occupied

    def _decode(self, vectors: Tensor, picked: Tensor) -> Tensor:
        """(K, n) logits of the K cells that (B, X, Y, Z) marks, from their (K, D) vectors."""
        empty = self.quantiser.zero_token
        logits: Tensor = self.decoder(vectors, places(picked), neighbour_rows(picked), empty)
        return logits


def _dice(chance: Tensor, truth: Tensor, grid: Tensor, count: int) -> Tensor:
    """1 - dice overlap, mean over `count` grids, of (K, n) blocks that belong to the (K,) grids."""
    zeros = chance.new_zeros(count)
    overlap = zeros.index_add(0, grid, (chance * truth).sum(1))
    total = zeros.index_add(0, grid, chance.sum(1) + truth.sum(1))
    return (1 - (2 * overlap + 1) / (total + 1)).mean()
