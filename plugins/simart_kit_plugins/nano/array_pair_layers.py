"""What `PairLayers` computes, by NumPy alone; it tells why it is as it is."""

from __future__ import annotations

from typing import Any

import numpy as np

from simart_kit.arrays import BoolArray, Float32Array, IntArray

from .array_layers import ArrayLayers, sigmoid, softmax
from .array_pairs import mutual_numbers, pair_numbers, rivalry
from .reading import PairInputs

_SURE = np.float32(12)


def paired(layers: ArrayLayers, count: int, given: PairInputs[Any]) -> Float32Array:
    """(B, S, S) logits of two pieces being of one part, after a look at all pairs; symmetric.

    Args:
        layers: of the network; names of these begin with "pairs.".
        count: of its pair layers.
        given: what they are given.
    """
    row, column = np.triu_indices(given.there.shape[1])
    pairs = layers.perceptron("pairs.enter", _entering(layers, given)[:, row, column])
    for number in range(count):
        pairs = _triangles(layers, f"pairs.layers.{number}", pairs, given.there)
    told = layers.linear("pairs.together", layers.norm("pairs.norm", pairs))[..., 0]
    return np.asarray(given.together + told[:, _place(given.there.shape[1])])


def _entering(layers: ArrayLayers, given: PairInputs[Any]) -> Float32Array:
    product, difference = (layers.linear(f"pairs.{name}", given.tokens) for name in ("product", "difference"))
    chance, kinds = sigmoid(given.moves), softmax(given.kind)
    lie = mutual_numbers(pair_numbers(given.own, given.gap))
    rivals = rivalry(given.own, given.gap, given.there)
    return np.concatenate(
        [
            product[:, :, None] * product[:, None],
            np.abs(difference[:, :, None] - difference[:, None]),
            np.concatenate([lie, rivals], axis=1).transpose(0, 2, 3, 1),
            np.clip(given.together, -_SURE, _SURE)[..., None] / 4,
            np.minimum(chance[:, :, None], chance[:, None])[..., None],
            np.maximum(chance[:, :, None], chance[:, None])[..., None],
            kinds[:, :, None] * kinds[:, None],
        ],
        axis=3,
    )


def _triangles(layers: ArrayLayers, name: str, pairs: Float32Array, there: BoolArray) -> Float32Array:
    """(B, P, C) pairs, each in one of its two orders: half of all that would be computed."""
    row, column = np.triu_indices(there.shape[1])
    seen = layers.norm(f"{name}.before", pairs)
    side = layers.linear(f"{name}.side", seen) * sigmoid(layers.linear(f"{name}.open", seen))
    whole = side[:, _place(there.shape[1])] * there[:, None, :, None]
    whole = whole.transpose(0, 3, 1, 2)
    triangles = (whole @ whole.transpose(0, 1, 3, 2)).transpose(0, 2, 3, 1)[:, row, column]
    answer = layers.linear(f"{name}.answer", layers.norm(f"{name}.sum", triangles))
    pairs = pairs + answer * sigmoid(layers.linear(f"{name}.heed", seen))
    return pairs + layers.perceptron(f"{name}.think", layers.norm(f"{name}.after", pairs))


def _place(count: int) -> IntArray:
    """(S, S) where each pair of pieces, in either order, is among those of `np.triu_indices`."""
    row, column = np.triu_indices(count)
    place = np.zeros((count, count), dtype=np.int64)
    place[row, column] = place[column, row] = np.arange(len(row))
    return place
