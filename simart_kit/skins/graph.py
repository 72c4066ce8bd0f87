"""The vertices of a skin and the edges between them: means of surroundings, and pieces that barriers part."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..topology import connected, edge_ends, half_edges
from ..triangles import lengths

if TYPE_CHECKING:
    from scipy.sparse import csr_array


@dataclass(frozen=True, eq=False)
class SkinGraph:
    """A surface by its vertices.

    Attributes:
        places: (V, 3) [m].
        normals: (V, 3) unit, means of the faces' by area.
        areas: (V,) a third of the faces around each [m^2].
        edges: (E, 2) vertices, each pair once.
        size: longest side of the object [m].
    """

    places: FloatArray
    normals: FloatArray
    areas: FloatArray
    edges: IntArray
    size: float

    @cached_property
    def spacing(self) -> float:
        """Length of the middle edge [m]."""
        a, b = self.edges.T
        return float(np.median(lengths(self.places[a] - self.places[b])))

    @cached_property
    def _step(self) -> csr_array[Any]:
        """(V, V) mean of a vertex and those beside it, by their areas."""
        from scipy.sparse import coo_array, diags_array

        a, b = self.edges.T
        count = len(self.places)
        every = np.arange(count)
        row, column = np.concatenate([a, b, every]), np.concatenate([b, a, every])
        weights = coo_array((self.areas[column], (row, column)), shape=(count, count)).tocsr()
        mean: csr_array[Any] = (diags_array(1 / weights.sum(axis=1)) @ weights).tocsr()
        return mean

    def means(self, values: FloatArray, steps: int) -> FloatArray:
        """(V, K) means of (V, K) values over neighbourhoods that many steps wide."""
        for _ in range(steps):
            values = self._step @ values
        return values

    def medians(self, values: FloatArray) -> FloatArray:
        """(V, K) medians of (V, K) values over each vertex and those beside it, column by column."""
        a, b = self.edges.T
        size = len(values)
        every = np.arange(size)
        row, column = np.concatenate([a, b, every]), np.concatenate([b, a, every])
        count = np.bincount(row, minlength=size)
        middle = np.cumsum(count) - count + count // 2
        rows = row * size
        found = np.empty_like(values)
        for k, one in enumerate(values.T):
            order = np.argsort(one, kind="stable")
            rank = np.zeros(size, dtype=np.int64)
            rank[order] = every
            # Rows by rank are whole numbers, which are sorted in a tenth of the time.
            found[:, k] = one[order[np.sort(rows + rank[column])[middle] % size]]
        return found

    def pieces(self, barrier: BoolArray) -> IntArray:
        """(V,) labels 0.. of what hangs together without (V,) barriers; each of these is alone."""
        a, b = self.edges.T
        free = ~(barrier[a] | barrier[b])
        return connected(len(self.places), a[free], b[free])

    def filled(self, label: IntArray, barrier: BoolArray, least: float) -> IntArray:
        """(V,) labels 0.. without gaps: barriers and small pieces go to the piece that reaches them first.

        Args:
            label: (V,) pieces.
            barrier: (V,) vertices of no piece.
            least: share of the whole surface below which a piece is none.
        """
        area = np.bincount(label, self.areas * ~barrier)
        large = area > least * area.sum()
        if not large.any():
            return np.zeros_like(label)
        grown = np.where(large[label] & ~barrier, label, -1)
        start, end = np.concatenate([self.edges, self.edges[:, ::-1]]).T
        while True:
            open_ends = np.flatnonzero(grown[end] < 0)
            start, end = start[open_ends], end[open_ends]
            reached = np.flatnonzero(grown[start] >= 0)
            if not len(reached):
                break
            grown[end[reached]] = grown[start[reached]]
        if (grown < 0).any():
            grown = _nearest(self.places, grown)
        return np.asarray(np.unique(grown, return_inverse=True)[1].reshape(-1))

    def borders(self, label: IntArray) -> FloatArray:
        """(P, P) how many edges join two of the pieces; 0 on the diagonal."""
        count = int(label.max()) + 1
        one, two = label[self.edges].T
        apart = one != two
        table = np.bincount(one[apart] * count + two[apart], minlength=count * count).reshape(count, count)
        return np.asarray(table + table.T, dtype=np.float64)


def skin_graph(places: FloatArray, faces: IntArray, normals: FloatArray, areas: FloatArray) -> SkinGraph:
    """The graph of a mesh.

    Args:
        places: (V, 3) [m]; each is a corner of a face.
        faces: (F, 3).
        normals: (F, 3) unit.
        areas: (F,) [m^2].
    """
    count, corners = len(places), faces.ravel()
    low, high, _ = edge_ends(faces, half_edges(faces)[1])
    around = np.bincount(corners, np.repeat(areas / 3, 3), count)
    sums = [np.bincount(corners, np.repeat(column * areas, 3), count) for column in normals.T]
    size = float(np.ptp(places, axis=0).max())
    edges = np.column_stack([low, high])[low != high]
    return SkinGraph(places, unit(np.stack(sums, axis=1)), np.maximum(around, 1e-12 * size**2), edges, size)


def unit(vectors: FloatArray) -> FloatArray:
    """(N, 3) vectors of unit length; zeros stay zero."""
    return np.asarray(vectors / np.maximum(lengths(vectors), 1e-30)[:, None])


def _nearest(places: FloatArray, label: IntArray) -> IntArray:
    """(V,) labels; those below 0, which no edge leads to, are the nearest vertex's."""
    from scipy.spatial import cKDTree

    known = label >= 0
    result = label.copy()
    result[~known] = label[known][np.asarray(cKDTree(places[known]).query(places[~known])[1])]
    return result
