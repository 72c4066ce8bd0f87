"""The USDZ exporter: the package, its one animation, and the joints told beside it."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade, UsdValidation
from simart_kit_exporters.usdz import Usdz

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint, Limits, Part
from simart_kit.kinematics import forward
from simart_kit.mesh import Image
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset, chain_asset, static_asset

from .export_cases import painted_asset, sheet_asset, with_joint_kind
from .usd_cases import glossy_asset, many_kinds_asset, triangles
from .usd_readers import open_stage

# Written out: x stays, up becomes y, front (-y) becomes +z.
STAGE_T_ASSET = np.array(
    [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
SHOWN = {"Xform", "Scope", "Mesh", "Material", "Shader"}
ASSETS = {
    a.name: a for a in (chain_asset(), static_asset(), glossy_asset(), many_kinds_asset(), painted_asset())
}


def export(asset: Asset, folder: Path) -> Path:
    folder.mkdir(exist_ok=True)
    return Usdz().export(asset, folder)


@pytest.fixture(scope="module", params=ASSETS)
def case(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Asset, Path]:
    asset = ASSETS[request.param]
    return asset, export(asset, tmp_path_factory.mktemp("usdz") / "usdz")


def poses(stage: Usd.Stage, seconds: float) -> dict[str, FloatArray]:
    """`stage_T_part` (4, 4) by name, at a time."""
    cache = UsdGeom.XformCache(seconds * stage.GetTimeCodesPerSecond())
    root = stage.GetDefaultPrim()
    parts = [p for p in stage.Traverse() if p.GetTypeName() == "Xform" and p != root]
    # Gf multiplies row vectors.
    return {prim.GetName(): np.array(cache.GetLocalToWorldTransform(prim)).T for prim in parts}


def expected(asset: Asset, positions: dict[str, float]) -> dict[str, FloatArray]:
    return {n: STAGE_T_ASSET @ pose @ STAGE_T_ASSET.T for n, pose in forward(asset, positions).items()}


def test_package_is_stored_aligned_and_without_a_time_of_day(case: tuple[Asset, Path]) -> None:
    data = case[1].read_bytes()
    with zipfile.ZipFile(case[1]) as package:
        entries = package.infolist()
    assert entries[0].filename == f"{case[0].name}.usdc"
    for entry in entries:
        assert entry.compress_type == zipfile.ZIP_STORED
        assert entry.date_time == (1980, 1, 1, 0, 0, 0)
        assert entry.filename.endswith((".usdc", ".png"))
        name, extra = (int.from_bytes(data[entry.header_offset + at :][:2], "little") for at in (26, 28))
        assert (entry.header_offset + 30 + name + extra) % 64 == 0


def test_openusd_finds_no_error(case: tuple[Asset, Path]) -> None:
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    found = UsdValidation.ValidationContext(validators).Validate(open_stage(case[1]))
    assert [error.GetMessage() for error in found] == []


def test_stage_is_what_ar_viewers_take(case: tuple[Asset, Path]) -> None:
    stage = open_stage(case[1])
    assert UsdGeom.GetStageUpAxis(stage) == "Y"
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    assert stage.GetDefaultPrim().GetName() == case[0].name
    assert {str(prim.GetTypeName()) for prim in stage.Traverse()} <= SHOWN


def test_surfaces_stand_where_the_asset_has_them(case: tuple[Asset, Path]) -> None:
    asset, stage = case[0], open_stage(case[1])
    meshes = [p for p in stage.Traverse() if p.IsA(UsdGeom.Mesh)]
    for index, part in enumerate(asset.parts):
        found = np.concatenate([triangles(p) for p in meshes if p.GetParent().GetName() == part.name])
        turned = asset.mesh.triangles[asset.face_part == index] @ STAGE_T_ASSET[:3, :3].T
        assert sorted_rows(found) == pytest.approx(sorted_rows(turned), abs=2e-5)


def test_textures_come_along_and_colors_are_pictures(tmp_path: Path) -> None:
    stage = open_stage(export(painted_asset(), tmp_path))
    for prim in stage.Traverse():
        if prim.IsA(UsdGeom.Mesh):
            material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
            source, channel, _ = (
                material.ComputeSurfaceSource()[0].GetInput("diffuseColor").GetConnectedSource()
            )
            texture = UsdShade.Shader(source.GetPrim())
            assert (texture.GetIdAttr().Get(), channel) == ("UsdUVTexture", "rgb")
            file = texture.GetInput("file").Get()
            with zipfile.ZipFile(tmp_path / "cabinet.usdz") as package:
                picture = Image(package.read(file.path.removeprefix("./")))
            assert len(np.unique(picture.pixels.reshape(-1, 4), axis=0)) > 1
            assert UsdGeom.PrimvarsAPI(prim).GetPrimvar("st").HasValue()


def test_open_surfaces_are_drawn_from_both_sides(tmp_path: Path) -> None:
    stage = open_stage(export(sheet_asset(), tmp_path))
    sides = {p.GetParent().GetName(): UsdGeom.Mesh(p) for p in stage.Traverse() if p.IsA(UsdGeom.Mesh)}
    assert {name: mesh.GetDoubleSidedAttr().Get() for name, mesh in sides.items()} == {
        "body": False,
        "flag": True,
    }


def test_parts_go_to_their_limits_and_back_one_after_the_other(tmp_path: Path) -> None:
    asset = cabinet_asset()
    stage = open_stage(export(asset, tmp_path))
    assert stage.GetEndTimeCode() / stage.GetTimeCodesPerSecond() == 6.0
    # The door takes from 0 to 4 s, the drawer from 2 to 6 s; half way through they are at their limits.
    for seconds, positions in {
        0.0: {},
        2.0: {"door_hinge": -1.5},
        4.0: {"drawer_slide": 0.3},
        6.0: {},
    }.items():
        found = poses(stage, seconds)
        for name, pose in expected(asset, positions).items():
            np.testing.assert_allclose(found[name], pose, atol=1e-6, err_msg=f"{name} at {seconds} s")
    assert poses(stage, 4.0)["drawer"][:3, 3] == pytest.approx([0.0, 0.65, 0.5], abs=1e-6)  # forward


def test_motions_of_a_chain_add_up(tmp_path: Path) -> None:
    asset = chain_asset()
    stage = open_stage(export(asset, tmp_path))
    # The arm starts at 2 s and has 0.9 + 1.6 + 0.7 rad to go in 4 s, so it is at 0.9 rad after 1.125 s. The
    # post has then done 3.125 of 4 s of its turn, which begins and ends gently: s^2 (3 - 2 s).
    share = 3.125 / 4.0
    positions = {"post_spin": 2 * np.pi * share**2 * (3 - 2 * share), "arm_hinge": 0.9}
    found = poses(stage, 3.125)
    for name, pose in expected(asset, positions).items():
        np.testing.assert_allclose(found[name], pose, atol=1e-6, err_msg=name)


def test_many_joints_are_shown_within_ten_seconds(tmp_path: Path) -> None:
    count = 21
    bounds = [((0.1 * i, 0.0, 0.0), (0.1 * i + 0.08, 0.1, 0.1)) for i in range(count)]
    parts = tuple(Part(f"box_{i}") for i in range(count))
    joints = tuple(
        Joint(f"slide_{i}", "prismatic", "box_0", f"box_{i}", limits=Limits(0.0, 0.2))
        for i in range(1, count)
    )
    asset = Asset("row", boxes_mesh(bounds), np.repeat(range(count), 12), parts, joints)
    stage = open_stage(export(asset, tmp_path))
    assert stage.GetEndTimeCode() <= 10.0 * stage.GetTimeCodesPerSecond()
    table = json.loads((tmp_path / "row.joints.json").read_text())
    starts = [joint["shown"][0] for joint in table["joints"]]
    assert starts == sorted(set(starts))
    for joint in table["joints"]:
        middle = poses(stage, sum(joint["shown"]) / 2)[joint["child"]]
        assert middle[1, 3] == pytest.approx(0.2, abs=1e-6)


def test_joints_are_told_in_the_frame_of_the_package(tmp_path: Path) -> None:
    asset = chain_asset()
    path = export(asset, tmp_path)
    table = json.loads((tmp_path / "chain.joints.json").read_text(encoding="utf-8"))
    assert sorted(file.name for file in tmp_path.iterdir()) == ["chain.joints.json", "chain.usdz"]
    assert (table["schema"], table["model"], table["units"]["angle"]) == (1, "chain.usdz", "rad")
    joints = {joint["name"]: joint for joint in table["joints"]}
    arm = joints["arm_hinge"]
    assert (arm["kind"], arm["limits"]) == ("revolute", [-0.7, 0.9])
    assert arm["origin"] == pytest.approx([0.05, 0.33, 0.0])
    assert arm["axis"] == pytest.approx([0.6, 0.8, 0.0])
    assert joints["post_spin"]["limits"] is None
    stage = open_stage(path)
    assert stage.GetPrimAtPath(arm["parent_path"]).GetName() == "post"
    assert stage.GetPrimAtPath(arm["child_path"]).GetName() == "arm"
    bodies = {body["name"]: body for body in table["bodies"]}
    for part in asset.parts:
        assert part.mass is not None
        assert bodies[part.name]["mass"] == part.mass.mass
        assert stage.GetPrimAtPath(bodies[part.name]["path"]).GetTypeName() == "Xform"


def test_what_stays_at_rest_is_told(tmp_path: Path) -> None:
    asset = with_joint_kind("ball")
    assert "at rest are those of: door_hinge" in " ".join(Usdz().unsupported(asset))
    stage = open_stage(export(asset, tmp_path))
    np.testing.assert_allclose(poses(stage, 1.0)["door"], expected(asset, {})["door"], atol=1e-6)
    table = json.loads((tmp_path / "cabinet.joints.json").read_text())
    assert {j["name"]: (j["shown"], j["axis"]) for j in table["joints"]}["door_hinge"] == (None, None)


def test_a_static_object_has_no_animation(tmp_path: Path) -> None:
    stage = open_stage(export(static_asset(), tmp_path))
    assert not stage.HasAuthoredTimeCodeRange()
    assert not any(
        attribute.GetNumTimeSamples() for prim in stage.Traverse() for attribute in prim.GetAttributes()
    )


def sorted_rows(corners: FloatArray) -> FloatArray:
    """(F, 9), in an order that does not depend on that of the faces."""
    rows = np.round(corners.reshape(-1, 9), 5) + 0.0
    return rows[np.lexsort(rows.T)]
