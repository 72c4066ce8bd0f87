"""Frames that several panels share, as drawers do whose gaps a skin has closed, shared out among these."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray, IntArray
from ..topology import connected
from .graph import SkinGraph, unit

# How flat a frame and its panels are, as the length of their mean normal, and how nearly they face one way.
_FLAT, _ALIKE = 0.6, 0.9
# Shares of the surface that a frame, and a panel in it, have at least.
_FRAME, _PANEL = 0.02, 0.004
# How much farther out than its frame a panel lies at most [spacings], and how much deeper [longest sides].
_OUT, _DEEP = 0.6, 0.04
_INSIDE = 0.6  # share of its border that a panel has with its frame
_SAME = 0.2  # of the shorter border of two panels that they share: they are of one


def with_frames_shared_out(graph: SkinGraph, label: IntArray, facing: FloatArray) -> IntArray:
    """(V,) labels 0..; of a frame with several panels, each part is what lies nearest to one of them.

    Args:
        graph: of the skin.
        label: (V,) its pieces 0...
        facing: (V, 3) unit, smooth normals.
    """
    pieces = _Pieces(graph, label, facing)
    result, count = label.copy(), int(label.max()) + 1
    for frame in np.flatnonzero((pieces.share > _FRAME) & (pieces.flat > _FLAT)):
        panels = pieces.panels(int(frame))
        if len(panels) > 1:
            inside = pieces.members(int(frame))
            result[inside] = count + _nearest(graph.places, [pieces.of(p) for p in panels], inside)
            count += len(panels)
    return np.asarray(np.unique(result, return_inverse=True)[1].reshape(-1))


class _Pieces:
    """What pieces of a skin are like, and which lie in which."""

    def __init__(self, graph: SkinGraph, label: IntArray, facing: FloatArray) -> None:
        count = int(label.max()) + 1
        area = np.bincount(label, graph.areas, count)
        mean = _sums(label, graph.areas, facing, count) / area[:, None]
        # Rims look aside: which way a piece looks is told by what looks much that way.
        main = graph.areas * (np.einsum("vi,vi->v", facing, unit(mean)[label]) > _ALIKE)
        self.share = area / area.sum()
        self.flat = np.linalg.norm(mean, axis=1)
        self._graph, self._normal = graph, unit(_sums(label, main, facing, count))
        self._border = graph.borders(label)
        self._order = np.argsort(label, kind="stable")
        self._starts = np.searchsorted(label[self._order], np.arange(count + 1))

    def members(self, piece: int) -> IntArray:
        """Its vertices."""
        return self._order[self._starts[piece] : self._starts[piece + 1]]

    def of(self, pieces: Sequence[int]) -> IntArray:
        """The vertices of several pieces."""
        return np.concatenate([self.members(piece) for piece in pieces])

    def panels(self, frame: int) -> list[list[int]]:
        """What lies in a frame, facing as it does, and not before it; each panel may be of several pieces."""
        beside = (self._border[frame] > 0) & (self.share > _PANEL) & (self.share < self.share[frame])
        alike = (self.flat > _FLAT) & (self._normal @ self._normal[frame] > _ALIKE)
        found = [int(piece) for piece in np.flatnonzero(beside & alike) if self._set_in(int(piece), frame)]
        if len(found) < 2:
            return []
        total, mutual = self._border[found].sum(axis=1), self._border[np.ix_(found, found)]
        one, two = np.nonzero(mutual > _SAME * np.minimum(total[:, None], total[None]))
        together = connected(len(found), one, two)
        panels = [[found[k] for k in np.flatnonzero(together == n)] for n in range(int(together.max()) + 1)]
        return [panel for panel in panels if self._enclosed(panel, frame)]

    def _set_in(self, piece: int, frame: int) -> bool:
        """Whether a piece lies about as far out as the frame, or a little deeper."""
        deeper = self._level(frame, frame) - self._level(piece, frame)
        return -_OUT * self._graph.spacing < deeper < _DEEP * self._graph.size

    def _level(self, piece: int, frame: int) -> float:
        return float(np.median(self._graph.places[self.members(piece)] @ self._normal[frame]))

    def _enclosed(self, panel: Sequence[int], frame: int) -> bool:
        own = self._border[panel].sum() - self._border[np.ix_(panel, panel)].sum()
        return bool(self._border[panel, frame].sum() > _INSIDE * own)


def _sums(label: IntArray, weights: FloatArray, facing: FloatArray, count: int) -> FloatArray:
    """(P, 3) sums of (V, 3) vectors by label, each times its weight."""
    return np.stack([np.bincount(label, weights * column, count) for column in facing.T], axis=1)


def _nearest(places: FloatArray, groups: Sequence[IntArray], wanted: IntArray) -> IntArray:
    """(W,) which of the groups of vertices comes nearest to each of the wanted ones."""
    from scipy.spatial import cKDTree

    owner = np.repeat(np.arange(len(groups)), [len(group) for group in groups])
    return np.asarray(owner[np.asarray(cKDTree(places[np.concatenate(groups)]).query(places[wanted])[1])])
