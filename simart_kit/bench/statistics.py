"""Means and how sure they are: the bootstrap."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray

_CHUNK = 1_000_000  # values drawn at a time: bounds memory, whatever the number of objects


def mean(values: FloatArray) -> float | None:
    """Arithmetic mean of (N,) values; None of none."""
    return float(np.mean(values)) if len(values) else None


def bootstrap_interval(
    values: FloatArray, *, resamples: int = 10_000, confidence: float = 0.95, seed: int = 0
) -> tuple[float, float] | None:
    """Percentile bootstrap interval of the mean (Efron 1979): the same input gives the same interval.

    Means are taken of samples of N values, drawn with replacement; the interval leaves out an equal share of
    them at both ends. With few values it is too narrow rather than too wide.

    Args:
        values: (N,) finite numbers, one an object.
        resamples: samples drawn.
        confidence: share of the means between the two ends.
        seed: of the random numbers.

    Returns:
        Lower and upper end; None for fewer than two values, which say nothing about spread.
    """
    count = len(values)
    if count < 2:
        return None
    random = np.random.default_rng(seed)
    rows = max(1, _CHUNK // count)
    means = np.concatenate(
        [
            values[random.integers(0, count, (min(rows, resamples - start), count))].mean(axis=1)
            for start in range(0, resamples, rows)
        ]
    )
    outside = (1.0 - confidence) / 2
    low, high = np.quantile(means, [outside, 1.0 - outside])
    return float(low), float(high)
