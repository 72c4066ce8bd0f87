"""How unlike the objects that it was trained on a network finds one, by where its tokens lie.

The Mahalanobis distance of Lee et al., "A simple unified framework for detecting out-of-distribution samples
and adversarial attacks" (2018), of two layers and without classes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from simart_kit.arrays import Float32Array, FloatArray

from .kinds import KindStatistics
from .voting import Said
from .whitening import whitening

# Tokens of an object, (V, S, D) as seen from V sides: half way through the layers, and after the last.
LAYERS = 2
Tokens: TypeAlias = tuple[Float32Array, Float32Array]


@dataclass(frozen=True, eq=False)
class TokenStatistics:
    """Where the tokens of objects lie that a network was trained on.

    Attributes:
        mean: (LAYERS, D).
        whitening: (LAYERS, D, D); (token - mean) @ whitening has unit variance in all directions.
        kinds: of the objects of each category, where these are known.
    """

    mean: Float32Array
    whitening: Float32Array
    kinds: KindStatistics | None = None

    def novelty(self, tokens: Tokens) -> float:
        """Mean squared Mahalanobis distance of its tokens, a channel: about 1 for what was trained on."""
        away = [(one - m) @ w for one, m, w in zip(tokens, self.mean, self.whitening, strict=True)]
        return float(np.mean([np.square(one).mean() for one in away]))


def tokens_of(said: Said) -> Tokens:
    """The tokens of the pieces that there are."""
    count = said.moves.shape[0]
    return said.middle[:, :count], said.tokens[:, :count]


@dataclass(frozen=True, eq=False)
class Moments:
    """Of the tokens of an object, over its pieces and the sides that it is seen from.

    Attributes:
        mean: (LAYERS, D).
        square: (LAYERS, D, D), the mean of their outer products.
    """

    mean: FloatArray
    square: FloatArray


def moments_of(tokens: Tokens) -> Moments:
    """The moments of an object's tokens."""
    each = [one.reshape(-1, one.shape[2]).astype(np.float64) for one in tokens]
    return Moments(
        np.stack([one.mean(axis=0) for one in each]), np.stack([one.T @ one / len(one) for one in each])
    )


def gathered(objects: Sequence[Moments]) -> TokenStatistics:
    """The statistics of some objects, at least one, of each alike however many pieces it has."""
    mean = np.mean([one.mean for one in objects], axis=0)
    square = np.mean([one.square for one in objects], axis=0)
    white = np.stack([whitening(one) for one in square - mean[:, :, None] * mean[:, None, :]])
    return TokenStatistics(mean.astype(np.float32), white.astype(np.float32))
