"""Putting pieces together again: where their common hull is tight after all, and where there are too many."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .hulls import hull_corners, outermost
from .pieces import Piece

Joins = dict[tuple[int, int], Piece]
"""What two pieces would be together, by their ordered keys."""

_TOUCHING = 1e-6  # [m]
_MANY_CORNERS = 128  # of a hull that is looked at again and again
_MOST_JOINS = 24  # pieces that each may be joined with as it touches them, those that it grows least by
_NEAR = 4  # pieces that each may be joined with where there are too many, besides those that it touches


def mended(pieces: Sequence[Piece], most: int, tight: float, least: float) -> list[Piece]:
    """The pieces in `most` or fewer, those joined first that waste least by it.

    Args:
        pieces: solids beside each other.
        most: of them; while there are fewer, only what is tight is joined.
        tight: times its solid that a tight hull holds at most,
        least: and what it may hold besides it at most [m^3].
    """
    left = dict(enumerate(pieces))
    joins: Joins = {}
    for key in left:
        joins |= _joins(left, key, _NEAR if len(left) > most else 0, joins)
    while len(left) > 1:
        crowded = len(left) > most
        wasted = [
            (joined.excess - left[i].excess - left[j].excess, i, j)
            for (i, j), joined in joins.items()
            if crowded or joined.excess <= min(least, (tight - 1) * joined.volume)
        ]
        if not wasted:
            break
        _, i, j = min(wasted)
        left[i] = joins[i, j]
        del left[j]
        joins = {pair: joined for pair, joined in joins.items() if not {i, j} & set(pair)}
        joins |= _joins(left, i, _NEAR if len(left) > most else 0, joins)
    return [left[key] for key in sorted(left)]


def _joins(pieces: Mapping[int, Piece], key: int, near: int, known: Joins) -> Joins:
    """One piece with each that it touches, and with so many that lie near, but those that are known."""
    others = [other for other in pieces if other != key]
    if not others:
        return {}
    mine = pieces[key]
    lower, upper = (np.array([getattr(pieces[o], end) for o in others]) for end in ("lower", "upper"))
    touching = (np.maximum(mine.lower - upper, lower - mine.upper) <= _TOUCHING).all(axis=1)
    common = (np.maximum(upper, mine.upper) - np.minimum(lower, mine.lower)).prod(axis=1)
    growth = common - (upper - lower).prod(axis=1)
    order = np.argsort(growth, kind="stable")
    chosen = {*order[touching[order]][:_MOST_JOINS].tolist(), *order[:near].tolist()}
    pairs = [(min(key, others[i]), max(key, others[i])) for i in sorted(chosen)]
    return {(i, j): _together(pieces[i], pieces[j]) for i, j in pairs if (i, j) not in known}


def _together(one: Piece, two: Piece) -> Piece:
    points = np.concatenate([one.points, two.points])
    hull, total = hull_corners(points), one.volume + two.volume
    if hull is None:
        return Piece(points, total, total, None)
    corners, size = hull
    if len(corners) > _MANY_CORNERS:  # shapes have fewer in the end
        corners = corners[outermost(corners, _MANY_CORNERS)]
    return Piece(corners, min(total, size), size, None)
