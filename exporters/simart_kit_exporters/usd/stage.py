"""The table of contents of a USD export: an Asset as one stage."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from simart_kit.asset import Asset, Material, Part, clean_name, unique_names
from simart_kit.kinematics import ordered_joints, rest_origin
from simart_kit.mesh import VisualMaterial
from simart_kit.surfaces import Surface, asset_surfaces

from ..overlaps import overlapping_strangers
from .geometry import define_surface
from .joints import define_fixed_base, define_joint
from .looks import by_material
from .materials import define_look
from .physics import define_body, define_collider, define_physics_material, filter_contact, set_mass

if TYPE_CHECKING:
    from pxr import Sdf, Usd, UsdShade

    Looks = dict[VisualMaterial, UsdShade.Material]
    Slides = dict[Material, UsdShade.Material]

# Capitals keep the scopes apart from parts, whose names have none.
JOINTS, LOOKS, SLIDES = "Joints", "Materials", "PhysicsMaterials"


def asset_stage(asset: Asset, directory: Path) -> Usd.Stage:
    """Author an asset in memory; textures are written into `directory`, beside which the layer belongs."""
    stage = _new_stage(asset.name)
    surfaces = asset_surfaces(asset)
    looks = _define_looks(stage, [s for group in surfaces.values() for s in group], directory)
    slides = _define_slides(stage, asset)
    for part in asset.parts:
        _define_part(stage, asset, part, slides)
        _define_surfaces(stage, part, surfaces[part.name], looks)
    _define_joints(stage, asset)
    _filter_overlaps(stage, asset)
    return stage


def _new_stage(name: str) -> Usd.Stage:
    from pxr import Kind, Usd, UsdGeom, UsdPhysics

    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, f"/{name}").GetPrim()
    stage.SetDefaultPrim(root)
    Usd.ModelAPI(root).SetKind(Kind.Tokens.component)
    _label(root, "class", name)
    return stage


def _define_looks(stage: Usd.Stage, surfaces: list[Surface], directory: Path) -> Looks:
    groups = by_material(surfaces)
    paths = _material_paths(stage, LOOKS, [material.name for material in groups])
    return {
        material: define_look(stage, path, group, directory)
        for path, (material, group) in zip(paths, groups.items(), strict=True)
    }


def _define_slides(stage: Usd.Stage, asset: Asset) -> Slides:
    materials = list(dict.fromkeys(part.material for part in asset.parts))
    paths = _material_paths(stage, SLIDES, [material.name for material in materials])
    return {m: define_physics_material(stage, path, m) for path, m in zip(paths, materials, strict=True)}


def _material_paths(stage: Usd.Stage, scope: str, names: list[str]) -> list[Sdf.Path]:
    """A path for each material in a new scope, by names that USD accepts; labelled with them."""
    parent = _scope(stage, scope)
    clean = unique_names([clean_name(name, "material") for name in names])
    for name in clean:
        _label(stage.DefinePrim(parent.AppendChild(name), "Material"), "material", name)
    return [parent.AppendChild(name) for name in clean]


def _define_part(stage: Usd.Stage, asset: Asset, part: Part, slides: Slides) -> None:
    origin = rest_origin(asset, part.name)
    path = stage.GetDefaultPrim().GetPath().AppendChild(part.name)
    body = define_body(stage, path, origin)
    _label(body.GetPrim(), "class", part.label or part.name)
    if part.mass:
        set_mass(body, part.mass, origin)
    for number, shape in enumerate(part.collision, 1):
        define_collider(stage, path.AppendChild(f"collision_{number}"), shape, origin, slides[part.material])


def _define_surfaces(stage: Usd.Stage, part: Part, surfaces: tuple[Surface, ...], looks: Looks) -> None:
    from pxr import UsdShade

    path = stage.GetDefaultPrim().GetPath().AppendChild(part.name)
    for number, surface in enumerate(surfaces, 1):
        mesh = define_surface(stage, path.AppendChild(f"visual_{number}"), surface)
        UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(looks[surface.material])


def _define_joints(stage: Usd.Stage, asset: Asset) -> None:
    from pxr import UsdPhysics

    scope = _scope(stage, JOINTS)
    base = stage.GetDefaultPrim().GetPath().AppendChild(asset.root.name)
    jointed = [j for j in ordered_joints(asset) if j.kind != "free"]
    if not asset.floating:
        define_fixed_base(stage, scope.AppendChild("FixedBase"), base)
    elif jointed:
        UsdPhysics.ArticulationRootAPI.Apply(stage.GetPrimAtPath(base))
    for joint in jointed:
        origin = rest_origin(asset, joint.child) - rest_origin(asset, joint.parent)
        define_joint(stage, scope.AppendChild(joint.name), joint, origin)


def _filter_overlaps(stage: Usd.Stage, asset: Asset) -> None:
    """Let parts that overlap pass through each other; those that a joint connects do so in USD anyway."""
    root = stage.GetDefaultPrim().GetPath()
    for first, second in overlapping_strangers(asset):
        filter_contact(stage, root.AppendChild(first), root.AppendChild(second))


def _scope(stage: Usd.Stage, name: str) -> Sdf.Path:
    from pxr import UsdGeom

    return UsdGeom.Scope.Define(stage, stage.GetDefaultPrim().GetPath().AppendChild(name)).GetPath()


def _label(prim: Usd.Prim, taxonomy: str, label: str) -> None:
    """Say what a prim is, for synthetic data."""
    from pxr import UsdSemantics

    UsdSemantics.LabelsAPI.Apply(prim, taxonomy).CreateLabelsAttr([label])
