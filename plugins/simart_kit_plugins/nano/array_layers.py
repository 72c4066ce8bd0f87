"""Layers of a network, by NumPy alone: what its modules compute, from weights by their names."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from simart_kit.arrays import Float32Array

_EPSILON = np.float32(1e-5)
_HALF, _ROOT = np.float32(0.5), np.float32(0.5**0.5)


class ArrayLayers:
    """The layers of a network.

    Args:
        weights: float32, by their names in its `state_dict()`.
    """

    def __init__(self, weights: Mapping[str, Float32Array]) -> None:
        self.weights = weights

    def perceptron(self, name: str, values: Float32Array) -> Float32Array:
        """Two linear layers with GELU between."""
        return self.linear(f"{name}.2", gelu(self.linear(f"{name}.0", values)))

    def linear(self, name: str, values: Float32Array) -> Float32Array:
        """(..., K) to (..., M)."""
        weight, bias = self.weights[f"{name}.weight"], self.weights[f"{name}.bias"]
        # One product of two matrices is quicker than many of smaller ones.
        flat = values.reshape(-1, values.shape[-1]) @ weight.T
        flat += bias
        return flat.reshape(*values.shape[:-1], len(weight))

    def norm(self, name: str, values: Float32Array) -> Float32Array:
        """Layer norm along the last axis."""
        away = values - values.mean(axis=-1, keepdims=True)
        spread = np.sqrt((away * away).mean(axis=-1, keepdims=True) + _EPSILON)
        return np.asarray(away / spread * self.weights[f"{name}.weight"] + self.weights[f"{name}.bias"])


def sigmoid(logits: Float32Array) -> Float32Array:
    """Chances of logits of any shape; large ones overflow nowhere."""
    lower = np.exp(-np.abs(logits))
    return np.asarray(np.where(logits >= 0, np.float32(1), lower) / (1 + lower))


def softmax(logits: Float32Array) -> Float32Array:
    """Chances along the last axis, the highest of which is finite."""
    chances = np.exp(logits - logits.max(axis=-1, keepdims=True))
    chances /= chances.sum(axis=-1, keepdims=True)
    return np.asarray(chances)


def gelu(values: Float32Array) -> Float32Array:
    """The exact one, by the error function."""
    from scipy.special import erf

    return np.asarray(_HALF * values * (1 + erf(values * _ROOT)), dtype=np.float32)
