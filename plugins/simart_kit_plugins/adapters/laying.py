"""Laying labels of one surface onto the faces of another, and giving a label to faces without one."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.bench.articulation import Articulation
from simart_kit.bench.frame import same_faces
from simart_kit.segments import WELD_TOLERANCE
from simart_kit.topology import neighbours, weld

from .placing import bare

if TYPE_CHECKING:
    from simart_kit import Mesh

_SAMPLES, _LEAST = 80_000, 1000  # points of a labelled surface: in all, and of each label
_FINER = (0.01, 0.05)  # of the diagonal: faces with longer edges are asked at 4 and at 16 places


def laid(found: Articulation, mesh: Mesh) -> IntArray:
    """(F,) labels of an object on the faces of the mesh that it lies on; -1 where it says nothing.

    A face that both share takes its label; others take what most of the places in them are nearest to.
    """
    partner = same_faces(bare(mesh), found)
    if partner is not None:
        return found.labels[partner]
    from simart_kit.bench.overlay import labels_there
    from simart_kit.bench.sampling import Cloud, Samples, sampled

    face, points = _places(mesh)
    cloud = Cloud(points, np.zeros(len(points), dtype=np.int32), np.ones(len(points)))
    own = Samples(cloud, mesh.triangles[face], mesh.face_normals[face])
    among = sampled(found, found.labels, _SAMPLES, _LEAST, 0)
    size = float((mesh.bounds[1] - mesh.bounds[0]).max())
    return _majority(face, labels_there(own, among, size), len(mesh.faces))


def filled(labels: IntArray, mesh: Mesh) -> IntArray:
    """(F,) labels with every -1 replaced by that of the nearest labelled face along the surface.

    Faces that share vertices come first, as those of one smooth patch do, then all that meet at an edge.
    Pieces without any label take that of the face nearest in space.

    Args:
        labels: (F,), at least one of them 0 or more.
        mesh: whose faces they are.
    """
    result = np.array(labels)
    for corners in (mesh.faces, weld(mesh.vertices, mesh.diagonal * WELD_TOLERANCE)[mesh.faces]):
        if (result < 0).any():
            result = _spread(result, corners, mesh)
    lost, known = np.flatnonzero(result < 0), np.flatnonzero(result >= 0)
    if len(lost):
        from scipy.spatial import cKDTree

        middles = mesh.triangles.mean(axis=1)
        result[lost] = result[known[cKDTree(middles[known]).query(middles[lost])[1]]]
    return result


def _spread(labels: IntArray, corners: IntArray, mesh: Mesh) -> IntArray:
    """(F,) labels, those of -1 by the nearest labelled face that (F, 3) `corners` connect them to."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import dijkstra

    middles = mesh.triangles.mean(axis=1)
    _, one, two = neighbours(corners)
    steps = np.linalg.norm(middles[one] - middles[two], axis=1) + mesh.diagonal * 1e-9  # 0 would be no edge
    graph = coo_array((steps, (one, two)), shape=(len(labels), len(labels))).tocsr()
    known = np.flatnonzero(labels >= 0)
    _, _, source = dijkstra(graph, directed=False, indices=known, min_only=True, return_predecessors=True)
    return np.where(source >= 0, labels[np.maximum(source, 0)], labels)


def on_faces(found: Articulation, mesh: Mesh) -> tuple[Articulation, int]:
    """The mesh with the parts of an object that lies on it, and how many faces it said nothing of."""
    labels = laid(found, mesh)
    missing = int((labels < 0).sum())
    return replace(found, vertices=mesh.vertices, faces=mesh.faces, labels=filled(labels, mesh)), missing


def _places(mesh: Mesh) -> tuple[IntArray, FloatArray]:
    """(N,) faces and (N, 3) places in them: 1, 4 or 16 in each, by its size."""
    edges = np.linalg.norm(mesh.triangles - np.roll(mesh.triangles, 1, axis=1), axis=2).max(axis=1)
    level = np.searchsorted(np.array(_FINER) * mesh.diagonal, edges)
    faces, points = [], []
    for number in range(len(_FINER) + 1):
        here = np.flatnonzero(level == number)
        weights = _middles(number)
        faces.append(np.repeat(here, len(weights)))
        points.append(np.einsum("pc,fcx->fpx", weights, mesh.triangles[here]).reshape(-1, 3))
    return np.concatenate(faces), np.concatenate(points)


def _middles(level: int) -> FloatArray:
    """(4**level, 3) barycentric middles of a triangle's quarters, and of their quarters."""
    triangles = np.eye(3)[None]
    for _ in range(level):
        a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = np.concatenate([np.stack(quarter, axis=1) for quarter in quarters])
    return np.asarray(triangles.mean(axis=1))


def _majority(face: IntArray, labels: IntArray, count: int) -> IntArray:
    """(count,) most frequent of (N,) labels of each face; of equals the lowest."""
    columns = int(labels.max(initial=-1)) + 2
    keys, votes = np.unique(face.astype(np.int64) * columns + labels + 1, return_counts=True)
    order = np.lexsort((keys, -votes))
    owner = keys[order] // columns
    first = np.unique(owner, return_index=True)[1]
    result = np.full(count, -1)
    result[owner[first]] = keys[order][first] % columns - 1
    return result
