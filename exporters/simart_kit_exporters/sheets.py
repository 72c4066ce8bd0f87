"""A back for flat surfaces: simulators refuse meshes without volume, even those that are only drawn."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray, IntArray, frozen_floats, frozen_ints
from simart_kit.asset import ConvexMesh
from simart_kit.bounds import bounds_of
from simart_kit.kept import kept
from simart_kit.surfaces import Surface
from simart_kit.triangles import areas, crosses, lengths

# MuJoCo refuses meshes of less than 1e-15 m^3; MIN_AREA is a speck of 0.03 mm, too small to see or to back.
MIN_VOLUME = 1e-14
MIN_AREA = 1e-9
# Less thick than this share of how far it reaches, a surface is flat: files have 8 decimals.
FLAT = 1e-6
THICKNESS = 1e-4
"""How far behind a flat surface its back is, as a fraction of the surface's diagonal."""


@kept
def is_speck(surface: Surface) -> bool:
    """Whether a surface is too small to draw."""
    return float(areas(surface.vertices[surface.faces]).sum()) < MIN_AREA


@kept
def backed(surface: Surface) -> Surface:
    """The surface itself, or with a back where it is flat: its faces turned round, a little behind it."""
    step = _step_back(surface.vertices, surface.faces)
    if step is None:
        return surface
    return replace(
        surface,
        vertices=frozen_floats(np.concatenate([surface.vertices, surface.vertices + step])),
        normals=frozen_floats(np.concatenate([surface.normals, -surface.normals])),
        uv=None if surface.uv is None else frozen_floats(np.concatenate([surface.uv, surface.uv])),
        faces=_two_sided(surface.faces, len(surface.vertices)),
    )


def backed_hull(hull: ConvexMesh) -> ConvexMesh:
    """The shape itself, or a thin slab where it is flat."""
    step = _step_back(hull.vertices, hull.faces)
    if step is None:
        return hull
    vertices = np.concatenate([hull.vertices, hull.vertices + step])
    return ConvexMesh(vertices, _two_sided(hull.faces, len(hull.vertices)))


def _two_sided(faces: IntArray, shift: int) -> IntArray:
    return frozen_ints(np.concatenate([faces, faces[:, ::-1] + shift]))


def _step_back(vertices: FloatArray, faces: IntArray) -> FloatArray | None:
    """(3,) way to the back of a surface [m]; None when it has volume."""
    corners = vertices[faces]
    cross = crosses(corners)
    area = 0.5 * lengths(cross)
    total = max(float(area.sum()), MIN_AREA)
    centroids = corners.mean(axis=1)
    middle = area @ centroids / total
    # The volume of the pyramids from the middle to every face, as MuJoCo measures open meshes.
    volume = np.abs(np.einsum("ij,ij->i", cross, centroids - middle)).sum() / 6
    ends = np.array(bounds_of(corners.reshape(-1, 3)))
    diagonal = float(np.linalg.norm(ends[1] - ends[0]))
    reach = max(diagonal, float(np.abs(ends).max()))
    if volume > max(MIN_VOLUME, FLAT * reach * area.sum()):
        return None
    normal = cross[area.argmax()] / max(2 * area.max(), MIN_AREA)
    return np.asarray(-normal * max(THICKNESS * diagonal, 6 * MIN_VOLUME / total))
