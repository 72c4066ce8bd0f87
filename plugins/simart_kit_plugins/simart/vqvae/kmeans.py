"""Nearest entries and Lloyd's k-means, in bounded memory and the same for one generator."""

from __future__ import annotations

import torch
from torch import Tensor

# Rows compared with all entries at once: 4096 x 8191 distances are 134 MB.
_ROWS = 4096
# Jitter of entries beyond the number of vectors, as a share of the vectors' spread: ties would never part.
_JITTER = 1e-2


def nearest(vectors: Tensor, entries: Tensor) -> Tensor:
    """(N, D) vectors and (K, D) entries to (N,) int64: the nearest entry, the first of equals."""
    return _nearest(vectors, entries)[0]


def kmeans(vectors: Tensor, clusters: int, generator: torch.Generator, iterations: int = 10) -> Tensor:
    """(N, D) float32 vectors to (clusters, D) centres by Lloyd's algorithm from random vectors.

    A cluster that loses all its vectors moves to one of the vectors farthest from their centres. With fewer
    vectors than clusters the rest are the same vectors, jittered.

    Args:
        vectors: at least one row.
        clusters: number of centres.
        generator: on the CPU, so that all devices draw alike.
        iterations: passes over the vectors.
    """
    centres = _starts(vectors, clusters, generator)
    for _ in range(iterations):
        rows, distances = _nearest(vectors, centres)
        counts, sums = tally(vectors, rows, clusters)
        centres = torch.where(counts[:, None] > 0, sums / counts[:, None].clamp(min=1), centres)
        empty = torch.nonzero(counts == 0)[:, 0][: len(vectors)]
        centres[empty] = vectors[torch.argsort(distances, descending=True, stable=True)[: len(empty)]]
    return centres


def tally(vectors: Tensor, rows: Tensor, entries: int) -> tuple[Tensor, Tensor]:
    """How often each entry was chosen, (K,) float32, and the sum of the vectors that chose it, (K, D)."""
    sums = vectors.new_zeros(entries, vectors.shape[1]).index_add_(0, rows, vectors)
    return torch.bincount(rows, minlength=entries).to(vectors.dtype), sums


def _starts(vectors: Tensor, clusters: int, generator: torch.Generator) -> Tensor:
    order = torch.randperm(len(vectors), generator=generator)[:clusters]
    missing = clusters - len(order)
    drawn = torch.randint(len(vectors), (missing,), generator=generator)
    noise = torch.randn(missing, vectors.shape[1], generator=generator).to(vectors)
    spread = vectors.std(dim=0, correction=0).clamp(min=torch.finfo(vectors.dtype).eps)
    repeated = vectors[drawn.to(vectors.device)] + _JITTER * spread * noise
    return torch.cat([vectors[order.to(vectors.device)], repeated])


def _nearest(vectors: Tensor, entries: Tensor) -> tuple[Tensor, Tensor]:
    """(N,) nearest entry and (N,) squared distance to it."""
    found = [_nearest_of_chunk(chunk, entries) for chunk in torch.split(vectors, _ROWS)]
    rows, scores = zip(*found, strict=True)
    return torch.cat(rows), torch.cat(scores) + vectors.square().sum(1)


def _nearest_of_chunk(vectors: Tensor, entries: Tensor) -> tuple[Tensor, Tensor]:
    scores = torch.addmm(entries.square().sum(1), vectors, entries.T, alpha=-2)
    least = scores.min(dim=1)
    return least.indices, least.values
