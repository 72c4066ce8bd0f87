"""How the faces of a surface follow each other: across which edges, and how sharply it turns there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.mesh import Mesh
from simart_kit.segments import WELD_TOLERANCE
from simart_kit.topology import half_edges, weld
from simart_kit.triangles import cosines, lengths


@dataclass(frozen=True, eq=False)
class Links:
    """Pairs of faces that share an edge; vertices at one place count as one.

    Attributes:
        left, right: (L,) ids of the two faces.
        length: (L,) of the edge [m].
        ways: (L,) between the faces' middles, over the middle of the edge [m].
        turn: (L,) angle between their normals [rad], positive where the surface is concave.
    """

    left: IntArray
    right: IntArray
    length: FloatArray
    ways: FloatArray
    turn: FloatArray

    def at(self, some: IntArray) -> Links:
        """Only (M,) of the links."""
        return Links(self.left[some], self.right[some], self.length[some], self.ways[some], self.turn[some])


def links(mesh: Mesh) -> Links:
    """Link the faces of a mesh at each edge that several of them share."""
    faces = weld(mesh.vertices, mesh.diagonal * WELD_TOLERANCE).take(mesh.faces)
    half, edge = half_edges(faces)
    same = np.flatnonzero(edge[1:] == edge[:-1])
    one = half.take(same)
    left, right = one // 3, half.take(same + 1) // 3
    start = mesh.vertices.take(mesh.faces[left, one % 3], axis=0)
    end = mesh.vertices.take(mesh.faces[left, (one + 1) % 3], axis=0)
    middle = mesh.triangles.mean(axis=1)
    here, there, between = middle.take(left, axis=0), middle.take(right, axis=0), (start + end) / 2
    angle = np.arccos(np.clip(cosines(mesh.face_normals, left, right), -1, 1))
    rises = np.einsum("ij,ij->i", there - here, mesh.face_normals.take(left, axis=0)) > 0
    ways = lengths(between - here) + lengths(there - between)
    return Links(left, right, lengths(end - start), ways, np.where(rises, angle, -angle))
