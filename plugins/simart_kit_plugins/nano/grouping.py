"""Pieces to parts: those that move, in clusters of what moves together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

# Two clusters of pieces are one part when the mean chance of their pieces to belong together is above this.
_JOINS = 0.55
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
        together: (S, S) chance of two pieces to be of one part; symmetric.
        area: (S,) of the pieces, any unit.
        least: parts less sure than this are left out.
    """
    pieces = np.flatnonzero(moves >= _MOVES)
    part = _parts(together[np.ix_(pieces, pieces)])
    every = [group_of(pieces[part == k], moves, together, area) for k in np.unique(part)]
    found = [group for group in every if group.score >= least]
    if sum(len(group.pieces) for group in found) == len(moves):
        # Something has to stand still: the largest is the likeliest.
        found.remove(max(found, key=lambda group: area[group.pieces].sum()))
    return sorted(found, key=lambda group: -group.score)


def group_of(pieces: IntArray, moves: FloatArray, together: FloatArray, area: FloatArray) -> Group:
    """These pieces as a group; arguments as of `groups`."""
    weight = area[pieces] / area[pieces].sum()
    inside = together[np.ix_(pieces, pieces)]
    return Group(pieces, float(weight @ moves[pieces] * (weight @ inside @ weight)))


def _parts(together: FloatArray) -> IntArray:
    """(S,) part of each piece: the surest pieces are joined first (average linkage).

    Of what is alike, as drawers side by side are, each then has its own before any could take another's.
    """
    from scipy.cluster.hierarchy import fcluster, linkage
    from scipy.spatial.distance import squareform

    if len(together) < 2:
        return np.zeros(len(together), dtype=np.int64)
    apart = np.maximum(1 - together, 0)
    np.fill_diagonal(apart, 0)
    tree = linkage(squareform(apart, checks=False), "average")
    return np.asarray(fcluster(tree, 1 - _JOINS, "distance"), dtype=np.int64)


def piece_parts(found: Sequence[IntArray], count: int) -> IntArray:
    """(count,) part of each piece: 0 for the body, then the parts of these pieces in their order."""
    part = np.zeros(count, dtype=np.int64)
    for number, pieces in enumerate(found, start=1):
        part[pieces] = number
    return part
