"""The codebooks: nearest entries for cells with geometry, one reserved vector for all others."""

from __future__ import annotations

from dataclasses import dataclass, replace

import torch
from torch import Tensor, nn

from simart_kit.errors import BadInputError

from .config import CodebookConfig
from .contexts import contexts
from .kmeans import kmeans, nearest, tally
from .losses import mean_squared

# The code of a cell without token where no code is reserved for it (mode force-sparse).
NO_TOKEN = -1
# An entry whose running count fell below this keeps its place: the quotient would be rounding only.
_LEAST_COUNT = 1e-6


@dataclass(frozen=True, eq=False)
class Quantised:
    """What the quantiser made of a batch.

    Attributes:
        vectors: (B, X, Y, Z, D) float32 for the decoder; gradients pass straight to the encoder's features.
        codes: (B, X, Y, Z) int64; in mode zero 0 is an empty cell, in mode force-sparse -1.
        codebook_loss: mean squared distance of chosen entries to the (fixed) features.
        commitment_loss: the same distance, of features to the (fixed) entries.
    """

    vectors: Tensor
    codes: Tensor
    codebook_loss: Tensor
    commitment_loss: Tensor


class Quantiser(nn.Module):
    """Codebook of `codebook_size` vectors: `zero_token` (mode zero only), then `entries`.

    Where the config has several codebooks, `entries` has one after the other, and `contexts` tells which one
    a cell's code is from.

    `entries` is a parameter, or with codebook_update "ema" a buffer that `update` moves. `zero_token` always
    is a parameter; only the decoder gives it a gradient.
    """

    entries: Tensor
    zero_token: nn.Parameter | None
    idle_steps: Tensor
    ema_count: Tensor
    ema_sum: Tensor

    def __init__(self, config: CodebookConfig) -> None:
        super().__init__()
        self.config = config
        self.first_code = config.first_code
        self.size = config.codebook_size - self.first_code
        spread, rows = 1 / config.codebook_size, self.first_code + config.codebooks * self.size
        codebook = torch.empty(rows, config.vector_length).uniform_(-spread, spread)
        zero_token, entries = codebook[: self.first_code], codebook[self.first_code :]
        reserved = nn.Parameter(zero_token[0].clone()) if self.first_code else None
        self.register_parameter("zero_token", reserved)
        if config.codebook_update == "loss":
            self.entries = nn.Parameter(entries.clone())
        else:
            self.register_buffer("entries", entries.clone())
            self.register_buffer("ema_count", torch.ones(len(entries)))
            self.register_buffer("ema_sum", entries.clone())
        self.register_buffer("idle_steps", torch.zeros(len(entries), dtype=torch.int64))

    def forward(self, features: Tensor, occupied: Tensor) -> Quantised:
        """Quantise (B, X, Y, Z, D) features where the (B, X, Y, Z) bool mask (and the mode) say so.

        Losses are means over the quantised cells, and 0 where there are none.
        """
        picked = torch.ones_like(occupied) if self.config.mode == "dense" else occupied
        found = self.quantise(features[picked], picked)
        vectors = self._empty(picked).index_put((picked,), found.vectors)
        return replace(found, vectors=vectors, codes=self.on_grid(found.codes, picked))

    def quantise(self, found: Tensor, picked: Tensor) -> Quantised:
        """As `forward`, of the (K, D) features of the cells that (B, X, Y, Z) marks: K vectors, K codes."""
        found, books = found.float(), contexts(picked, self.config.codebooks)
        rows = torch.zeros(len(found), dtype=torch.int64, device=found.device)
        with torch.autocast(found.device.type, enabled=False):  # distances need float32
            for book, own in _by_book(books):
                rows[own] = nearest(found[own].detach(), self._book(self.entries.detach(), book))
        chosen = self.entries[rows + books * self.size]
        codebook_loss = mean_squared(chosen, found.detach())
        if self.config.codebook_update == "ema":
            codebook_loss = torch.zeros_like(codebook_loss)
        # In this order the sum is exactly the entry, so that decoding the codes gives the same logits.
        vectors = chosen.detach() + (found - found.detach())
        codes = rows + self.first_code
        return Quantised(vectors, codes, codebook_loss, mean_squared(found, chosen.detach()))

    def on_grid(self, codes: Tensor, picked: Tensor) -> Tensor:
        """(K,) codes of the K cells that (B, X, Y, Z) marks, to (B, X, Y, Z) with 0 or -1 elsewhere."""
        grid = torch.full(picked.shape, self.first_code - 1, dtype=torch.int64, device=picked.device)
        grid[picked] = codes
        return grid

    def lookup(self, codes: Tensor) -> Tensor:
        """(B, X, Y, Z) codes to (B, X, Y, Z, D) vectors; raises BadInputError as `entries_of` does."""
        picked = codes >= self.first_code
        return self._empty(picked).index_put((picked,), self.entries_of(codes, picked))

    def entries_of(self, codes: Tensor, picked: Tensor) -> Tensor:
        """(K, D) entries of (B, X, Y, Z) codes, at the K cells that (B, X, Y, Z) marks.

        Raises:
            BadInputError: a code is not in the codebook.
        """
        lowest = NO_TOKEN if self.config.mode == "force-sparse" else 0
        wrong = codes[(codes < lowest) | (codes >= self.config.codebook_size)]
        if len(wrong):
            raise BadInputError(
                f"code {wrong[0].item()} is not in the codebook: "
                f"this model's codes are {lowest}..{self.config.codebook_size - 1}"
            )
        return self.entries[self._rows(codes, picked)]

    @torch.no_grad()
    def initialise(self, vectors: Tensor, books: Tensor, generator: torch.Generator) -> None:
        """Set the entries to k-means centres of (N, D) encoder features of (N,) codebooks, N > 0.

        Each codebook starts from the centres of all features together: so a code tends to mean something
        alike in all of them.
        """
        shared = kmeans(vectors.float(), self.size, generator)
        self.entries.copy_(shared.repeat(self.config.codebooks, 1))
        for book, own in _by_book(books) if self.config.codebooks > 1 else ():
            centres = kmeans(vectors[own].float(), self.size, generator, start=shared)
            self._book(self.entries, book).copy_(centres)
        self.idle_steps.zero_()
        if self.config.codebook_update == "ema":
            self.ema_count.fill_(1)
            self.ema_sum.copy_(self.entries)

    @torch.no_grad()
    def update(self, features: Tensor, codes: Tensor, generator: torch.Generator) -> int:
        """What a training step does to the codebook besides its gradient: running mean, then revival.

        An entry unused in `revive_after` steps in a row becomes a random feature of this batch, each feature
        at most once; entries left over wait for the next step.

        Args:
            features: (B, X, Y, Z, D) what the encoder gave, or (K, D) in the cells with a token alone.
            codes: (B, X, Y, Z) what `forward` made of it.
            generator: on the CPU, so that all devices draw alike.

        Returns:
            Number of entries revived.
        """
        picked = codes >= self.first_code
        found = (features if features.ndim == 2 else features[picked]).float()
        counts, sums = tally(found, self._rows(codes, picked), len(self.entries))
        if self.config.codebook_update == "ema":
            self._move_entries(counts, sums)
        self.idle_steps.add_(1).masked_fill_(counts > 0, 0)
        return self._revive(found, picked, generator) if self.config.revive_after else 0

    def candidates(self, found: Tensor, picked: Tensor, count: int) -> Tensor:
        """(K, count) codes of the entries nearest to (K, D) features, the nearest first; or all, if fewer."""
        rows = torch.zeros(len(found), min(count, self.size), dtype=torch.int64, device=found.device)
        for book, own in _by_book(contexts(picked, self.config.codebooks)):
            distances = torch.cdist(found[own].float(), self._book(self.entries, book))
            rows[own] = distances.topk(rows.shape[1], largest=False).indices
        return rows + self.first_code

    def _rows(self, codes: Tensor, picked: Tensor) -> Tensor:
        """(K,) rows of `entries` for (B, X, Y, Z) codes, at the K cells that (B, X, Y, Z) marks."""
        return codes[picked] - self.first_code + self.size * contexts(picked, self.config.codebooks)

    def _book(self, values: Tensor, book: int) -> Tensor:
        """The part of a tensor by entry that belongs to one codebook."""
        return values[book * self.size : (book + 1) * self.size]

    def _empty(self, picked: Tensor) -> Tensor:
        """(B, X, Y, Z, D) vectors as if no cell had geometry."""
        shape = (*picked.shape, self.config.vector_length)
        if self.zero_token is None:
            return torch.zeros(shape, device=self.entries.device)
        return self.zero_token.expand(shape)

    def _move_entries(self, counts: Tensor, sums: Tensor) -> None:
        self.ema_count.lerp_(counts, 1 - self.config.ema_decay)
        self.ema_sum.lerp_(sums, 1 - self.config.ema_decay)
        known = (self.ema_count > _LEAST_COUNT)[:, None]
        means = self.ema_sum / self.ema_count.clamp(min=_LEAST_COUNT)[:, None]
        self.entries.copy_(torch.where(known, means, self.entries))

    def _revive(self, found: Tensor, picked: Tensor, generator: torch.Generator) -> int:
        idle = self.idle_steps >= self.config.revive_after
        revived = 0
        for book, own in _by_book(contexts(picked, self.config.codebooks)):
            dead = torch.nonzero(self._book(idle, book))[:, 0][: len(own)] + book * self.size
            drawn = own[torch.randperm(len(own), generator=generator)[: len(dead)].to(found.device)]
            self.entries[dead] = found[drawn]
            self.idle_steps[dead] = 0
            if self.config.codebook_update == "ema":
                self.ema_count[dead] = 1
                self.ema_sum[dead] = found[drawn]
            revived += len(dead)
        return revived


def _by_book(books: Tensor) -> list[tuple[int, Tensor]]:
    """Each codebook of (K,) with the rows that are its own, those without any left out."""
    return [(book, torch.nonzero(books == book)[:, 0]) for book in torch.unique(books).tolist()]
