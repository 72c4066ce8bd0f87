"""Mesh -> segments: connected components, and crease-bounded patches where everything is fused."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray, frozen_ints
from .mesh import Mesh
from .normals import weld

WELD_TOLERANCE = 1e-5  # of the diagonal: far below any gap that is modelled, above single precision's noise
CREASE_ANGLE = np.deg2rad(25.0)
# A component is fused when it spans the object and holds nearly all of its surface.
_FUSED_EXTENT, _FUSED_AREA = 0.95, 0.85


@dataclass(frozen=True, eq=False)
class Segments:
    """Pieces of a surface.

    Attributes:
        face_segment: (F,) segment of every face of the mesh, 0..count-1, largest area first.
        vertex: (V,) welded id of every vertex of the mesh.
        count: number of segments.
        duplicates: faces that repeat an earlier one; they share its segment.
        degenerates: faces without area; they share the segment of a neighbour.
        patches: whether a fused component was cut at its creases.
    """

    face_segment: IntArray
    vertex: IntArray
    count: int
    duplicates: int
    degenerates: int
    patches: bool

    def describe(self) -> str:
        """One sentence for the report."""
        kind = "crease-bounded patches of a fused surface" if self.patches else "connected components"
        text = f"{self.count} {kind}"
        if self.duplicates or self.degenerates:
            text += f"; {self.duplicates} duplicate and {self.degenerates} degenerate faces not analysed"
        return text


def find_segments(mesh: Mesh, crease: float = CREASE_ANGLE, node_hint: bool = False) -> Segments:
    """Cut a mesh into segments.

    Args:
        mesh: faces keep their order; nothing is removed from it.
        crease: dihedral angle that bounds the patches of a fused component [rad].
        node_hint: never join faces of different scene-graph nodes.
    """
    vertex = weld(mesh.vertices, mesh.diagonal * WELD_TOLERANCE)
    corners = vertex[mesh.faces]
    degenerate = _degenerate(mesh, corners)
    first = _first_of_duplicates(corners)
    duplicate = (first != np.arange(len(corners))) & ~degenerate
    keys = corners
    if node_hint and mesh.face_node is not None:
        keys = corners + int(vertex.max() + 1) * mesh.face_node[:, None]
    labels = _components(keys)
    patches = False
    kept = np.flatnonzero(~degenerate & ~duplicate)
    fused = _fused_component(mesh, labels, kept)
    if fused is not None:
        inside = kept[labels[kept] == fused]
        labels[inside] = labels.max() + 1 + _patches(mesh.face_normals[inside], corners[inside], crease)
        patches = True
        labels[degenerate] = _neighbour_labels(labels, corners, degenerate, kept)
    labels[duplicate] = labels[first[duplicate]]
    labels = _by_area(labels, mesh.face_areas)
    return Segments(
        frozen_ints(labels),
        vertex,
        int(labels.max()) + 1,
        int(duplicate.sum()),
        int(degenerate.sum()),
        patches,
    )


def _degenerate(mesh: Mesh, corners: IntArray) -> BoolArray:
    a, b, c = corners.T
    tiny = mesh.face_areas < (mesh.diagonal * 1e-9) ** 2
    return np.asarray((a == b) | (b == c) | (c == a) | tiny)


def _first_of_duplicates(corners: IntArray) -> IntArray:
    """(F,) index of the first face with the same corners, in whatever order."""
    _, first, same = np.unique(np.sort(corners, axis=1), axis=0, return_index=True, return_inverse=True)
    return np.asarray(first[same.reshape(-1)])


def _components(corners: IntArray) -> IntArray:
    """(F,) label of faces connected by shared vertices.

    Not by shared edges: edges with more than two faces, as duplicates make them, would cut everything apart.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ids, compact = np.unique(corners, return_inverse=True)
    a, b, c = compact.reshape(-1, 3).T
    links = coo_array((np.ones(2 * len(a)), (np.r_[a, b], np.r_[b, c])), shape=(len(ids), len(ids)))
    _, label = connected_components(links, directed=False)
    return np.asarray(label[a], dtype=np.int64)


def _fused_component(mesh: Mesh, labels: IntArray, kept: IntArray) -> int | None:
    areas = np.bincount(labels[kept], mesh.face_areas[kept])
    largest = int(areas.argmax())
    corners = mesh.triangles[kept[labels[kept] == largest]].reshape(-1, 3)
    extent, whole = np.ptp(corners, axis=0), mesh.bounds[1] - mesh.bounds[0]
    spans = bool((extent >= _FUSED_EXTENT * whole).all())
    return largest if spans and areas[largest] >= _FUSED_AREA * areas.sum() else None


def _patches(normals: FloatArray, corners: IntArray, crease: float) -> IntArray:
    """(F,) label of faces connected across edges flatter than `crease`."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    edges = np.sort(corners[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    face = np.repeat(np.arange(len(corners)), 3)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    edges, face = edges[order], face[order]
    same = (edges[1:] == edges[:-1]).all(axis=1)
    left, right = face[:-1][same], face[1:][same]
    flat = np.einsum("ij,ij->i", normals[left], normals[right]) >= np.cos(crease)
    links = coo_array((np.ones(int(flat.sum())), (left[flat], right[flat])), shape=(len(corners),) * 2)
    return np.asarray(connected_components(links, directed=False)[1], dtype=np.int64)


def _neighbour_labels(labels: IntArray, corners: IntArray, wanted: BoolArray, kept: IntArray) -> IntArray:
    """Labels for faces without area: that of a kept face at one of their vertices."""
    at_vertex = np.full(int(corners.max()) + 1, -1, dtype=np.int64)
    at_vertex[corners[kept].ravel()] = np.repeat(labels[kept], 3)
    found = at_vertex[corners[wanted]].max(axis=1)
    return np.where(found >= 0, found, labels[wanted])


def _by_area(labels: IntArray, areas: FloatArray) -> IntArray:
    used, compact = np.unique(labels, return_inverse=True)
    order = np.argsort(-np.bincount(compact.reshape(-1), areas), kind="stable")
    rank = np.zeros(len(used), dtype=np.int64)
    rank[order] = np.arange(len(used))
    return np.asarray(rank[compact.reshape(-1)])
