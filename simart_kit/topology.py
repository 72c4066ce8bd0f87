"""How faces hang together: vertices that coincide, rows that repeat, edges that are shared, pieces.

Faces are (F, 3) ids of their corners, of vertices or of whatever else they meet at.
"""

from __future__ import annotations

import math

import numpy as np

from .arrays import FloatArray, IntArray
from .triangles import chunks


def weld(vertices: FloatArray, tolerance: float) -> IntArray:
    """(V,) ids 0.. such that vertices in one cell of a `tolerance` grid share an id."""
    tolerance = max(tolerance, 1e-12)  # a quotient of subnormal numbers would overflow
    columns = [np.round((column - column.min()) / tolerance).astype(np.int64) for column in vertices.T]
    cells = np.stack(columns).T
    keys = _row_keys(cells)
    if keys is None:
        return unique_rows(cells)[1].astype(np.int32)
    # Equal ones may come in any order here, which is found in half the time of a stable one.
    order = np.argsort(keys)
    ids = np.zeros(len(keys), dtype=np.int32)
    ids[order] = _numbered(keys.take(order))
    return ids


def unique_rows(rows: IntArray) -> tuple[IntArray, IntArray]:
    """The rows (N, K) that differ, in ascending order, many times as fast as `numpy.unique`.

    Returns:
        Index of the first of each, and (N,) which of them every row is.
    """
    keys = _row_keys(rows)
    new = np.ones(len(rows), dtype=np.bool_)
    order: IntArray
    if keys is None:
        order = np.lexsort(rows.T[::-1])
        ordered = rows.take(order, axis=0)
        new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    else:
        order = _sort(keys)
        new[1:] = keys[1:] != keys[:-1]
    ids = np.zeros(len(rows), dtype=np.int64)
    ids[order] = np.cumsum(new) - 1
    return order[new], ids


def first_alike(faces: IntArray) -> IntArray:
    """(F,) for each face the first one with the same three corners, in whatever order."""
    # Sums of random numbers tell nearly all of them apart; those that they do not are looked at.
    drawn = np.random.default_rng(0).integers(1 << 38, size=int(faces.max(initial=-1)) + 1)
    a, b, c = np.ascontiguousarray(faces.T)
    mark = drawn.take(a)
    mark += drawn.take(b)
    mark += drawn.take(c)
    order = _sort(mark)
    same = np.zeros(len(faces) + 1, dtype=np.bool_)
    same[1:-1] = mark[1:] == mark[:-1]
    suspects = np.sort(order[same[1:] | same[:-1]])
    once, which = unique_rows(np.sort(faces[suspects], axis=1))
    first = np.arange(len(faces))
    first[suspects] = suspects[once[which]]
    return first


def _row_keys(rows: IntArray) -> IntArray | None:
    """(N,) numbers 0.. that sort like the rows (N, K), where 63 bits hold them."""
    if not len(rows):
        return None
    low = [int(column.min()) for column in rows.T]
    spans = [int(column.max()) - least + 1 for column, least in zip(rows.T, low, strict=True)]
    if math.prod(spans) >= 1 << 63:
        return None
    keys = np.zeros(len(rows), dtype=np.int64)
    for column, least, span in zip(rows.T, low, spans, strict=True):
        keys *= span
        keys += column
        keys -= least
    return keys


def stable_order(keys: IntArray) -> tuple[IntArray, IntArray]:
    """What sorts (N,) int64 keys 0.., equal ones staying in order, and the sorted keys."""
    ordered = keys.copy()
    return _sort(ordered), ordered


def _sort(keys: IntArray) -> IntArray:
    """Sort (N,) int64 keys 0.. in place, without more memory than it takes to tell (N,) what sorts them.

    Sorting numbers is several times as fast as finding an order: the index travels in the low bits.
    """
    bits = len(keys).bit_length()
    mask = (1 << bits) - 1
    if int(keys.max(initial=0)) < 1 << (63 - bits):
        keys <<= bits
        keys |= np.arange(len(keys), dtype=np.uint32)
        keys.sort()
        order = keys & mask
        keys >>= bits
        return order
    order = np.argsort(keys)
    keys[:] = keys.take(order)
    return np.sort((_numbered(keys) << bits) | order) & mask


def half_edges(faces: IntArray) -> tuple[IntArray, IntArray]:
    """Half-edges (3 * face + side), those of an edge together and in order, and each one's edge.

    Edges have ascending numbers with gaps, whichever way they are walked.
    """
    count = int(faces.max(initial=0)) + 1
    keys = np.zeros((len(faces), 3), dtype=np.int64)
    for some in chunks(len(faces)):
        start = faces[some].astype(np.int64)
        end = start[:, [1, 2, 0]]
        keys[some] = np.minimum(start, end) * count + np.maximum(start, end)
    edge: IntArray = keys.ravel()
    return _sort(edge), edge


def shared_by_two(edge: IntArray) -> IntArray:
    """Where in sorted (N,) edges those begin that stand there exactly twice."""
    new = np.ones(len(edge) + 1, dtype=np.bool_)
    new[1:-1] = edge[1:] != edge[:-1]
    return np.flatnonzero(new[:-2] & ~new[1:-1] & new[2:])


def edge_ends(faces: IntArray, edge: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Lower and higher corner of each of the edges (E,), and how many faces have it.

    Args:
        faces: (F, 3).
        edge: (3 * F,) as `half_edges` gives it.
    """
    new = np.ones(len(edge) + 1, dtype=np.bool_)
    new[1:-1] = edge[1:] != edge[:-1]
    start = np.flatnonzero(new)
    edge, count = edge.take(start[:-1]), int(faces.max(initial=0)) + 1
    low = edge // count  # several times as fast as `numpy.divmod`
    return low, edge - low * count, np.diff(start)


def edges(faces: IntArray) -> IntArray:
    """(F, 3) ids 0.. of the edges from each corner to the next, whichever way they are walked."""
    half, edge = half_edges(faces)
    ids = np.zeros(len(half), dtype=np.int64)
    ids[half] = _numbered(edge)
    return ids.reshape(-1, 3)


def neighbours(faces: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Pairs of faces that follow each other around an edge: (N,) edge, and the two faces of each."""
    half, edge = half_edges(faces)
    same = np.flatnonzero(edge[1:] == edge[:-1])
    return _numbered(edge)[same], half[same] // 3, half[same + 1] // 3


def _numbered(ordered: IntArray) -> IntArray:
    """(N,) sorted values as numbers 0.. without gaps."""
    numbers = np.zeros(len(ordered), dtype=np.int64)
    np.cumsum(ordered[1:] != ordered[:-1], out=numbers[1:])
    return numbers


def touching(faces: IntArray, pieces: IntArray | None = None) -> IntArray:
    """(F,) labels 0.. of faces that hang together by shared corners.

    Not by shared edges: edges with more than two faces, as repeated faces make them, would cut all apart.

    Args:
        faces: (F, 3).
        pieces: (F,) labels 0.. of faces that are known to hang together, which saves time.
    """
    if pieces is not None and not pieces.any():
        return pieces.copy()
    used, corners = without_gaps(faces)
    count = len(used)
    a, b, c = np.ascontiguousarray(corners.T)
    if pieces is None:
        return np.asarray(connected(count, np.concatenate([a, b]), np.concatenate([b, c])).take(a))
    # Each corner stands for one of its pieces; only where it has others too do these touch.
    at_corner = np.zeros(count, dtype=np.int64)
    for corner in (a, b, c):
        at_corner[corner] = pieces
    one = [at_corner.take(corner) for corner in (a, b, c)]
    others = [np.flatnonzero(here != pieces) for here in one]
    links = [
        np.concatenate([here.take(face) for here, face in zip(one, others, strict=True)]),
        np.concatenate([pieces.take(face) for face in others]),
    ]
    found = connected(int(pieces.max(initial=-1)) + 1, *links)
    return np.asarray(_ranks(found.take(at_corner), len(found)).take(found).take(pieces))


def _ranks(labels: IntArray, count: int) -> IntArray:
    """(count,) numbers 0.. of the labels 0..count-1, in the order in which (N,) labels first have them."""
    first = np.full(count, len(labels))
    first[labels[::-1]] = np.arange(len(labels))[::-1]
    rank = np.zeros(count, dtype=np.int64)
    rank[np.argsort(first)] = np.arange(count)
    return rank


def occurring(ids: IntArray) -> IntArray:
    """The ids 0.. that occur among `ids`, of any shape, ascending; many times as fast as `numpy.unique`."""
    highest = int(ids.max(initial=-1))
    if highest > 2 * ids.size:
        return np.unique(ids)
    occurs = np.zeros(highest + 1, dtype=np.bool_)
    occurs[ids] = True
    return np.flatnonzero(occurs)


def without_gaps(ids: IntArray) -> tuple[IntArray, IntArray]:
    """The ids 0.. that occur, ascending, and for each of `ids`, of any shape, which of them it is."""
    used = occurring(ids)
    if not len(used) or used[-1] < len(used):
        return used, ids
    if used[-1] > 2 * ids.size:
        return used, np.searchsorted(used, ids)
    which = np.zeros(int(used[-1]) + 1, dtype=np.int64)
    which[used] = np.arange(len(used))
    return used, which[ids]


def connected(count: int, one: IntArray, two: IntArray) -> IntArray:
    """(count,) labels 0.. of the pieces of a graph whose links join `one` (N,) and `two` (N,).

    Pieces are numbered by their lowest nodes. Every node joins its lowest neighbour, and what has joined is a
    node of a smaller graph, until no link is left.
    """
    if count < 1 << 31:  # the smaller, the faster
        one, two = one.astype(np.int32, copy=False), two.astype(np.int32, copy=False)
    # Nodes linked to the one before them join first: in a mesh's own order they often come in long runs.
    begins = np.ones(count, dtype=np.bool_)
    begins[np.maximum(one, two)[np.abs(one - two) == 1]] = False
    step: IntArray = np.cumsum(begins, dtype=one.dtype) - 1
    label = step
    while True:
        one, two = step.take(one), step.take(two)
        apart = one != two
        if not apart.any():
            return label.astype(np.int64)
        one, two = one[apart], two[apart]
        step = _joined(int(step.max()) + 1, np.minimum(one, two), np.maximum(one, two))
        label = step.take(label)


def _joined(count: int, low: IntArray, high: IntArray) -> IntArray:
    """(count,) numbers 0.. of nodes that have each joined their lowest neighbour, if that is lower."""
    nodes = np.arange(count, dtype=low.dtype)
    root = nodes.copy()
    np.minimum.at(root, high, low)
    while not np.array_equal(above := root.take(root), root):
        root = above
    return np.asarray((np.cumsum(root == nodes, dtype=low.dtype) - 1).take(root))
