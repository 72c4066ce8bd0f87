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
    listens = np.diff(weights.indptr)[:, None] > 0
    for _ in range(iterations):
        mean = weights @ np.concatenate([values, brought])
        values = np.where(listens, (values + mean) / 2, values)
    return values


def hearing(faces: IntArray, listens: BoolArray, creased: BoolArray, bringing: IntArray) -> csr_array:
    """(V, V + B) row-stochastic weights of what each vertex hears from its neighbours.

    An edge counts once for each of its faces. Pieces that share no vertex do not hear each other.

    Args:
        faces: (F, 3) vertex ids.
        listens: (V,) vertices that hear at all.
        creased: (V,) vertices on creases, which are heard little.
        bringing: (B,) faces that bring values of their own, which their corners hear like a vertex.
    """
    from scipy.sparse import csr_array

    count = len(listens)
    ahead, back = faces[:, [1, 2, 0]].ravel(), faces.ravel()
    listener = np.concatenate([back, ahead, faces[bringing].ravel()])
    brought = count + np.repeat(np.arange(len(bringing)), 3)
    teller = np.concatenate([ahead, back, brought.astype(faces.dtype)])
    loudness = np.concatenate([np.where(creased, CREASE_WEIGHT, 1.0), np.ones(len(bringing))])
    used = np.flatnonzero(listens[listener] & (listener != teller))
    listener, teller = listener[used], teller[used]
    heard = loudness[teller]
    share = (heard / np.bincount(listener, heard, count)[listener]).astype(np.float32)
    return csr_array((share, (listener, teller)), shape=(count, count + len(bringing)))
