"""What stands out like a trigger: hollow where it meets the rest, and on one side smooth all the way."""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..topology import connected
from .graph import SkinGraph

_LEAST, _MOST = 0.004, 0.08  # shares of the surface that such a piece has before
_HOLLOW, _SHARP = 0.01, 0.02  # heights from which on its border is hollow, or a sharp edge
_PARTS = 0.25  # share of its border that is so, each
_FEW = 6  # fewer places tell no plane
_FLAT = 0.35  # how far off their plane the hollow places are, as a share of how far they spread
_LARGER = 3.0  # so many times its area what it is taken from has
_STANDS = 0.3  # how far it stands out, as a share of the radius of a disc as large
_GROWS = 6.0  # so many times its area it has then, at most


def with_lobes_whole(graph: SkinGraph, label: IntArray, height: FloatArray) -> IntArray:
    """(V,) labels 0..; a piece takes what is beyond the plane of its hollow border and hangs on it.

    Args:
        graph: of the skin.
        label: (V,) its pieces 0...
        height: (V,) how hollow it is there, as `relief_pieces` takes it.
    """
    area = np.bincount(label, graph.areas)
    a, b = graph.edges.T
    apart = label[a] != label[b]
    border = np.zeros(len(label), dtype=np.bool_)
    border[graph.edges[apart]] = True
    result = label.copy()
    for piece in np.flatnonzero((area > _LEAST * area.sum()) & (area < _MOST * area.sum())):
        own = label == piece
        rim = np.flatnonzero(border & own)
        hollow = rim[height[rim] > _HOLLOW]
        if len(hollow) < max(_PARTS * len(rim), _FEW) or (height[rim] < -_SHARP).sum() < _PARTS * len(rim):
            continue
        lobe = _beyond(graph, own | (area[label] > _LARGER * area[piece]), own, hollow)
        if lobe is not None and graph.areas[lobe].sum() < _GROWS * area[piece]:
            result[lobe] = piece
    return np.asarray(np.unique(result, return_inverse=True)[1].reshape(-1))


def _beyond(graph: SkinGraph, able: BoolArray, own: BoolArray, hollow: IntArray) -> BoolArray | None:
    """(V,) what hangs together with a piece beyond the plane of its hollow places, if that stands out.

    Args:
        graph: of the skin.
        able: (V,) what may be of it.
        own: (V,) what is.
        hollow: (N,) vertices.
    """
    places = graph.places[hollow]
    middle = places.mean(axis=0)
    spread, ways = np.linalg.svd(places - middle, full_matrices=False)[1:]
    if spread[2] > _FLAT * spread[1]:
        return None
    out = ways[2] * np.sign((graph.places[own].mean(axis=0) - middle) @ ways[2])
    level = (graph.places - middle) @ out
    beyond = (able & (level > 0)) | own
    a, b = graph.edges.T
    free = beyond[a] & beyond[b]
    together = connected(len(own), a[free], b[free])
    lobe = together == together[np.flatnonzero(own)[0]]
    wide = np.sqrt(graph.areas[lobe].sum() / np.pi)
    return np.asarray(lobe) if level[lobe].max() > _STANDS * wide else None
