"""What the network is given and what it says, as tensors in training and as NumPy's arrays in use."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from simart_kit.arrays import BoolArray, Float32Array, IntArray

from .scene import MIDDLE, PAIR_NUMBERS, RIVALRY_NUMBERS
from .store import Stored
from .truth import KINDS

POINT_NUMBERS = 3 + 3 + 6 + 3
# What pair layers are told of each pair besides its tokens.
PAIR_WIDTH = PAIR_NUMBERS + RIVALRY_NUMBERS + 3 + len(KINDS)
# Pairs of more pieces are not looked at: it takes time by the cube, and none of these is trained on.
MOST_PAIRED = 128
_STEP = 16
Values = TypeVar("Values")


@dataclass(frozen=True, eq=False)
class Rows:
    """Objects side by side, padded to the most pieces.

    Attributes:
        points: (N, POINT_NUMBERS) float32 of all objects.
        owner: (N,) row of `numbers`, flattened to B * S, that each point is of.
        numbers: (B, S, PIECE_NUMBERS) float32.
        gap: (B, S, S) float32 least distance of two pieces [sides of the object].
        there: (B, S) bool, which pieces exist.
    """

    points: Float32Array
    owner: IntArray
    numbers: Float32Array
    gap: Float32Array
    there: BoolArray


@dataclass(frozen=True, eq=False)
class PiecesRead(Generic[Values]):
    """What the network makes of the pieces.

    Attributes:
        tokens: (B, S, D).
        together: (B, S, S) logits of two pieces being of one part; symmetric.
        moves: (B, S) logit of the piece being of a moving part.
        kind: (B, S, 5) logits of how its part moves, by `KINDS`.
        label: (B, S, L) logits of what its part is called.
        category: (B, C) logits of what the object is.
        size: (B,) natural logarithm of its longest side [m].
        middle: (B, S, D) tokens half way through the layers.
    """

    tokens: Values
    together: Values
    moves: Values
    kind: Values
    label: Values
    category: Values
    size: Values
    middle: Values


@dataclass(frozen=True, eq=False)
class PairInputs(Generic[Values]):
    """What pair layers are given: what was said of the pieces, and how these lie to each other.

    Attributes:
        tokens: (B, S, D).
        together: (B, S, S) logits.
        moves: (B, S) logits.
        kind: (B, S, 5) logits.
        own: (B, S, PIECE_NUMBERS).
        gap: (B, S, S) least distance of two pieces [sides of the object].
        there: (B, S) bool, which pieces exist.
    """

    tokens: Values
    together: Values
    moves: Values
    kind: Values
    own: Values
    gap: Values
    there: Values


@dataclass(frozen=True, eq=False)
class PartsRead(Generic[Values]):
    """What the network makes of parts.

    Attributes:
        kind: (P, 5) logits, by `KINDS`.
        right: (P, C) logits of the candidates; -inf where there is none.
        sense: (P, C) logits of opening in the sense of each candidate's axis.
        near: (P,) logits; half of their chance is the share of the travel that is on the shorter side of 0.
        reach: (P, 2) natural logarithms of the travel: of a turn [rad], of a slide [sides of the object].
        embedding: (P, D).
    """

    kind: Values
    right: Values
    sense: Values
    near: Values
    reach: Values
    embedding: Values


def rows_of(examples: Sequence[Stored]) -> Rows:
    """Examples side by side."""
    most = padded(examples)
    count = len(examples)
    numbers = np.zeros((count, most, examples[0].own.shape[1]), dtype=np.float32)
    gap = np.zeros((count, most, most), dtype=np.float32)
    there = np.zeros((count, most), dtype=np.bool_)
    points, owner = [], []
    for row, e in enumerate(examples):
        size = len(e.own)
        numbers[row, :size], there[row, :size] = e.own, True
        gap[row, :size, :size] = e.gap
        points.append(point_numbers(e))
        owner.append(e.piece.astype(np.int64) + row * most)
    return Rows(np.concatenate(points), np.concatenate(owner), numbers, gap, there)


def padded(examples: Sequence[Stored]) -> int:
    """Pieces of a batch: one of few numbers, since the arithmetic is prepared anew for every new shape."""
    return -(-max(len(e.own) for e in examples) // _STEP) * _STEP


def point_numbers(e: Stored) -> Float32Array:
    """(N, POINT_NUMBERS): place, place in the piece, direction without sense, colour."""
    points, normals = e.points.astype(np.float32), e.normals.astype(np.float32)
    x, y, z = normals.T
    facing = np.stack([x * x, y * y, z * z, x * y, x * z, y * z], axis=1)
    inside = 4 * (points - e.own[e.piece, MIDDLE])
    return np.concatenate([points, inside, facing, e.colors.astype(np.float32) - 0.5], axis=1)
