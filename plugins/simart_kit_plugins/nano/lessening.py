"""Stored examples with less on them: without some of their moving parts and some of what stands still."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from simart_kit.arrays import BoolArray, IntArray

from .scene import AREA
from .store import Stored

# Share of the moving parts that stay, and of the pieces of the body that touch none of these.
_PARTS, _PIECES = (0.3, 0.95), (0.3, 1.0)
_TOUCHING = 0.02  # [sides of the object]


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


def _kept_parts(e: Stored, generator: np.random.Generator) -> IntArray:
    """Numbers of the parts that stay: at random, but none whose carrier goes."""
    numbers = np.unique(e.part[e.part > 0])
    gone = set(numbers[generator.random(len(numbers)) >= generator.uniform(*_PARTS)].tolist())
    carrier = dict(zip(e.number.tolist(), e.parent.tolist(), strict=True))
    for _ in carrier:  # chains are no longer than this
        gone |= {number for number, its in carrier.items() if its in gone}
    return np.array([number for number in numbers.tolist() if number not in gone], dtype=np.int16)


def _only(e: Stored, stays: BoolArray) -> Stored:
    """The example with these (S,) pieces, of whose parts all or none stay."""
    renumbered = np.cumsum(stays) - 1
    seen = stays[e.piece]
    told = np.isin(e.number, e.part[stays])
    candidates = np.repeat(told, e.candidates)
    return replace(
        e,
        **{name: getattr(e, name)[seen] for name in ("points", "normals", "colors")},
        piece=renumbered[e.piece[seen]].astype(e.piece.dtype),
        own=e.own[stays],
        part=e.part[stays],
        gap=e.gap[np.ix_(stays, stays)],
        **{n: getattr(e, n)[told] for n in ("number", "kind", "parent", "label", "travel", "candidates")},
        numbers=e.numbers[candidates],
        right=e.right[candidates],
        category="",
    )
