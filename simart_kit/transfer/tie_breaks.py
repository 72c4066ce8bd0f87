"""Faces that the votes leave open: they join the decided faces that they hang together with."""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..triangles import lengths
from .edge_links import EdgeLinks

# How much longer a way counts that crosses a crease.
_CREASE_COST = 10.0


def ways_to_parts(
    middles: FloatArray, links: EdgeLinks, tied: IntArray, label: IntArray, contenders: BoolArray
) -> FloatArray:
    """(T, P) how far each tied face has it over the surface to a decided face of each contending part [m].

    The way leads from middle to middle, through tied faces for which the same part contends; it counts ten
    times where it crosses a crease, and is infinite where there is none.

    Args:
        middles: (F, 3) of the faces [m].
        links: of the faces.
        tied: (T,) ids of faces.
        label: (F,) part of each face; those of the tied ones do not matter.
        contenders: (T, P) which parts may have a tied face.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import dijkstra

    left = np.concatenate([links.left, links.repeats[:, 0]])
    right = np.concatenate([links.right, links.repeats[:, 1]])
    bent = np.concatenate([links.bent, np.zeros(len(links.repeats), dtype=np.bool_)])
    open_ = np.zeros(len(middles), dtype=np.bool_)
    open_[tied] = True
    near = np.flatnonzero(open_.take(left) | open_.take(right))
    left, right = left.take(near), right.take(near)
    cost = lengths(middles.take(left, axis=0) - middles.take(right, axis=0))
    cost = np.where(bent.take(near), _CREASE_COST, 1.0) * np.maximum(cost, np.finfo(np.float64).tiny)
    # The faces that matter, the tied ones first.
    beside = np.zeros(len(middles), dtype=np.bool_)
    beside[left] = beside[right] = True
    nodes = np.concatenate([tied, np.flatnonzero(beside & ~open_)])
    here = np.zeros(len(middles), dtype=np.int32)
    here[nodes] = np.arange(len(nodes))
    left, right, decided = here.take(left), here.take(right), label[nodes[len(tied) :]]
    ways = np.full(contenders.shape, np.inf)
    for part, contends in enumerate(np.ascontiguousarray(contenders.T)):
        mine = np.flatnonzero(contends)
        allowed = np.concatenate([contends, decided == part])
        usable = np.flatnonzero(allowed.take(left) & allowed.take(right))
        number = np.cumsum(allowed, dtype=np.int32) - 1
        count = int(allowed.sum())
        ends = (number.take(left.take(usable)), number.take(right.take(usable)))
        graph = csr_array((cost.take(usable), ends), shape=(count, count))
        if 0 < len(mine) < count:
            sources = np.arange(len(mine), count)
            ways[mine, part] = dijkstra(graph, directed=False, indices=sources, min_only=True)[: len(mine)]
    return ways
