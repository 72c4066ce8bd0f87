"""Pieces to parts: who says that it moves takes along those that it says it moves with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

# A piece joins a part when its mean chance of belonging with the part's pieces is above this.
_JOINS = 0.5
_ROUNDS = 3
# A piece whose chance to move is less belongs to the body.
_MOVES = 0.5


@dataclass(frozen=True, eq=False)
class Group:
    """Pieces that move as one.

    Attributes:
        pieces: their numbers, ascending.
        score: how sure it is that they move, and together; 0..1.
    """

    pieces: IntArray
    score: float


def groups(moves: FloatArray, together: FloatArray, area: FloatArray, least: float) -> list[Group]:
    """Moving parts, the surest first; each piece is in one at most, and at least one is the body's.

    Args:
        moves: (S,) chance of each piece to be of a moving part.
        together: (S, S) chance of two pieces to be of one part.
        area: (S,) of the pieces, any unit.
        least: parts less sure than this are left out.
    """
    left = moves >= _MOVES
    found: list[Group] = []
    while left.any():
        # A large sure piece knows more of its part than a small one does.
        seed = int(np.where(left, moves + 0.05 * np.log(area / area.max() + 1e-6), -np.inf).argmax())
        members = _members(seed, left, together, area)
        group = group_of(members, moves, together, area)
        left[members] = False
        if group.score >= least:
            found.append(group)
    if sum(len(group.pieces) for group in found) == len(moves):
        # Something has to stand still: the largest is the likeliest.
        found.remove(max(found, key=lambda group: area[group.pieces].sum()))
    return sorted(found, key=lambda group: -group.score)


def group_of(pieces: IntArray, moves: FloatArray, together: FloatArray, area: FloatArray) -> Group:
    """These pieces as a group; arguments as of `groups`."""
    weight = area[pieces] / area[pieces].sum()
    inside = together[np.ix_(pieces, pieces)]
    return Group(pieces, float(weight @ moves[pieces] * (weight @ inside @ weight)))


def _members(seed: int, left: np.ndarray, together: FloatArray, area: FloatArray) -> IntArray:
    """The pieces that belong with a seed, by what the part found so far says on average."""
    chance = together[seed]
    members = np.flatnonzero(left & (chance > _JOINS))
    members = np.union1d(members, [seed])
    for _ in range(_ROUNDS):
        weight = np.sqrt(area[members])
        chance = weight @ together[members] / weight.sum()
        grown = np.union1d(np.flatnonzero(left & (chance > _JOINS)), [seed])
        if np.array_equal(grown, members):
            break
        members = grown
    return np.asarray(members, dtype=np.int64)


def piece_parts(found: Sequence[IntArray], count: int) -> IntArray:
    """(count,) part of each piece: 0 for the body, then the parts of these pieces in their order."""
    part = np.zeros(count, dtype=np.int64)
    for number, pieces in enumerate(found, start=1):
        part[pieces] = number
    return part
