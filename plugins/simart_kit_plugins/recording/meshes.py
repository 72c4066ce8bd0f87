"""Surfaces as rerun meshes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from simart_kit.arrays import ByteArray, FloatArray, IntArray
from simart_kit.mesh import Image, Mesh
from simart_kit.srgb import encoded
from simart_kit.topology import neighbours


def textured_mesh(mesh: Mesh, faces: IntArray, material: int, texels: int) -> Any:
    """Some faces of one material as they look; the texture is shrunk to so many texels."""
    look = mesh.materials[material]
    image = look.base_color_image if mesh.uv is not None else None
    used, corners = np.unique(mesh.faces[faces], return_inverse=True)
    assert mesh.normals is not None
    return mesh3d(
        mesh.vertices[used],
        corners,
        mesh.normals[used],
        colors=None if mesh.colors is None else mesh.colors[used],
        uv=None if mesh.uv is None or image is None else mesh.uv[used],
        texture=None if image is None else _texture(image, texels),
        factor=encoded(np.array(look.base_color)).tolist(),
    )


def plain_mesh(mesh: Mesh, faces: IntArray, color: Sequence[int]) -> Any:
    """Some faces in one colour."""
    used, corners = np.unique(mesh.faces[faces], return_inverse=True)
    assert mesh.normals is not None
    return mesh3d(mesh.vertices[used], corners, mesh.normals[used], factor=color)


def mesh3d(
    vertices: FloatArray,
    faces: IntArray,
    normals: FloatArray,
    *,
    colors: ByteArray | None = None,
    uv: FloatArray | None = None,
    texture: ByteArray | None = None,
    factor: Sequence[int] | None = None,
) -> Any:
    """A Mesh3D of (V, 3) vertices [m], (F, 3) faces and (V, 3) normals, with any of the looks."""
    import rerun as rr

    return rr.Mesh3D(
        vertex_positions=vertices.astype(np.float32),
        triangle_indices=faces.reshape(-1, 3).astype(np.uint32),
        vertex_normals=normals.astype(np.float32),
        vertex_colors=colors,
        # rerun's textures begin at the top, as in glTF; ours at the bottom.
        vertex_texcoords=None if uv is None else (uv * [1.0, -1.0] + [0.0, 1.0]).astype(np.float32),
        albedo_texture=texture,
        albedo_factor=factor,
    )


def _texture(image: Image, texels: int) -> ByteArray:
    """(H, W, 3) pixels, shrunk to at most so many."""
    from PIL import Image as Pillow

    pixels = image.pixels[:, :, :3]
    shrink = (texels / (pixels.shape[0] * pixels.shape[1])) ** 0.5
    if shrink >= 1.0:
        return np.ascontiguousarray(pixels)
    size = (max(int(pixels.shape[1] * shrink), 1), max(int(pixels.shape[0] * shrink), 1))
    return np.asarray(Pillow.fromarray(pixels).resize(size, Pillow.Resampling.BOX))


def convex_edges(vertices: FloatArray, faces: IntArray) -> IntArray:
    """(E, 2) edges of a convex mesh that lie between faces of different direction."""
    normals = Mesh(vertices, faces).face_normals
    edge, left, right = neighbours(faces)
    flat = np.einsum("ij,ij->i", normals[left], normals[right]) > 0.9999
    ends = np.unique(np.sort(np.stack([faces, faces[:, [1, 2, 0]]], axis=-1).reshape(-1, 2)), axis=0)
    return np.asarray(np.delete(ends, edge[flat], axis=0))
