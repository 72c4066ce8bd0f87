"""Assets that show what the USD exporter can do, and how tests look at its meshes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from pxr import Usd, UsdGeom
from simart_kit_exporters.usd import Usd as UsdExporter

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint, Limits
from simart_kit.mesh import Image, VisualMaterial
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset, chain_asset, static_asset


def painted_asset() -> Asset:
    """The cabinet with vertex colours: red below 0.4 m, half-transparent sRGB grey above."""
    asset = cabinet_asset(textured=False)
    low = asset.mesh.vertices[:, 2:] < 0.4
    colors = np.where(low, [255, 0, 0, 255], [128, 128, 128, 128]).astype(np.uint8)
    materials = (VisualMaterial("paint", (1.0, 1.0, 1.0, 1.0)),)
    return replace(asset, name="painted", mesh=replace(asset.mesh, colors=colors, materials=materials))


def many_kinds_asset() -> Asset:
    """A joint of every kind but free, with axes along -x and aslant."""
    chain = chain_asset()
    bounds = [((i, 0.0, 0.0), (i + 0.5, 0.4, 0.3)) for i in range(5)]
    masses = [chain.parts[i % 3] for i in range(5)]
    parts = tuple(replace(p, name=n) for p, n in zip(masses, ("joints", "b", "c", "d", "e"), strict=True))
    joints = (
        Joint(
            "slide",
            "prismatic",
            "b",
            "c",
            (2.0, 0.1, 0.2),
            (0.36, -0.48, 0.8),
            Limits(-0.2, 0.4),
            damping=3.0,
        ),
        Joint("weld", "fixed", "joints", "b", (1.0, 0.2, 0.0)),
        Joint("shoulder", "ball", "c", "d", (3.0, 0.2, 0.1), damping=0.1),
        Joint(
            "wrist", "revolute", "d", "e", (4.0, 0.3, 0.3), (-1.0, 0.0, 0.0), Limits(-1.0, 2.0), damping=0.5
        ),
    )
    return Asset("kinds", boxes_mesh(bounds), np.repeat(range(5), 12), parts, joints)


def glossy_asset() -> Asset:
    """The cabinet with all three kinds of texture, a glass door, and a drawer of which both are part."""
    asset = cabinet_asset()
    pixels = np.full((4, 4, 3), 128, dtype=np.uint8)
    checks = replace(
        asset.mesh.materials[0],
        name="Chêne (wood) 01",
        metallic=0.5,
        roughness=0.25,
        metallic_roughness_image=Image.from_pixels(pixels),
        normal_image=Image.from_pixels(pixels + np.array([0, 0, 127], dtype=np.uint8)),
    )
    glass = VisualMaterial("glass", (0.9, 0.9, 1.0, 0.25), roughness=0.0)
    face_material = (asset.face_part == 1).astype(np.int32)
    face_material[-12:] = 1  # the drawer has both
    mesh = replace(asset.mesh, materials=(checks, glass), face_material=face_material)
    return replace(asset, name="glossy", mesh=mesh)


ASSETS = {
    asset.name: asset
    for asset in (
        cabinet_asset(),
        chain_asset(),
        static_asset(),
        painted_asset(),
        many_kinds_asset(),
        glossy_asset(),
        replace(cabinet_asset(), name="floating", floating=True),
        replace(static_asset(), name="loose", floating=True),
    )
}


def export(asset: Asset, directory: Path, **options: object) -> Path:
    """The main file of an export, without a thumbnail unless the options ask for one."""
    directory.mkdir()
    chosen = UsdExporter.Options.model_validate({"thumbnail": False, **options})
    return UsdExporter(chosen).export(asset, directory)


def children(stage: Usd.Stage, part: str) -> list[Usd.Prim]:
    return list(stage.GetPrimAtPath(stage.GetDefaultPrim().GetPath().AppendChild(part)).GetChildren())


def triangles(prim: Usd.Prim) -> FloatArray:
    """(F, 3, 3) corners in the stage's frame."""
    points = np.array(UsdGeom.Mesh(prim).GetPointsAttr().Get(), dtype=np.float64)
    world_T_mesh = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim)).T
    indices = np.array(UsdGeom.Mesh(prim).GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    return np.asarray((points @ world_T_mesh[:3, :3].T + world_T_mesh[:3, 3])[indices])
