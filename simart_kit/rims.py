"""Where open surfaces end."""

from __future__ import annotations

import numpy as np

from .arrays import IntArray


def rim(faces: IntArray) -> IntArray:
    """(E, 2) edges of (F, 3) faces that are walked one way only, as they are walked."""
    ways = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
    count = int(faces.max()) + 1
    there, back = ways @ [count, 1], ways @ [1, count]
    return np.asarray(ways[~np.isin(there, back)])


def holes(edges: IntArray) -> list[IntArray] | None:
    """The corners of each hole that (E, 2) rim edges are around, in the order that closes it.

    None where holes touch.
    """
    following = dict(edges[:, ::-1].tolist())
    if len(following) != len(edges) or set(following) != set(following.values()):
        return None
    loops = []
    while following:
        corner, found = next(iter(following)), []
        while corner in following:
            found.append(corner)
            corner = following.pop(corner)
        loops.append(np.array(found))
    return loops


def outlines(edges: IntArray) -> list[IntArray]:
    """The corners of closed ways along (E, 2) rim edges, as these are walked, without what does not close.

    Where ways meet, any may go on: taken together, they go around the same.
    """
    following: dict[int, list[int]] = {}
    for start, end in edges.tolist():
        following.setdefault(start, []).append(end)
    found = []
    for first in list(following):
        while following[first]:
            loop, corner = [first], following[first].pop()
            while corner != first and following.get(corner):
                loop.append(corner)
                corner = following[corner].pop()
            if corner == first:
                found.append(np.array(loop))
    return found
