"""Faces halved at some of their edges, with all that meet there, so that no corner hangs in an edge."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray, IntArray, units
from simart_kit.mesh import Mesh
from simart_kit.segments import WELD_TOLERANCE
from simart_kit.srgb import decoded, encoded
from simart_kit.topology import edges, weld

from .region import Region


@dataclass(frozen=True, eq=False)
class Pieces:
    """Faces of a mesh, some of them divided.

    Attributes:
        mesh: the vertices of the undivided one come first.
        vertex: (V,) ids that vertices at one place share.
        ends: (M, 2) the vertices between which each of the M new ones lies half-way.
        parent: (F,) face of the step before that each face is a piece of.
        source: (F,) face of the whole mesh that it is a piece of.
        weights: (F, 3, 3) barycentric weights of each corner in that face.
    """

    mesh: Mesh
    vertex: IntArray
    ends: IntArray
    parent: IntArray
    source: IntArray
    weights: FloatArray


def undivided(region: Region) -> Pieces:
    """Some faces of a mesh as they are."""
    mesh, count = region.mesh, len(region.face)
    none = np.zeros((0, 2), dtype=np.int64)
    vertex = weld(mesh.vertices, mesh.diagonal * WELD_TOLERANCE)
    return Pieces(mesh, vertex, none, np.arange(count), region.face, np.tile(np.eye(3), (count, 1, 1)))


def halved(pieces: Pieces, sides: BoolArray) -> Pieces:
    """Divide faces at the middles of (F, 3) sides, from each corner to the next, and their neighbours there.

    The pieces of a face stand in its place.
    """
    mesh, faces = pieces.mesh, pieces.mesh.faces
    shared = edges(pieces.vertex[faces])
    split = np.zeros(int(shared.max()) + 1, dtype=np.bool_)
    split[shared[sides]] = True
    sides = split[shared]
    # Both copies of an edge at a seam of the texture get a middle of their own, with one welded id.
    _, first, middle = np.unique(edges(faces)[sides], return_index=True, return_inverse=True)
    face, side = (index[first] for index in np.nonzero(sides))
    ends = np.stack([faces[face, side], faces[face, (side + 1) % 3]], axis=1)
    middles = np.full(faces.shape, -1, dtype=np.int64)
    middles[sides] = len(mesh.vertices) + middle.reshape(-1)
    vertex = np.concatenate([pieces.vertex, int(pieces.vertex.max()) + 1 + shared[face, side]])
    parent, corner = _pieces(mesh.vertices, faces, sides)
    six = np.concatenate([faces, middles], axis=1)
    weights = pieces.weights[parent]
    both = np.concatenate([weights, (weights + np.roll(weights, -1, axis=1)) / 2], axis=1)
    return Pieces(
        _with_middles(mesh, ends, np.take_along_axis(six[parent], corner, axis=1), parent),
        vertex,
        np.concatenate([pieces.ends, ends]),
        parent,
        pieces.source[parent],
        np.take_along_axis(both, corner[:, :, None], axis=1),
    )


def _pieces(vertices: FloatArray, faces: IntArray, sides: BoolArray) -> tuple[IntArray, IntArray]:
    """(G,) face of each piece, and (G, 3) its corners: 0..2 are the face's, 3..5 the middles of its sides."""
    count = sides.sum(axis=1)
    # The corner from which the case is the one below.
    one, two = sides.argmax(axis=1), (sides.argmin(axis=1) + 1) % 3
    turn = np.where(count == 1, one, np.where(count == 2, two, 0))
    rows = np.arange(len(faces))
    a, b, c = (vertices[faces[rows, (turn + step) % 3]] for step in range(3))
    short = np.linalg.norm((b + c) / 2 - a, axis=1) < np.linalg.norm((a + b) / 2 - c, axis=1)
    cases = (
        (count == 0, ((0, 1, 2),)),
        (count == 1, ((0, 3, 2), (3, 1, 2))),
        ((count == 2) & short, ((3, 1, 4), (0, 3, 4), (0, 4, 2))),
        ((count == 2) & ~short, ((3, 1, 4), (0, 3, 2), (3, 4, 2))),
        (count == 3, ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))),
    )
    parents, corners = [], []
    for chosen, pattern in cases:
        face = np.flatnonzero(chosen)
        corner = np.array(pattern)
        parents.append(np.repeat(face, len(pattern)))
        turned = (corner % 3 + turn[face, None, None]) % 3 + 3 * (corner >= 3)
        corners.append(turned.reshape(-1, 3))
    parent = np.concatenate(parents)
    order = np.argsort(parent, kind="stable")
    return parent[order], np.concatenate(corners)[order]


def _with_middles(mesh: Mesh, ends: IntArray, faces: IntArray, parent: IntArray) -> Mesh:
    """The mesh with a vertex half-way between each two `ends` (M, 2), and (G, 3) faces from their parents."""
    one, two = ends.T
    normals, uv, colors = mesh.normals, mesh.uv, mesh.colors
    if normals is not None:
        normals = np.concatenate([normals, units(normals[one] + normals[two], otherwise=(0.0, 0.0, 1.0))])
    if uv is not None:
        uv = np.concatenate([uv, (uv[one] + uv[two]) / 2])
    if colors is not None:  # light is what renderers interpolate
        light = (decoded(colors[one]) + decoded(colors[two])).astype(np.float64) / 2
        colors = np.concatenate([colors, encoded(light)])
    return replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, (mesh.vertices[one] + mesh.vertices[two]) / 2]),
        faces=faces,
        normals=normals,
        uv=uv,
        colors=colors,
        face_material=mesh.face_material[parent],
        face_node=None if mesh.face_node is None else mesh.face_node[parent],
    )
