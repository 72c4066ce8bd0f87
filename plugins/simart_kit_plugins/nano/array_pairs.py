"""The numbers of `pairs`, by NumPy alone."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import Float32Array

from .scene import AREA, COLOR, FACING, HALF, MARGIN, MIDDLE, NEAR


def pair_numbers(own: Float32Array, gap: Float32Array) -> Float32Array:
    """(B, PAIR_NUMBERS, S, S); arguments and meaning as of `pairs.pair_numbers`."""
    middle, half = own[..., MIDDLE], own[..., HALF]
    apart = _distances(middle)
    low, high = middle - half - MARGIN, middle + half + MARGIN
    shared = np.minimum(high[:, :, None], high[:, None]) - np.maximum(low[:, :, None], low[:, None])
    within = np.maximum(shared, 0).prod(axis=-1) / (high - low).prod(axis=-1)[..., None]
    above, area = middle[..., 2], own[..., AREA]
    return np.stack(
        [
            *(np.exp(-gap / np.float32(reach)) for reach in NEAR),
            apart,
            np.exp(-8 * apart),
            above[:, :, None] - above[:, None],
            within,
            within.transpose(0, 2, 1),
            np.exp(-8 * _distances(half)),
            np.exp(-8 * _distances(own[..., COLOR])),
            _distances(own[..., FACING]),
            area[:, :, None] - area[:, None],
            np.broadcast_to(np.eye(own.shape[1], dtype=np.float32), gap.shape),
        ],
        axis=1,
    )


def _distances(rows: Float32Array) -> Float32Array:
    """(B, S, S) between all (B, S, K); summed a column at a time, which takes the least memory."""
    squared = np.zeros((*rows.shape[:2], rows.shape[1]), dtype=np.float32)
    for column in np.moveaxis(rows, 2, 0):
        squared += np.square(column[:, :, None] - column[:, None])
    return np.sqrt(squared, out=squared)
