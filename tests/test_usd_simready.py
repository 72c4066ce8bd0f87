"""The USD exporter: what SimReady's profile wants beside bodies and joints, and native primitives."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from pxr import Sdf, Usd, UsdGeom, UsdPhysics, UsdSemantics, UsdShade, UsdValidation
from simart_kit_exporters.usd.semantics import category

from simart_kit.asset import Asset, ConvexMesh, Part
from simart_kit.primitives import Primitive
from simart_kit.testing.meshes import cabinet_asset, static_asset

from .usd_cases import children, export, glossy_asset, many_kinds_asset, painted_asset
from .usd_readers import open_stage, parsed

TURNED = ((0.0, -1.0, 0.0, 0.1), (1.0, 0.0, 0.0, 0.2), (0.0, 0.0, 1.0, 0.3), (0.0, 0.0, 0.0, 1.0))
"""A quarter turn about z, then a shift."""


def test_metadata_says_what_the_object_is(tmp_path: Path) -> None:
    path = export(cabinet_asset(), tmp_path / "usd", author="Ada", license="CC-BY-4.0")
    data = Sdf.Layer.FindOrOpen(str(path)).customLayerData
    fields = data["SimReady_Metadata"]
    assert (fields["author"], fields["asset_license"]) == ("Ada", "CC-BY-4.0")
    assert (fields["asset_name"], fields["asset_type"]) == ("cabinet", "prop")
    assert (fields["category"], fields["qcode"]) == ("furniture", "Q14745")
    assert fields["rigid_body_count"] == 3
    asset = cabinet_asset()
    assert fields["mass"] == pytest.approx(sum(p.mass.mass for p in asset.parts if p.mass))
    assert tuple(fields["asset_extents"]) == pytest.approx(tuple(np.ptp(asset.mesh.bounds, axis=0)))
    assert {"asset_name", "asset_type", "source_file", "usd_date_generated"} < set(data)


def test_metadata_without_masses_claims_none(tmp_path: Path) -> None:
    path = export(cabinet_asset(physics=False), tmp_path / "usd")
    assert "mass" not in Sdf.Layer.FindOrOpen(str(path)).customLayerData["SimReady_Metadata"]


@pytest.mark.parametrize(
    ("name", "root", "expected"),
    [
        ("dishwasher_02", "body", "dishwasher"),
        ("old_fridge_with_drawers", "body", "refrigerator"),
        ("front_door", "frame", "door"),
        ("input", "cabinet", "furniture"),
        ("input", "body", "physical object"),
        ("tablet", "body", "physical object"),
    ],
)
def test_category_is_read_from_whole_words(name: str, root: str, expected: str) -> None:
    asset = static_asset()
    named = replace(asset, name=name, parts=(Part("part", label=root),))
    assert category(named).name == expected


def test_thumbnail_is_where_browsers_look_and_the_same_every_time(tmp_path: Path) -> None:
    pictures = []
    for folder in ("one", "two"):
        path = export(painted_asset(), tmp_path / folder, thumbnail=True)
        picture = path.parent / ".thumbs" / "256x256" / "painted.usda.png"
        pictures.append(picture.read_bytes())
    assert pictures[0] == pictures[1]
    with Image.open(picture) as image:
        assert image.size == (256, 256)
        pixels = np.asarray(image.convert("RGB"), dtype=int)
    assert (pixels[0, 0] == 255).all()
    assert (pixels[..., 0] - pixels[..., 1] > 100).any(), "the red paint shows"


def test_there_is_one_usd_file_beside_the_folders(tmp_path: Path) -> None:
    # SimReady's NP.005; NP.002 and NP.003 allow these characters alone.
    for number, options in enumerate(({}, {"format": "usdc"}, {"layers": True})):
        path = export(glossy_asset(), tmp_path / str(number), **options)
        assert [p for p in path.parent.iterdir() if p.is_file()] == [path]
        names = "".join(p.name for p in path.parent.rglob("*"))
        assert names == names.lower()
        assert set(names) <= set("abcdefghijklmnopqrstuvwxyz0123456789._-")


def test_everything_is_labelled(tmp_path: Path) -> None:
    stage = open_stage(export(glossy_asset(), tmp_path / "usd"))
    materials = [prim for prim in stage.Traverse() if prim.IsA(UsdShade.Material)]
    assert sum(prim.HasAPI(UsdPhysics.MaterialAPI) for prim in materials) >= 1
    for prim in materials:
        assert list(UsdSemantics.LabelsAPI(prim, "material").GetLabelsAttr().Get()) == [prim.GetName()]
    assert list(
        UsdSemantics.LabelsAPI(stage.GetPrimAtPath("/glossy/door"), "class").GetLabelsAttr().Get()
    ) == ["door"]


def test_text_holds_no_long_arrays(tmp_path: Path) -> None:
    layer = Sdf.Layer.FindOrOpen(str(export(painted_asset(), tmp_path / "usd")))
    paths: list[Sdf.Path] = []
    layer.Traverse("/painted", paths.append)
    found = [layer.GetAttributeAtPath(path) for path in paths if path.IsPrimPropertyPath()]
    lengths = [len(a.default) for a in found if a and a.typeName.isArray]
    assert lengths
    assert max(lengths) <= 64  # what NVIDIA's UsdAsciiPerformanceChecker allows


def test_primitives_are_native_shapes_at_their_pose(tmp_path: Path) -> None:
    asset = primitive_asset()
    stage = open_stage(export(asset, tmp_path / "usd"))
    box, cylinder, sphere = (p for p in children(stage, "body") if p.HasAPI(UsdPhysics.CollisionAPI))
    assert [p.GetTypeName() for p in (box, cylinder, sphere)] == ["Cube", "Cylinder", "Sphere"]
    # 1 m along its own x is along y once turned.
    assert world_corners(box) == pytest.approx(np.array([[-0.9, -0.3, -1.2], [1.1, 0.7, 1.8]]), abs=1e-6)
    assert world_corners(cylinder) == pytest.approx(np.array([[-0.1, 0.0, -0.2], [0.3, 0.4, 0.8]]), abs=1e-6)
    assert world_corners(sphere) == pytest.approx(
        np.array([[-0.05, 0.05, 0.15], [0.25, 0.35, 0.45]]), abs=1e-6
    )
    assert UsdGeom.Cylinder(cylinder).GetAxisAttr().Get() == "Z"
    for prim in (box, cylinder, sphere):
        assert UsdGeom.Imageable(prim).ComputePurpose() == "guide"
        assert not prim.HasAPI(UsdPhysics.MeshCollisionAPI)
        assert UsdShade.MaterialBindingAPI(prim).GetDirectBinding("physics").GetMaterial()
    found = parsed(stage)
    assert set(found["RigidBody"]["body"].collisions) == {p.GetPath() for p in (box, cylinder, sphere)}
    assert tuple(found["CubeShape"]["collision_1"].halfExtents) == pytest.approx((0.5, 1.0, 1.5))
    assert found["CylinderShape"]["collision_2"].radius == pytest.approx(0.2)
    assert found["SphereShape"]["collision_3"].radius == pytest.approx(0.15)


def test_validators_of_openusd_find_nothing_in_primitives_and_layers(tmp_path: Path) -> None:
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    context = UsdValidation.ValidationContext(validators)
    for asset, options in ((primitive_asset(), {}), (many_kinds_asset(), {"layers": True})):
        stage = open_stage(export(asset, tmp_path / asset.name, **options))
        assert [(e.GetName(), e.GetMessage()) for e in context.Validate(stage)] == []


def primitive_asset() -> Asset:
    """One part that stands still, with a box, a cylinder and a sphere of different sizes in one pose."""
    pose = np.array(TURNED)
    corners = ConvexMesh(np.eye(4, 3), np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]))
    shapes = (
        Primitive("box", (1.0, 2.0, 3.0), pose),
        Primitive("cylinder", (0.4, 0.4, 1.0), pose),
        Primitive("sphere", (0.3, 0.3, 0.3), pose),
    )
    asset = static_asset()
    body = replace(asset.parts[0], collision=tuple(replace(corners, primitive=shape) for shape in shapes))
    return replace(asset, name="solids", parts=(body,))


def world_corners(prim: Usd.Prim) -> np.ndarray:
    """(2, 3) bounds of a collision shape in the stage's frame."""
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["guide"])
    bounds = cache.ComputeWorldBound(prim).ComputeAlignedRange()
    return np.array([bounds.GetMin(), bounds.GetMax()])
