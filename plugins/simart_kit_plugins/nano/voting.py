"""An object read from several sides at once: what the network says on average."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray, Float32Array, FloatArray

from .array_layers import sigmoid, softmax
from .array_network import ArrayNetwork
from .candidates import SLIDE
from .cloud import Cloud
from .examples import Example
from .reading import MOST_PAIRED, PairInputs, PiecesRead, Rows, rows_of
from .scene import pieces_of
from .store import stored
from .turning import VIEWS, turned, turned_evidence

# From how many sides an object is looked at.
VOTES = 4
# The time that the network takes grows with the square of the pieces.
_MANY = 256
# A smaller share of the travel than this on the shorter side is none.
_ONE_SIDED = 0.1
# Less than this the sides always differ, by rounding and by chance.
_LEAST = 1e-4


@dataclass(frozen=True, eq=False)
class Said:
    """What is said of an object; chances are means over the sides that it was seen from.

    Attributes:
        moves: (S,) chance of each piece to be of a moving part.
        together: (S, S) chance of two pieces to be of one part.
        label: (S, L) chances of what the piece's part is called.
        category: (C,) chances of what the object is.
        size: longest side [m], and the factor by which the sides differ about it, at least 1.
        discord: how far the sides are from saying the same, see `discord`.
        gap: (S, S) least distance of two pieces [sides of the object]; what is far apart is at a fixed one.
        tokens: (V, S', D) of each side, for `say_parts`; padded as in training.
        middle: (V, S', D) of each side, half way through the layers.
    """

    moves: FloatArray
    together: FloatArray
    label: FloatArray
    category: FloatArray
    size: tuple[float, float]
    discord: float
    gap: Float32Array
    tokens: Float32Array
    middle: Float32Array


@dataclass(frozen=True, eq=False)
class SaidParts:
    """What is said of parts.

    Attributes:
        kind: (P, K) chances, by `KINDS`.
        right: (P, C) chance of each candidate; 0 where there is none.
        travel: (P, C, 2) limits about each: turns [rad], slides [sides of the object].
        carrier: (P, P + 1) chance of being carried by the body, and by each part.
    """

    kind: FloatArray
    right: FloatArray
    travel: FloatArray
    carrier: FloatArray


def say(network: ArrayNetwork, cloud: Cloud, votes: int = VOTES) -> Said:
    """Read a cloud from the first `votes` of the eight `VIEWS`; one of very many pieces from one alone."""
    votes = votes if cloud.count <= _MANY else 1
    nothing = Example(
        cloud, pieces_of(cloud), np.zeros(cloud.count, dtype=np.int64), np.array([True]), (), "", 1.0
    )
    here = stored(nothing)
    rows = rows_of([turned(here, *view) for view in VIEWS[:votes]])
    read = network.read(rows)
    count = cloud.count
    moves, category = sigmoid(read.moves[:, :count]), softmax(read.category)
    return Said(
        _mean(moves),
        _together(network, read, rows, count),
        _mean(softmax(read.label[:, :count])),
        _mean(category),
        (float(np.exp(read.size.mean())), float(np.exp(read.size.std()))),
        discord(moves, category),
        here.gap,
        read.tokens,
        read.middle,
    )


def _together(network: ArrayNetwork, read: PiecesRead[Float32Array], rows: Rows, count: int) -> FloatArray:
    """(S, S) chances of pieces to belong together; of few pieces by all pairs, for the mean of the sides."""
    if count > MOST_PAIRED:
        return _mean(sigmoid(read.together[:, :count, :count]))
    said = (read.tokens, read.together, read.moves, read.kind)
    tokens, together, moves, kind = (values.mean(axis=0, keepdims=True) for values in said)
    # How pieces lie to each other is the same from all sides.
    own, gap, there = rows.numbers[:1], rows.gap[:1], rows.there[:1]
    pairs = network.paired(PairInputs(tokens, together, moves, kind, own, gap, there))
    return _mean(sigmoid(pairs[:, :count, :count]))


def discord(moves: Float32Array, category: Float32Array) -> float:
    """How far several sides of an object are from saying the same of it; infinite for one side alone.

    The geometric mean of how they differ about what moves (standard deviation, mean over the pieces) and
    about what the object is (total variation from their mean, mean over the sides).

    Args:
        moves: (V, S) chance of each piece to be of a moving part.
        category: (V, C) chances of what the object is.
    """
    if len(moves) < 2:
        return float("inf")
    of_moves = float(moves.std(axis=0).mean())
    of_category = float(np.abs(category - category.mean(axis=0)).sum(axis=1).mean()) / 2
    return float(np.sqrt((of_moves + _LEAST) * (of_category + _LEAST)))


def say_parts(
    network: ArrayNetwork, tokens: Float32Array, share: Float32Array, numbers: FloatArray, real: BoolArray
) -> SaidParts:
    """Read parts of an object.

    Args:
        network: that read it.
        tokens: (V, S', D) of `say`.
        share: (P, S) how much of the part each piece is; rows sum to 1.
        numbers: (P, C, COUNT) evidence of its candidates, as seen from the first side.
        real: (P, C) which candidates exist.
    """
    kinds, rights, senses, nears, reaches, carriers = [], [], [], [], [], []
    padded = np.pad(share, ((0, 0), (0, tokens.shape[1] - share.shape[1])))
    for own, (quarters, mirrored) in zip(tokens, VIEWS, strict=False):
        flat = turned_evidence(numbers.reshape(-1, numbers.shape[2]), quarters, mirrored)
        seen = flat.reshape(numbers.shape).astype(np.float32)
        read = network.parts(own[None], np.zeros(len(share), dtype=np.int64), padded, seen, real)
        turns_other_way = mirrored & (seen[..., SLIDE] == 0)
        kinds.append(softmax(read.kind))
        rights.append(softmax(read.right))
        senses.append(np.where(turns_other_way, -read.sense, read.sense))
        nears.append(sigmoid(read.near) / 2)
        reaches.append(read.reach)
        carriers.append(softmax(_with_body(network.carriers(read.embedding, read.embedding))))
    kind, right, sense, near, reach, carrier = (
        _mean(np.stack(found)) for found in (kinds, rights, senses, nears, reaches, carriers)
    )
    travel = _travel(numbers[..., SLIDE] > 0, sense, near, np.exp(reach))
    return SaidParts(kind, right, travel, carrier)


def _travel(slide: BoolArray, sense: FloatArray, near: FloatArray, reach: FloatArray) -> FloatArray:
    """(P, C, 2) limits about each candidate: the longer way is the one that its sense speaks for.

    Args:
        slide: (P, C) whether it is a slide.
        sense: (P, C) above 0 where it opens in the sense of its axis.
        near: (P,) share of the travel that is on the shorter side; next to none is none.
        reach: (P, 2) travel of a turn [rad] and of a slide [sides of the object].
    """
    whole = np.where(slide, reach[:, 1:], reach[:, :1])
    back = np.where(near < _ONE_SIDED, 0.0, near)[:, None] * whole
    onward = sense >= 0
    lower, upper = np.where(onward, back, whole - back), np.where(onward, whole - back, back)
    return np.stack([0.0 - lower, upper], axis=-1)


def _with_body(carried: Float32Array) -> Float32Array:
    """(P, P + 1) logits: the body's, which is 0, then those of the parts, of which none carries itself."""
    alone = np.where(np.eye(len(carried), dtype=np.bool_), np.float32(-np.inf), carried)
    return np.pad(alone, ((0, 0), (1, 0)))


def _mean(votes: Float32Array) -> FloatArray:
    return np.asarray(votes.mean(axis=0), dtype=np.float64)
