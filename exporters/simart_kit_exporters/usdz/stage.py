"""The table of contents of a USDZ export: an asset as a stage of surfaces that move."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.asset import Asset, Joint, clean_name, unique_names
from simart_kit.bake import textured_surfaces
from simart_kit.kinematics import rest_origin
from simart_kit.mesh import VisualMaterial
from simart_kit.surfaces import Surface

from ..both_sides import two_sided_parts
from ..sweeps import quaternions
from ..usd.geometry import define_surface
from ..usd.looks import by_material
from ..usd.materials import define_look
from ..y_up import y_up
from .clip import FRAMES_A_SECOND, frames, last_frame, positions
from .joints import part_path

if TYPE_CHECKING:
    from pxr import Usd, UsdShade

    Looks = dict[VisualMaterial, UsdShade.Material]

# Capitals keep these apart from parts, whose names have none.
LOOKS, SURFACE = "Materials", "Surface"


def ar_stage(asset: Asset, directory: Path) -> Usd.Stage:
    """Author an asset in memory; textures are written into `directory`, beside which the layer belongs.

    Every part is below the part that carries it, so that motions add up. Colours are in textures or are
    plain: readers differ in what they make of vertex colours and of factors on textures.
    """
    asset = y_up(asset)
    stage = _new_stage(asset)
    surfaces, two_sided = textured_surfaces(asset), two_sided_parts(asset)
    looks = _define_looks(stage, (s for group in surfaces.values() for s in group), directory)
    shown = dict(frames(asset))
    for part in asset.parts:
        joint = asset.joint_to(part.name)
        _define_part(stage, asset, part.name, joint, shown.get(joint) if joint else None)
        for number, surface in enumerate(surfaces[part.name], 1):
            path = f"{part_path(asset, part.name)}/{SURFACE}_{number}"
            _define_surface(stage, path, surface, looks, part.name in two_sided)
    return stage


def _new_stage(asset: Asset) -> Usd.Stage:
    from pxr import Kind, Usd, UsdGeom

    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, f"/{asset.name}").GetPrim()
    stage.SetDefaultPrim(root)
    Usd.ModelAPI(root).SetKind(Kind.Tokens.component)
    if last_frame(asset):
        stage.SetTimeCodesPerSecond(FRAMES_A_SECOND)
        stage.SetFramesPerSecond(FRAMES_A_SECOND)
        stage.SetStartTimeCode(0)
        stage.SetEndTimeCode(last_frame(asset))
    return stage


def _define_looks(stage: Usd.Stage, surfaces: Iterable[Surface], directory: Path) -> Looks:
    from pxr import UsdGeom

    scope = UsdGeom.Scope.Define(stage, stage.GetDefaultPrim().GetPath().AppendChild(LOOKS)).GetPath()
    groups = by_material(surfaces)
    names = unique_names([clean_name(material.name, "material") for material in groups])
    return {
        material: define_look(stage, scope.AppendChild(name), group, directory)
        for name, (material, group) in zip(names, groups.items(), strict=True)
    }


def _define_part(
    stage: Usd.Stage, asset: Asset, part: str, joint: Joint | None, shown: tuple[int, int] | None
) -> None:
    """Author a part's frame at rest, and as samples over the frames in which its joint is shown."""
    from pxr import Gf, UsdGeom

    xform = UsdGeom.Xform.Define(stage, part_path(asset, part))
    if joint is None:
        return
    rest = rest_origin(asset, part) - rest_origin(asset, joint.parent)
    place = xform.AddTranslateOp()
    place.Set(Gf.Vec3d(*rest.tolist()))
    if shown is None:
        return
    start, end = shown
    way = positions(joint, end - start + 1)
    if joint.turns:
        turn = xform.AddOrientOp()
        turn.Set(Gf.Quatf(1.0))
        for frame, (x, y, z, w) in enumerate(quaternions(joint, way).tolist(), start):
            turn.Set(Gf.Quatf(w, x, y, z), frame)
    else:
        for frame, position in enumerate(way, start):
            place.Set(Gf.Vec3d(*(rest + position * np.array(joint.axis)).tolist()), frame)


def _define_surface(stage: Usd.Stage, path: str, surface: Surface, looks: Looks, two_sided: bool) -> None:
    from pxr import Sdf, UsdShade

    mesh = define_surface(stage, Sdf.Path(path), surface)
    mesh.CreateDoubleSidedAttr(two_sided)
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(looks[surface.material])
