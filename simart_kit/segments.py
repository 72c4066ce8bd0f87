"""Mesh -> segments: connected components, and patches between creases or grooves where all is fused."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray, frozen_ints
from .mesh import Mesh
from .skins.relief import is_fine, relief_pieces
from .topology import connected, first_alike, half_edges, shared_by_two, touching, weld
from .triangles import cosines

WELD_TOLERANCE = 1e-5  # of the diagonal: far below any gap that is modelled, above single precision's noise
CREASE_ANGLE = np.deg2rad(25.0)
# A component that spans the object may be several solids welded together. It is fused when one of them still
# spans the object and holds nearly all of its surface.
_SPANNING, _FUSED_AREA = 0.95, 0.85


@dataclass(frozen=True, eq=False)
class Segments:
    """Pieces of a surface.

    Attributes:
        face_segment: (F,) segment of every face of the mesh, 0..count-1, largest area first.
        vertex: (V,) welded id of every vertex of the mesh.
        count: number of segments.
        duplicates: faces that repeat an earlier one; they share its segment.
        degenerates: faces without area; they join nothing, and share the largest segment that they touch.
        patches: whether a fused component was cut at its creases, a fine one by `relief_pieces`.
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


def find_segments(
    mesh: Mesh, crease: float = CREASE_ANGLE, node_hint: bool = False, vertex: IntArray | None = None
) -> Segments:
    """Cut a mesh into segments.

    Args:
        mesh: faces keep their order; nothing is removed from it.
        crease: dihedral angle that bounds the patches of a coarse fused component [rad].
        node_hint: never join faces of different scene-graph nodes.
        vertex: (V,) welded id of every vertex, as `weld` gives it with `WELD_TOLERANCE`, where known.
    """
    if vertex is None:
        vertex = weld(mesh.vertices, mesh.diagonal * WELD_TOLERANCE)
    corners = vertex[mesh.faces]
    degenerate = _degenerate(mesh, corners)
    first = first_alike(corners)
    duplicate = (first != np.arange(len(corners))) & ~degenerate
    kept = np.flatnonzero(~degenerate & ~duplicate)
    keys = corners
    if node_hint and mesh.face_node is not None:
        keys = corners + int(vertex.max() + 1) * mesh.face_node[:, None]
    found, fused = _pieces(mesh, keys[kept], kept, crease)
    labels = np.zeros(len(corners), dtype=np.int64)
    labels[kept] = _by_area(found, mesh.face_areas[kept])
    labels[degenerate] = _largest_beside(labels, corners, degenerate, kept)
    labels[duplicate] = labels[first[duplicate]]
    return Segments(
        frozen_ints(labels),
        vertex,
        int(labels.max()) + 1,
        int(duplicate.sum()),
        int(degenerate.sum()),
        fused,
    )


def _pieces(mesh: Mesh, corners: IntArray, kept: IntArray, crease: float) -> tuple[IntArray, bool]:
    """(K,) labels of the `kept` faces, and whether a fused component was cut at its creases.

    Args:
        mesh: the faces' mesh.
        corners: (K, 3) what the faces meet at.
        kept: (K,) ids of the faces.
        crease: dihedral angle that bounds the patches of a fused component [rad].
    """
    joints = _joints(*half_edges(corners), mesh.face_normals.take(kept, axis=0))
    smooth = joints.patches(crease)
    sheets = joints.patches(np.pi, smooth)
    found = touching(corners, sheets)
    spanning = _spanning_component(mesh, found, kept)
    if spanning is not None:
        inside = found == spanning
        found[inside] = found.max() + 1 + sheets[inside]
        spanning = _spanning_component(mesh, found, kept)
    if spanning is None or _share(mesh, found, kept, spanning) < _FUSED_AREA:
        return found, False
    inside = found == spanning
    if is_fine(mesh, kept[inside]):
        pieces = relief_pieces(mesh, corners[inside], kept[inside])
    else:
        pieces = joints.among(inside).patches(crease, smooth)[inside]
    found[inside] = found.max() + 1 + pieces
    return found, True


def _degenerate(mesh: Mesh, corners: IntArray) -> BoolArray:
    a, b, c = corners.T
    tiny = mesh.face_areas < (mesh.diagonal * 1e-9) ** 2
    return np.asarray((a == b) | (b == c) | (c == a) | tiny)


def _spanning_component(mesh: Mesh, labels: IntArray, kept: IntArray) -> int | None:
    """The one of (K,) `labels` of the `kept` faces with most surface, if it spans the object."""
    areas = np.bincount(labels, mesh.face_areas[kept], minlength=1)
    largest = int(areas.argmax())
    used = np.zeros(len(mesh.vertices), dtype=np.bool_)
    used[mesh.faces.take(kept.take(np.flatnonzero(labels == largest)), axis=0)] = True
    if not used.any():
        return None
    ids = np.flatnonzero(used)
    extent = np.array([np.ptp(column.take(ids)) for column in mesh.vertices.T])
    whole = mesh.bounds[1] - mesh.bounds[0]
    return largest if (extent >= _SPANNING * whole).all() else None


def _share(mesh: Mesh, labels: IntArray, kept: IntArray, label: int | None) -> float:
    """Share of the surface that one of the labels holds."""
    areas = mesh.face_areas[kept]
    return float(areas[labels == label].sum() / areas.sum()) if label is not None else 0.0


@dataclass(frozen=True, eq=False)
class _Joints:
    """Edges that join two faces.

    An edge with more than two faces, as where a board stands on another, bounds them all.

    Attributes:
        half, edge: half-edges (3 * face + side) sorted by their edge.
        normals: (F, 3) of the faces.
        left, right: (J,) the two faces of each joint.
        cosine: (J,) of the angle between their normals.
    """

    half: IntArray
    edge: IntArray
    normals: FloatArray
    left: IntArray
    right: IntArray
    cosine: FloatArray

    def among(self, inside: BoolArray) -> _Joints:
        """The joints as if only (F,) some of the faces were there."""
        if inside.all():
            return self
        used = inside[self.half // 3]
        return _joints(self.half[used], self.edge[used], self.normals)

    def patches(self, crease: float, known: IntArray | None = None) -> IntArray:
        """(F,) labels of faces connected across edges flatter than `crease` [rad].

        Args:
            crease: dihedral angle.
            known: (F,) labels 0.. of faces that are connected for sure, which saves time.
        """
        flat = np.flatnonzero(self.cosine >= np.cos(crease))
        left, right = self.left.take(flat), self.right.take(flat)
        if known is None:
            return connected(len(self.normals), left, right)
        left, right = known.take(left), known.take(right)
        apart = left != right
        return connected(int(known.max(initial=-1)) + 1, left[apart], right[apart])[known]


def _joints(half: IntArray, edge: IntArray, normals: FloatArray) -> _Joints:
    first = shared_by_two(edge)
    left, right = half.take(first) // 3, half.take(first + 1) // 3
    return _Joints(half, edge, normals, left, right, cosines(normals, left, right))


def _largest_beside(labels: IntArray, corners: IntArray, wanted: BoolArray, kept: IntArray) -> IntArray:
    """Labels for faces without area: the lowest at one of their vertices, 0 where there is none."""
    if not wanted.any():
        return np.zeros(0, dtype=np.int64)
    none = len(labels)
    at_vertex = np.full(int(corners.max()) + 1, none, dtype=np.int64)
    touched = np.zeros(len(at_vertex), dtype=np.bool_)
    touched[corners[wanted]] = True
    a, b, c = touched.take(corners).T
    beside = kept[(a | b | c)[kept]]
    np.minimum.at(at_vertex, corners[beside].ravel(), np.repeat(labels[beside], 3))
    found = at_vertex[corners[wanted]].min(axis=1)
    return np.where(found < none, found, 0)


def _by_area(labels: IntArray, areas: FloatArray) -> IntArray:
    used = np.flatnonzero(np.bincount(labels))
    order = np.argsort(-np.bincount(labels, areas)[used], kind="stable")
    rank = np.zeros(int(labels.max(initial=-1)) + 1, dtype=np.int64)
    rank[used[order]] = np.arange(len(used))
    return rank.take(labels)
