"""URDF as a source: the same kinematics as yourdfpy reads, the same looks, and clear words about the rest."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
import yourdfpy
from PIL import Image as Pillow
from simart_kit_exporters.urdf import Urdf

import simart_kit as sk
from simart_kit.arrays import unit, vec3
from simart_kit.asset import Asset, Joint, Limits
from simart_kit.kinematics import rest_to_posed, sample_positions
from simart_kit.testing.meshes import cabinet_asset, chain_asset

from . import usd_readers
from .adapter_cases import BASE, BOX, joint, limit, load, write

RED = (200, 30, 40)
LEANING = vec3(unit((0.05, 0.0, 1.0)))
# Left out: that they say the right things is tested elsewhere.
CHECKS = (
    *("files", "lint", "agreement", "mass", "collision", "joints", "penetration", "sweep", "travel"),
    *("settle", "gravity", "push", "energy", "timestep", "realtime"),
)


def assert_same_motion(path: Path, asset: Asset, names: dict[str, str] | None = None, count: int = 5) -> None:
    """Every part moves as yourdfpy says that its link does, over random positions, to 1e-6."""
    robot = yourdfpy.URDF.load(str(path), load_meshes=False, build_scene_graph=True)
    links = names or {part.name: part.name for part in asset.parts}
    robot.update_cfg(dict.fromkeys(robot.actuated_joint_names, 0.0))
    rest = {part: robot.get_transform(link) for part, link in links.items()}
    source_from_asset = np.linalg.inv(asset.asset_from_source)
    rng = np.random.default_rng(5)
    for _ in range(count):
        positions = sample_positions(asset, rng)
        assert set(positions) == set(robot.actuated_joint_names)
        robot.update_cfg(positions)
        for part, moved in rest_to_posed(asset, positions).items():
            expected = robot.get_transform(links[part]) @ np.linalg.inv(rest[part])
            np.testing.assert_allclose(
                source_from_asset @ moved @ asset.asset_from_source, expected, atol=1e-6, err_msg=part
            )


def part_bounds(asset: Asset, name: str) -> np.ndarray:
    """(2, 3) box of a part in the frame of its source."""
    faces = asset.face_part == asset.part_index(name)
    corners = asset.mesh.triangles[faces].reshape(-1, 3)
    back = np.linalg.inv(asset.asset_from_source)
    points = corners @ back[:3, :3].T + back[:3, 3]
    return np.array([points.min(axis=0), points.max(axis=0)])


def exported(asset: Asset, folder: Path, **options: bool) -> Path:
    folder.mkdir()
    return Urdf(Urdf.Options(**options)).export(asset, folder)


@pytest.mark.parametrize("make", [cabinet_asset, chain_asset])
@pytest.mark.parametrize("packaged", [False, True])
def test_an_export_comes_back_as_it_was(make: Callable[[], Asset], packaged: bool, tmp_path: Path) -> None:
    asset = make()
    path = exported(asset, tmp_path / "urdf", package_uris=packaged)
    again = load(path)
    assert_same_motion(path, again)
    assert [part.name for part in again.parts] == [part.name for part in asset.parts]
    assert [len(again.mesh.faces), again.mesh.diagonal] == [
        len(asset.mesh.faces),
        pytest.approx(asset.mesh.diagonal),
    ]
    shift = again.asset_from_source[:3, 3]
    for mine in asset.joints:
        other = again.joint(mine.name)
        assert (other.kind, other.parent, other.child) == (mine.kind, mine.parent, mine.child)
        np.testing.assert_allclose(other.axis, mine.axis, atol=1e-6)
        np.testing.assert_allclose(other.origin - shift, mine.origin, atol=1e-6)
        assert (other.limits is None) == (mine.limits is None)
        if mine.limits and other.limits:
            assert other.limits.lower == pytest.approx(mine.limits.lower)
            assert other.limits.upper == pytest.approx(mine.limits.upper)
        assert (other.effort, other.velocity) == (mine.effort, mine.velocity)
    for part in asset.parts:
        stated = again.part(part.name).stated_mass
        assert part.mass is None or stated == pytest.approx(part.mass.mass)


def test_a_picture_of_an_export_is_kept_once_and_pixel_for_pixel(tmp_path: Path) -> None:
    asset = cabinet_asset()
    again = load(exported(asset, tmp_path / "urdf"))
    (before,) = {id(m.base_color_image): m.base_color_image for m in asset.mesh.materials}.values()
    (after,) = {id(m.base_color_image): m.base_color_image for m in again.mesh.materials}.values()
    assert before is not None
    assert after is not None
    np.testing.assert_array_equal(after.pixels, before.pixels)
    assert again.mesh.uv is not None


def everything(folder: Path) -> Path:
    """Origins with rpy, a scaled and mirrored mesh, primitives, kinds of joint, global materials."""
    cube = trimesh.creation.box(extents=(1, 2, 3))
    (folder / "meshes").mkdir()
    cube.export(folder / "meshes" / "cube.stl")
    visual = '<visual><origin xyz="0.1 0.2 0.3" rpy="0.3 -0.2 0.5"/><geometry>{}</geometry>{}</visual>'
    shapes = {
        "base": '<mesh filename="meshes/cube.stl" scale="0.1 -0.2 0.3"/>',
        "arm": '<box size="0.1 0.2 0.4"/>',
        "hand": '<cylinder radius="0.05" length="0.3"/>',
        "slide": '<sphere radius="0.1"/>',
        "wheel": '<cylinder radius="0.2" length="0.05"/>',
        "plate": '<box size="0.3 0.3 0.01"/>',
    }
    links = [
        f'<link name="{name}">{visual.format(shape, "<material name=" + chr(34) + "red" + chr(34) + "/>")}'
        f'<inertial><mass value="{index + 1}"/></inertial></link>'
        for index, (name, shape) in enumerate(shapes.items())
    ]
    place = '<origin xyz="0.4 -0.1 0.2" rpy="0.1 0.7 -0.4"/>'
    return write(
        folder,
        '<material name="red"><color rgba="1 0 0 0.5"/></material>',
        *links,
        joint("j_arm", "revolute", "base", "arm", f'{place}<axis xyz="1 2 -1"/>{limit(-0.5, 1.2)}'),
        joint("j_hand", "continuous", "arm", "hand", f'{place}<axis xyz="0 0 -2"/>'),
        joint("j_slide", "prismatic", "hand", "slide", f"{place}{limit(0, 0.3)}"),
        joint(
            "j_wheel",
            "continuous",
            "base",
            "wheel",
            f'{place}<axis xyz="0 1 0"/><dynamics damping="0.7" friction="0.2"/>',
        ),
        joint("j_plate", "fixed", "slide", "plate", place),
    )


def test_a_file_with_everything_moves_as_yourdfpy_says(tmp_path: Path) -> None:
    path = everything(tmp_path)
    asset = load(path)
    assert_same_motion(path, asset)
    kinds = {j.name: j.kind for j in asset.joints}
    assert kinds == {
        "j_arm": "revolute",
        "j_hand": "continuous",
        "j_slide": "prismatic",
        "j_wheel": "continuous",
        "j_plate": "fixed",
    }
    assert (asset.joint("j_arm").effort, asset.joint("j_arm").velocity) == (9.0, 3.0)
    assert (asset.joint("j_wheel").damping, asset.joint("j_wheel").friction) == (0.7, 0.2)
    assert [part.stated_mass for part in asset.parts] == [1, 2, 3, 4, 5, 6]


def test_shapes_stand_where_yourdfpy_puts_them(tmp_path: Path) -> None:
    path = everything(tmp_path)
    asset = load(path)
    robot = yourdfpy.URDF.load(str(path))
    # Round shapes are cut into other triangles: 5 mm is near.
    back = np.linalg.inv(asset.asset_from_source)
    points = asset.mesh.triangles.reshape(-1, 3) @ back[:3, :3].T + back[:3, 3]
    np.testing.assert_allclose([points.min(0), points.max(0)], robot.scene.bounds, atol=0.005)
    assert trimesh.Trimesh(asset.mesh.vertices, asset.mesh.faces).volume > 0, (
        "the mirrored mesh is outside in"
    )


def test_a_capsule_is_as_long_as_its_cylinder_and_two_caps(tmp_path: Path) -> None:
    shape = BASE.replace('<box size="1 1 1"/>', '<capsule radius="0.1" length="0.5"/>')
    np.testing.assert_allclose(
        part_bounds(load(write(tmp_path, shape)), "base"), [(-0.1, -0.1, -0.35), (0.1, 0.1, 0.35)], atol=1e-9
    )


def test_colors_are_srgb_and_named_materials_are_found(tmp_path: Path) -> None:
    asset = load(everything(tmp_path))
    assert {m.base_color for m in asset.mesh.materials} == {(1.0, 0.0, 0.0, 0.5)}
    grey = write(
        tmp_path,
        BASE.replace("</visual>", '<material name=""><color rgba="0.5 0.5 0.5 1"/></material></visual>'),
    )
    (material,) = load(grey).mesh.materials
    assert material.base_color[0] == pytest.approx(((0.5 + 0.055) / 1.055) ** 2.4)  # IEC 61966-2-1


def test_pictures_of_mesh_files_are_found_as_in_partnet_mobility(tmp_path: Path) -> None:
    for name in ("textured_objs", "images"):
        (tmp_path / name).mkdir()
    Pillow.new("RGB", (4, 4), RED).save(tmp_path / "images" / "texture_0.png")
    (tmp_path / "textured_objs" / "a.mtl").write_text("newmtl m\nmap_Kd ../images/texture_0.png\n")
    (tmp_path / "textured_objs" / "a.obj").write_text(
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
    )
    mesh = '<visual><geometry><mesh filename="textured_objs/a.obj"/></geometry></visual>'
    (tmp_path / "mobility_v2.json").write_text('[{"id": 0, "name": "door", "joint": "hinge"}]')
    asset = load(write(tmp_path, f'<link name="link_0">{mesh}</link>'))
    (material,) = asset.mesh.materials
    assert material.base_color_image is not None
    assert material.base_color_image.pixels[0, 0, :3].tolist() == list(RED)
    assert asset.parts[0].label == "door"


def test_a_texture_of_the_urdf_is_put_on_a_mesh_with_coordinates(tmp_path: Path) -> None:
    Pillow.new("RGB", (4, 4), RED).save(tmp_path / "red.png")
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
    mesh = (
        '<visual><geometry><mesh filename="a.obj"/></geometry>'
        '<material name="m"><texture filename="red.png"/></material></visual>'
    )
    (material,) = load(write(tmp_path, f'<link name="a">{mesh}</link>')).mesh.materials
    assert material.base_color_image is not None
    assert material.base_color_image.pixels[0, 0, :3].tolist() == list(RED)


def test_links_without_a_shape_that_are_fixed_change_nothing(tmp_path: Path) -> None:
    turn = '<origin xyz="1 0 0" rpy="0 0 1.2"/>'
    path = write(
        tmp_path,
        '<link name="world"/>',
        BASE,
        '<link name="axle"/>',
        f'<link name="wheel">{BOX}</link>',
        f'<link name="cap">{BOX}</link>',
        '<link name="tip"/>',
        joint("mount", "fixed", "world", "base", turn),
        joint("spin", "continuous", "base", "axle", turn + '<axis xyz="0 1 0"/>'),
        joint("weld", "fixed", "axle", "wheel", turn),
        joint("cap_spin", "continuous", "axle", "cap", turn),
        joint("tip_weld", "fixed", "cap", "tip", turn),
    )
    asset = load(path)
    assert [part.name for part in asset.parts] == ["base", "wheel", "cap"]
    assert_same_motion(path, asset)
    assert asset.joint("spin").child == "wheel"
    assert asset.joint("cap_spin").parent == "wheel"


def test_a_joint_that_cannot_be_at_0_is_counted_from_where_it_stands(tmp_path: Path) -> None:
    path = write(
        tmp_path,
        BASE,
        f'<link name="lid">{BOX}</link>',
        f'<link name="knob">{BOX}</link>',
        joint("hinge", "revolute", "base", "lid", f'<axis xyz="0 0 1"/>{limit(math.pi / 2, 3)}'),
        joint("slide", "prismatic", "lid", "knob", f'<origin xyz="2 0 0"/>{limit(0, 1)}'),
    )
    asset = load(path)
    # The lid stands at a quarter turn about z, so the knob is 2 along y and slides along y.
    np.testing.assert_allclose(part_bounds(asset, "knob").mean(axis=0), (0, 2, 0), atol=1e-9)
    np.testing.assert_allclose(asset.joint("slide").axis, (0, 1, 0), atol=1e-9)
    assert asset.joint("hinge").limits == Limits(0.0, 3 - math.pi / 2)
    assert any("cannot be at 0" in note.text for note in asset.notes)


def test_a_conversion_takes_the_joints_of_the_file_whatever_the_recipe(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path.write_bytes(b"picture"))
    asset = cabinet_asset()
    # An axis that `snap` would turn upright, and limits that `sweep` would shorten.
    lean = Joint("lean", "revolute", "body", "door", (-0.275, -0.19, 0.0), LEANING, Limits(-1.5, 1.5))
    odd = replace(asset, joints=(lean, asset.joints[1]))
    path = exported(odd, tmp_path / "urdf")
    off = [f"checks.{name}=false" for name in CHECKS]
    result = sk.convert(path, "usd", out=tmp_path / "out", record=False, sets=off)
    assert_same_motion(path, result.asset)
    limits = result.asset.joint("lean").limits
    assert limits is not None
    assert (limits.lower, limits.upper) == (-1.5, 1.5)
    texts = [note.text for note in result.report.notes]
    assert "the file states its joints, so they are left as they are by snap, sweep, clear" in texts
    assert any("the recipe's segmenter and joint predictor are not used" in text for text in texts)
    assert_same_usd(result.paths["usd"], path, result.asset)
    assert len(list((tmp_path / "out" / "usd" / "textures").glob("*.png"))) == 1


def assert_same_usd(file: Path, path: Path, asset: Asset) -> None:
    """Bodies of a USD move as yourdfpy says that the links of the URDF do, to 1e-6."""
    stage, robot = usd_readers.open_stage(file), yourdfpy.URDF.load(str(path), load_meshes=False)
    turn = asset.asset_from_source
    at_rest = usd_readers.forward(stage, {})
    rest = {name: robot.get_transform(name) for name in at_rest}
    positions = sample_positions(asset, np.random.default_rng(3))
    robot.update_cfg(positions)
    for name, pose in usd_readers.forward(stage, positions).items():
        expected = turn @ robot.get_transform(name) @ np.linalg.inv(rest[name]) @ np.linalg.inv(turn)
        np.testing.assert_allclose(pose @ np.linalg.inv(at_rest[name]), expected, atol=1e-6, err_msg=name)
