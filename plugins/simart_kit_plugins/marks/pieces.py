"""Pieces fine enough that none mixes two parts, and few enough that each can bear a number in a picture."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray, frozen_ints
from simart_kit.mesh import Mesh
from simart_kit.segments import WELD_TOLERANCE
from simart_kit.sweeping import sample_surface
from simart_kit.topology import connected, half_edges, shared_by_two, weld
from simart_kit.triangles import cosines

_POINTS = 20  # sampled on a piece, and about as many of its corners, to find what it is next to
# Nearer than this share of the diagonal is as near as touching: of such neighbours the smallest is joined.
_TOUCH = 0.004
_CLOSELY = 250  # pieces that are joined one by one; smaller ones join the nearest of these at once


def numbered_pieces(mesh: Mesh, proposed: IntArray, most: int, crease: float = np.pi) -> IntArray:
    """Pieces to number in pictures.

    Args:
        mesh: in the canonical frame.
        proposed: (F,) labels 0.. of a segmenter.
        most: of pieces; beyond, the smallest are joined with what they are next to.
        crease: edges sharper than this bound pieces as well [rad]; pi: none does.

    Returns:
        (F,) int32 pieces 0..N-1, largest first.
    """
    coarse = _by_area(proposed, mesh.face_areas)
    fine = _by_area(split(mesh, coarse, crease, most), mesh.face_areas)
    return frozen_ints(_by_area(joined(mesh, fine, most), mesh.face_areas))


def split(mesh: Mesh, labels: IntArray, crease: float, most: int) -> IntArray:
    """Cut labels where their faces share no edge of two, or only a sharp one.

    Those that come apart into the fewest are cut first, as long as there are no more than `most` in all: what
    comes apart into a great many is a mesh whose faces are not joined, and no piece of several parts.

    Args:
        mesh: of the faces.
        labels: (F,) ids 0..N-1.
        crease: angle of a sharp edge [rad].
        most: of pieces in all.

    Returns:
        (F,) ids 0..
    """
    corners = weld(mesh.vertices, mesh.diagonal * WELD_TOLERANCE)[mesh.faces]
    half, edge = half_edges(corners)
    first = shared_by_two(edge)
    left, right = half[first] // 3, half[first + 1] // 3
    flat = cosines(mesh.face_normals, left, right) >= np.cos(crease) - 1e-12
    same = flat & (labels[left] == labels[right])
    fine = connected(len(labels), left[same], right[same])
    _, one = np.unique(fine, return_index=True)
    more = np.bincount(labels[one]) - 1  # pieces that cutting a label adds
    order = np.argsort(more, kind="stable")
    cut = np.zeros(len(more), dtype=np.bool_)
    cut[order] = len(more) + np.cumsum(more[order]) <= most
    return np.where(cut[labels], len(more) + fine, labels)


def joined(mesh: Mesh, labels: IntArray, most: int) -> IntArray:
    """(F,) labels of at most so many pieces: again and again the smallest joins what it is next to.

    Args:
        mesh: of the faces.
        labels: (F,) ids 0..N-1, largest first.
        most: of pieces, at least 1.
    """
    count = int(labels.max()) + 1
    if count <= most:
        return labels
    points, owner = _samples(mesh, labels, count)
    if count > max(most, _CLOSELY):
        labels, owner = _crumbs_joined(labels, points, owner, max(most, _CLOSELY))
        count = max(most, _CLOSELY)
    gap = _gaps(points, owner, count)
    areas = np.bincount(labels, mesh.face_areas, count)
    into = np.arange(count)  # the piece that each belongs to by now
    for _ in range(count - most):
        alive = np.flatnonzero(into == np.arange(count))
        small = int(alive[np.argmin(areas[alive])])
        others = alive[alive != small]
        reach = max(_TOUCH * mesh.diagonal, 1.5 * float(gap[small, others].min()))
        close = others[gap[small, others] <= reach]
        other = int(close[np.argmin(areas[close])])
        into[into == small] = other
        areas[other] += areas[small]
        gap[other] = gap[:, other] = np.minimum(gap[other], gap[small])
    return np.asarray(into[labels])


def _gaps(points: FloatArray, owner: IntArray, count: int) -> FloatArray:
    """(N, N) least distance of the points of two pieces.

    Args:
        points: (K, 3).
        owner: (K,) piece of each, 0..N-1.
        count: N.
    """
    from scipy.spatial.distance import cdist

    order = np.argsort(owner, kind="stable")
    sizes = np.bincount(owner, minlength=count)
    place = np.arange(len(order)) - np.repeat(np.cumsum(sizes) - sizes, sizes)  # within the own piece
    kept = place % np.repeat(-(-sizes // (2 * _POINTS)), sizes) == 0
    points = points[order[kept]]
    ends = np.cumsum(np.bincount(owner[order[kept]], minlength=count))
    starts = np.concatenate([[0], ends[:-1]])
    rows = [
        np.minimum.reduceat(cdist(points[start:end], points).min(axis=0), starts)
        for start, end in zip(starts, ends, strict=True)
    ]
    return np.stack(rows)


def _crumbs_joined(
    labels: IntArray, points: FloatArray, owner: IntArray, most: int
) -> tuple[IntArray, IntArray]:
    """Labels of faces, and of points, when all but the first so many pieces join the nearest of these."""
    from scipy.spatial import cKDTree

    large = owner < most
    found, index = cKDTree(points[large]).query(points[~large])
    distance = np.asarray(found)
    crumb, target = owner[~large], owner[large][index]
    order = np.lexsort((distance, crumb))
    pieces, first = np.unique(crumb[order], return_index=True)
    into = np.arange(int(owner.max()) + 1)
    into[pieces] = target[order][first]
    return into[labels], into[owner]


def _samples(mesh: Mesh, labels: IntArray, count: int) -> tuple[FloatArray, IntArray]:
    """(N, 3) points on all pieces and the (N,) piece of each; of each piece its corners, or some, too."""
    rng = np.random.default_rng(0)
    order = np.argsort(labels, kind="stable")
    points, owner = [], []
    for piece, faces in enumerate(np.split(order, np.cumsum(np.bincount(labels, minlength=count))[:-1])):
        triangles = mesh.triangles[faces]
        corners = triangles.reshape(-1, 3)
        step = max(1, -(-len(corners) // _POINTS))
        own = np.concatenate([sample_surface(triangles, _POINTS, rng), corners[::step]])
        points.append(own)
        owner.append(np.full(len(own), piece))
    return np.concatenate(points), np.concatenate(owner)


def _by_area(labels: IntArray, areas: FloatArray) -> IntArray:
    """(F,) the same pieces as 0..N-1, largest first."""
    _, which = np.unique(labels, return_inverse=True)
    order = np.argsort(-np.bincount(which, areas), kind="stable")
    rank = np.zeros(len(order), dtype=np.int64)
    rank[order] = np.arange(len(order))
    return rank[which]


def faces_of(piece: IntArray, members: tuple[int, ...]) -> BoolArray:
    """(F,) whether each face is of one of some pieces."""
    return np.asarray(np.isin(piece, members))
