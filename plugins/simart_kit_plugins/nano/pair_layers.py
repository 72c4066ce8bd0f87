"""Pairs of pieces look at each other in triangles: what belongs with the same third belongs together."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from .config import NanoConfig
from .pairs import mutual_numbers, pair_numbers, rivalry
from .reading import PAIR_WIDTH, PairInputs

# Surer than this is all one [logit].
_SURE = 12


class PairLayers(nn.Module):
    """What is said of pieces, said again after a look at all pairs of them.

    Whether two pieces belong together follows from their tokens alone before, one product of two vectors.
    Of things alike side by side, as drawers and keys are, that cannot tell whose a handle is: here what a
    pair says depends on what both say of every third (Jumper et al., "Highly accurate protein structure
    prediction with AlphaFold", 2021, supplement 1.6.5; as belonging together has no direction, one of the
    two ways round a triangle is enough).
    """

    def __init__(self, config: NanoConfig) -> None:
        super().__init__()
        width, own = config.channels, config.pair_channels
        self.product, self.difference = nn.Linear(width, own // 2), nn.Linear(width, own // 2)
        self.enter = _perceptron(2 * (own // 2) + PAIR_WIDTH, own)
        self.layers = nn.ModuleList(_Triangles(own) for _ in range(config.pair_layers))
        self.norm = nn.LayerNorm(own)
        self.together = nn.Linear(own, 1)
        # To begin with nothing is changed.
        nn.init.zeros_(self.together.weight)
        nn.init.zeros_(self.together.bias)

    def forward(self, given: PairInputs[Tensor]) -> Tensor:
        """(B, S, S) logits of two pieces being of one part, after a look at all pairs; symmetric."""
        pairs = self.enter(self._entering(given))
        for layer in self.layers:
            pairs = layer(pairs, given.there)
        together: Tensor = given.together + self.together(self.norm(pairs))[..., 0]
        return together

    def _entering(self, given: PairInputs[Tensor]) -> Tensor:
        """(B, S, S, K) what the layers are told of each pair; the order of the two does not matter."""
        product, difference = self.product(given.tokens), self.difference(given.tokens)
        chance, kinds = given.moves.sigmoid(), given.kind.softmax(2)
        lie = mutual_numbers(pair_numbers(given.own, given.gap))
        rivals = rivalry(given.own, given.gap, given.there)
        return torch.cat(
            [
                product[:, :, None] * product[:, None],
                (difference[:, :, None] - difference[:, None]).abs(),
                torch.cat([lie, rivals], dim=1).permute(0, 2, 3, 1),
                given.together.clamp(-_SURE, _SURE)[..., None] / 4,
                torch.minimum(chance[:, :, None], chance[:, None])[..., None],
                torch.maximum(chance[:, :, None], chance[:, None])[..., None],
                kinds[:, :, None] * kinds[:, None],
            ],
            dim=3,
        )


class _Triangles(nn.Module):
    """Each pair looks at all thirds that both have pairs with, and a perceptron; both residual."""

    def __init__(self, own: int) -> None:
        super().__init__()
        self.before, self.after = nn.LayerNorm(own), nn.LayerNorm(own)
        self.side, self.open = nn.Linear(own, own // 2), nn.Linear(own, own // 2)
        self.sum, self.answer = nn.LayerNorm(own // 2), nn.Linear(own // 2, own)
        self.heed = nn.Linear(own, own)
        self.think = _perceptron(own, own)
        nn.init.normal_(self.answer.weight, std=0.02)

    def forward(self, pairs: Tensor, there: Tensor) -> Tensor:
        """(B, S, S, C) pairs; (B, S) which pieces exist."""
        seen = self.before(pairs)
        side = self.side(seen) * self.open(seen).sigmoid() * there[:, None, :, None]
        side = side.permute(0, 3, 1, 2)
        triangles = (side @ side.transpose(2, 3)).permute(0, 2, 3, 1)
        pairs = pairs + self.answer(self.sum(triangles)) * self.heed(seen).sigmoid()
        result: Tensor = pairs + self.think(self.after(pairs))
        return result


def _perceptron(inner: int, own: int) -> nn.Sequential:
    return nn.Sequential(nn.Linear(inner, 2 * own), nn.GELU(), nn.Linear(2 * own, own))
