"""Tangents for normal maps, by the method of MikkTSpace, which the tools that bake such maps follow.

http://www.mikktspace.com. Files without tangents leave them to each viewer.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray, IntArray, frozen_bytes, frozen_floats, frozen_ints, units
from simart_kit.surfaces import Surface


def with_tangents(surface: Surface) -> tuple[Surface, FloatArray]:
    """A surface that has texture coordinates, with (V, 4) tangents.

    The first three are the unit direction in which u grows, the last is -1 where the picture is mirrored,
    else 1. Vertices between faces of both sorts are doubled.
    """
    assert surface.uv is not None
    one, two = _sides(surface.uv[surface.faces])
    area = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
    used, faces = np.unique(surface.faces * 2 + (area < 0)[:, None], return_inverse=True)
    surface = _on_vertices(surface, used // 2, faces.reshape(-1, 3))
    edge, other = _sides(surface.vertices[surface.faces])
    along = np.sign(area)[:, None] * (edge * two[:, 1:] - other * one[:, 1:])
    tangents = _gathered(surface, along)
    return surface, np.column_stack([tangents, np.where(used % 2, -1.0, 1.0)])


def _gathered(surface: Surface, along: FloatArray) -> FloatArray:
    """(V, 3) unit mean of the faces' (F, 3) directions in the plane across each normal, weighted by angle."""
    result = np.zeros((len(surface.vertices), 3))
    normals = surface.normals[surface.faces]
    corners = surface.vertices[surface.faces]
    for corner in range(3):
        normal, here = normals[:, corner], corners[:, corner]
        after = units(_across(corners[:, (corner + 1) % 3] - here, normal))
        before = units(_across(corners[:, (corner + 2) % 3] - here, normal))
        angle = np.arccos(np.clip(np.einsum("ij,ij->i", after, before), -1.0, 1.0))
        np.add.at(result, surface.faces[:, corner], angle[:, None] * units(_across(along, normal)))
    result = units(_across(result, surface.normals))
    found = np.any(result != 0.0, axis=1, keepdims=True)
    return np.where(found, result, _any_across(surface.normals))


def _any_across(normals: FloatArray) -> FloatArray:
    """(N, 3) unit directions across (N, 3) unit normals, where the picture tells none."""
    axis = np.eye(3)[np.abs(normals).argmin(axis=1)]
    return units(_across(axis, normals))


def _across(vectors: FloatArray, normals: FloatArray) -> FloatArray:
    """(N, 3) vectors without their share along (N, 3) unit normals."""
    return np.asarray(vectors - normals * np.einsum("ij,ij->i", vectors, normals)[:, None])


def _sides(corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The sides of (F, 3, D) triangles from their first corner to the second and third."""
    return corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]


def _on_vertices(surface: Surface, source: IntArray, faces: IntArray) -> Surface:
    """The same surface on copies of its vertices."""
    return replace(
        surface,
        vertices=frozen_floats(surface.vertices[source]),
        normals=frozen_floats(surface.normals[source]),
        uv=None if surface.uv is None else frozen_floats(surface.uv[source]),
        colors=None if surface.colors is None else frozen_bytes(surface.colors[source]),
        faces=frozen_ints(faces),
    )
