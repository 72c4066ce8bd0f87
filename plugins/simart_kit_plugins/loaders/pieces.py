"""Pieces of a scene, and how they become one Mesh."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from simart_kit import BadInputError, Mesh, Note, VisualMaterial
from simart_kit.arrays import UP, ByteArray, FloatArray, IntArray, units
from simart_kit.mesh import UpAxis
from simart_kit.normals import with_normals

Rows = TypeVar("Rows", FloatArray, ByteArray)

# Beyond this a file is a bomb of instances, or needs decimation before anything else.
MAX_FACES = 20_000_000


@dataclass(frozen=True, eq=False)
class Piece:
    """One mesh of a scene.

    Attributes:
        vertices: (V, 3) in file units.
        faces: (F, 3).
        face_material: (F,) index into the file's materials.
        normals: (V, 3) any length, or None.
        uv: (V, 2) origin bottom left, or None.
        colors: (V, 4) RGBA 0..255, or None.
        node: scene-graph node that it hangs on.
    """

    vertices: FloatArray
    faces: IntArray
    face_material: IntArray
    normals: FloatArray | None = None
    uv: FloatArray | None = None
    colors: ByteArray | None = None
    node: int = 0

    def moved(self, world_from_piece: FloatArray) -> Piece:
        """The piece under a (4, 4) affine transform; a mirroring one turns the faces round."""
        linear = world_from_piece[:3, :3]
        determinant = np.linalg.det(linear)
        vertices = self.vertices @ linear.T + world_from_piece[:3, 3]
        normals = self.normals
        if normals is not None:
            regular = np.isfinite(determinant) and determinant != 0
            normals = normals @ np.linalg.inv(linear) if regular else None
        faces = self.faces[:, ::-1] if determinant < 0 else self.faces
        return replace(self, vertices=vertices, faces=faces, normals=normals)

    def with_face_colors(self, colors: ByteArray) -> Piece:
        """The piece with (F, 4) RGBA colours, no vertex shared between faces."""
        corners = self.faces.ravel()
        return replace(
            self,
            vertices=self.vertices[corners],
            faces=np.arange(len(corners)).reshape(-1, 3),
            normals=None if self.normals is None else self.normals[corners],
            uv=None if self.uv is None else self.uv[corners],
            colors=np.repeat(colors, 3, axis=0),
        )


def bounded(pieces: Iterable[Piece]) -> list[Piece]:
    """All pieces, checked as they come; raises BadInputError for indices out of range and too many faces."""
    result, faces = [], 0
    for piece in pieces:
        _check(piece)
        faces += len(piece.faces)
        if faces > MAX_FACES:
            raise BadInputError(f"it has more than {MAX_FACES:,} faces: decimate it first")
        result.append(piece)
    return result


def joined(
    pieces: Sequence[Piece],
    materials: Sequence[VisualMaterial],
    up: UpAxis,
    metres_per_unit: float | None,
    nodes: bool,
    warnings: Sequence[str],
) -> Mesh:
    """One Mesh of all pieces, their faces one after the other.

    Args:
        pieces: in scene order.
        materials: of the file.
        up: axis of the file that points up.
        metres_per_unit: of the file [m], or None.
        nodes: whether `Piece.node` means anything.
        warnings: what the loader had to leave out.

    Raises:
        BadInputError: no face at all.
    """
    pieces = [piece for piece in pieces if len(piece.faces)]
    if not pieces:
        raise BadInputError("no faces in it: it is empty or damaged, or holds only points or curves")
    pieces = _same_attributes(pieces)
    # A palette may hold more than the faces turned out to use.
    used, face_material = np.unique(
        np.concatenate([piece.face_material for piece in pieces]), return_inverse=True
    )
    first = np.cumsum([0] + [len(piece.vertices) for piece in pieces])
    return Mesh(
        vertices=np.concatenate([piece.vertices for piece in pieces]),
        faces=np.concatenate([p.faces + start for p, start in zip(pieces, first[:-1], strict=True)]),
        normals=_stacked([piece.normals for piece in pieces]),
        uv=_stacked([piece.uv for piece in pieces]),
        colors=_stacked([piece.colors for piece in pieces]),
        materials=tuple(materials[i] for i in used),
        face_material=face_material.reshape(-1),
        face_node=np.concatenate([np.full(len(p.faces), p.node) for p in pieces]) if nodes else None,
        up=up,
        metres_per_unit=metres_per_unit,
        notes=tuple(Note("load", "warning", text) for text in warnings),
    )


def _check(piece: Piece) -> None:
    """Indices must be checked here: once pieces stand in a row, one too high hits the next piece."""
    faces, count = piece.faces, len(piece.vertices)
    if len(faces) and (faces.min() < 0 or faces.max() >= count):
        bad = faces.max() if faces.max() >= count else faces.min()
        raise BadInputError(f"face index {bad} is out of range: its mesh has {count} vertices")


def _same_attributes(pieces: Sequence[Piece]) -> list[Piece]:
    """Pieces that have all the attributes that any of them has."""
    clean = [replace(p, normals=_unit(p), uv=None if p.uv is None else np.nan_to_num(p.uv)) for p in pieces]
    if any(p.normals is not None for p in clean):
        clean = [p if p.normals is not None else _with_normals(p) for p in clean]
    if any(p.uv is not None for p in clean):
        clean = [p if p.uv is not None else replace(p, uv=np.zeros((len(p.vertices), 2))) for p in clean]
    # White changes nothing.
    if all(p.colors is None or (p.colors == 255).all() for p in clean):
        return [replace(p, colors=None) for p in clean]
    return [p if p.colors is not None else replace(p, colors=_white(len(p.vertices))) for p in clean]


def _unit(piece: Piece) -> FloatArray | None:
    """(V, 3) unit normals; None if one that a face uses has no direction."""
    if piece.normals is None:
        return None
    length = np.linalg.norm(piece.normals, axis=1, keepdims=True)
    good = np.isfinite(length) & (length > 1e-12)
    if not good[piece.faces.ravel()].all():
        return None
    return units(np.where(good, piece.normals, 0.0), otherwise=UP)


def _with_normals(piece: Piece) -> Piece:
    mesh = with_normals(Mesh(piece.vertices, piece.faces, uv=piece.uv, colors=piece.colors))
    return replace(
        piece,
        vertices=mesh.vertices,
        faces=mesh.faces,
        normals=mesh.normals,
        uv=mesh.uv,
        colors=mesh.colors,
    )


def _white(count: int) -> ByteArray:
    return np.full((count, 4), 255, dtype=np.uint8)


def _stacked(values: Sequence[Rows | None]) -> Rows | None:
    present = [value for value in values if value is not None]
    return np.concatenate(present) if present else None
