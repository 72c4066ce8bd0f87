"""Collision shapes of a part: dozens, where the rest of it is a handful of prims."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import UP, FloatArray, units
from simart_kit.asset import ConvexMesh, Part
from simart_kit.primitives import Primitive
from simart_kit.triangles import crosses

from .draft import Draft
from .frames import quaternion
from .runtimes import RUNTIME_SCHEMAS
from .specs import Typed, Values, apply, define, relate, set_values

if TYPE_CHECKING:
    from pxr import Sdf


def define_colliders(draft: Draft, path: Sdf.Path, part: Part, slide: Sdf.Path, origin: FloatArray) -> None:
    """Author the collision shapes of a body.

    Args:
        draft: where each layer takes its share.
        path: of the body, which exists.
        part: whose shapes they are.
        slide: path of its physics material.
        origin: (3,) of the body [m].
    """
    from pxr import Sdf

    with Sdf.ChangeBlock():
        for number, shape in enumerate(part.collision, 1):
            _define_collider(draft, path.AppendChild(f"collision_{number}"), shape, slide, origin)


def _define_collider(
    draft: Draft, path: Sdf.Path, shape: ConvexMesh, slide: Sdf.Path, origin: FloatArray
) -> None:
    layers, physics = draft.layers, draft.layers["physics"]
    kind, values = _solid(shape.primitive, origin) if shape.primitive else _hull(shape, origin)
    # Renderers leave guides out.
    define(layers["geometries"], path, kind, {**values, "purpose": Typed("Token", "guide", uniform=True)})
    apply(physics, path, "PhysicsCollisionAPI")
    if kind == "Mesh":
        apply(physics, path, "PhysicsMeshCollisionAPI")
        set_values(physics, path, {"physics:approximation": Typed("Token", "convexHull", uniform=True)})
    apply(physics, path, "MaterialBindingAPI")
    relate(physics, path, "material:binding:physics", slide)
    for role, schemas in RUNTIME_SCHEMAS.items():
        apply(layers[role], path, *schemas[: 2 if kind == "Mesh" else 1])


def _solid(shape: Primitive, origin: FloatArray) -> tuple[str, Values]:
    """Schema and attributes of a box, cylinder or sphere of a body at `origin` (3,) [m]."""
    from pxr import Gf, Vt

    kind, values, half = _about_its_middle(shape)
    extent = Vt.Vec3fArray([Gf.Vec3f(*(-half).tolist()), Gf.Vec3f(*half.tolist())])
    moves = {
        "translate": Typed("Double3", Gf.Vec3d(*(shape.asset_T_shape[:3, 3] - origin).tolist())),
        "orient": Typed("Quatf", quaternion(shape.asset_T_shape[:3, :3])),
    }
    if shape.kind == "box":
        moves["scale"] = Typed("Float3", Gf.Vec3f(*shape.size))
    named = {f"xformOp:{name}": move for name, move in moves.items()}
    order = Typed("TokenArray", Vt.TokenArray(list(named)), uniform=True)
    return kind, {**values, "extent": Typed("Float3Array", extent), **named, "xformOpOrder": order}


def _about_its_middle(shape: Primitive) -> tuple[str, dict[str, Typed], FloatArray]:
    """Schema, attributes and (3,) half the extent [m]; a box is a cube of 1 m that waits for its scale."""
    radius, height = shape.size[0] / 2, shape.size[2]
    if shape.kind == "box":
        return "Cube", {"size": Typed("Double", 1.0)}, np.full(3, 0.5)
    if shape.kind == "sphere":
        return "Sphere", {"radius": Typed("Double", radius)}, np.full(3, radius)
    values = {
        "axis": Typed("Token", "Z", uniform=True),
        "radius": Typed("Double", radius),
        "height": Typed("Double", height),
    }
    return "Cylinder", values, np.array([radius, radius, height / 2])


def _hull(shape: ConvexMesh, origin: FloatArray) -> tuple[str, Values]:
    """Schema and attributes of a convex mesh of a body at `origin` (3,) [m]."""
    from pxr import UsdGeom, Vt

    vertices = shape.vertices - origin
    points = Vt.Vec3fArray.FromNumpy(vertices.astype(np.float32))
    # A normal a face: viewers that do show guides then show flat sides.
    normals = Vt.Vec3fArray.FromNumpy(units(crosses(vertices[shape.faces]), otherwise=UP).astype(np.float32))
    return "Mesh", {
        "points": Typed("Point3fArray", points),
        "extent": Typed("Float3Array", UsdGeom.PointBased.ComputeExtent(points)),
        "faceVertexCounts": Typed("IntArray", Vt.IntArray(len(shape.faces), 3)),
        "faceVertexIndices": Typed("IntArray", Vt.IntArray.FromNumpy(shape.faces.ravel())),
        "subdivisionScheme": Typed("Token", "none", uniform=True),
        "normals": Typed("Normal3fArray", normals, interpolation="uniform"),
    }
