"""Where something begins and ends but for little of it: handles and screws, or the ragged rims of a skin."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray


def extent_without(share: float, values: FloatArray, weights: FloatArray) -> FloatArray:
    """(2,) where (N,) values begin and end, but for a share of their (N,) weight at either end."""
    order = np.argsort(values)
    before = np.cumsum(weights[order]) / weights.sum()
    first, last = np.searchsorted(before, [share, 1 - share])
    return values[order[[first, min(last, len(order) - 1)]]]
