"""Smoothing over a mesh: values at its vertices spread to their neighbours, but hardly past a crease."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..arrays import BoolArray, Float32Array, IntArray

if TYPE_CHECKING:
    from scipy.sparse import csr_array

# Weight of what a vertex on a crease says: it belongs to both sides, so neither learns much from it.
CREASE_WEIGHT = 0.1


def smoothed(
    values: Float32Array, brought: Float32Array, weights: csr_array, iterations: int
) -> Float32Array:
    """(V, K) values after each vertex moved half-way to the mean that it hears, several times.

    Args:
        values: (V, K) at the vertices.
        brought: (B, K) further values, which stay.
        weights: (V, V + B), such as of `hearing`; vertices with an empty row stay as well.
        iterations: how often.
    """
    heard = np.concatenate([values, brought])
    moving = heard[: len(values)]
    # What hears nothing adds nothing, and is not halved.
    share = np.where(np.diff(weights.indptr) > 0, np.float32(0.5), np.float32(1))[:, None]
    for _ in range(iterations):
        moving += weights @ heard
        moving *= share
    return moving


def hearing(
    ends: tuple[IntArray, IntArray, IntArray], listens: BoolArray, creased: BoolArray, bringing: IntArray
) -> csr_array:
    """(V, V + B) row-stochastic weights of what each vertex hears from its neighbours.

    An edge counts once for each of its faces. Pieces that share no vertex do not hear each other.

    Args:
        ends: (E,) lower and higher vertex of each edge, and how many faces have it.
        listens: (V,) vertices that hear at all.
        creased: (V,) vertices on creases, which are heard little.
        bringing: (B, 3) corners of faces that bring values of their own, which these hear like a vertex.
    """
    from scipy.sparse import csr_array

    count = len(listens)
    low, high, shared = ends
    loudness = np.where(creased, CREASE_WEIGHT, 1.0)
    brought = count + np.repeat(np.arange(len(bringing)), 3)
    # In this order the rows come out sorted.
    listener = np.concatenate([high, low, bringing.ravel()])
    teller = np.concatenate([low, high, brought])
    loud = np.concatenate([loudness.take(low) * shared, loudness.take(high) * shared, np.ones(len(brought))])
    used = np.flatnonzero(listens.take(listener) & (listener != teller))
    listener, loud = listener.take(used), loud.take(used)
    loud /= np.bincount(listener, loud, count).take(listener)
    links = (listener.astype(np.int32), teller.take(used).astype(np.int32))
    return csr_array((loud.astype(np.float32), links), shape=(count, count + len(bringing)))
