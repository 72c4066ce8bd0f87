"""The network: pieces of a surface look at each other, and say what belongs together and how it moves."""

from __future__ import annotations

from dataclasses import dataclass, fields

import torch
from torch import Tensor, nn
from torch.nn.functional import gelu, scaled_dot_product_attention

from .config import NanoConfig
from .evidence import COUNT
from .scene import PIECE_NUMBERS
from .truth import KINDS

POINT_NUMBERS = 3 + 3 + 6 + 3
PAIR_NUMBERS = 7
_SMALL = 0.02


@dataclass(frozen=True, eq=False)
class Batch:
    """Objects side by side, padded to the most pieces.

    Attributes:
        points: (N, POINT_NUMBERS) of all objects.
        owner: (N,) row of `numbers`, flattened to B * S, that each point is of.
        numbers: (B, S, PIECE_NUMBERS).
        pairs: (B, S, S, PAIR_NUMBERS).
        there: (B, S) bool, which pieces exist.
    """

    points: Tensor
    owner: Tensor
    numbers: Tensor
    pairs: Tensor
    there: Tensor

    def to(self, device: torch.device | str) -> Batch:
        """On another device."""
        return Batch(*(getattr(self, field.name).to(device) for field in fields(self)))


@dataclass(frozen=True, eq=False)
class Reading:
    """What the network makes of the pieces.

    Attributes:
        tokens: (B, S, D).
        together: (B, S, S) logits of two pieces being of one part; symmetric.
        moves: (B, S) logit of the piece being of a moving part.
        kind: (B, S, 5) logits of how its part moves, by `KINDS`.
        label: (B, S, L) logits of what its part is called.
        category: (B, C) logits of what the object is.
        size: (B,) natural logarithm of its longest side [m].
    """

    tokens: Tensor
    together: Tensor
    moves: Tensor
    kind: Tensor
    label: Tensor
    category: Tensor
    size: Tensor


@dataclass(frozen=True, eq=False)
class PartReading:
    """What the network makes of parts.

    Attributes:
        kind: (P, 5) logits, by `KINDS`.
        right: (P, C) logits of the candidates; -inf where there is none.
        travel: (P, C, 2) limits about each candidate: turns [pi rad], slides [sides of the object].
        embedding: (P, D).
    """

    kind: Tensor
    right: Tensor
    travel: Tensor
    embedding: Tensor


class NanoNetwork(nn.Module):
    """See `Reading` and `PartReading` for what it says."""

    def __init__(self, config: NanoConfig, seed: int = 0) -> None:
        super().__init__()
        self.config = config
        width, pair = config.channels, config.pair_channels
        with torch.random.fork_rng(devices=[]):
            torch.default_generator.manual_seed(seed)
            self.points = _perceptron(POINT_NUMBERS, config.point_channels, config.point_channels)
            self.enter = _perceptron(2 * config.point_channels + PIECE_NUMBERS, config.hidden, width)
            self.pairs = _perceptron(PAIR_NUMBERS, pair, pair)
            self.layers = nn.ModuleList(_Layer(config) for _ in range(config.layers))
            self.norm = nn.LayerNorm(width)
            self.left, self.right = nn.Linear(width, width), nn.Linear(width, width)
            self.near = nn.Linear(pair, 1)
            self.moves = nn.Linear(width, 1)
            self.kind = nn.Linear(width, len(KINDS))
            self.label = nn.Linear(width, len(config.labels) + 1)
            self.category = nn.Linear(width, len(config.categories) + 1)
            self.size = nn.Linear(width, 1)
            self.part = _perceptron(3 * width, config.hidden, width)
            self.part_kind = nn.Linear(width, len(KINDS))
            self.candidate = _perceptron(COUNT, width, width)
            self.choice = _perceptron(2 * width, config.hidden // 2, 3)
            self.carrier = _perceptron(2 * width, config.hidden // 2, 1)

    def forward(self, batch: Batch) -> Reading:
        """Read objects."""
        count, most = batch.there.shape
        features = self.points(batch.points)
        index = batch.owner[:, None].expand_as(features)
        empty = features.new_zeros(count * most, features.shape[1])
        means = empty.scatter_reduce(0, index, features, "mean", include_self=False)
        highest = empty.scatter_reduce(0, index, features, "amax", include_self=False)
        pooled = torch.cat([means, highest], dim=1).reshape(count, most, -1)
        tokens = self.enter(torch.cat([pooled, batch.numbers], dim=2))
        pairs = gelu(self.pairs(batch.pairs))
        hidden = (~batch.there)[:, None, None, :]
        for layer in self.layers:
            tokens = layer(tokens, pairs, hidden)
        tokens = self.norm(tokens)
        alike = self.left(tokens) @ self.right(tokens).transpose(1, 2) / tokens.shape[2] ** 0.5
        together = alike + self.near(pairs)[..., 0]
        together = together + together.transpose(1, 2)
        seen = batch.there[..., None].to(tokens.dtype)
        whole = (tokens * seen).sum(1) / seen.sum(1).clamp(min=1)
        return Reading(
            tokens,
            together,
            self.moves(tokens)[..., 0],
            self.kind(tokens),
            self.label(tokens),
            self.category(whole),
            self.size(whole)[..., 0],
        )

    def parts(
        self, tokens: Tensor, owner: Tensor, share: Tensor, numbers: Tensor, real: Tensor
    ) -> PartReading:
        """Read parts.

        Args:
            tokens: (B, S, D) of the objects.
            owner: (P,) object of each part.
            share: (P, S) how much of the part each piece is; rows sum to 1.
            numbers: (P, C, COUNT) evidence of its candidates.
            real: (P, C) bool, which candidates exist.
        """
        own = tokens[owner]
        inside = share > 0
        mean = torch.einsum("ps,psd->pd", share, own)
        highest = own.masked_fill(~inside[..., None], -1e4).amax(1)
        whole = own.mean(1)
        embedding = self.part(torch.cat([mean, highest, whole], dim=1))
        shown = torch.cat(
            [embedding[:, None].expand(-1, numbers.shape[1], -1), self.candidate(numbers)], dim=2
        )
        said = self.choice(shown)
        right = said[..., 0].masked_fill(~real, -torch.inf)
        return PartReading(self.part_kind(embedding), right, said[..., 1:], embedding)

    def carriers(self, child: Tensor, parent: Tensor) -> Tensor:
        """(P, Q) logits of each of (Q, D) embeddings carrying each of (P, D)."""
        both = torch.cat(
            [child[:, None].expand(-1, len(parent), -1), parent[None].expand(len(child), -1, -1)], dim=2
        )
        logits: Tensor = self.carrier(both)[..., 0]
        return logits


class _Layer(nn.Module):
    """Attention that heeds how pieces lie to each other, and a perceptron; both residual."""

    def __init__(self, config: NanoConfig) -> None:
        super().__init__()
        width = config.channels
        self.heads = config.heads
        self.before, self.after = nn.LayerNorm(width), nn.LayerNorm(width)
        self.ask, self.answer = nn.Linear(width, 3 * width), nn.Linear(width, width)
        self.bias = nn.Linear(config.pair_channels, config.heads)
        self.think = _perceptron(width, config.hidden, width)
        nn.init.normal_(self.answer.weight, std=_SMALL)

    def forward(self, tokens: Tensor, pairs: Tensor, hidden: Tensor) -> Tensor:
        count, most, width = tokens.shape
        split = self.ask(self.before(tokens)).reshape(count, most, 3, self.heads, -1)
        query, key, value = split.permute(2, 0, 3, 1, 4)
        bias = self.bias(pairs).permute(0, 3, 1, 2).masked_fill(hidden, -torch.inf)
        heard = scaled_dot_product_attention(query, key, value, attn_mask=bias.to(query.dtype))
        tokens = tokens + self.answer(heard.transpose(1, 2).reshape(count, most, width))
        result: Tensor = tokens + self.think(self.after(tokens))
        return result


def _perceptron(inner: int, hidden: int, outer: int) -> nn.Sequential:
    return nn.Sequential(nn.Linear(inner, hidden), nn.GELU(), nn.Linear(hidden, outer))
