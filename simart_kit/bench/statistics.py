"""Means and how sure they are: the bootstrap; and whether a difference is chance: sign flips."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..arrays import FloatArray

_CHUNK = 1_000_000  # values drawn at a time: bounds memory, whatever the number of objects
_EXACT = 12  # up to so many differences, all ways to flip their signs are tried
_ROUNDING = 1e-9  # of the sum of sizes: sums that differ by less are equal


def mean(values: FloatArray) -> float | None:
    """Arithmetic mean of (N,) values; None of none."""
    return float(np.mean(values)) if len(values) else None


def bootstrap_interval(
    values: FloatArray, *, resamples: int = 10_000, confidence: float = 0.95, seed: int = 0
) -> tuple[float, float] | None:
    """Percentile bootstrap interval of the mean (Efron 1979): the same input gives the same interval.

    Means are taken of samples of N values, drawn with replacement; the interval leaves out an equal share of
    them at both ends. It is too narrow for few or skewed values: a nominal 95 % holds the true mean of an
    exponential distribution about 90 % of the time at N = 36, and less below. To judge a difference, use
    `sign_flip_p`.

    Args:
        values: (N,) finite numbers, one an object.
        resamples: samples drawn.
        confidence: share of the drawn means between the two ends.
        seed: of the random numbers.

    Returns:
        Lower and upper end; None for fewer than two values, which say nothing about spread.
    """
    count = len(values)
    if count < 2:
        return None
    random = np.random.default_rng(seed)
    means = np.concatenate(
        [values[random.integers(0, count, (rows, count))].mean(axis=1) for rows in _chunks(resamples, count)]
    )
    outside = (1.0 - confidence) / 2
    low, high = np.quantile(means, [outside, 1.0 - outside])
    return float(low), float(high)


def sign_flip_p(differences: FloatArray, *, flips: int = 10_000, seed: int = 0) -> float | None:
    """How likely a mean this far from 0 is, where each difference is as likely to be its opposite.

    The paired permutation test (Fisher 1935), two-sided. Up to 12 differences other than 0, all ways to flip
    their signs are tried and the number is exact; else random ones, among which the one that was found
    counts, so that the test stays valid. Fewer than six differences cannot come out below 0.05.

    Args:
        differences: (N,) finite numbers, one an object.
        flips: random ways tried.
        seed: of the random numbers.

    Returns:
        The p value, in 0..1; None of no differences.
    """
    if not len(differences):
        return None
    moved = differences[differences != 0]
    count = len(moved)
    least = abs(moved.sum()) - _ROUNDING * np.abs(moved).sum()
    if count <= _EXACT:
        signs = 1.0 - 2.0 * (np.arange(2**count)[:, None] >> np.arange(count) & 1)
        return float((np.abs(signs @ moved) >= least).mean())
    random = np.random.default_rng(seed)
    draws = (random.integers(0, 2, (rows, count)) * 2.0 - 1.0 for rows in _chunks(flips, count))
    as_far = sum(int((np.abs(signs @ moved) >= least).sum()) for signs in draws)
    return (as_far + 1) / (flips + 1)


def _chunks(samples: int, size: int) -> Iterator[int]:
    """How many samples of a size to draw at a time."""
    rows = max(1, _CHUNK // size)
    return (min(rows, samples - start) for start in range(0, samples, rows))
