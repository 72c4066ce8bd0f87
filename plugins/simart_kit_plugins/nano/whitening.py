"""Directions of unit variance."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray

# Share of the mean variance that every direction has at least.
_LEAST = 0.01


def whitening(covariance: FloatArray) -> FloatArray:
    """(D, D) W with W W^T the inverse of a (D, D) covariance, of which no direction is without spread."""
    values, vectors = np.linalg.eigh(covariance)
    least = max(_LEAST * float(values.mean()), 1e-12)
    return np.asarray(vectors / np.sqrt(np.maximum(values, 0) + least))
