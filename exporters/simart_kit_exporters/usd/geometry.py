"""Meshes: what is drawn, and what collides."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import UP, FloatArray, IntArray, units
from simart_kit.asset import ConvexMesh
from simart_kit.surfaces import Surface
from simart_kit.triangles import crosses

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
        uv = Vt.Vec2fArray.FromNumpy(surface.uv.astype(np.float32))
        primvars = UsdGeom.PrimvarsAPI(mesh)
        primvars.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.vertex).Set(uv)
    if reads_colors(surface):
        colors = linear_colors(surface).astype(np.float32)
        mesh.CreateDisplayColorPrimvar(UsdGeom.Tokens.vertex).Set(Vt.Vec3fArray.FromNumpy(colors[:, :3]))
        mesh.CreateDisplayOpacityPrimvar(UsdGeom.Tokens.vertex).Set(Vt.FloatArray.FromNumpy(colors[:, 3]))
    return mesh
