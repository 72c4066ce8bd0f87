"""Nearest entries and Lloyd's k-means, in bounded memory and the same for one generator."""

from __future__ import annotations

import torch
from torch import Tensor

# Rows compared with all entries at once: their distances fit a processor's cache, or fill a GPU.
_ROWS = {"cpu": 512, "cuda": 1 << 15}
# Jitter of entries beyond the number of vectors, as a share of the vectors' spread: ties would never part.
_JITTER = 1e-2


def nearest(vectors: Tensor, entries: Tensor) -> Tensor:
    """(N, D) vectors and (K, D) entries to (N,) int64: the nearest entry, the first of equals."""
    return _nearest(vectors, entries)[0]


def kmeans(
    vectors: Tensor,
    clusters: int,
    generator: torch.Generator,
    iterations: int = 10,
    start: Tensor | None = None,
) -> Tensor:
    """(N, D) float32 vectors to (clusters, D) centres by Lloyd's algorithm from random vectors.

    A cluster that loses all its vectors moves to one of the vectors farthest from their centres. With fewer
    vectors than clusters the rest are the same vectors, jittered.

    Args:
        vectors: at least one row.
        clusters: number of centres.
        generator: on the CPU, so that all devices draw alike.
        iterations: passes over the vectors.
        start: (clusters, D) centres to begin with, instead of random vectors.
    """
    centres = _starts(vectors, clusters, generator) if start is None else start
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
    # |v - e|^2 - |v|^2 as one product: (v, 1) . (-2 e, |e|^2).
    ones, squares = vectors.new_ones(len(vectors), 1), entries.square().sum(1, keepdim=True)
    left, right = torch.cat([vectors, ones], dim=1), torch.cat([-2 * entries, squares], dim=1).T
    size = _ROWS[vectors.device.type]
    # One buffer for all: fresh memory costs more than the product.
    buffer = vectors.new_empty(min(size, len(vectors)), len(entries))
    found = [_nearest_of_chunk(chunk, right, buffer) for chunk in torch.split(left, size)]
    rows, scores = zip(*found, strict=True)
    return torch.cat(rows), torch.cat(scores) + vectors.square().sum(1)


def _nearest_of_chunk(vectors: Tensor, entries: Tensor, buffer: Tensor) -> tuple[Tensor, Tensor]:
    scores = torch.mm(vectors, entries, out=buffer[: len(vectors)])
    rows = _least(scores)
    return rows, scores.gather(1, rows[:, None])[:, 0]


def _least(scores: Tensor) -> Tensor:
    """(N,) column of the least score of (N, K), the first of equals; numpy's search takes half the time."""
    if scores.device.type == "cpu":
        return torch.from_numpy(scores.numpy().argmin(axis=1))
    return scores.argmin(dim=1)
