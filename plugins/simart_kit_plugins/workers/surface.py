"""The surface that a worker is sent: welded, and its faces in an order that others bear."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit import Mesh
from simart_kit.arrays import FloatArray, IntArray, frozen_floats, frozen_ints
from simart_kit.mesh import UpAxis, z_up_from
from simart_kit.segments import WELD_TOLERANCE
from simart_kit.topology import half_edges, shared_by_two, weld


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles without looks, and where they come from.

    Attributes:
        vertices: (V, 3), with `up` up.
        faces: (F, 3).
        face: (F,) face of the mesh that each face is; each once.
        up: which axis points up; the front of +y is +z, as in glTF.
    """

    vertices: FloatArray
    faces: IntArray
    face: IntArray
    up: UpAxis

    def canonical(self, vertices: FloatArray) -> FloatArray:
        """(N, 3) points of this surface's frame in the canonical frame."""
        return vertices @ z_up_from(self.up).T


def sent_surface(mesh: Mesh, up: UpAxis) -> Surface:
    """A mesh as others expect one.

    Vertices at UV seams are welded, or each seam would be a gap. Faces that share no edge with one other come
    first: P3-SAM's table of neighbours ends at the last face that has one.

    Args:
        mesh: in the canonical frame.
        up: which axis is to point up.
    """
    vertex = weld(mesh.vertices, mesh.diagonal * WELD_TOLERANCE)
    _, first = np.unique(vertex, return_index=True)
    corners = vertex[mesh.faces]
    half, edge = half_edges(corners)
    start = shared_by_two(edge)
    joined = np.zeros(len(corners), dtype=np.bool_)
    joined[half[start] // 3] = True
    joined[half[start + 1] // 3] = True
    order = np.argsort(joined, kind="stable")
    vertices = mesh.vertices[first] @ z_up_from(up)  # the inverse of a rotation, from the right
    return Surface(frozen_floats(vertices), frozen_ints(corners[order]), frozen_ints(order), up)
