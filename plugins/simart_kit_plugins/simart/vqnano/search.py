"""Encoding by trial: of the codes near a block's features, those from which it comes back best.

The decoder looks at the cells around a cell, so that the nearest code is often not the best one. Codes are
tried in cells that lie apart, all of these at once, and kept where the cells around come back better.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import torch
from torch import Tensor
from torch.nn.functional import binary_cross_entropy_with_logits

from .blocks import neighbour_rows, places

if TYPE_CHECKING:
    from .model import VqNano

# Cells tried at once are so many cells apart. They then share cells around; three apart they would not,
# which finds codes that are no better, and takes three times as long.
_APART = 2
# How often each cell is tried: what is best for it depends on what was chosen around it.
_SWEEPS = 2
# What an unsure voxel costs beside a wrong one: it tells codes apart that get the same voxels right.
_UNSURE = 0.3


@dataclass(frozen=True, eq=False)
class Trial:
    """Decodes the K cells that get a token, and says how well each comes back.

    Attributes:
        model: its decoder and codebooks.
        truth: (K, n) bool voxels of the blocks.
        picked: (B, X, Y, Z) bool.
        rows: (K, 27) `neighbour_rows`.
    """

    model: VqNano
    truth: Tensor
    picked: Tensor
    rows: Tensor

    def logits(self, codes: Tensor) -> Tensor:
        """(K, n) what (K,) codes decode to."""
        quantiser = self.model.quantiser
        vectors = quantiser.entries_of(quantiser.on_grid(codes, self.picked), self.picked)
        decoded: Tensor = self.model.decoder(vectors, places(self.picked), self.rows, quantiser.zero_token)
        return decoded

    def wrong(self, logits: Tensor) -> Tensor:
        """(K,) number of wrong voxels of each cell."""
        return ((logits > 0) != self.truth).sum(1)

    def costs(self, codes: Tensor) -> Tensor:
        """(K,) how badly each cell comes back from (K,) codes; a cell without token costs nothing."""
        logits = self.logits(codes)
        unsure = binary_cross_entropy_with_logits(logits, self.truth.float(), reduction="none").sum(1)
        return self.wrong(logits) + _UNSURE * unsure

    def around(self, costs: Tensor) -> Tensor:
        """(K,) what the cells around each cell cost together, itself among them."""
        total: Tensor = torch.cat([costs, costs.new_zeros(1)])[self.rows].sum(1)
        return total


@torch.no_grad()
def best_codes(model: VqNano, truth: Tensor, features: Tensor, picked: Tensor) -> Tensor:
    """(K,) codes of (K, n) bool blocks with (K, D) features, in the cells that (B, X, Y, Z) marks."""
    candidates = model.quantiser.candidates(features, picked, model.config.candidates)
    codes = candidates[:, 0].clone()
    if candidates.shape[1] == 1 or not len(codes):
        return codes
    trial = Trial(model, truth, picked, neighbour_rows(picked))
    group = _groups(picked)
    for _ in range(_SWEEPS):
        codes = _swept(trial, codes, candidates, group)
    return codes


def _swept(trial: Trial, codes: Tensor, candidates: Tensor, group: Tensor) -> Tensor:
    """(K,) codes after each cell was tried once, where (K, C) candidates come back better than its own."""
    codes = codes.clone()
    # Cells that come back right, and those around them too, have nothing to gain.
    worth = trial.around(trial.wrong(trial.logits(codes))) > 0
    for number in range(_APART**3):
        members = torch.nonzero((group == number) & worth)[:, 0]
        if not len(members):
            continue
        least = trial.around(trial.costs(codes))[members]
        for choice in candidates.T:
            tried = codes.clone()
            tried[members] = choice[members]
            cost = trial.around(trial.costs(tried))[members]
            better = cost < least
            codes[members[better]] = choice[members[better]]
            least = torch.where(better, cost, least)
    return codes


def _groups(picked: Tensor) -> Tensor:
    """(K,) groups of the marked cells, such that those of one are `_APART` cells apart."""
    x, y, z = (torch.nonzero(picked)[:, 1:] % _APART).T
    group: Tensor = _APART * (_APART * x + y) + z
    return group
