"""The cheapest way to part a graph in two."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray

# Costs become whole numbers; the dearest link this one.
_STEPS = 1 << 16


def min_cut(
    left: IntArray, right: IntArray, cost: FloatArray, stays: FloatArray, leaves: FloatArray
) -> BoolArray:
    """(N,) whether each node is on the second side, at the least cost: an exact minimum cut.

    Args:
        left: (L,) first node of each link.
        right: (L,) the second one.
        cost: (L,) of parting them.
        stays: (N,) cost of a node on the first side.
        leaves: (N,) cost of a node on the second side.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import breadth_first_order, maximum_flow

    count = len(stays)
    unit = _STEPS / max(cost.max(initial=0.0), 1e-300)
    low = np.minimum(stays, leaves)
    node, first, second = np.arange(count), np.full(count, count), np.full(count, count + 1)
    rows = np.concatenate([left, right, first, node])
    columns = np.concatenate([right, left, node, second])
    values = np.concatenate([cost, cost, leaves - low, stays - low])
    whole = np.minimum(np.rint(values * unit), (1 << 30) / 8).astype(np.int32)
    graph = coo_array((whole, (rows, columns)), shape=(count + 2, count + 2)).tocsr()
    graph.eliminate_zeros()
    flow = maximum_flow(graph, count, count + 1).flow
    rest = graph - flow
    rest.data = np.maximum(rest.data, 0)
    rest.eliminate_zeros()
    reached = np.zeros(count + 2, dtype=np.bool_)
    reached[breadth_first_order(rest, count, return_predecessors=False)] = True
    return ~reached[:count]
