"""Rigid bodies: mass properties, and the materials that they slide on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import MassProperties, Material

from .frames import principal_axes, quaternion

if TYPE_CHECKING:
    from pxr import Sdf, Usd, UsdGeom, UsdShade


def define_frame(stage: Usd.Stage, path: Sdf.Path, origin: FloatArray) -> UsdGeom.Xform:
    """Author the frame of a body, which has the asset's axes and sits at `origin` (3,) [m]."""
    from pxr import Gf, UsdGeom

    frame = UsdGeom.Xform.Define(stage, path)
    frame.AddTranslateOp().Set(Gf.Vec3d(*origin.tolist()))
    return frame


def make_body(frame: UsdGeom.Xform, mass: MassProperties | None, origin: FloatArray) -> None:
    """Make a frame at `origin` (3,) [m] a rigid body, with mass, centre and inertia where they are known."""
    from pxr import Gf, UsdPhysics

    UsdPhysics.RigidBodyAPI.Apply(frame.GetPrim())
    if mass is None:
        return
    moments, axes = principal_axes(mass.inertia)
    api = UsdPhysics.MassAPI.Apply(frame.GetPrim())
    api.CreateMassAttr(mass.mass)
    api.CreateCenterOfMassAttr(Gf.Vec3f(*(np.array(mass.center) - origin).tolist()))
    api.CreateDiagonalInertiaAttr(Gf.Vec3f(*moments.tolist()))
    api.CreatePrincipalAxesAttr(quaternion(axes))


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
