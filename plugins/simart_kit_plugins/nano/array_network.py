"""What `NanoNetwork` computes, by NumPy alone: importing torch takes longer than all that it would compute.

`NanoNetwork` is what is trained, and tells why it is as it is; tests hold both to the same numbers.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from simart_kit.arrays import BoolArray, Float32Array, IntArray

from .array_pairs import pair_numbers
from .config import NanoConfig
from .evidence import WAY
from .reading import PartsRead, PiecesRead, Rows
from .ways import WAY_NUMBERS

# What a hidden piece is worth to attention, as in `NanoNetwork`.
_HIDDEN = np.float32(-1e4)
_EPSILON = np.float32(1e-5)
_HALF, _ROOT = np.float32(0.5), np.float32(0.5**0.5)


class ArrayNetwork:
    """See `PiecesRead` and `PartsRead` for what it says.

    Args:
        config: sizes.
        weights: float32, by their names in `NanoNetwork.state_dict()`.
    """

    def __init__(self, config: NanoConfig, weights: Mapping[str, Float32Array]) -> None:
        self.config = config
        self._weights = weights

    def read(self, rows: Rows) -> PiecesRead[Float32Array]:
        """Read objects."""
        tokens = self._perceptron("enter", np.concatenate([self._pooled(rows), rows.numbers], axis=2))
        biases, middle = self._biases(rows), tokens
        for number in range(self.config.layers):
            first = number * self.config.heads
            tokens = self._layer(f"layers.{number}", tokens, biases[:, first : first + self.config.heads])
            middle = tokens if number + 1 == self.config.layers // 2 else middle
        tokens = self._norm("norm", tokens)
        alike = self._linear("left", tokens) @ self._linear("right", tokens).transpose(0, 2, 1)
        together = alike / np.float32(tokens.shape[2] ** 0.5) + biases[:, -1]
        seen = rows.there[..., None].astype(np.float32)
        whole = (tokens * seen).sum(axis=1) / np.maximum(seen.sum(axis=1), 1)
        return PiecesRead(
            tokens,
            together + together.transpose(0, 2, 1),
            self._linear("moves", tokens)[..., 0],
            self._linear("kind", tokens),
            self._linear("label", tokens),
            self._linear("category", whole),
            self._linear("size", whole)[..., 0],
            middle,
        )

    def parts(
        self,
        tokens: Float32Array,
        owner: IntArray,
        share: Float32Array,
        numbers: Float32Array,
        real: BoolArray,
    ) -> PartsRead[Float32Array]:
        """Read parts; arguments as of `NanoNetwork.parts`."""
        own = tokens[owner]
        mean = (share[:, None] @ own)[:, 0]
        highest = np.where((share > 0)[..., None], own, _HIDDEN).max(axis=1)
        embedding = self._perceptron("part", np.concatenate([mean, highest, own.mean(axis=1)], axis=1))
        asked = self._linear("asking", embedding)[:, None]
        candidate = self._perceptron("candidate", numbers[..., : WAY.start]) + asked
        right = np.where(real, self._linear("choice", _gelu(candidate))[..., 0], np.float32(-np.inf))
        counts, near, reach = np.split(
            self._perceptron("opening", embedding), [WAY_NUMBERS, WAY_NUMBERS + 1], axis=1
        )
        sense = (numbers[..., WAY] @ counts[..., None])[..., 0]
        return PartsRead(self._linear("part_kind", embedding), right, sense, near[:, 0], reach, embedding)

    def carriers(self, child: Float32Array, parent: Float32Array) -> Float32Array:
        """(P, Q) logits of each of (Q, D) embeddings carrying each of (P, D)."""
        shape = (len(child), len(parent), child.shape[1])
        both = [np.broadcast_to(child[:, None], shape), np.broadcast_to(parent[None], shape)]
        return self._perceptron("carrier", np.concatenate(both, axis=2))[..., 0]

    def _pooled(self, rows: Rows) -> Float32Array:
        """(B, S, 2 * point_channels) mean and maximum of what the points of each piece say; else 0."""
        features = self._perceptron("points", rows.points)
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
        weight = self._weights["biases.weight"][..., 0, 0]
        biases = weight @ numbers.reshape(count, -1, pieces * pieces) + self._weights["biases.bias"][:, None]
        biases = biases.reshape(count, -1, pieces, pieces)
        biases[:, :-1] += np.where(rows.there, np.float32(0), _HIDDEN)[:, None, None]
        return biases

    def _layer(self, name: str, tokens: Float32Array, biases: Float32Array) -> Float32Array:
        """Attention that heeds (B, H, S, S) biases, and a perceptron; both residual."""
        count, pieces, width = tokens.shape
        asked = self._linear(f"{name}.ask", self._norm(f"{name}.before", tokens))
        query, key, value = asked.reshape(count, pieces, 3, self.config.heads, -1).transpose(2, 0, 3, 1, 4)
        query = query / np.float32(query.shape[3] ** 0.5)
        heard = softmax(query @ key.transpose(0, 1, 3, 2) + biases) @ value
        heard = heard.transpose(0, 2, 1, 3).reshape(count, pieces, width)
        tokens = tokens + self._linear(f"{name}.answer", heard)
        return tokens + self._perceptron(f"{name}.think", self._norm(f"{name}.after", tokens))

    def _perceptron(self, name: str, values: Float32Array) -> Float32Array:
        return self._linear(f"{name}.2", _gelu(self._linear(f"{name}.0", values)))

    def _linear(self, name: str, values: Float32Array) -> Float32Array:
        weight, bias = self._weights[f"{name}.weight"], self._weights[f"{name}.bias"]
        # One product of two matrices is quicker than many of smaller ones.
        flat = values.reshape(-1, values.shape[-1]) @ weight.T
        flat += bias
        return flat.reshape(*values.shape[:-1], len(weight))

    def _norm(self, name: str, values: Float32Array) -> Float32Array:
        away = values - values.mean(axis=-1, keepdims=True)
        spread = np.sqrt((away * away).mean(axis=-1, keepdims=True) + _EPSILON)
        return np.asarray(away / spread * self._weights[f"{name}.weight"] + self._weights[f"{name}.bias"])


def sigmoid(logits: Float32Array) -> Float32Array:
    """Chances of logits of any shape; large ones overflow nowhere."""
    lower = np.exp(-np.abs(logits))
    return np.asarray(np.where(logits >= 0, np.float32(1), lower) / (1 + lower))


def softmax(logits: Float32Array) -> Float32Array:
    """Chances along the last axis, the highest of which is finite."""
    chances = np.exp(logits - logits.max(axis=-1, keepdims=True))
    chances /= chances.sum(axis=-1, keepdims=True)
    return np.asarray(chances)


def _gelu(values: Float32Array) -> Float32Array:
    from scipy.special import erf

    return np.asarray(_HALF * values * (1 + erf(values * _ROOT)), dtype=np.float32)
