"""Some faces of a mesh as a mesh of their own, and what was made of them back in the whole."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from simart_kit.arrays import IntArray
from simart_kit.mesh import Mesh

T = TypeVar("T", bound=np.generic)


@dataclass(frozen=True, eq=False)
class Region:
    """Some faces of a mesh.

    Attributes:
        mesh: they alone, on the vertices that they use.
        face: (R,) their ids in the whole.
        vertex: (U,) the ids of its vertices in the whole.
    """

    mesh: Mesh
    face: IntArray
    vertex: IntArray


def region_of(mesh: Mesh, face: IntArray) -> Region:
    """Take out (R,) faces."""
    vertex, corners = np.unique(mesh.faces[face], return_inverse=True)
    small = replace(
        mesh,
        vertices=mesh.vertices[vertex],
        faces=corners.reshape(-1, 3),
        normals=None if mesh.normals is None else mesh.normals[vertex],
        uv=None if mesh.uv is None else mesh.uv[vertex],
        colors=None if mesh.colors is None else mesh.colors[vertex],
        face_material=mesh.face_material[face],
        face_node=None if mesh.face_node is None else mesh.face_node[face],
    )
    return Region(small, face, vertex)


def put_back(whole: Mesh, region: Region, made: Mesh, source: IntArray) -> tuple[Mesh, IntArray, IntArray]:
    """The whole mesh with the region replaced by what was made of it.

    Args:
        whole: what the region was taken from; its vertices stay as they are.
        region: of it.
        made: whose first vertices are the region's.
        source: (G,) face of the whole that each face of `made` is a piece of.

    Returns:
        The mesh; (H,) source of each of its faces, ascending; and (H,) which of the whole's faces, or beyond
        their number which of those made, each is.
    """
    old, first = len(region.vertex), len(whole.vertices)
    place = np.concatenate([region.vertex, first + np.arange(len(made.vertices) - old)])
    kept = np.delete(np.arange(len(whole.faces)), region.face)
    every = np.concatenate([kept, source])
    order = np.argsort(every, kind="stable")
    faces = np.concatenate([whole.faces[kept], place[made.faces]])[order]
    row = np.concatenate([kept, len(whole.faces) + np.arange(len(source))])[order]
    mesh = replace(
        whole,
        vertices=np.concatenate([whole.vertices, made.vertices[old:]]),
        faces=faces,
        normals=_more(whole.normals, made.normals, old),
        uv=_more(whole.uv, made.uv, old),
        colors=_more(whole.colors, made.colors, old),
        face_material=whole.face_material[every[order]],
        face_node=None if whole.face_node is None else whole.face_node[every[order]],
    )
    return mesh, every[order], row


def _more(values: NDArray[T] | None, others: NDArray[T] | None, old: int) -> NDArray[T] | None:
    """All values of the whole's vertices, then those of the new ones."""
    return None if values is None or others is None else np.concatenate([values, others[old:]])
