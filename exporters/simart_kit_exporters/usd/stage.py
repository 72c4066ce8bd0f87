"""The table of contents of a USD export: an Asset as one stage."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from simart_kit.asset import Asset, Material, Part, clean_name, unique_names
from simart_kit.kinematics import ordered_joints, rest_origin
from simart_kit.mesh import VisualMaterial
from simart_kit.surfaces import Surface, asset_surfaces

from ..overlaps import overlapping_strangers
from .colliders import define_colliders
from .draft import Draft
from .geometry import define_surface
from .joints import define_fixed_base, define_joint
from .looks import by_material
from .materials import define_look
from .physics import define_frame, define_physics_material, filter_contact, make_body
from .runtimes import set_mujoco, set_newton
from .semantics import category, label

if TYPE_CHECKING:
    from pxr import Sdf, Usd, UsdShade

    Looks = dict[VisualMaterial, UsdShade.Material]
    Slides = dict[Material, UsdShade.Material]

# Capitals keep the scopes apart from parts, whose names have none.
JOINTS, LOOKS, SLIDES = "Joints", "Materials", "PhysicsMaterials"


def write_asset(draft: Draft, asset: Asset, directory: Path) -> None:
    """Author an asset; textures are written into `directory`, beside which the layer of looks belongs."""
    stage, surfaces = draft.stage, asset_surfaces(asset)
    root = stage.GetDefaultPrim()
    label(root, "class", asset.name)
    label(root, "wikidata_qcode", category(asset).qcode)
    with draft.writing("materials"):
        looks = _define_looks(stage, [s for group in surfaces.values() for s in group], directory)
    with draft.writing("physics"):
        slides = _define_slides(stage, asset)
    for part in asset.parts:
        _define_part(draft, asset, part, slides)
        _define_surfaces(draft, part, surfaces[part.name], looks)
    _define_joints(draft, asset)
    with draft.writing("physics"):
        _filter_overlaps(stage, asset)


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
        label(stage.DefinePrim(parent.AppendChild(name), "Material"), "material", name)
    return [parent.AppendChild(name) for name in clean]


def _define_part(draft: Draft, asset: Asset, part: Part, slides: Slides) -> None:
    stage, origin = draft.stage, rest_origin(asset, part.name)
    path = stage.GetDefaultPrim().GetPath().AppendChild(part.name)
    frame = define_frame(stage, path, origin)
    label(frame.GetPrim(), "class", part.label or part.name)
    with draft.writing("physics"):
        make_body(frame, part.mass, origin)
    define_colliders(draft, path, part, slides[part.material].GetPath(), origin)


def _define_surfaces(draft: Draft, part: Part, surfaces: tuple[Surface, ...], looks: Looks) -> None:
    from pxr import UsdShade

    path = draft.stage.GetDefaultPrim().GetPath().AppendChild(part.name)
    for number, surface in enumerate(surfaces, 1):
        with draft.writing("geometries"):
            mesh = define_surface(draft.stage, path.AppendChild(f"visual_{number}"), surface)
        with draft.writing("instances"):
            UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(looks[surface.material])


def _define_joints(draft: Draft, asset: Asset) -> None:
    from pxr import UsdPhysics

    stage = draft.stage
    base = stage.GetDefaultPrim().GetPath().AppendChild(asset.root.name)
    jointed = [j for j in ordered_joints(asset) if j.kind != "free"]
    with draft.writing("physics"):
        scope = _scope(stage, JOINTS)
        if not asset.floating:
            define_fixed_base(stage, scope.AppendChild("FixedBase"), base)
        # What lies loose and carries something, such as a jug with a lid, is an articulation of its own.
        loose = [j.child for j in asset.joints if j.kind == "free"] + [asset.root.name] * asset.floating
        for name in sorted({j.parent for j in jointed} & set(loose)):
            UsdPhysics.ArticulationRootAPI.Apply(stage.GetPrimAtPath(base.ReplaceName(name)))
        for joint in jointed:
            origin = rest_origin(asset, joint.child) - rest_origin(asset, joint.parent)
            define_joint(stage, scope.AppendChild(joint.name), joint, origin)
    for joint in (j for j in jointed if j.moves):
        with draft.writing("newton"):
            set_newton(stage.GetPrimAtPath(scope.AppendChild(joint.name)), joint)
        with draft.writing("mujoco"):
            set_mujoco(stage.GetPrimAtPath(scope.AppendChild(joint.name)), joint)


def _filter_overlaps(stage: Usd.Stage, asset: Asset) -> None:
    """Let parts that overlap pass through each other; those that a joint connects do so in USD anyway."""
    root = stage.GetDefaultPrim().GetPath()
    for first, second in overlapping_strangers(asset):
        filter_contact(stage, root.AppendChild(first), root.AppendChild(second))


def _scope(stage: Usd.Stage, name: str) -> Sdf.Path:
    from pxr import UsdGeom

    return UsdGeom.Scope.Define(stage, stage.GetDefaultPrim().GetPath().AppendChild(name)).GetPath()
