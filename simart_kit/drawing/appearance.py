"""What a mesh looks like at points of its faces: linear colour, opacity and smooth normals."""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, Float32Array, FloatArray, IntArray
from ..mesh import Mesh
from ..srgb import decoded, srgb_to_linear
from .texture import texture


class Appearance:
    """Looks up colours and normals on a mesh that has normals.

    Args:
        mesh: its materials' base colours, textures and vertex colours are multiplied, as in glTF.
        paint: (F, 4) sRGB colour 0..1 and strength 0..1 that is laid over each face, or None.
    """

    def __init__(self, mesh: Mesh, paint: FloatArray | None = None) -> None:
        assert mesh.normals is not None
        self._mesh = mesh
        self._normals = mesh.normals.astype(np.float32)
        self._face_normals = mesh.face_normals.astype(np.float32)
        self._uv = None if mesh.uv is None else mesh.uv.astype(np.float32)
        self._colors = None if mesh.colors is None else decoded(mesh.colors)
        self._paint = None if paint is None else _decoded_paint(paint)
        self._textures = [
            None if m.base_color_image is None or mesh.uv is None else texture(m.base_color_image)
            for m in mesh.materials
        ]

    @property
    def translucent(self) -> bool:
        """Whether rays may pass through some face."""
        factors = any(m.base_color[3] < 1 for m in self._mesh.materials)
        textures = any(t is not None and t.translucent for t in self._textures)
        return factors or textures or (self._mesh.colors is not None and self._mesh.colors[:, 3].min() < 255)

    def normals(
        self, face: IntArray, weights: Float32Array, directions: Float32Array
    ) -> tuple[Float32Array, Float32Array]:
        """(N, 3) unit normals of the faces and (N, 3) smooth ones, both against (N, 3) ray directions."""
        flat = self._face_normals.take(face, axis=0)
        flat *= _sign(-np.einsum("ij,ij->i", flat, directions))
        smooth = normalized(_mixed(self._normals, self._mesh.faces.take(face, axis=0), weights))
        return flat, smooth * _sign(np.einsum("ij,ij->i", smooth, flat))

    def colors(self, face: IntArray, weights: Float32Array, footprint: Float32Array) -> Float32Array:
        """(N, 4) linear RGBA.

        Args:
            face: (N,) face of each point.
            weights: (N, 3) barycentric weights.
            footprint: (N,) width of the surface that the point stands for [m]; textures are averaged over it.
        """
        corners = self._mesh.faces.take(face, axis=0)
        material = self._mesh.face_material.take(face)
        result = np.array([m.base_color for m in self._mesh.materials], dtype=np.float32)[material]
        if self._colors is not None:
            result *= _mixed(self._colors, corners, weights)
        for index in np.unique(material):
            picture = self._textures[index]
            if picture is not None and self._uv is not None:
                at = np.flatnonzero(material == index)
                uv = _mixed(self._uv, corners[at], weights[at])
                result[at] *= picture.sample(uv, footprint[at] * _uv_density(self._mesh, face[at]))
        if self._paint is not None:
            _lay_over(result, self._paint[face])
        return result


def normalized(vectors: Float32Array) -> Float32Array:
    """(N, 3) vectors of unit length; zeros stay zero."""
    length = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))
    return np.asarray(vectors / np.maximum(length, np.float32(1e-20))[:, None])


def _decoded_paint(paint: FloatArray) -> Float32Array:
    linear = np.column_stack([srgb_to_linear(paint[:, :3]), paint[:, 3]])
    return np.asarray(linear, dtype=np.float32)


def _lay_over(colors: Float32Array, paint: Float32Array) -> None:
    """Blend paint into linear colours in place, keeping light and dark of the texture."""
    light = np.sqrt(np.clip(colors[:, :3] @ np.array([0.2126, 0.7152, 0.0722], np.float32), 0, 1))
    shade = (0.45 + 0.75 * light)[:, None]
    strength = paint[:, 3:]
    colors[:, :3] += strength * (paint[:, :3] * shade - colors[:, :3])


def _mixed(values: Float32Array, corners: IntArray, weights: Float32Array) -> Float32Array:
    """(N, K) vertex values at barycentric weights."""
    result = values.take(corners[:, 0], axis=0) * weights[:, :1]
    result += values.take(corners[:, 1], axis=0) * weights[:, 1:2]
    result += values.take(corners[:, 2], axis=0) * weights[:, 2:]
    return result


def _sign(values: Float32Array) -> Float32Array:
    """(N, 1) of -1 and 1."""
    return np.asarray(np.where(values < 0, -1, 1)[:, None], dtype=np.float32)


def _uv_density(mesh: Mesh, face: IntArray) -> Float32Array:
    """(N,) UV units a metre on (N,) faces, the mean of both directions."""
    assert mesh.uv is not None
    once = np.zeros(len(mesh.faces), dtype=np.bool_)
    once[face] = True
    seen = np.flatnonzero(once)  # of a dense mesh, a small picture shows few faces
    a, b, c = mesh.uv.take(mesh.faces.take(seen, axis=0).T, axis=0)
    twice = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    result = np.zeros(len(mesh.faces), dtype=np.float32)
    result[seen] = np.sqrt(0.5 * twice / np.maximum(mesh.face_areas.take(seen), 1e-30))
    return result.take(face)


def look_alike(mesh: Mesh, paint: FloatArray | None) -> IntArray:
    """(F,) ids that faces share if they lie in one plane and have the same material, colour and paint.

    Roughly: to 4 degrees and 0.3 % of the mesh's size. Where neighbouring pixels show faces that look alike,
    the picture has no edge.
    """
    first = mesh.vertices.take(mesh.faces[:, 0], axis=0)
    offset = np.einsum("ij,ij->i", mesh.face_normals, first) / max(mesh.diagonal, 1e-30)
    columns = [*(mesh.face_normals * 16).T, offset * 300, mesh.face_material]
    columns += [] if paint is None else [*(paint * 255).T]
    columns += [] if mesh.colors is None else [*(mesh.colors.take(mesh.faces[:, 0], axis=0) / 16.0).T]
    factors = np.cumprod(np.full(len(columns), 6364136223846793005, dtype=np.int64))  # Knuth's MMIX; wraps
    result = np.zeros(len(mesh.faces), dtype=np.int64)
    for column, factor in zip(columns, factors, strict=True):
        result += np.rint(column).astype(np.int64) * factor
    return result


def opaque_faces(mesh: Mesh) -> BoolArray:
    """(F,) faces whose material is not glass, and so throw a shadow."""
    return np.array([m.base_color[3] >= 0.5 for m in mesh.materials])[mesh.face_material]
