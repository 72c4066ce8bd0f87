"""Small pieces that a cut leaves go to the part that surrounds them."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import BoolArray, IntArray
from simart_kit.topology import connected

from .links import Links


def without_islands(label: IntArray, free: BoolArray, around: Links) -> IntArray:
    """(F,) labels, where pieces of nothing but free faces took that with which they share most edge.

    Args:
        label: (F,) part of each face.
        free: (F,) faces whose part could change; a piece with another face stays.
        around: of all faces.
    """
    same = label[around.left] == label[around.right]
    piece = connected(len(label), around.left[same], around.right[same])
    count, parts = int(piece.max(initial=-1)) + 1, int(label.max(initial=-1)) + 1
    island = np.bincount(piece, ~free, count) == 0
    if not island.any():
        return label
    one = np.concatenate([around.left[~same], around.right[~same]])
    two = np.concatenate([around.right[~same], around.left[~same]])
    length = np.tile(around.length[~same], 2)
    used = island[piece[one]] & ~island[piece[two]]
    key, slot = np.unique(piece[one[used]] * parts + label[two[used]], return_inverse=True)
    shared = np.bincount(slot, length[used], len(key))
    order = np.argsort(shared, kind="stable")
    taken = np.full(count, -1, dtype=np.int64)
    taken[key[order] // parts] = key[order] % parts
    return np.where(taken[piece] >= 0, taken[piece], label).astype(np.int32)
