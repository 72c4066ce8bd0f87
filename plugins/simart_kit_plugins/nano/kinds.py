"""How unlike the objects of its kind an object is, by where its tokens lie half way through the layers.

The Mahalanobis distance of Lee et al. (2018), see `novelty`, with a mean for each class and one covariance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import Float32Array, FloatArray

from .whitening import whitening

if TYPE_CHECKING:
    from .novelty import Tokens

# Where the mean of a kind is of which no object was seen: so far off that nothing is like it.
_NOWHERE = 1e4


@dataclass(frozen=True, eq=False)
class KindStatistics:
    """Where objects lie of each kind that a network was trained on.

    Attributes:
        means: (C, D) of each category of the network.
        whitening: (D, D); (object - mean of its kind) @ whitening has unit variance in all directions.
    """

    means: Float32Array
    whitening: Float32Array

    def unlikeness(self, tokens: Tokens, kind: int) -> float:
        """Mean squared Mahalanobis distance from its kind, a channel: about 1 for an object of it."""
        away = (place_of(tokens) - self.means[kind]) @ self.whitening
        return float(np.square(away).mean())


def kinds_of(objects: Sequence[tuple[int, FloatArray]], count: int) -> KindStatistics:
    """The statistics of some objects.

    Args:
        objects: kind, 0..count - 1, and place of each; at least one.
        count: of kinds.
    """
    kind, place = np.array([k for k, _ in objects]), np.stack([p for _, p in objects])
    means = np.full((count, place.shape[1]), _NOWHERE)
    away = list[FloatArray]()
    for number in range(count):
        own = place[kind == number]
        if len(own):
            means[number] = own.mean(axis=0)
            # From the mean of few objects these are nearer than from that of all there could be.
            away.append((own - means[number]) * np.sqrt(len(own) / max(len(own) - 1, 1)))
    apart = np.concatenate(away)
    if not apart.any():  # one object a kind tells nothing of how its like differ
        apart = place - place.mean(axis=0)
    spread = whitening(apart.T @ apart / len(apart))
    return KindStatistics(means.astype(np.float32), spread.astype(np.float32))


def place_of(tokens: Tokens) -> FloatArray:
    """(D,) where an object lies: the mean of its tokens half way, over all pieces and sides."""
    middle = tokens[0]
    return np.asarray(middle.reshape(-1, middle.shape[2]).mean(axis=0, dtype=np.float64))
