"""Mesh -> segments: connected components, and crease-bounded patches where everything is fused."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray, frozen_bools, frozen_ints
from .bounds import bounds_of
from .kept import kept
from .mesh import Mesh
from .skins.aside import aside_of_skin, pieces_before
from .skins.fineness import are_shells, is_fine, is_rough
from .skins.relief import relief_pieces
from .topology import connected, first_alike, half_edges, occurring, shared_by_two, touching, weld
from .touching_solids import plugs
from .triangles import cosines

WELD_TOLERANCE = 1e-5  # of the diagonal: far below any gap that is modelled, above single precision's noise
CREASE_ANGLE = np.deg2rad(25.0)
# A component that spans the object may be several solids welded together. It is fused when one of them still
# spans the object and holds nearly all of its surface.
_SPANNING, _FUSED_AREA = 0.95, 0.85
_MAIN_AREA = 0.9  # the same of a skin that does not span all because of stray shells, as fine as it is
# How a fused component is cut; "" where there is none.
_Cut: TypeAlias = Literal["", "creases", "relief"]
_SOME = 32  # each so many faces are a first look at how far they extend


@dataclass(frozen=True, eq=False)
class Segments:
    """Pieces of a surface.

    Attributes:
        face_segment: (F,) segment of every face of the mesh, 0..count-1, largest area first.
        vertex: (V,) welded id of every vertex of the mesh.
        count: number of segments.
        duplicates: faces that repeat an earlier one; they share its segment.
        degenerates: faces without area; they join nothing, and share the largest segment that they touch.
        patch: (F,) which faces are of a fused component that was cut, at its creases or by relief.
        relief: whether it was by relief.
        aside: (F,) which faces are of shells that tell nothing of a skin, as the inner sides of its walls and
            strays are; each is of the segment next to it.
    """

    face_segment: IntArray
    vertex: IntArray
    count: int
    duplicates: int
    degenerates: int
    patch: BoolArray
    relief: bool
    aside: BoolArray

    @property
    def patches(self) -> bool:
        """Whether a fused component was cut."""
        return bool(self.patch.any())

    def describe(self) -> str:
        """One sentence for the report."""
        kind = "crease-bounded patches of a fused surface" if self.patches else "connected components"
        text = f"{self.count} {kind}"
        if self.duplicates or self.degenerates:
            text += f"; {self.duplicates} duplicate and {self.degenerates} degenerate faces not analysed"
        return f"{text}; {self.told_aside}" if self.told_aside else text

    @property
    def told_aside(self) -> str:
        """What is aside of a skin, in words for the report; "" where nothing is."""
        count = int(self.aside.sum())
        told = f"{count} faces of inner sides of walls and of strays go with what is next to them"
        return told if count else ""


def find_segments(
    mesh: Mesh,
    crease: float = CREASE_ANGLE,
    node_hint: bool = False,
    vertex: IntArray | None = None,
    relief: bool = False,
) -> Segments:
    """Cut a mesh into segments; the mesh keeps those of each kind.

    Args:
        mesh: faces keep their order; nothing is removed from it.
        crease: dihedral angle that bounds the patches of a fused component [rad].
        node_hint: never join faces of different scene-graph nodes.
        vertex: (V,) welded id of every vertex, as `weld` gives it with `WELD_TOLERANCE`, where known.
        relief: cut a finely meshed fused component into few pieces, as `relief_pieces` does, and not into
            patches: a rough one has thousands.
    """
    if vertex is not None:
        return _cut(mesh, _cleaned(mesh, vertex), crease, node_hint, relief)
    return _segments_of(mesh, crease, node_hint, relief)


@kept
def _segments_of(mesh: Mesh, crease: float, node_hint: bool, relief: bool) -> Segments:
    return _cut(mesh, _faces_of(mesh), crease, node_hint, relief)


@dataclass(frozen=True, eq=False)
class _Faces:
    """What the faces of a mesh meet at, and which of them are looked at.

    Attributes:
        vertex: (V,) welded id of every vertex of the mesh.
        corners: (F, 3) welded ids, those of solids that fill holes apart from the others.
        first: (F,) first face with the same corners.
        degenerate: (F,) whether a face has no area.
        duplicate: (F,) whether a face with area repeats an earlier one.
    """

    vertex: IntArray
    corners: IntArray
    first: IntArray
    degenerate: BoolArray
    duplicate: BoolArray


@kept
def _faces_of(mesh: Mesh) -> _Faces:
    return _cleaned(mesh, weld(mesh.vertices, mesh.diagonal * WELD_TOLERANCE))


def _cleaned(mesh: Mesh, vertex: IntArray) -> _Faces:
    corners = vertex.astype(np.int32).take(mesh.faces)
    degenerate = _degenerate(mesh, corners)
    with_area = np.flatnonzero(~degenerate)
    plug = np.zeros((len(corners), 1), dtype=np.int64)
    plug[with_area, 0] = plugs(mesh, corners.take(with_area, axis=0), with_area)
    if plug.any():  # it meets nothing but itself
        corners = corners + int(vertex.max() + 1) * plug
    first = first_alike(corners)
    duplicate = (first != np.arange(len(corners))) & ~degenerate
    return _Faces(vertex, corners, first, degenerate, duplicate)


def _cut(mesh: Mesh, of: _Faces, crease: float, node_hint: bool, relief: bool) -> Segments:
    looked_at = np.flatnonzero(~of.degenerate & ~of.duplicate)
    keys = of.corners
    if node_hint and mesh.face_node is not None:
        keys = keys + int(keys.max() + 1) * mesh.face_node[:, None]
    found = _pieces(mesh, keys.take(looked_at, axis=0), looked_at, crease, relief)
    labels = np.zeros(len(keys), dtype=np.int64)
    labels[looked_at] = _by_area(found.label, mesh.face_areas.take(looked_at))
    labels[of.degenerate] = _largest_beside(labels, of.corners, of.degenerate, looked_at)
    labels[of.duplicate] = labels[of.first[of.duplicate]]
    patch, aside = np.zeros((2, len(keys)), dtype=np.bool_)
    for told, which in ((patch, found.patch), (aside, found.aside)):
        told[looked_at[which]] = True
        told[of.duplicate] = told[of.first[of.duplicate]]
    return Segments(
        frozen_ints(labels),
        of.vertex,
        int(labels.max()) + 1,
        int(of.duplicate.sum()),
        int(of.degenerate.sum()),
        frozen_bools(patch),
        found.cut == "relief",
        frozen_bools(aside),
    )


@dataclass(frozen=True, eq=False)
class _Found:
    """Pieces of K faces.

    Attributes:
        label: (K,) of the piece of each.
        cut: how a fused component was cut.
        patch: (K,) which are of that component.
        aside: (K,) which are aside of it.
    """

    label: IntArray
    cut: _Cut
    patch: BoolArray
    aside: BoolArray


def _pieces(mesh: Mesh, corners: IntArray, kept: IntArray, crease: float, relief: bool) -> _Found:
    """The pieces of the `kept` faces.

    Args:
        mesh: the faces' mesh.
        corners: (K, 3) what the faces meet at.
        kept: (K,) ids of the faces.
        crease: dihedral angle that bounds the patches of a fused component [rad].
        relief: whether a finely meshed one is cut into pieces instead.
    """
    surface = _Surface(mesh, kept, mesh.face_areas.take(kept))
    joints = _joints(corners, kept, mesh.face_normals)
    smooth = joints.patches(crease)
    sheets = joints.patches(np.pi, smooth)
    found, fused = _shells(surface, corners, joints, sheets)
    if fused is None:
        return _pieces_of_skin(surface, corners, found, smooth, crease, relief)
    inside = found == fused
    cut: _Cut = "creases"
    if relief and (is_fine(mesh, kept[inside]) or is_rough(mesh, kept[inside], smooth[inside])):
        pieces, cut = relief_pieces(mesh, corners[inside], kept[inside]), "relief"
    elif inside.all():
        pieces = smooth
    else:  # edges that it shares with others are now its own
        alone = _joints(corners[inside], kept[inside], mesh.face_normals)
        pieces = alone.patches(crease, smooth[inside])
    found[inside] = found.max() + 1 + pieces
    return _Found(found, cut, inside, np.zeros_like(inside))


def _shells(
    surface: _Surface, corners: IntArray, joints: _Joints, sheets: IntArray
) -> tuple[IntArray, int | None]:
    """(K,) labels of what hangs together, and the one that is several solids in one, if any."""
    found = touching(corners, sheets)
    spanning = surface.spanning(found)
    if spanning is not None:
        inside = found == spanning
        found[inside] = found.max() + 1 + sheets[inside]
        spanning = surface.spanning(found)
    else:  # what touches the largest and is closed is not of it
        body = found == np.bincount(found, surface.areas, 1).argmax()
        found = np.where(body & joints.closed(sheets), found.max(initial=-1) + 1 + sheets, found)
    return found, surface.fused(found, spanning)


def _pieces_of_skin(
    surface: _Surface, corners: IntArray, found: IntArray, smooth: IntArray, crease: float, relief: bool
) -> _Found:
    """As `_pieces`, of a skin that what is aside of it keeps from being told; of all else, as found."""
    mesh, kept = surface.mesh, surface.face_ids
    aside = aside_of_skin(mesh, kept, found, smooth)
    rest = ~aside
    if aside.any():
        of = _pieces(mesh, corners[rest], kept[rest], crease, relief)
        if of.cut:
            patch = np.zeros_like(aside)
            found[rest], patch[rest], aside[rest] = of.label, of.patch, of.aside
            found[~rest] = pieces_before(mesh, kept[rest], of.label, kept[~rest])
            return _Found(found, of.cut, patch, aside)
    return _Found(found, "", np.zeros_like(aside), np.zeros_like(aside))


@dataclass(frozen=True, eq=False)
class _Surface:
    """Some faces of a mesh.

    Attributes:
        mesh: theirs.
        face_ids: (K,) of them.
        areas: (K,) in square units.
    """

    mesh: Mesh
    face_ids: IntArray
    areas: FloatArray

    @cached_property
    def bounds(self) -> FloatArray:
        """(2, 3) lower and upper corner."""
        if len(self.face_ids) == len(self.mesh.faces):
            return self.mesh.bounds
        return np.array(bounds_of(self.mesh.vertices[occurring(self.mesh.faces[self.face_ids])]))

    def spanning(self, labels: IntArray) -> int | None:
        """The one of (K,) labels with most surface, if it spans the object."""
        if not len(labels):
            return None
        largest = int(np.bincount(labels, self.areas).argmax())
        inside = np.flatnonzero(labels == largest)
        whole = np.ptp(self.bounds, axis=0)
        # Some of its faces often show that it does, in little time.
        for some in (inside[::_SOME], inside):
            used = np.zeros(len(self.mesh.vertices), dtype=np.bool_)
            used[self.mesh.faces.take(self.face_ids.take(some), axis=0)] = True
            columns = self.mesh.vertices.compress(used, axis=0).T
            if (np.array([np.ptp(column) for column in columns]) >= _SPANNING * whole).all():
                return largest
        return None

    def fused(self, labels: IntArray, spanning: int | None) -> int | None:
        """The one of (K,) labels that is several solids in one, if any: nearly all of the surface."""
        if spanning is not None:
            return spanning if self.share(labels == spanning) >= _FUSED_AREA else None
        if not are_shells(self.mesh, self.face_ids, labels):
            return None
        main = int(np.bincount(labels, self.areas).argmax())
        return main if self.share(labels == main) >= _MAIN_AREA else None

    def share(self, inside: BoolArray) -> float:
        """Share of the area that lies in (K,) some of the faces."""
        return float(self.areas[inside].sum() / self.areas.sum())


def _degenerate(mesh: Mesh, corners: IntArray) -> BoolArray:
    a, b, c = corners.T
    tiny = mesh.face_areas < (mesh.diagonal * 1e-9) ** 2
    return np.asarray((a == b) | (b == c) | (c == a) | tiny)


@dataclass(frozen=True, eq=False)
class _Joints:
    """Edges that join two faces.

    An edge with more than two faces, as where a board stands on another, bounds them all.

    Attributes:
        count: number of faces, F.
        left, right: (J,) the two faces of each joint.
        cosine: (J,) of the angle between their normals.
    """

    count: int
    left: IntArray
    right: IntArray
    cosine: FloatArray

    def closed(self, sheets: IntArray) -> BoolArray:
        """(F,) whether the sheet of each face has no end: it touches others, but is a solid of its own."""
        count = int(sheets.max(initial=-1)) + 1
        if count < 2:
            return np.zeros(self.count, dtype=np.bool_)
        joined = np.bincount(sheets.take(self.left), minlength=count)
        return np.asarray(2 * joined == 3 * np.bincount(sheets, minlength=count)).take(sheets)

    def patches(self, crease: float, known: IntArray | None = None) -> IntArray:
        """(F,) labels of faces connected across edges flatter than `crease` [rad].

        Args:
            crease: dihedral angle.
            known: (F,) labels 0.. of faces that are connected for sure, which saves time.
        """
        flat = self.cosine >= np.cos(crease)
        if known is None:
            return connected(self.count, self.left[flat], self.right[flat])
        if not known.any():
            return known
        left, right = known.take(self.left), known.take(self.right)
        apart = flat & (left != right)
        return connected(int(known.max(initial=-1)) + 1, left[apart], right[apart]).take(known)


def _joints(corners: IntArray, face_ids: IntArray, normals: FloatArray) -> _Joints:
    """Those of (F, 3) faces, whose `face_ids` (F,) tell the unit `normals` that are theirs."""
    left, right = _sharing(corners)
    cosine = cosines(normals, face_ids.take(left), face_ids.take(right))
    return _Joints(len(corners), left, right, cosine)


def _sharing(corners: IntArray) -> tuple[IntArray, IntArray]:
    """The two faces (J,) of each edge of (F, 3) faces that just two share."""
    half, edge = half_edges(corners)
    first = shared_by_two(edge)
    face = half.astype(np.int32)
    face //= 3
    return face.take(first), face.take(first + 1)


def _largest_beside(labels: IntArray, corners: IntArray, wanted: BoolArray, kept: IntArray) -> IntArray:
    """Labels for faces without area: the lowest at one of their vertices, 0 where there is none."""
    if not wanted.any():
        return np.zeros(0, dtype=np.int64)
    none = len(labels)
    at_vertex = np.full(int(corners.max()) + 1, none, dtype=np.int64)
    touched = np.zeros(len(at_vertex), dtype=np.bool_)
    touched[corners[wanted]] = True
    is_kept = np.zeros(len(labels), dtype=np.bool_)
    is_kept[kept] = True
    beside = np.flatnonzero(touched.take(corners)) // 3
    beside = beside[is_kept[beside]]
    np.minimum.at(at_vertex, corners[beside].ravel(), np.repeat(labels[beside], 3))
    found = at_vertex[corners[wanted]].min(axis=1)
    return np.where(found < none, found, 0)


def _by_area(labels: IntArray, areas: FloatArray) -> IntArray:
    used = np.flatnonzero(np.bincount(labels))
    order = np.argsort(-np.bincount(labels, areas)[used], kind="stable")
    rank = np.zeros(int(labels.max(initial=-1)) + 1, dtype=np.int64)
    rank[used[order]] = np.arange(len(used))
    return rank.take(labels)
