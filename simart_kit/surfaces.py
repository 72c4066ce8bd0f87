"""Part surfaces: what an exporter draws, cut out of the Asset's one mesh."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .arrays import ByteArray, FloatArray, IntArray, frozen_bytes, frozen_floats, frozen_ints
from .asset import Asset
from .kept import kept
from .kinematics import rest_origin
from .mesh import Image, Mesh, VisualMaterial
from .normals import with_normals
from .topology import without_gaps


@dataclass(frozen=True, eq=False)
class Surface:
    """The faces of one part that share a material, in the part's frame.

    Attributes:
        part: name of the part.
        index: position among the part's surfaces.
        material: how it looks.
        vertices: (V, 3) [m].
        normals: (V, 3) unit.
        uv: (V, 2) origin bottom left, or None.
        colors: (V, 4) RGBA 0..255, or None.
        faces: (F, 3).
        source_faces: (F,) index of each face in the asset's mesh.
    """

    part: str
    index: int
    material: VisualMaterial
    vertices: FloatArray
    normals: FloatArray
    uv: FloatArray | None
    colors: ByteArray | None
    faces: IntArray
    source_faces: IntArray

    @property
    def picture(self) -> Image | None:
        """The texture of its base colour; None also where it has no coordinates to read one by."""
        return None if self.uv is None else self.material.base_color_image

    @property
    def translucent(self) -> bool:
        """Whether its texture, or without one its vertex colours, lets light through."""
        rgba = self.picture.pixels if self.picture else self.colors
        return rgba is not None and bool(rgba[..., 3].min() < 255)


@kept
def asset_surfaces(asset: Asset) -> Mapping[str, tuple[Surface, ...]]:
    """The surfaces of every part, by part name; at least one each."""
    mesh = with_normals(asset.mesh)
    result = {}
    for index, part in enumerate(asset.parts):
        faces = np.flatnonzero(asset.face_part == index)
        used = np.unique(mesh.face_material[faces])
        groups = [faces[mesh.face_material[faces] == material] for material in used]
        origin = rest_origin(asset, part.name)
        result[part.name] = tuple(_cut(mesh, part.name, i, group, origin) for i, group in enumerate(groups))
    return result


def _cut(mesh: Mesh, part: str, index: int, face_ids: IntArray, origin: FloatArray) -> Surface:
    used, faces = without_gaps(mesh.faces[face_ids])
    assert mesh.normals is not None
    return Surface(
        part=part,
        index=index,
        material=mesh.materials[int(mesh.face_material[face_ids[0]])],
        vertices=frozen_floats(mesh.vertices[used] - origin),
        normals=frozen_floats(mesh.normals[used]),
        uv=None if mesh.uv is None else frozen_floats(mesh.uv[used]),
        colors=None if mesh.colors is None else frozen_bytes(mesh.colors[used]),
        faces=frozen_ints(faces),
        source_faces=frozen_ints(face_ids),
    )
