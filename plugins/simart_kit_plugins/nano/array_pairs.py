"""The numbers of `pairs`, by NumPy alone."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import BoolArray, Float32Array

from .scene import AREA, COLOR, FACING, FAR, HALF, MARGIN, MIDDLE, NEAR, REACH, WITHIN


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


def mutual_numbers(numbers: Float32Array) -> Float32Array:
    """As `pairs.mutual_numbers`."""
    other = numbers.transpose(0, 1, 3, 2)
    mutual = np.maximum(numbers, other)
    mutual[:, WITHIN + 1] = np.minimum(numbers[:, WITHIN], other[:, WITHIN])
    return mutual


def rivalry(own: Float32Array, gap: Float32Array, there: BoolArray) -> Float32Array:
    """As `pairs.rivalry`."""
    alike = np.exp(-8 * _distances(own[..., HALF]) - 4 * _distances(own[..., COLOR]))
    unlike = np.where(there[:, None], 1 - alike, np.float32(np.inf))
    found = []
    for distance, most in ((gap, REACH), (_distances(own[..., MIDDLE]), FAR)):
        farther, away = np.empty_like(distance), np.float32(most) * unlike
        for piece in range(distance.shape[1]):
            here = distance[:, piece]
            others = here[:, None] + away
            others[:, :, piece] = np.inf
            farther[:, piece] = here - np.minimum(others.min(axis=2), here)
        farther /= np.float32(most)
        other = farther.transpose(0, 2, 1)
        found += [np.maximum(farther, other), np.minimum(farther, other)]
    return np.stack(found, axis=1)


def _distances(rows: Float32Array) -> Float32Array:
    """(B, S, S) between all (B, S, K); summed a column at a time, which takes the least memory."""
    squared = np.zeros((*rows.shape[:2], rows.shape[1]), dtype=np.float32)
    for column in np.moveaxis(rows, 2, 0):
        squared += np.square(column[:, :, None] - column[:, None])
    return np.sqrt(squared, out=squared)
