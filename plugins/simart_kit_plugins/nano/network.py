"""The network: pieces of a surface look at each other, and say what belongs together and how it moves."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TypeAlias

import torch
from torch import Tensor, nn
from torch.nn.functional import gelu

from .config import NanoConfig
from .evidence import WAY
from .pair_layers import PairLayers
from .pairs import pair_numbers
from .reading import POINT_NUMBERS, PairInputs, PartsRead, PiecesRead
from .scene import PAIR_NUMBERS, PIECE_NUMBERS
from .truth import KINDS
from .ways import WAY_NUMBERS

_SMALL = 0.02
Reading: TypeAlias = PiecesRead[Tensor]
PartReading: TypeAlias = PartsRead[Tensor]
# Of so many parts in training, one has its joint chosen by the candidates' evidence alone.
_BLIND = 4


@dataclass(frozen=True, eq=False)
class Batch:
    """Objects side by side, padded to the most pieces.

    Attributes:
        points: (N, POINT_NUMBERS) of all objects.
        owner: (N,) row of `numbers`, flattened to B * S, that each point is of.
        numbers: (B, S, PIECE_NUMBERS).
        gap: (B, S, S) least distance of two pieces [sides of the object].
        there: (B, S) bool, which pieces exist.
    """

    points: Tensor
    owner: Tensor
    numbers: Tensor
    gap: Tensor
    there: Tensor

    def to(self, device: torch.device | str) -> Batch:
        """On another device."""
        return Batch(*(getattr(self, field.name).to(device) for field in fields(self)))


class NanoNetwork(nn.Module):
    """See `Reading` and `PartReading` for what it says."""

    def __init__(self, config: NanoConfig, seed: int = 0) -> None:
        super().__init__()
        self.config = config
        width = config.channels
        with torch.random.fork_rng(devices=[]):
            torch.default_generator.manual_seed(seed)
            self.points = _perceptron(POINT_NUMBERS, config.point_channels, config.point_channels)
            self.enter = _perceptron(2 * config.point_channels + PIECE_NUMBERS, config.hidden, width)
            # A bias of every head of every layer, and one of the answer whether two pieces belong together.
            self.biases = nn.Conv2d(PAIR_NUMBERS, config.layers * config.heads + 1, 1)
            self.layers = nn.ModuleList(_Layer(config) for _ in range(config.layers))
            self.norm = nn.LayerNorm(width)
            self.left, self.right = nn.Linear(width, width), nn.Linear(width, width)
            self.moves = nn.Linear(width, 1)
            self.kind = nn.Linear(width, len(KINDS))
            self.label = nn.Linear(width, len(config.labels) + 1)
            self.category = nn.Linear(width, len(config.categories) + 1)
            self.size = nn.Linear(width, 1)
            self.part = _perceptron(3 * width, config.hidden, width)
            self.part_kind = nn.Linear(width, len(KINDS))
            # Parts have a hundred candidates: what is done for each has to be little.
            self.candidate = _perceptron(WAY.start, config.choice_channels, config.choice_channels)
            self.asking = nn.Linear(width, config.choice_channels)
            self.choice = nn.Linear(config.choice_channels, 1)
            # What each way counts for the sense in which it opens, and how far it goes: see `PartsRead`.
            self.opening = _perceptron(width, config.choice_channels, WAY_NUMBERS + 3)
            self.carrier = _perceptron(2 * width, config.hidden // 2, 1)
            self.pairs = PairLayers(config)

    def forward(self, batch: Batch) -> Reading:
        """Read objects."""
        pooled = self._pooled(batch)
        tokens = self.enter(torch.cat([pooled, batch.numbers], dim=2))
        biases = self.biases(pair_numbers(batch.numbers, batch.gap))
        hidden = (~batch.there)[:, None, None, :]
        *of_layers, near = biases.split([self.config.heads] * self.config.layers + [1], dim=1)
        middle = tokens
        for number, (layer, bias) in enumerate(zip(self.layers, of_layers, strict=True), start=1):
            tokens = layer(tokens, bias, hidden)
            middle = tokens if number == self.config.layers // 2 else middle
        tokens = self.norm(tokens)
        alike = self.left(tokens) @ self.right(tokens).transpose(1, 2) / tokens.shape[2] ** 0.5
        together = alike + near[:, 0]
        together = together + together.transpose(1, 2)
        whole = _whole(tokens, batch.there)
        return Reading(
            tokens,
            together,
            self.moves(tokens)[..., 0],
            self.kind(tokens),
            self.label(tokens),
            self.category(whole),
            self.size(whole)[..., 0],
            middle,
        )

    def paired(self, batch: Batch, read: Reading, rows: Tensor, most: int) -> Tensor:
        """(R, S, S) logits of two pieces being of one part, after a look at all pairs of some objects.

        What was read before learns nothing by it.

        Args:
            batch: with the objects.
            read: what was said of it.
            rows: of the batch; (B,) bool, or (R,) numbers.
            most: pieces of these at most; what comes after is left out.
        """
        with _plain(read.tokens):
            together: Tensor = self.pairs(
                PairInputs(
                    read.tokens[rows, :most].detach().float(),
                    read.together[rows, :most, :most].detach().float(),
                    read.moves[rows, :most].detach().float(),
                    read.kind[rows, :most].detach().float(),
                    batch.numbers[rows, :most],
                    batch.gap[rows, :most, :most],
                    batch.there[rows, :most],
                )
            )
        return together

    def _pooled(self, batch: Batch) -> Tensor:
        """(B, S, 2 * point_channels) mean and maximum of what the points of each piece say."""
        with _plain(batch.points):
            features = self.points(batch.points)
        sizes = torch.bincount(batch.owner, minlength=batch.there.numel())
        order = torch.argsort(batch.owner, stable=True)
        rows = features[order]
        pooled = torch.cat([torch.segment_reduce(rows, how, lengths=sizes) for how in ("mean", "max")], dim=1)
        # Where there is no piece, nothing is the mean of no points.
        return pooled.masked_fill(sizes[:, None] == 0, 0).reshape(*batch.there.shape, -1)

    def parts(
        self, tokens: Tensor, there: Tensor, owner: Tensor, share: Tensor, numbers: Tensor, real: Tensor
    ) -> PartReading:
        """Read parts.

        Args:
            tokens: (B, S, D) of the objects.
            there: (B, S) bool, which pieces exist.
            owner: (P,) object of each part.
            share: (P, S) how much of the part each piece is; rows sum to 1.
            numbers: (P, C, COUNT) evidence of its candidates.
            real: (P, C) bool, which candidates exist.
        """
        own = tokens[owner]
        inside = share > 0
        mean = torch.einsum("ps,psd->pd", share, own)
        highest = own.masked_fill(~inside[..., None], -1e4).amax(1)
        whole = _whole(tokens, there)[owner]
        embedding = self.part(torch.cat([mean, highest, whole], dim=1))
        seen = embedding
        if self.training:
            told = torch.arange(len(embedding), device=embedding.device) % _BLIND > 0
            seen = embedding * told[:, None]
        with _plain(numbers):
            candidate = self.candidate(numbers[..., : WAY.start]) + self.asking(seen.float())[:, None]
            right = self.choice(gelu(candidate))[..., 0].masked_fill(~real, -torch.inf)
            counts, near, reach = self.opening(embedding.float()).split([WAY_NUMBERS, 1, 2], dim=1)
            sense = (numbers[..., WAY] @ counts[..., None])[..., 0]
        return PartReading(self.part_kind(embedding), right, sense, near[:, 0], reach, embedding)

    def carriers(self, child: Tensor, parent: Tensor) -> Tensor:
        """(P, Q) logits of each of (Q, D) embeddings carrying each of (P, D)."""
        both = torch.cat(
            [child[:, None].expand(-1, len(parent), -1), parent[None].expand(len(child), -1, -1)], dim=2
        )
        logits: Tensor = self.carrier(both)[..., 0]
        return logits


def _whole(tokens: Tensor, there: Tensor) -> Tensor:
    """(B, D) means of (B, S, D) tokens, of the pieces that exist."""
    seen = there[..., None].to(tokens.dtype)
    return (tokens * seen).sum(1) / seen.sum(1).clamp(min=1)


class _Layer(nn.Module):
    """Attention that heeds how pieces lie to each other, and a perceptron; both residual."""

    def __init__(self, config: NanoConfig) -> None:
        super().__init__()
        width = config.channels
        self.heads = config.heads
        self.before, self.after = nn.LayerNorm(width), nn.LayerNorm(width)
        self.ask, self.answer = nn.Linear(width, 3 * width), nn.Linear(width, width)
        self.think = _perceptron(width, config.hidden, width)
        nn.init.normal_(self.answer.weight, std=_SMALL)

    def forward(self, tokens: Tensor, biases: Tensor, hidden: Tensor) -> Tensor:
        """(B, S, D) tokens; (B, H, S, S) biases; (B, 1, 1, S) True where there is no piece."""
        count, most, width = tokens.shape
        split = self.ask(self.before(tokens)).reshape(count, most, 3, self.heads, -1)
        query, key, value = split.permute(2, 0, 3, 1, 4)
        # torch's own attention has no fast path for biases that learn; its slow one takes longer than this.
        heeded = query @ key.transpose(2, 3) / query.shape[3] ** 0.5 + biases
        shares = heeded.masked_fill(hidden, -1e4).softmax(3).to(value.dtype)
        heard = shares @ value
        tokens = tokens + self.answer(heard.transpose(1, 2).reshape(count, most, width))
        result: Tensor = tokens + self.think(self.after(tokens))
        return result


def _plain(tensor: Tensor) -> torch.autocast:
    """Single precision, where rows are of ever new numbers: half would be prepared anew for each."""
    return torch.autocast(tensor.device.type, enabled=False)


def _perceptron(inner: int, hidden: int, outer: int) -> nn.Sequential:
    return nn.Sequential(nn.Linear(inner, hidden), nn.GELU(), nn.Linear(hidden, outer))
