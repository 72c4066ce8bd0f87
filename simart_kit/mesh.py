"""Mesh: the surface a run starts from, with its look, in a frame that it names."""

from __future__ import annotations

import io
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from .arrays import (
    BoolArray,
    ByteArray,
    FloatArray,
    IntArray,
    frozen_bytes,
    frozen_floats,
    frozen_ints,
    units,
)
from .errors import BadInputError
from .topology import occurring
from .triangles import areas_and_normals

UpAxis = Literal["+x", "-x", "+y", "-y", "+z", "-z"]

# Rotations that bring a file's up axis to +Z. For "+y" this is glTF's (x, y, z) -> (x, -z, y), which also
# turns glTF's front (+Z) to ours (-Y). The others keep as many directions in place as they can.
_TO_Z_UP: dict[str, list[list[int]]] = {
    "+y": [[1, 0, 0], [0, 0, -1], [0, 1, 0]],
    "-y": [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
    "+z": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "-z": [[1, 0, 0], [0, -1, 0], [0, 0, -1]],
    "+x": [[0, 0, -1], [0, 1, 0], [1, 0, 0]],
    "-x": [[0, 0, 1], [0, 1, 0], [-1, 0, 0]],
}


@dataclass(frozen=True, eq=False)
class Image:
    """A picture kept as the PNG file that exporters write.

    Attributes:
        png: bytes of an 8-bit PNG file.
    """

    png: bytes

    @cached_property
    def pixels(self) -> ByteArray:
        """(H, W, 4) RGBA values, 0..255; row 0 is the top of the picture."""
        from PIL import Image as Pillow

        with Pillow.open(io.BytesIO(self.png)) as picture:
            return frozen_bytes(np.asarray(picture.convert("RGBA")))

    @classmethod
    def from_pixels(cls, pixels: ByteArray) -> Image:
        """Encode (H, W, 3 or 4) values 0..255."""
        from PIL import Image as Pillow

        buffer = io.BytesIO()
        # Level 1: photographs shrink little more at higher levels and take ten times as long.
        Pillow.fromarray(np.asarray(pixels, dtype=np.uint8)).save(buffer, "PNG", compress_level=1)
        return cls(buffer.getvalue())


@dataclass(frozen=True, eq=False)
class VisualMaterial:
    """How a surface looks: the glTF 2.0 metallic-roughness model.

    Attributes:
        name: name in the source file, made unique.
        base_color: linear RGBA factor, 0..1; multiplies `base_color_image`.
        metallic: 0 (dielectric) .. 1 (metal); multiplies blue of `metallic_roughness_image`.
        roughness: 0 (mirror) .. 1 (matte); multiplies green of `metallic_roughness_image`.
        base_color_image: sRGB texture, or None.
        metallic_roughness_image: linear texture, green roughness and blue metallic, or None.
        normal_image: tangent-space normals (OpenGL convention, +Y up), or None.
    """

    name: str = "default"
    base_color: tuple[float, float, float, float] = (0.8, 0.8, 0.8, 1.0)
    metallic: float = 0.0
    roughness: float = 0.6
    base_color_image: Image | None = None
    metallic_roughness_image: Image | None = None
    normal_image: Image | None = None


@dataclass(frozen=True)
class Note:
    """Something a person should know about a run.

    Attributes:
        stage: where it was noticed, such as "load" or "mass".
        level: "info" for a decision, "warning" for something lost or doubtful.
        text: one sentence.
    """

    stage: str
    level: Literal["info", "warning"]
    text: str


@dataclass(frozen=True, eq=False)
class Mesh:
    """A triangle mesh with materials; arrays are read-only and checked on construction.

    Attributes are one value a vertex, as in glTF: vertices at a UV seam stand twice. Faces are never dropped
    or re-ordered, so labels a face made by others stay valid.

    Attributes:
        vertices: (V, 3) positions, in units of `metres_per_unit`.
        faces: (F, 3) vertex indices, counter-clockwise from outside.
        normals: (V, 3) unit normals, or None: computed from the faces, creases kept.
        uv: (V, 2) texture coordinates, origin bottom left (OBJ, USD), or None.
        colors: (V, 4) RGBA 0..255, sRGB, or None.
        materials: at least one.
        face_material: (F,) index into `materials`.
        face_node: (F,) scene-graph node of each face, a hint for segmenters, or None.
        up: axis of the frame that points up; "+z" in the canonical frame.
        metres_per_unit: length of a unit [m]; None when the file format does not say.
        notes: what the loader decided or had to leave out.

    Raises:
        BadInputError: no face, an index out of range, a value that is not finite, or an array of wrong shape.
    """

    vertices: FloatArray
    faces: IntArray
    normals: FloatArray | None = None
    uv: FloatArray | None = None
    colors: ByteArray | None = None
    materials: tuple[VisualMaterial, ...] = (VisualMaterial(),)
    face_material: IntArray = field(default_factory=lambda: frozen_ints([]))
    face_node: IntArray | None = None
    up: UpAxis = "+z"
    metres_per_unit: float | None = 1.0
    notes: tuple[Note, ...] = ()

    def __post_init__(self) -> None:
        _check_faces(np.asarray(self.vertices), np.asarray(self.faces))
        set_field = object.__setattr__
        set_field(self, "vertices", frozen_floats(self.vertices))
        set_field(self, "faces", frozen_ints(self.faces))
        if not len(self.face_material):
            set_field(self, "face_material", frozen_ints(np.zeros(len(self.faces))))
        for name, freeze, rows, columns in (
            ("normals", frozen_floats, len(self.vertices), 3),
            ("uv", frozen_floats, len(self.vertices), 2),
            ("colors", frozen_bytes, len(self.vertices), 4),
            ("face_material", frozen_ints, len(self.faces), 0),
            ("face_node", frozen_ints, len(self.faces), 0),
        ):
            values = getattr(self, name)
            if values is not None:
                set_field(self, name, freeze(values))
                _check_shape(name, getattr(self, name).shape, (rows, columns) if columns else (rows,))
                if not np.isfinite(getattr(self, name)).all():
                    raise BadInputError(f"{name} holds values that are NaN or infinite")
        if self.up not in get_args(UpAxis):
            raise BadInputError(f"up axis '{self.up}': use one of {', '.join(get_args(UpAxis))}")
        if self.face_material.min() < 0 or self.face_material.max() >= len(self.materials):
            raise BadInputError(f"face_material must lie in 0..{len(self.materials) - 1}")

    @cached_property
    def triangles(self) -> FloatArray:
        """(F, 3, 3) corner positions."""
        return frozen_floats(self.vertices.take(self.faces, axis=0))

    @cached_property
    def face_areas(self) -> FloatArray:
        """(F,) areas, in square units."""
        return self._areas_and_normals[0]

    @cached_property
    def face_normals(self) -> FloatArray:
        """(F, 3) unit normals; zero for a face without area."""
        return self._areas_and_normals[1]

    @cached_property
    def _areas_and_normals(self) -> tuple[FloatArray, FloatArray]:
        areas, normals = areas_and_normals(self.vertices, self.faces)
        areas.setflags(write=False)
        normals.setflags(write=False)
        return areas, normals

    @cached_property
    def bounds(self) -> FloatArray:
        """(2, 3) lower and upper corner of the vertices that faces use."""
        used = np.zeros(len(self.vertices), dtype=np.bool_)
        used[self.faces] = True
        columns = self.vertices.compress(used, axis=0).T
        return frozen_floats([[column.min() for column in columns], [column.max() for column in columns]])

    @property
    def diagonal(self) -> float:
        """Length of the bounding box's diagonal, in units."""
        return float(np.linalg.norm(self.bounds[1] - self.bounds[0]))

    def points_of(self, faces: BoolArray) -> FloatArray:
        """(N, 3) the vertices that the faces which (F,) marks use, each once."""
        return self.vertices[occurring(self.faces[faces])]

    def transformed(self, new_from_old: FloatArray) -> Mesh:
        """The mesh moved by a (4, 4) similarity; normals are turned with it."""
        matrix = np.asarray(new_from_old, dtype=np.float64)
        vertices = self.vertices @ matrix[:3, :3].T + matrix[:3, 3]
        normals = self.normals
        if normals is not None:
            normals = units(normals @ np.linalg.inv(matrix[:3, :3]))
        return replace(self, vertices=vertices, normals=normals)

    def on_vertices(self, source: IntArray, faces: IntArray) -> Mesh:
        """The same surface on other vertices: (W,) the one each is copied from, and (F, 3) faces on them."""
        return replace(
            self,
            vertices=self.vertices[source],
            faces=faces,
            normals=None if self.normals is None else self.normals[source],
            uv=None if self.uv is None else self.uv[source],
            colors=None if self.colors is None else self.colors[source],
        )


def z_up_from(up: UpAxis) -> FloatArray:
    """(3, 3) rotation that brings a frame with this up axis to +Z up; glTF's front (+Z) becomes -Y."""
    return np.array(_TO_Z_UP[up], dtype=np.float64)


def canonical(
    mesh: Mesh, up: UpAxis | None = None, metres_per_unit: float | None = None
) -> tuple[Mesh, FloatArray]:
    """Bring a mesh to the canonical frame: metres, +Z up, front -Y, centred in x and y, standing on z = 0.

    Args:
        mesh: in the file's own frame.
        up: overrides what the file says.
        metres_per_unit: overrides what the file says [m].

    Returns:
        The mesh, and `asset_from_source` (4, 4), which maps the file's coordinates to the asset's [m].
    """
    rotation = z_up_from(up or mesh.up)
    factor = metres_per_unit or mesh.metres_per_unit or 1.0
    asset_from_source = np.eye(4)
    asset_from_source[:3, :3] = rotation * factor
    corners = mesh.vertices[occurring(mesh.faces)] @ asset_from_source[:3, :3].T
    lower, upper = corners.min(axis=0), corners.max(axis=0)
    asset_from_source[:3, 3] = -(lower + upper) / 2
    asset_from_source[2, 3] = -lower[2]
    moved = mesh.transformed(asset_from_source)
    return replace(moved, up="+z", metres_per_unit=1.0), frozen_floats(asset_from_source)


def _check_faces(vertices: FloatArray, faces: IntArray) -> None:
    _check_shape("vertices", vertices.shape, (len(vertices), 3))
    if faces.size == 0:
        raise BadInputError("the mesh has no faces: export it with triangles, not only points or curves")
    _check_shape("faces", faces.shape, (len(faces), 3))
    if faces.min() < 0 or faces.max() >= len(vertices):
        bad = int(faces.max() if faces.max() >= len(vertices) else faces.min())
        raise BadInputError(f"face index {bad} is out of range: the mesh has {len(vertices)} vertices")
    broken = int((~np.isfinite(vertices)).any(axis=1).sum())
    if broken:
        raise BadInputError(
            f"{broken} of {len(vertices)} vertices are NaN or infinite: repair the mesh first"
        )


def _check_shape(name: str, shape: tuple[int, ...], expected: tuple[int, ...]) -> None:
    if shape != expected:
        raise BadInputError(f"{name} has shape {shape}, expected {expected}")
