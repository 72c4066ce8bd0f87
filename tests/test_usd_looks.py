"""The USD exporter: meshes, materials and textures."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset
from simart_kit.mesh import Image, VisualMaterial
from simart_kit.testing.meshes import static_asset

from .usd_cases import ASSETS, children, export, glossy_asset, painted_asset, triangles
from .usd_readers import open_stage


@pytest.fixture(scope="module", params=ASSETS)
def case(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Asset, Path]:
    asset = ASSETS[request.param]
    return asset, export(asset, tmp_path_factory.mktemp("usd") / "usd")


def test_surfaces_put_together_are_the_mesh(case: tuple[Asset, Path]) -> None:
    asset, stage = case[0], open_stage(case[1])
    for index, part in enumerate(asset.parts):
        prims = [p for p in children(stage, part.name) if UsdGeom.Imageable(p).ComputePurpose() == "default"]
        corners = np.concatenate([triangles(prim) for prim in prims])
        expected = asset.mesh.triangles[asset.face_part == index]
        assert sorted_rows(corners) == pytest.approx(sorted_rows(expected), abs=1e-6)


def test_meshes_are_well_formed(case: tuple[Asset, Path]) -> None:
    stage = open_stage(case[1])
    meshes = [UsdGeom.Mesh(p) for p in stage.Traverse() if p.IsA(UsdGeom.Mesh)]
    assert meshes
    for mesh in meshes:
        points, indices = (
            np.array(mesh.GetPointsAttr().Get()),
            np.array(mesh.GetFaceVertexIndicesAttr().Get()),
        )
        normals = np.array(mesh.GetNormalsAttr().Get())
        assert mesh.GetSubdivisionSchemeAttr().Get() == "none"
        assert set(mesh.GetFaceVertexCountsAttr().Get()) == {3}
        assert set(indices) == set(range(len(points)))
        assert np.array_equal(mesh.GetExtentAttr().Get(), [points.min(axis=0), points.max(axis=0)])
        assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0, abs=1e-5)
        side = np.cross(*(np.diff(points[indices.reshape(-1, 3)], axis=1).transpose(1, 0, 2)))
        corner = normals if mesh.GetNormalsInterpolation() == "uniform" else normals[indices[::3]]
        assert (np.einsum("ij,ij->i", side, corner) > 0).all()


def test_everything_that_renders_has_a_material_and_coordinates_for_its_textures(
    case: tuple[Asset, Path],
) -> None:
    asset, stage = case[0], open_stage(case[1])
    drawn = [p for p in stage.Traverse() if p.IsA(UsdGeom.Gprim) and not p.HasAPI(UsdPhysics.CollisionAPI)]
    assert len(drawn) >= len(asset.parts)
    for prim in drawn:
        material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
        primvars = UsdGeom.PrimvarsAPI(prim)
        for name in varnames(material):
            assert primvars.GetPrimvar(name).HasValue(), f"{prim.GetPath()} lacks {name}"


def test_vertex_colors_become_linear_and_are_what_the_material_reads(tmp_path: Path) -> None:
    asset = painted_asset()
    stage = open_stage(export(asset, tmp_path / "usd"))
    mesh = UsdGeom.Mesh.Get(stage, "/painted/body/visual_1")
    low = np.array(mesh.GetPointsAttr().Get())[:, 2] < 0.4
    colors = np.array(mesh.GetDisplayColorPrimvar().ComputeFlattened())
    # sRGB 128 is 0.2158605 in linear light (IEC 61966-2-1).
    assert colors[low] == pytest.approx(np.tile([1.0, 0.0, 0.0], (low.sum(), 1)))
    assert colors[~low] == pytest.approx(np.full(((~low).sum(), 3), 0.2158605), abs=1e-6)
    opacity = np.array(mesh.GetDisplayOpacityPrimvar().ComputeFlattened())
    assert opacity == pytest.approx(np.where(low, 1.0, 128 / 255), abs=1e-6)
    material, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    assert varnames(material) == {"displayColor", "displayOpacity"}


def test_textures_feed_the_inputs_they_are_made_for(tmp_path: Path) -> None:
    asset = glossy_asset()
    path = export(asset, tmp_path / "usd")
    stage = open_stage(path)
    material, _ = UsdShade.MaterialBindingAPI(
        stage.GetPrimAtPath("/glossy/body/visual_1")
    ).ComputeBoundMaterial()
    surface = material.ComputeSurfaceSource()[0]
    wood = asset.mesh.materials[0]
    expected = {
        "diffuseColor": ("rgb", "sRGB", wood.base_color_image, wood.base_color),
        "roughness": ("g", "raw", wood.metallic_roughness_image, (1.0, 0.25, 0.5, 1.0)),
        "metallic": ("b", "raw", wood.metallic_roughness_image, (1.0, 0.25, 0.5, 1.0)),
        "normal": ("rgb", "raw", wood.normal_image, (2.0, 2.0, 2.0, 1.0)),
    }
    for name, (output, space, image, scale) in expected.items():
        source, channel, _ = surface.GetInput(name).GetConnectedSource()
        texture = UsdShade.Shader(source.GetPrim())
        assert channel == output
        assert texture.GetInput("sourceColorSpace").Get() == space
        assert tuple(texture.GetInput("scale").Get()) == pytest.approx(scale)
        file = texture.GetInput("file").Get()
        assert file.path.startswith("./textures/")
        assert image is not None
        assert Path(file.resolvedPath).read_bytes() == image.png
    assert not surface.GetInput("opacity").HasConnectedSource()
    assert tuple(texture.GetInput("bias").Get()) == (-1.0, -1.0, -1.0, 0.0)


def test_glass_is_transparent_and_a_part_of_two_materials_has_two_meshes(tmp_path: Path) -> None:
    stage = open_stage(export(glossy_asset(), tmp_path / "usd"))
    materials = [
        UsdShade.MaterialBindingAPI(stage.GetPrimAtPath(f"/glossy/{path}")).ComputeBoundMaterial()[0]
        for path in ("drawer/visual_1", "drawer/visual_2", "door/visual_1")
    ]
    assert [m.GetPrim().GetName() for m in materials] == ["chene_wood_01", "glass", "glass"]
    assert materials[1].ComputeSurfaceSource()[0].GetInput("opacity").Get() == 0.25


def test_texture_with_holes_feeds_the_opacity(tmp_path: Path) -> None:
    asset = static_asset()
    pixels = np.full((2, 2, 4), 255, dtype=np.uint8)
    pixels[0, 0, 3] = 0
    leaf = VisualMaterial("leaf", base_color_image=Image.from_pixels(pixels))
    stage = open_stage(export(replace(asset, mesh=replace(asset.mesh, materials=(leaf,))), tmp_path / "usd"))
    surface = UsdShade.Shader.Get(stage, "/block/Materials/leaf/surface")
    assert surface.GetInput("opacity").GetConnectedSource()[1] == "a"


def sorted_rows(corners: FloatArray) -> FloatArray:
    """(F, 9), in an order that does not depend on that of the faces."""
    rows = np.round(corners.reshape(-1, 9), 6)
    return rows[np.lexsort(rows.T)]


def varnames(material: UsdShade.Material) -> set[str]:
    """The primvars that a material reads."""
    shaders = [UsdShade.Shader(p) for p in Usd.PrimRange(material.GetPrim()) if p.IsA(UsdShade.Shader)]
    return {s.GetInput("varname").Get() for s in shaders if s.GetInput("varname")}
