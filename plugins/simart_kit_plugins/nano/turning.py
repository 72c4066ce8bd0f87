"""An example seen from another side: turned by quarters about z, and mirrored."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from simart_kit.arrays import Float32Array, FloatArray

from .candidates import SLIDE
from .evidence import ALONG_AXES, BOTH_WAYS, PLACE, WAY
from .scene import FACING, HALF, MIDDLE, SPREAD
from .store import Stored

# All ways that an object may be seen: quarters and whether mirrored; those that differ most come first.
VIEWS = ((0, False), (1, True), (2, False), (3, True), (0, True), (1, False), (2, True), (3, False))


def turned(e: Stored, quarters: int, mirrored: bool) -> Stored:
    """The example mirrored in x if so wished, then turned by quarters about z."""
    matrix = _matrix(quarters, mirrored)
    right = e.right
    if mirrored:  # a turn about the mirrored axis goes the other way round, a slide does not
        right = np.where(e.numbers[:, SLIDE] > 0, right, -right).astype(right.dtype)
    return replace(
        e,
        points=e.points @ matrix.T.astype(e.points.dtype),
        normals=e.normals @ matrix.T.astype(e.normals.dtype),
        own=turned_pieces(e.own, quarters, mirrored),
        numbers=turned_evidence(e.numbers, quarters, mirrored),
        right=right,
    )


def turned_pieces(own: Float32Array, quarters: int, mirrored: bool) -> Float32Array:
    """(S, PIECE_NUMBERS) of the same pieces, turned."""
    matrix = _matrix(quarters, mirrored)
    result = own.copy()
    result[:, MIDDLE] = own[:, MIDDLE] @ matrix.T
    result[:, HALF] = own[:, HALF] @ np.abs(matrix).T
    for columns in (SPREAD, FACING):
        # Roots of second moments turn like these: a turn by quarters only swaps them and their signs.
        result[:, columns] = _packed(np.asarray(matrix @ _square(own[:, columns]) @ matrix.T, np.float32))
    return result


def turned_evidence(numbers: FloatArray, quarters: int, mirrored: bool) -> FloatArray:
    """(C, COUNT) evidence of the same candidates, turned."""
    result = numbers.copy()
    result[:, PLACE] = numbers[:, PLACE] @ _matrix(quarters, mirrored).T.astype(numbers.dtype)
    if quarters % 2:
        for columns in ALONG_AXES:
            result[:, columns] = numbers[:, columns][:, [1, 0, 2]]
    if mirrored:
        turns = numbers[:, SLIDE] == 0
        result[turns, BOTH_WAYS] = numbers[turns, BOTH_WAYS][:, ::-1]
        result[turns, WAY] *= -1
    return result


def _matrix(quarters: int, mirrored: bool) -> Float32Array:
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarters % 4]
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]], dtype=np.float32)
    return turn * np.array([-1, 1, 1], dtype=np.float32) if mirrored else turn


def _square(packed: Float32Array) -> Float32Array:
    """(S, 3, 3) symmetric from (S, 6) xx, yy, zz, xy, xz, yz."""
    return packed[:, [0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(-1, 3, 3)


def _packed(square: Float32Array) -> Float32Array:
    return square.reshape(-1, 9)[:, [0, 4, 8, 1, 2, 5]]
