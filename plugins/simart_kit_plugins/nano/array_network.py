"""What `NanoNetwork` computes, by NumPy alone: importing torch takes longer than all that it would compute.

`NanoNetwork` is what is trained, and tells why it is as it is; tests hold both to the same numbers.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from simart_kit.arrays import BoolArray, Float32Array, IntArray

from .array_layers import ArrayLayers, gelu, softmax
from .array_pair_layers import paired
from .array_pairs import pair_numbers
from .config import NanoConfig
from .evidence import WAY
from .reading import PairInputs, PartsRead, PiecesRead, Rows
from .ways import WAY_NUMBERS

# What a hidden piece is worth to attention, as in `NanoNetwork`.
_HIDDEN = np.float32(-1e4)


class ArrayNetwork:
    """See `PiecesRead` and `PartsRead` for what it says.

    Args:
        config: sizes.
        weights: float32, by their names in `NanoNetwork.state_dict()`.
    """

    def __init__(self, config: NanoConfig, weights: Mapping[str, Float32Array]) -> None:
        self.config = config
        self._layers = ArrayLayers(weights)

    def read(self, rows: Rows) -> PiecesRead[Float32Array]:
        """Read objects."""
        tokens = self._layers.perceptron("enter", np.concatenate([self._pooled(rows), rows.numbers], axis=2))
        biases, middle = self._biases(rows), tokens
        for number in range(self.config.layers):
            first = number * self.config.heads
            tokens = self._layer(f"layers.{number}", tokens, biases[:, first : first + self.config.heads])
            middle = tokens if number + 1 == self.config.layers // 2 else middle
        tokens = self._layers.norm("norm", tokens)
        alike = self._layers.linear("left", tokens) @ self._layers.linear("right", tokens).transpose(0, 2, 1)
        together = alike / np.float32(tokens.shape[2] ** 0.5) + biases[:, -1]
        seen = rows.there[..., None].astype(np.float32)
        whole = (tokens * seen).sum(axis=1) / np.maximum(seen.sum(axis=1), 1)
        return PiecesRead(
            tokens,
            together + together.transpose(0, 2, 1),
            self._layers.linear("moves", tokens)[..., 0],
            self._layers.linear("kind", tokens),
            self._layers.linear("label", tokens),
            self._layers.linear("category", whole),
            self._layers.linear("size", whole)[..., 0],
            middle,
        )

    def paired(self, given: PairInputs[Any]) -> Float32Array:
        """(B, S, S) logits of two pieces being of one part, after a look at all pairs."""
        return paired(self._layers, self.config.pair_layers, given)

    def parts(
        self,
        tokens: Float32Array,
        owner: IntArray,
        share: Float32Array,
        numbers: Float32Array,
        real: BoolArray,
    ) -> PartsRead[Float32Array]:
        """Read parts; arguments as of `NanoNetwork.parts`, of objects of which all pieces exist."""
        own = tokens[owner]
        mean = (share[:, None] @ own)[:, 0]
        highest = np.where((share > 0)[..., None], own, _HIDDEN).max(axis=1)
        embedding = self._layers.perceptron("part", np.concatenate([mean, highest, own.mean(axis=1)], axis=1))
        asked = self._layers.linear("asking", embedding)[:, None]
        candidate = self._layers.perceptron("candidate", numbers[..., : WAY.start]) + asked
        right = np.where(real, self._layers.linear("choice", gelu(candidate))[..., 0], np.float32(-np.inf))
        counts, near, reach = np.split(
            self._layers.perceptron("opening", embedding), [WAY_NUMBERS, WAY_NUMBERS + 1], axis=1
        )
        sense = (numbers[..., WAY] @ counts[..., None])[..., 0]
        return PartsRead(
            self._layers.linear("part_kind", embedding), right, sense, near[:, 0], reach, embedding
        )

    def carriers(self, child: Float32Array, parent: Float32Array) -> Float32Array:
        """(P, Q) logits of each of (Q, D) embeddings carrying each of (P, D)."""
        shape = (len(child), len(parent), child.shape[1])
        both = [np.broadcast_to(child[:, None], shape), np.broadcast_to(parent[None], shape)]
        return self._layers.perceptron("carrier", np.concatenate(both, axis=2))[..., 0]

    def _pooled(self, rows: Rows) -> Float32Array:
        """(B, S, 2 * point_channels) mean and maximum of what the points of each piece say; else 0."""
        features = self._layers.perceptron("points", rows.points)
        order = np.argsort(rows.owner, kind="stable")
        owner, features = rows.owner[order], features[order]
        starts = np.flatnonzero(np.diff(owner, prepend=-1))
        size = np.diff(starts, append=len(owner)).astype(np.float32)
        mean = np.add.reduceat(features, starts, axis=0) / size[:, None]
        pooled = np.zeros((rows.there.size, 2 * features.shape[1]), dtype=np.float32)
        pooled[owner[starts]] = np.concatenate([mean, np.maximum.reduceat(features, starts, axis=0)], axis=1)
        return pooled.reshape(*rows.there.shape, -1)

    def _biases(self, rows: Rows) -> Float32Array:
        """(B, layers * heads + 1, S, S): of every head of every layer, and whether two belong together."""
        count, pieces = rows.there.shape
        numbers = pair_numbers(rows.numbers, rows.gap)
        weight = self._layers.weights["biases.weight"][..., 0, 0]
        biases = (
            weight @ numbers.reshape(count, -1, pieces * pieces)
            + self._layers.weights["biases.bias"][:, None]
        )
        biases = biases.reshape(count, -1, pieces, pieces)
        biases[:, :-1] += np.where(rows.there, np.float32(0), _HIDDEN)[:, None, None]
        return biases

    def _layer(self, name: str, tokens: Float32Array, biases: Float32Array) -> Float32Array:
        """Attention that heeds (B, H, S, S) biases, and a perceptron; both residual."""
        count, pieces, width = tokens.shape
        asked = self._layers.linear(f"{name}.ask", self._layers.norm(f"{name}.before", tokens))
        query, key, value = asked.reshape(count, pieces, 3, self.config.heads, -1).transpose(2, 0, 3, 1, 4)
        query = query / np.float32(query.shape[3] ** 0.5)
        heard = softmax(query @ key.transpose(0, 1, 3, 2) + biases) @ value
        heard = heard.transpose(0, 2, 1, 3).reshape(count, pieces, width)
        tokens = tokens + self._layers.linear(f"{name}.answer", heard)
        return tokens + self._layers.perceptron(f"{name}.think", self._layers.norm(f"{name}.after", tokens))
