"""Stored examples with less on them, without some of what moves and stands still, or less asked of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from simart_kit.arrays import BoolArray, IntArray

from .scene import AREA
from .store import Stored

# Share of the moving parts that stay, and of the pieces of the body that touch none of these.
_PARTS, _PIECES = (0.3, 0.95), (0.3, 1.0)
_TOUCHING = 0.02  # [sides of the object]
# Parts of an object that are asked for in a step, at most, besides what carries them.
MOST_ASKED = 24


def lessened(e: Stored, generator: np.random.Generator) -> Stored:
    """The example without some parts, what these carry, and pieces of the body; all else is as it was.

    What moves then has to be told by what it looks like itself, and no longer by what the object is. One
    moving part and the largest piece of the body stay. Lengths are still in sides of the whole.
    """
    kept = _kept_parts(e, generator)
    if len(kept) == 0 and e.part.any():
        return e
    stays = np.isin(e.part, kept)
    body = e.part == 0
    near = body & (e.gap[:, stays].min(axis=1, initial=np.inf) <= _TOUCHING)
    lucky = body & (generator.random(len(body)) < generator.uniform(*_PIECES))
    largest = np.argmax(np.where(body, e.own[:, AREA], -np.inf))
    stays = stays | near | lucky
    stays[largest] = True
    return e if stays.all() else _only(e, stays)


def few_asked(e: Stored, generator: np.random.Generator) -> Stored:
    """The example with the joints and names of some of its parts only; the pieces of all still move.

    The hundredth key teaches nothing about joints that the first ones did not, and costs as much time.
    """
    if len(e.number) <= MOST_ASKED:
        return e
    asked = set(generator.choice(e.number, MOST_ASKED, replace=False).tolist())
    carrier = _carriers(e)
    for _ in carrier:  # chains are no longer than this
        asked |= {carrier[number] for number in asked if number in carrier}
    return _told(e, np.isin(e.number, list(asked)))


def _carriers(e: Stored) -> dict[int, int]:
    return dict(zip(e.number.tolist(), e.parent.tolist(), strict=True))


def _told(e: Stored, told: BoolArray) -> Stored:
    """The example with what is known of these (Q,) parts."""
    candidates = np.repeat(told, e.candidates)
    return replace(
        e,
        **{n: getattr(e, n)[told] for n in ("number", "kind", "parent", "label", "travel", "candidates")},
        numbers=e.numbers[candidates],
        right=e.right[candidates],
    )


def _kept_parts(e: Stored, generator: np.random.Generator) -> IntArray:
    """Numbers of the parts that stay: at random, but none whose carrier goes."""
    numbers = np.unique(e.part[e.part > 0])
    gone = set(numbers[generator.random(len(numbers)) >= generator.uniform(*_PARTS)].tolist())
    carrier = _carriers(e)
    for _ in carrier:  # chains are no longer than this
        gone |= {number for number, its in carrier.items() if its in gone}
    return np.array([number for number in numbers.tolist() if number not in gone], dtype=np.int16)


def _only(e: Stored, stays: BoolArray) -> Stored:
    """The example with these (S,) pieces, of whose parts all or none stay."""
    renumbered = np.cumsum(stays) - 1
    seen = stays[e.piece]
    return replace(
        _told(e, np.isin(e.number, e.part[stays])),
        **{name: getattr(e, name)[seen] for name in ("points", "normals", "colors")},
        piece=renumbered[e.piece[seen]].astype(e.piece.dtype),
        own=e.own[stays],
        part=e.part[stays],
        gap=e.gap[np.ix_(stays, stays)],
        category="",
    )
