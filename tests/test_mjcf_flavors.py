"""MJCF as robosuite's objects have it, and as one archive."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree
from zipfile import ZipFile

import mujoco
import numpy as np
import pytest
from simart_kit_exporters.mjcf import Mjcf

from simart_kit.asset import Asset, Part
from simart_kit.kinematics import forward
from simart_kit.testing.meshes import cabinet_asset, chain_asset, static_asset

from .export_cases import (
    CASES,
    assert_same_robot,
    folder_hashes,
    overlapping_asset,
    random_positions,
    with_joint_kind,
)
from .readers import read_mujoco


def export(asset: Asset, folder: Path, **options: str | bool) -> Path:
    folder.mkdir()
    return Mjcf(Mjcf.Options(**options)).export(asset, folder)


def robosuite(asset: Asset, folder: Path) -> Path:
    return export(asset, folder, flavor="robosuite")


def lifted(asset: Asset, height: float) -> Asset:
    """The asset with its surface moved up, and nothing else."""
    return replace(asset, mesh=replace(asset.mesh, vertices=asset.mesh.vertices + [0.0, 0.0, height]))


@pytest.mark.parametrize("case", CASES)
def test_an_object_of_robosuite_is_the_same_robot(case: str, tmp_path: Path) -> None:
    asset = CASES[case]()
    positions = random_positions(asset)
    reading = read_mujoco(robosuite(asset, tmp_path / "mjcf"), [positions])[0]
    for name in ("", "object"):
        np.testing.assert_array_equal(reading.poses.pop(name), np.eye(4))
        assert reading.inertials.pop(name).mass == 0.0
    assert_same_robot(reading, asset, positions)


def test_robosuite_finds_the_object_and_its_sites(tmp_path: Path) -> None:
    root = ElementTree.parse(robosuite(lifted(cabinet_asset(), 0.1), tmp_path / "mjcf"))
    assert root.find("worldbody/body/body[@name='object']/body[@name='body']") is not None
    sites = {s.attrib["name"]: s.attrib["pos"] for s in root.findall("worldbody/body/site")}
    places = {name: np.array(place.split(), dtype=float) for name, place in sites.items()}
    assert set(places) == {"bottom_site", "top_site", "horizontal_radius_site"}
    # 0.6 x 0.4 x 0.8 m; handles stand out by 30 mm, but less far from the middle than the corners.
    np.testing.assert_allclose(places["bottom_site"], [0.0, 0.0, 0.1], atol=1e-12)
    np.testing.assert_allclose(places["top_site"], [0.0, 0.0, 0.9])
    np.testing.assert_allclose(places["horizontal_radius_site"][:2], np.hypot(0.3, 0.2))


def test_what_robosuite_reads_from_the_text_is_in_it(tmp_path: Path) -> None:
    # It looks up groups in the class alone, wants a place of each site, and knows no folder of meshes.
    path = robosuite(cabinet_asset(), tmp_path / "mjcf")
    root = ElementTree.parse(path)
    groups = {d.attrib["class"]: d.find("geom").attrib["group"] for d in root.findall("default/default")}
    assert groups == {"visual": "1", "collision": "0", "region": "1"}
    assert all("pos" in site.attrib for site in root.iter("site"))
    assert all("class" in geom.attrib for geom in root.find("worldbody").iter("geom"))
    files = [element.attrib["file"] for element in root.find("asset") if "file" in element.attrib]
    assert len(files) == 13
    assert all((path.parent / file).is_file() for file in files)
    assert root.find("compiler").attrib == {"angle": "radian"}
    assert all(j.attrib["limited"] == "true" for j in root.iter("joint"))


def test_shapes_are_named_and_grouped_as_robosuite_has_them(tmp_path: Path) -> None:
    model = mujoco.MjModel.from_xml_path(str(robosuite(cabinet_asset(), tmp_path / "mjcf")))
    names = {model.geom(g).name: int(model.geom_group[g]) for g in range(model.ngeom)}
    solid = {name for name, group in names.items() if group == 0}
    drawn = {name for name, group in names.items() if group == 1}
    assert solid == {
        f"{part}_g{i}" for part, count in (("body", 5), ("door", 2), ("drawer", 2)) for i in range(count)
    }
    assert drawn == {"body_g0_vis", "door_g0_vis", "drawer_g0_vis", "reg_bbox"}
    region = model.geom("reg_bbox")
    np.testing.assert_allclose(region.size, [0.3, 0.215, 0.4])
    np.testing.assert_allclose(region.pos, [0.0, -0.015, 0.4])
    assert region.contype == region.conaffinity == region.rgba[3] == 0


def test_pairs_are_excluded_by_the_names_of_their_bodies(tmp_path: Path) -> None:
    asset = overlapping_asset()
    model = mujoco.MjModel.from_xml_path(str(robosuite(asset, tmp_path / "mjcf")))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert model.nexclude == 2
    assert min((contact.dist for contact in data.contact), default=0.0) > -1e-5


def test_names_that_robosuite_keeps_for_itself_are_numbered_and_told(tmp_path: Path) -> None:
    asset = static_asset()
    asset = replace(asset, parts=(replace(asset.parts[0], name="object"),))
    model = mujoco.MjModel.from_xml_path(str(robosuite(asset, tmp_path / "mjcf")))
    assert [model.body(b).name for b in range(model.nbody)] == ["world", "", "object", "object_2"]
    told = Mjcf(Mjcf.Options(flavor="robosuite")).unsupported(asset)
    assert any(text.endswith(": object as object_2") for text in told)
    assert not any("object_2" in text for text in Mjcf().unsupported(asset))


def test_what_floats_is_fixed_in_an_object_of_robosuite_and_told(tmp_path: Path) -> None:
    asset = replace(with_joint_kind("free"), floating=True)
    model = mujoco.MjModel.from_xml_path(str(robosuite(asset, tmp_path / "mjcf")))
    assert [model.joint(j).name for j in range(model.njnt)] == ["drawer_slide"]
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    np.testing.assert_allclose(data.body("door").xpos, forward(asset)["door"][:3, 3], atol=1e-12)
    told = Mjcf(Mjcf.Options(flavor="robosuite")).unsupported(asset)
    assert any("written as fixed: door_hinge" in text for text in told)
    assert any("base is written as fixed" in text for text in told)


def test_a_flat_object_has_a_box_of_bounds_that_mujoco_takes(tmp_path: Path) -> None:
    asset = static_asset()
    vertices = asset.mesh.vertices * [1.0, 1.0, 0.0]
    asset = replace(asset, mesh=replace(asset.mesh, vertices=vertices))
    asset = asset.with_parts({"body": Part("body")})
    model = mujoco.MjModel.from_xml_path(str(robosuite(asset, tmp_path / "mjcf")))
    np.testing.assert_allclose(model.geom("reg_bbox").size, [0.2, 0.15, 0.005])


@pytest.mark.parametrize("flavor", ["menagerie", "robosuite"])
@pytest.mark.parametrize("case", ["two_tone", "chain", "primitives"])
def test_one_archive_holds_the_same_model(case: str, flavor: str, tmp_path: Path) -> None:
    asset = CASES[case]()
    loose = mujoco.MjModel.from_xml_path(str(export(asset, tmp_path / "loose", flavor=flavor)))
    path = export(asset, tmp_path / "one", flavor=flavor, single_file=True)
    assert [p.name for p in (tmp_path / "one").iterdir()] == [f"{asset.name}.mjz"] == [path.name]
    shutil.move(path, tmp_path / "moved.mjz")
    packed = mujoco.MjSpec.from_file(str(tmp_path / "moved.mjz")).compile()
    for field in ("body_mass", "body_inertia", "jnt_range", "geom_pos", "geom_quat", "mesh_vert", "tex_data"):
        np.testing.assert_array_equal(getattr(packed, field), getattr(loose, field), err_msg=field)


def test_two_archives_are_identical(tmp_path: Path) -> None:
    for name in ("one", "two"):
        export(CASES["two_tone"](), tmp_path / name, single_file=True)
    assert folder_hashes(tmp_path / "one") == folder_hashes(tmp_path / "two")
    with ZipFile(tmp_path / "one" / "cabinet.mjz") as archive:
        names = archive.namelist()
        assert archive.testzip() is None
    assert names[0] == "model.xml"
    assert names[1:] == sorted(names[1:])
    assert all(name.startswith("assets/") for name in names[1:])


def test_the_flavor_changes_no_number_of_the_joints(tmp_path: Path) -> None:
    models = [
        mujoco.MjModel.from_xml_path(str(export(chain_asset(), tmp_path / name, flavor=name)))
        for name in ("menagerie", "robosuite")
    ]
    for field in ("jnt_type", "jnt_axis", "jnt_range", "dof_damping", "dof_armature", "dof_frictionloss"):
        np.testing.assert_array_equal(getattr(models[0], field), getattr(models[1], field), err_msg=field)
