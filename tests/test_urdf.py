"""URDF: four loaders see what the asset says, in folders that can be moved and made again byte for byte."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import yourdfpy
from simart_kit_exporters.urdf import Urdf

from simart_kit.asset import Asset, ConvexMesh, Limits, Material
from simart_kit.kinematics import forward
from simart_kit.testing.meshes import cabinet_asset, static_asset

from .export_cases import (
    CASES,
    absolute_paths,
    assert_same_robot,
    folder_hashes,
    random_positions,
    sheet_asset,
    surface_count,
    two_tone_asset,
    with_joint_kind,
)
from .readers import URDF_READERS, read_mujoco, read_yourdfpy

DRAKE = "{http://drake.mit.edu}"


def export(asset: Asset, folder: Path, **options: bool) -> Path:
    folder.mkdir()
    return Urdf(Urdf.Options(**options)).export(asset, folder)


@pytest.mark.parametrize("loader", URDF_READERS)
@pytest.mark.parametrize("case", CASES)
def test_loaders_see_the_asset(case: str, loader: str, tmp_path: Path) -> None:
    asset = CASES[case]()
    positions = random_positions(asset)
    reading = URDF_READERS[loader](export(asset, tmp_path / "urdf"), [positions])[0]
    assert_same_robot(reading, asset, positions)


@pytest.mark.parametrize(
    ("case", "pictures"), [("textured", 3), ("plain", 0), ("painted", 3), ("two_tone", 3), ("static", 1)]
)
def test_surfaces_keep_their_pictures(case: str, pictures: int, tmp_path: Path) -> None:
    asset = CASES[case]()
    path = export(asset, tmp_path / "urdf")
    robot = ElementTree.parse(path)
    assert len(robot.findall("link/visual")) == surface_count(asset)
    assert read_yourdfpy(path, [{}])[0].pictures == pictures


def test_a_picture_is_the_one_of_the_asset(tmp_path: Path) -> None:
    asset = static_asset()
    robot = yourdfpy.URDF.load(str(export(asset, tmp_path / "urdf")))
    (shape,) = robot.scene.geometry.values()
    image = asset.mesh.materials[0].base_color_image
    assert image is not None
    np.testing.assert_array_equal(np.asarray(shape.visual.material.image.convert("RGBA")), image.pixels)
    np.testing.assert_allclose(shape.bounds, asset.mesh.bounds, atol=1e-6)


def test_parts_share_one_picture_file(tmp_path: Path) -> None:
    export(cabinet_asset(), tmp_path / "urdf")
    assert len(list((tmp_path / "urdf").rglob("*.png"))) == 1
    assert len(list((tmp_path / "urdf").rglob("*.mtl"))) == 3


def test_plain_colors_are_srgb(tmp_path: Path) -> None:
    path = export(two_tone_asset(), tmp_path / "urdf")
    (color,) = ElementTree.parse(path).findall("link/visual/material/color")
    # Linear 0.8 and 0.1 are 0.906 and 0.349 in IEC 61966-2-1.
    np.testing.assert_allclose(
        [float(v) for v in color.attrib["rgba"].split()], [0.906, 0.349, 0.349, 0.5], atol=1e-3
    )


def test_two_exports_are_identical_and_hold_no_absolute_path(tmp_path: Path) -> None:
    for case in ("textured", "painted", "two_tone", "sheet"):
        export(CASES[case](), tmp_path / case)
        export(CASES[case](), tmp_path / f"{case}_again")
        assert folder_hashes(tmp_path / case) == folder_hashes(tmp_path / f"{case}_again")
        assert absolute_paths(tmp_path / case) == []


def test_the_folder_can_be_moved(tmp_path: Path) -> None:
    export(cabinet_asset(), tmp_path / "here")
    shutil.move(tmp_path / "here", tmp_path / "there")
    assert read_yourdfpy(tmp_path / "there" / "cabinet.urdf", [{}])[0].pictures == 3
    assert read_mujoco(tmp_path / "there" / "cabinet.urdf", [{}])[0].colliders.total() == 9


def test_every_joint_has_what_ros_asks_for(tmp_path: Path) -> None:
    robot = ElementTree.parse(export(CASES["chain"](), tmp_path / "urdf"))
    limits = {j.attrib["name"]: j.find("limit").attrib for j in robot.findall("joint")}
    assert limits["post_spin"] == {"effort": "50", "velocity": "2"}
    assert limits["arm_hinge"] == {"lower": "-0.7", "upper": "0.9", "effort": "50", "velocity": "2"}
    package = ElementTree.parse(tmp_path / "urdf" / "package.xml").getroot()
    fields = {"name", "version", "description", "maintainer", "license"}
    assert {child.tag for child in package} == fields
    assert all((child.text or "").strip() for child in package)


def test_dry_friction_is_written_on_request_only(tmp_path: Path) -> None:
    asset = cabinet_asset()
    without = ElementTree.parse(export(asset, tmp_path / "without")).findall("joint/dynamics")
    assert [d.attrib for d in without] == [{"damping": "0.05"}, {"damping": "2"}]
    with_it = ElementTree.parse(export(asset, tmp_path / "with", dynamics_friction=True)).findall(
        "joint/dynamics"
    )
    assert [d.attrib["friction"] for d in with_it] == ["0.02", "0.5"]
    assert any("dry friction" in text for text in Urdf().unsupported(asset))
    assert not any("dry friction" in t for t in Urdf(Urdf.Options(dynamics_friction=True)).unsupported(asset))


def test_meshes_are_named_by_package_on_request(tmp_path: Path) -> None:
    asset = cabinet_asset()
    path = export(asset, tmp_path / "urdf", package_uris=True)
    names = [mesh.attrib["filename"] for mesh in ElementTree.parse(path).iter("mesh")]
    assert len(names) == 12
    # Some find a package by its name, some by that of its folder.
    assert ElementTree.parse(path.parent / "package.xml").getroot().findtext("name") == path.parent.name
    for name in names:
        assert name.startswith("package://cabinet/meshes/")
        assert (tmp_path / "urdf" / name.removeprefix("package://")).is_file()
    assert read_yourdfpy(path, [{}])[0].pictures == 3


def test_surface_friction_is_written_for_gazebo_pybullet_and_drake(tmp_path: Path) -> None:
    asset = static_asset()
    asset = asset.with_parts({"body": replace(asset.parts[0], material=Material("ice", 900.0, 0.03, 0.0))})
    robot = ElementTree.parse(export(asset, tmp_path / "urdf"))
    properties = f"link/collision/{DRAKE}proximity_properties/{DRAKE}mu_"
    for path in ("link/contact/lateral_friction", f"{properties}static", f"{properties}dynamic"):
        assert [e.attrib["value"] for e in robot.findall(path)] == ["0.03"], path
    for path in ("gazebo/mu1", "gazebo/mu2"):
        assert [e.text for e in robot.findall(path)] == ["0.03"], path


@pytest.mark.parametrize("loader", URDF_READERS)
@pytest.mark.parametrize("kind", ["fixed", "ball", "free"])
def test_joints_that_urdf_lacks_become_fixed(kind: str, loader: str, tmp_path: Path) -> None:
    asset = with_joint_kind(kind)
    positions = {"drawer_slide": 0.2}
    reading = URDF_READERS[loader](export(asset, tmp_path / "urdf"), [positions])[0]
    assert set(reading.limits) == {"drawer_slide"}
    for name, pose in forward(asset, positions).items():
        np.testing.assert_allclose(reading.poses[name], pose, atol=1e-6)
    told = any(re.search("written as fixed: door_hinge$", t) for t in Urdf().unsupported(asset))
    assert told == (kind != "fixed")


@pytest.mark.parametrize("loader", URDF_READERS)
def test_a_joint_without_travel_loads_as_fixed(loader: str, tmp_path: Path) -> None:
    asset = cabinet_asset()
    stuck = replace(asset.joint("door_hinge"), limits=Limits(0.0, 0.0))
    asset = asset.with_joints({"door_hinge": stuck})
    reading = URDF_READERS[loader](export(asset, tmp_path / "urdf"), [{}])[0]
    assert set(reading.limits) == {"drawer_slide"}
    assert "a joint without travel is written as fixed: door_hinge" in Urdf().unsupported(asset)


@pytest.mark.parametrize("loader", URDF_READERS)
def test_a_flat_collision_shape_becomes_a_slab(loader: str, tmp_path: Path) -> None:
    square = ConvexMesh(
        np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]), np.array([[0, 1, 2], [0, 2, 3]])
    )
    asset = static_asset()
    asset = asset.with_parts({"body": replace(asset.parts[0], collision=(square, square))})
    assert URDF_READERS[loader](export(asset, tmp_path / "urdf"), [{}])[0].colliders["body"] == 2


def test_what_is_lost_is_told() -> None:
    heavy = replace(cabinet_asset().joint("door_hinge"), armature=0.1)
    told = Urdf().unsupported(cabinet_asset().with_joints({"door_hinge": heavy}))
    assert any(re.search("armature.*: door_hinge$", text) for text in told)
    assert any("base is free" in text for text in Urdf().unsupported(replace(cabinet_asset(), floating=True)))
    assert any("body, door, drawer" in t for t in Urdf().unsupported(cabinet_asset(physics=False)))
    assert any(re.search("given a back.*: flag$", text) for text in Urdf().unsupported(sheet_asset()))
    assert Urdf().unsupported(static_asset()) == ()


def test_an_asset_without_physics_loads_for_kinematics(tmp_path: Path) -> None:
    asset = cabinet_asset(physics=False)
    positions = random_positions(asset)
    reading = read_yourdfpy(export(asset, tmp_path / "urdf"), [positions])[0]
    for name, pose in forward(asset, positions).items():
        np.testing.assert_allclose(reading.poses[name], pose, atol=1e-6)
