"""Real objects from file to asset: the parts, joints and sizes that they really have."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import simart_kit as sk
from simart_kit.asset import Asset, Joint
from simart_kit.cli.main import run
from simart_kit.kinematics import rest_to_posed

from .real_objects import DATA, Truth, line_distance, needs_data, source, true_axis, true_part, truth

pytestmark = needs_data

Convert = Callable[[str], sk.Result]

JOINTS = {
    "painted_wooden_cabinet": Counter(revolute=2, prismatic=2),
    "painted_wooden_cabinet_02": Counter(revolute=1, prismatic=1),
    "painted_wooden_stool": Counter[str](),
}
HEIGHTS = {  # [m], of the files as they came, in which drawers and doors are nodes of their own
    "painted_wooden_cabinet_1k": 1.18,
    "painted_wooden_cabinet_02_1k": 2.57,
    "painted_wooden_stool_1k": 0.58,
}

# True parts that must be found; finding more of what is true is no fault.
FOUND = {
    "bigym_base_door": {"door_right"},
    "bigym_base_drawers": {"drawer_big_2", "drawer_small_1", "drawer_small_2"},
    "bigym_base_small_drawers": {f"drawer_small_{number}" for number in (1, 2, 3, 4)},
    "bigym_wall_cabinet": {"door_left", "door_right"},
    "bigym_wall_cabinet_glass": {"door_left_glass", "door_right_glass"},
    "gz_hinged_door": {"door"},
    "gz_wooden_case": set[str](),
    "jsk_fridge": {f"ROOM73B2-HITACHI-FIESTA-REFRIGERATOR-BODYSET{number}_link" for number in (6, 7)},
}


@pytest.fixture
def no_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures take longest, and have tests of their own."""
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)


@pytest.fixture
def quick(tmp_path: Path, no_picture: None) -> Convert:
    """Convert as far as parts, joints and sizes go: without physics, formats and recording."""
    moving = 'modify=[{use="scale"},{use="snap"},{use="sweep"}]'
    return lambda name: sk.convert(
        source(name), "geometric", out=tmp_path / name, record=False, sets=["export=[]", moving]
    )


def kinds(asset: Asset) -> Counter[str]:
    return Counter(joint.kind for joint in asset.joints)


def assert_true(asset: Asset, joint: Joint, known: Truth, overlap: float) -> None:
    """The joint moves a true part, as it really moves."""
    part, share = true_part(asset, joint, known)
    assert share >= overlap, f"{joint.child} is {share:.2f} of {part['name']}"
    assert joint.kind == part["joint"]["type"]
    direction, point = true_axis(part, asset.asset_from_source)
    assert abs(direction @ joint.axis) > np.cos(np.deg2rad(1.0)), joint.name
    if joint.turns:
        away = line_distance(np.array(joint.origin), np.array(joint.axis), point)
        assert away < 0.05 * asset.mesh.diagonal, f"{joint.name} is {away:.3f} m off"


def assert_opens_toward_the_front(asset: Asset, joint: Joint) -> None:
    """At its upper limit the part is far out in front (-y) of where it rests."""
    assert joint.limits is not None
    corners = asset.mesh.triangles[asset.face_part == asset.part_index(joint.child)].reshape(-1, 3)
    posed_T_rest = rest_to_posed(asset, {joint.name: joint.limits.upper})[joint.child]
    moved = (corners @ posed_T_rest[:3, :3].T + posed_T_rest[:3, 3])[:, 1].min()
    size = corners[:, :2].max(axis=0) - corners[:, :2].min(axis=0)
    assert moved < corners[:, 1].min() - 0.5 * size.max() * (1.0 if joint.turns else 0.5)


def assert_as_in_truth(name: str, asset: Asset) -> None:
    assert kinds(asset) == JOINTS[name.removesuffix("_1k")]
    known = truth(name)
    matched = [true_part(asset, joint, known)[0]["name"] for joint in asset.joints]
    assert sorted(matched) == sorted(part["name"] for part in known.moving())
    for joint in asset.joints:
        assert_true(asset, joint, known, overlap=0.9)
        assert_opens_toward_the_front(asset, joint)
        assert joint.parent == asset.root.name
        assert joint.flags == ()
        upright = (0.0, 0.0, 1.0) if joint.turns else (0.0, -1.0, 0.0)
        assert np.abs(np.dot(joint.axis, upright)) > 0.9999


@pytest.mark.parametrize("name", JOINTS)
def test_one_mesh_comes_apart_as_it_really_does(name: str, converted: Convert) -> None:
    result = converted(name)
    assert_as_in_truth(name, result.asset)
    assert result.report.passed


@pytest.mark.parametrize(("name", "height"), HEIGHTS.items())
def test_nodes_with_transforms_make_no_difference(name: str, height: float, quick: Convert) -> None:
    nodes = json.loads(source(name).read_text(encoding="utf-8"))["nodes"]
    moved = [node for node in nodes if "translation" in node]
    asset = quick(name).asset
    assert_as_in_truth(name, asset)
    assert len(moved) == len(asset.joints)
    assert np.ptp(asset.mesh.bounds[:, 2]) == pytest.approx(height, abs=0.005)
    assert asset.mesh.bounds[0, 2] == pytest.approx(0.0, abs=1e-9)
    assert asset.scale.factor == 1.0


def test_a_stool_is_static_and_that_is_a_success_that_is_told(
    no_picture: None, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    stool = DATA / "painted_wooden_stool" / "input.glb"
    arguments = ["convert", str(stool), "--recipe", "usd", "--out", str(tmp_path), "--no-record"]
    assert run(arguments) == 0
    assert "static: nothing moves (1 part, 0 joints)" in capfd.readouterr().out
    report = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert report["static"] is True
    assert report["joints"] == []
    assert report["passed"] is True


def test_the_command_line_converts_a_cabinet_to_usd(
    no_picture: None, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    cabinet = DATA / "painted_wooden_cabinet" / "input.glb"
    arguments = ["convert", str(cabinet), "--recipe", "usd", "--out", str(tmp_path), "--no-record"]
    assert run([*arguments, "--name", "cabinet"]) == 0
    assert "5 parts, 4 joints" in capfd.readouterr().out
    assert (tmp_path / "usd" / "cabinet.usda").is_file()
    assert not any((tmp_path / other).exists() for other in ("urdf", "mjcf"))
    assert_as_in_truth("painted_wooden_cabinet", sk.load_asset(tmp_path))


@pytest.mark.parametrize("name", FOUND)
def test_what_is_found_is_true(name: str, quick: Convert) -> None:
    asset, known = quick(name).asset, truth(name)
    matched = [true_part(asset, joint, known)[0]["name"] for joint in asset.joints]
    assert len(set(matched)) == len(matched)
    assert set(matched) >= FOUND[name]
    for joint in asset.joints:
        assert_true(asset, joint, known, overlap=0.9)
