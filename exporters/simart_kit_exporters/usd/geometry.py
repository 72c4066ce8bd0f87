"""Meshes: what is drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from simart_kit.arrays import Float32Array, FloatArray, IntArray
from simart_kit.surfaces import Surface

from .looks import linear_colors, reads_colors

if TYPE_CHECKING:
    from pxr import Sdf, Usd, UsdGeom


def define_mesh(stage: Usd.Stage, path: Sdf.Path, vertices: FloatArray, faces: IntArray) -> UsdGeom.Mesh:
    """Author (V, 3) vertices [m] and (F, 3) triangles as they are, without subdivision."""
    from pxr import UsdGeom, Vt

    mesh = UsdGeom.Mesh.Define(stage, path)
    points = Vt.Vec3fArray.FromNumpy(vertices.astype(np.float32))
    mesh.CreatePointsAttr(points)
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(points))
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(faces), 3, dtype=np.int32)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(faces.ravel()))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    return mesh


def define_surface(stage: Usd.Stage, path: Sdf.Path, surface: Surface) -> UsdGeom.Mesh:
    """Author a surface with its normals, texture coordinates and vertex colours."""
    from pxr import Sdf, UsdGeom, Vt

    mesh = define_mesh(stage, path, surface.vertices, surface.faces)
    mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(surface.normals.astype(np.float32)))
    mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
    if surface.uv is not None:
        coordinates = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray)
        _set_a_vertex(coordinates, surface.uv)
    if reads_colors(surface):
        colors = linear_colors(surface)
        _set_a_vertex(mesh.CreateDisplayColorPrimvar(), colors[:, :3])
        _set_a_vertex(mesh.CreateDisplayOpacityPrimvar(), colors[:, 3:])
    return mesh


def _set_a_vertex(primvar: UsdGeom.Primvar, values: FloatArray) -> None:
    """Give each vertex its row of (V, N) values; rows that repeat are stored once."""
    from pxr import UsdGeom, Vt

    rows = np.ascontiguousarray(values, dtype=np.float32) + np.float32(0.0)  # no -0.0, which equals 0.0
    array = {1: Vt.FloatArray, 2: Vt.Vec2fArray, 3: Vt.Vec3fArray}[rows.shape[1]]
    _, first, index = np.unique(_keys(rows), return_index=True, return_inverse=True)
    primvar.SetInterpolation(UsdGeom.Tokens.vertex)
    if len(first) < len(rows):
        rows = rows[first]
        primvar.SetIndices(Vt.IntArray.FromNumpy(index.astype(np.int32)))
    primvar.Set(array.FromNumpy(rows.squeeze(1) if rows.shape[1] == 1 else rows))


def _keys(rows: Float32Array) -> NDArray[Any]:
    """(V,) values that sort as the bytes of (V, N) rows; whole numbers where they fit, which sort faster."""
    size = rows.strides[0]
    keys = rows.view(f">u{size}" if size in (4, 8) else f"V{size}").ravel()
    return keys.astype(np.uint64) if size in (4, 8) else keys
