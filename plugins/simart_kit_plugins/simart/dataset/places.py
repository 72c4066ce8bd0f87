"""Which of several like parts is meant, by its place: "the upper left drawer", "the second key from the top".

Left is as the viewer sees it who stands before the object.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

import numpy as np

from simart_kit.arrays import FloatArray

# Words for the low and the high end of x, y and z: of two parts, and of more.
_PAIR = (("left", "right"), ("front", "rear"), ("lower", "upper"))
_ENDS = (("leftmost", "rightmost"), ("foremost", "rearmost"), ("bottom", "top"))
_FROM = (("left", "right"), ("front", "back"), ("bottom", "top"))
_ORDINALS = ("second", "third", "fourth", "fifth")
# Shares of the object's longest side: parts nearer than this are at one height, and those that differ by less
# than the second from the middle are on neither side.
_APART, _BESIDE = 0.04, 0.03
_PLANES = ((2, 0), (1, 0), (2, 1))


def place_words(centers: Sequence[tuple[float, float, float]]) -> Iterator[tuple[int, str]]:
    """What tells each of (N,) like parts from all others by its place.

    Args:
        centers: (N, 3) middles in the object's cube, 0..1; at least two.

    Yields:
        A part's number and words for it that are true of no other: to be put before what it is; those that
        come after it begin with "*", such as "second * from the top".
    """
    places = np.array(centers)
    for axis in range(3):
        yield from _along(places[:, axis], axis)
    for plane in _PLANES:
        yield from _corners(places, plane)


def _along(values: FloatArray, axis: int) -> Iterator[tuple[int, str]]:
    order = np.argsort(values, kind="stable")
    gaps = np.diff(values[order])
    words = _PAIR[axis] if len(values) == 2 else _ENDS[axis]
    if gaps[0] > _APART:
        yield int(order[0]), words[0]
    if gaps[-1] > _APART:
        yield int(order[-1]), words[1]
    if len(values) < 3 or gaps.min() <= _APART:
        return
    if len(values) % 2:
        yield int(order[len(values) // 2]), "middle"
    for rank, ordinal in enumerate(_ORDINALS[: len(values) - 2], start=1):
        yield int(order[rank]), f"{ordinal} * from the {_FROM[axis][0]}"
        yield int(order[-1 - rank]), f"{ordinal} * from the {_FROM[axis][1]}"


def _corners(places: FloatArray, plane: tuple[int, int]) -> Iterator[tuple[int, str]]:
    """Parts that are alone in a quarter of a plane: nobody else is there or near it."""
    offset = places - (places.min(axis=0) + places.max(axis=0)) / 2
    for ends in product((0, 1), repeat=2):
        sides = np.array([1 if end else -1 for end in ends])
        beyond = (offset[:, plane] * sides).min(axis=1)
        near = np.flatnonzero(beyond > -_BESIDE)
        if len(near) == 1 and beyond[near[0]] > _BESIDE:
            first, second = (_PAIR[axis][end] for axis, end in zip(plane, ends, strict=True))
            yield int(near[0]), f"{first} {second}"
