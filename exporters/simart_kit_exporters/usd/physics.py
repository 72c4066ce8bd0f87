"""Rigid bodies: mass properties, colliders, and the materials that they slide on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import ConvexMesh, MassProperties, Material

from .frames import principal_axes, quaternion
from .geometry import define_hull

if TYPE_CHECKING:
    from pxr import Sdf, Usd, UsdGeom, UsdShade


def define_body(stage: Usd.Stage, path: Sdf.Path, origin: FloatArray) -> UsdGeom.Xform:
    """Author a rigid body whose frame has the asset's axes and sits at `origin` (3,) [m]."""
    from pxr import Gf, UsdGeom, UsdPhysics

    body = UsdGeom.Xform.Define(stage, path)
    body.AddTranslateOp().Set(Gf.Vec3d(*origin.tolist()))
    UsdPhysics.RigidBodyAPI.Apply(body.GetPrim())
    return body


def set_mass(body: UsdGeom.Xform, mass: MassProperties, origin: FloatArray) -> None:
    """Author mass, centre and inertia of a body at `origin` (3,) [m], so that no simulator guesses them."""
    from pxr import Gf, UsdPhysics

    moments, axes = principal_axes(mass.inertia)
    api = UsdPhysics.MassAPI.Apply(body.GetPrim())
    api.CreateMassAttr(mass.mass)
    api.CreateCenterOfMassAttr(Gf.Vec3f(*(np.array(mass.center) - origin).tolist()))
    api.CreateDiagonalInertiaAttr(Gf.Vec3f(*moments.tolist()))
    api.CreatePrincipalAxesAttr(quaternion(axes))


def define_collider(
    stage: Usd.Stage, path: Sdf.Path, shape: ConvexMesh, origin: FloatArray, surface: UsdShade.Material
) -> None:
    """Author a convex collider of a body at `origin` (3,) [m]."""
    from pxr import UsdPhysics, UsdShade

    mesh = define_hull(stage, path, shape, origin)
    UsdPhysics.CollisionAPI.Apply(mesh.GetPrim())
    hull = UsdPhysics.MeshCollisionAPI.Apply(mesh.GetPrim())
    hull.CreateApproximationAttr(UsdPhysics.Tokens.convexHull)
    binding = UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim())
    binding.Bind(surface, materialPurpose="physics")


def define_physics_material(stage: Usd.Stage, path: Sdf.Path, material: Material) -> UsdShade.Material:
    """Author friction and restitution; mass is set on the bodies, so density is not."""
    from pxr import UsdPhysics, UsdShade

    result = UsdShade.Material.Define(stage, path)
    api = UsdPhysics.MaterialAPI.Apply(result.GetPrim())
    api.CreateStaticFrictionAttr(material.friction)
    api.CreateDynamicFrictionAttr(material.friction)
    api.CreateRestitutionAttr(material.restitution)
    return result


def filter_contact(stage: Usd.Stage, first: Sdf.Path, second: Sdf.Path) -> None:
    """Let two bodies pass through each other."""
    from pxr import UsdPhysics

    filtered = UsdPhysics.FilteredPairsAPI.Apply(stage.GetPrimAtPath(first))
    filtered.CreateFilteredPairsRel().AddTarget(second)
