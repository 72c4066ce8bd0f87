"""How unlike the objects that it was trained on a network finds one, by where its tokens lie.

The Mahalanobis distance of Lee et al., "A simple unified framework for detecting out-of-distribution samples
and adversarial attacks" (2018), of two layers and without classes.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from simart_kit.arrays import Float32Array, FloatArray

from .array_network import ArrayNetwork
from .cloud import Cloud
from .kinds import KindStatistics
from .voting import Said, say
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


def gathered(network: ArrayNetwork, clouds: Iterable[Cloud]) -> TokenStatistics:
    """The statistics of some objects, of each alike however many pieces it has.

    Args:
        network: that reads them.
        clouds: at least one.
    """
    firsts, seconds = list[FloatArray](), list[FloatArray]()
    for cloud in clouds:
        each = [one.reshape(-1, one.shape[2]).astype(np.float64) for one in tokens_of(say(network, cloud))]
        firsts.append(np.stack([one.mean(axis=0) for one in each]))
        seconds.append(np.stack([one.T @ one / len(one) for one in each]))
    mean = np.mean(firsts, axis=0)
    covariance = np.mean(seconds, axis=0) - mean[:, :, None] * mean[:, None, :]
    white = np.stack([whitening(one) for one in covariance])
    return TokenStatistics(mean.astype(np.float32), white.astype(np.float32))
