"""Meshes: the surfaces of a part as the primitives of one mesh, in the part's frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from simart_kit.arrays import IntArray, units
from simart_kit.srgb import decoded
from simart_kit.surfaces import Surface

from .builder import INDICES, VERTICES, Builder, Json
from .materials import Look, has_texture, visible_colors
from .tangents import with_tangents


def add_mesh(
    builder: Builder, surfaces: tuple[Surface, ...], materials: Mapping[Look, int], two: bool
) -> int:
    """Add a part's mesh, a primitive a material.

    Args:
        builder: of the file.
        surfaces: of the part.
        materials: index of each look.
        two: whether both sides of the part's faces are drawn.
    """
    primitives = [_primitive(builder, s, materials[s.material, two]) for s in surfaces]
    return builder.add("meshes", {"name": surfaces[0].part, "primitives": primitives})


def add_indices(builder: Builder, faces: IntArray, vertex_count: int) -> int:
    """Add the corners of (F, 3) faces; 16 bits where they are enough, since 65535 is no vertex in glTF."""
    kind = np.uint16 if vertex_count <= 65535 else np.uint32
    return builder.add_array(faces.ravel().astype(kind), INDICES)


def _primitive(builder: Builder, surface: Surface, material: int) -> Json:
    attributes = {}
    surface = replace(surface, normals=units(surface.normals, otherwise=(0.0, 1.0, 0.0)))
    if surface.uv is not None and surface.material.normal_image:
        surface, tangents = with_tangents(surface)
        attributes["TANGENT"] = builder.add_array(tangents.astype(np.float32), VERTICES)
    points, normals = surface.vertices.astype(np.float32), surface.normals.astype(np.float32)
    attributes["POSITION"] = builder.add_array(points, VERTICES, bounds=True)
    attributes["NORMAL"] = builder.add_array(normals, VERTICES)
    if surface.uv is not None and has_texture(surface):
        uv = surface.uv * [1.0, -1.0] + [0.0, 1.0]  # v counts from the top
        attributes["TEXCOORD_0"] = builder.add_array(uv.astype(np.float32), VERTICES)
    if surface.colors is not None and visible_colors(surface):
        # Linear light, as glTF has it; 16 bits, as 8 are too few for dark colours.
        colors = np.rint(decoded(surface.colors) * 65535.0).astype(np.uint16)
        attributes["COLOR_0"] = builder.add_array(colors, VERTICES, unit=True)
    indices = add_indices(builder, surface.faces, len(surface.vertices))
    return {"attributes": attributes, "indices": indices, "material": material}
