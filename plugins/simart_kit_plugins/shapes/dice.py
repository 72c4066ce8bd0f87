"""Random choices of one object, drawn in blocks: single draws of numpy take ten times as long."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from typing import TypeVar

import numpy as np

from simart_kit.arrays import FloatArray

T = TypeVar("T")
_BLOCK = 512


class Dice:
    """Numbers that depend on the seed and the order of the calls only.

    Args:
        seed: entropy of `numpy.random.default_rng`.
    """

    def __init__(self, seed: int | Sequence[int]) -> None:
        self._generator = np.random.default_rng(seed)
        self._left: list[float] = []

    def unit(self) -> float:
        """Uniform in 0..1."""
        if not self._left:
            self._left = self._generator.random(_BLOCK).tolist()
        return self._left.pop()

    def between(self, low: float, high: float) -> float:
        """Uniform in a range."""
        return low + (high - low) * self.unit()

    def spread(self, low: float, high: float) -> float:
        """Log-uniform in a range of positive numbers: each size is as likely as its double."""
        return float(low * (high / low) ** self.unit())

    def whole(self, low: int, high: int) -> int:
        """One of low..high, both included."""
        return low + int(self.unit() * (high - low + 1))

    def chance(self, share: float) -> bool:
        """True in this share of calls."""
        return self.unit() < share

    def sign(self) -> int:
        """-1 or 1."""
        return -1 if self.unit() < 0.5 else 1

    def pick(self, options: Sequence[T]) -> T:
        """One of the options, all as likely."""
        return options[int(self.unit() * len(options))]

    def weighted(self, options: Sequence[tuple[float, T]]) -> T:
        """One of the (weight, option) pairs, as likely as its weight says."""
        sums = list(accumulate(weight for weight, _ in options))
        point = self.unit() * sums[-1]
        return next(option for total, (_, option) in zip(sums, options, strict=True) if point <= total)

    def units(self, *shape: int) -> FloatArray:
        """Array of uniform numbers in 0..1."""
        return self._generator.random(shape)

    def normals(self, *shape: int) -> FloatArray:
        """Array of standard normal numbers."""
        return self._generator.standard_normal(shape)
