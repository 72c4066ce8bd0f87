"""Meshes: what is drawn, and what collides."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import UP, FloatArray, IntArray, units
from simart_kit.asset import ConvexMesh
from simart_kit.primitives import Primitive
from simart_kit.surfaces import Surface
from simart_kit.triangles import crosses

from .frames import quaternion
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


def define_shape(stage: Usd.Stage, path: Sdf.Path, shape: ConvexMesh, origin: FloatArray) -> UsdGeom.Gprim:
    """Author a collision shape of a body at `origin` (3,) [m], as the primitive that it is if it is one."""
    if shape.primitive:
        return define_primitive(stage, path, shape.primitive, origin)
    return define_hull(stage, path, shape, origin)


def define_primitive(stage: Usd.Stage, path: Sdf.Path, shape: Primitive, origin: FloatArray) -> UsdGeom.Gprim:
    """Author a box, cylinder or sphere of a body at `origin` (3,) [m]; renderers leave it out."""
    from pxr import Gf, Usd, UsdGeom

    gprim = _solid(stage, path, shape)
    gprim.CreateExtentAttr(UsdGeom.Boundable.ComputeExtentFromPlugins(gprim, Usd.TimeCode.Default()))
    gprim.CreatePurposeAttr(UsdGeom.Tokens.guide)
    gprim.AddTranslateOp().Set(Gf.Vec3d(*(shape.asset_T_shape[:3, 3] - origin).tolist()))
    gprim.AddOrientOp().Set(quaternion(shape.asset_T_shape[:3, :3]))
    if shape.kind == "box":
        gprim.AddScaleOp().Set(Gf.Vec3f(*shape.size))
    return gprim


def define_hull(stage: Usd.Stage, path: Sdf.Path, shape: ConvexMesh, origin: FloatArray) -> UsdGeom.Mesh:
    """Author a collision shape of a body at `origin` (3,) [m]; renderers leave it out."""
    from pxr import UsdGeom, Vt

    vertices = shape.vertices - origin
    mesh = define_mesh(stage, path, vertices, shape.faces)
    mesh.CreatePurposeAttr(UsdGeom.Tokens.guide)
    # A normal a face: viewers that do show guides then show flat sides.
    normals = units(crosses(vertices[shape.faces]), otherwise=UP)
    mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(normals.astype(np.float32)))
    mesh.SetNormalsInterpolation(UsdGeom.Tokens.uniform)
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
    _, first, index = np.unique(
        rows.view(f"V{rows.strides[0]}").ravel(), return_index=True, return_inverse=True
    )
    primvar.SetInterpolation(UsdGeom.Tokens.vertex)
    if len(first) < len(rows):
        rows = rows[first]
        primvar.SetIndices(Vt.IntArray.FromNumpy(index.astype(np.int32)))
    primvar.Set(array.FromNumpy(rows.squeeze(1) if rows.shape[1] == 1 else rows))


def _solid(stage: Usd.Stage, path: Sdf.Path, shape: Primitive) -> UsdGeom.Gprim:
    """The prim of a primitive, about its own middle; a box is a cube of 1 m that waits for its scale."""
    from pxr import UsdGeom

    if shape.kind == "box":
        cube = UsdGeom.Cube.Define(stage, path)
        cube.CreateSizeAttr(1.0)
        return cube
    if shape.kind == "sphere":
        sphere = UsdGeom.Sphere.Define(stage, path)
        sphere.CreateRadiusAttr(shape.size[0] / 2)
        return sphere
    cylinder = UsdGeom.Cylinder.Define(stage, path)
    cylinder.CreateAxisAttr(UsdGeom.Tokens.z)
    cylinder.CreateRadiusAttr(shape.size[0] / 2)
    cylinder.CreateHeightAttr(shape.size[2])
    return cylinder
