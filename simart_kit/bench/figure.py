"""Figure: an Articulation as meshes that can be drawn, closed and open, parts in their colours."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..colors import BODY, Color, part_color
from ..mesh import Mesh
from ..normals import with_normals
from .articulation import Articulation
from .states import states, way

NO_PART: Color = (226, 226, 226)
"""Faces that belong to no part."""
_SPLATS = 8000  # points of a cloud that are drawn at most
_SPLAT_SIZE = 0.008  # of the cloud's diagonal
_TIPS = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=np.float64)
_SIDES = np.array(
    [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]], dtype=np.int64
)


@dataclass(frozen=True, eq=False)
class Figure:
    """What to draw of an object; links fixed to each other are one part.

    Attributes:
        surface: with normals, as given.
        closed: the same with no vertex in two parts, at rest; faces in the order of `surface`.
        opened: all joints at the end of their way.
        travels: whether these two differ.
        moves: (F,) whether a face belongs to a part that moves or is carried by one.
        paint: (F, 4) sRGB colour 0..1 of each face's part, and strength 1.
    """

    surface: Mesh
    closed: Mesh
    opened: Mesh
    travels: bool
    moves: BoolArray
    paint: FloatArray

    @property
    def unpainted(self) -> FloatArray:
        """(F, 4) as `paint`, all grey."""
        return np.tile(_paint(BODY), (len(self.paint), 1))

    @classmethod
    def of(
        cls, rigid: Articulation, numbers: Mapping[int, int] | None = None, like: Figure | None = None
    ) -> Figure:
        """Prepare an object for drawing.

        Args:
            rigid: z up, links fixed to each other taken together; of a cloud, at most 8000 points are taken.
            numbers: of the colour of each link that moves; the default is their order.
            like: a figure that may have the same surface; then its normals are taken over.
        """
        numbers = numbers or {link: number for number, link in enumerate(rigid.moving, start=1)}
        rigid = _as_surface(rigid)
        surface = smooth_surface(rigid, None if like is None else like.surface)
        closed, vertex_link = _taken_apart(surface, rigid.labels, len(rigid.links))
        travels = any(way(link.joint)[1] != 0.0 for link in rigid.links)
        opened = _posed(closed, vertex_link, states(rigid)[-1]) if travels else closed
        # The last rows are found by label -1.
        moving = np.array([link.joint.moves for link in rigid.links] + [False])
        paints = [_paint(part_color(numbers.get(link, 0))) for link in range(len(rigid.links))]
        colors = np.array([*paints, _paint(NO_PART)])
        return cls(surface, closed, opened, travels, moving[rigid.labels], colors[rigid.labels])


def smooth_surface(articulation: Articulation, known: Mesh | None) -> Mesh:
    """The surface with normals; `known` itself when it is that surface, for normals take a while."""
    if known is not None and len(known.faces) == len(articulation.faces):
        size = max(articulation.diagonal, 1e-12)
        if np.allclose(known.triangles, articulation.triangles, rtol=0, atol=1e-5 * size):
            return known
    return with_normals(Mesh(articulation.vertices, articulation.faces))


def _paint(color: Color) -> list[float]:
    return [*(value / 255.0 for value in color), 1.0]


def _taken_apart(mesh: Mesh, labels: IntArray, count: int) -> tuple[Mesh, IntArray]:
    """The mesh with vertices doubled where parts shared them, and the (V,) label of each, -1 for none."""
    keys = mesh.faces.astype(np.int64) * (count + 1) + (labels[:, None] + 1)
    used, faces = np.unique(keys, return_inverse=True)
    source, label = np.divmod(used, count + 1)
    return mesh.on_vertices(source, faces.reshape(-1, 3)), label - 1


def _posed(mesh: Mesh, vertex_link: IntArray, posed_T_rest: FloatArray) -> Mesh:
    """The mesh with each link where (L, 4, 4) motions take it."""
    assert mesh.normals is not None
    vertices, normals = mesh.vertices.copy(), mesh.normals.copy()
    for link in np.unique(vertex_link[vertex_link >= 0]):
        at = np.flatnonzero(vertex_link == link)
        turn, shift = posed_T_rest[link, :3, :3], posed_T_rest[link, :3, 3]
        vertices[at] = vertices[at] @ turn.T + shift
        normals[at] = normals[at] @ turn.T
    return replace(mesh, vertices=vertices, normals=normals)


def _as_surface(articulation: Articulation) -> Articulation:
    """A cloud as a surface of small octahedra; a surface as it is."""
    if not articulation.is_cloud:
        return articulation
    count = len(articulation.vertices)
    chosen = np.unique(np.linspace(0, count - 1, min(count, _SPLATS)).round().astype(np.int64))
    radius = _SPLAT_SIZE * max(articulation.diagonal, 1e-12)
    corners = articulation.vertices[chosen, None] + radius * _TIPS
    faces = _SIDES + len(_TIPS) * np.arange(len(chosen))[:, None, None]
    labels = np.repeat(articulation.labels[chosen], len(_SIDES))
    return replace(articulation, vertices=corners.reshape(-1, 3), faces=faces.reshape(-1, 3), labels=labels)
