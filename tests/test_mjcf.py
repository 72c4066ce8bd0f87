"""MJCF: MuJoCo sees what the asset says, with textures, classes and contacts that make sense."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from simart_kit_exporters.mjcf import Mjcf

from simart_kit.asset import Asset, ConvexMesh, Limits, Material
from simart_kit.errors import BadInputError
from simart_kit.kinematics import forward
from simart_kit.mesh import Image, Mesh, VisualMaterial
from simart_kit.testing.meshes import cabinet_asset, static_asset

from .export_cases import (
    CASES,
    absolute_paths,
    assert_same_robot,
    folder_hashes,
    overlapping_asset,
    random_positions,
    sheet_asset,
    surface_count,
    with_joint_kind,
)
from .readers import read_mujoco

VISUAL, COLLISION = 2, 3


def export(asset: Asset, folder: Path, **options: float) -> Path:
    folder.mkdir()
    return Mjcf(Mjcf.Options(**options)).export(asset, folder)


def load(asset: Asset, folder: Path, **options: float) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_path(str(export(asset, folder, **options)))


def contacts(model: mujoco.MjModel) -> list[float]:
    """Distances of the contacts at rest [m]."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return [float(contact.dist) for contact in data.contact]


@pytest.mark.parametrize("case", CASES)
def test_mujoco_sees_the_asset(case: str, tmp_path: Path) -> None:
    asset = CASES[case]()
    positions = random_positions(asset)
    assert_same_robot(read_mujoco(export(asset, tmp_path / "mjcf"), [positions])[0], asset, positions)


@pytest.mark.parametrize("case", CASES)
def test_shapes_are_either_drawn_or_solid(case: str, tmp_path: Path) -> None:
    asset = CASES[case]()
    model = load(asset, tmp_path / "mjcf")
    drawn, solid = model.geom_group == VISUAL, model.geom_group == COLLISION
    assert drawn.sum() == surface_count(asset)
    assert solid.sum() == sum(len(part.collision) for part in asset.parts)
    assert drawn.sum() + solid.sum() == model.ngeom
    np.testing.assert_array_equal(model.geom_contype, solid)
    np.testing.assert_array_equal(model.geom_conaffinity, solid)
    assert (model.geom_condim[solid] == 4).all()


@pytest.mark.parametrize(
    ("case", "pictures", "files"),
    [("textured", 3, 1), ("plain", 0, 0), ("painted", 3, 3), ("two_tone", 3, 1)],
)
def test_surfaces_keep_their_pictures(case: str, pictures: int, files: int, tmp_path: Path) -> None:
    path = export(CASES[case](), tmp_path / "mjcf")
    assert read_mujoco(path, [{}])[0].pictures == pictures
    assert len(list(path.parent.rglob("*.png"))) == mujoco.MjModel.from_xml_path(str(path)).ntex == files


def test_a_texture_has_the_pixels_and_coordinates_of_the_asset(tmp_path: Path) -> None:
    pixels = np.zeros((2, 2, 3), dtype=np.uint8)
    pixels[0, 0], pixels[1, 1] = (255, 0, 0), (0, 0, 255)
    asset = static_asset()
    look = replace(asset.mesh.materials[0], base_color_image=Image.from_pixels(pixels))
    model = load(replace(asset, mesh=replace(asset.mesh, materials=(look,))), tmp_path / "mjcf")
    np.testing.assert_array_equal(model.tex_data.reshape(2, 2, 3), pixels)
    # MuJoCo turns meshes to their principal axes; row 0 of its pictures is the top, where its v is 0.
    rotation, shift = np.zeros(9), model.mesh_pos[0]
    mujoco.mju_quat2Mat(rotation, model.mesh_quat[0])
    vertices = model.mesh_vert[: model.mesh_vertnum[0]] @ rotation.reshape(3, 3).T + shift
    faces = slice(0, model.mesh_facenum[0])
    corners = vertices[model.mesh_face[faces].ravel()]
    coordinates = model.mesh_texcoord[model.mesh_facetexcoord[faces].ravel()]
    # static_asset maps (x, z) to (x, z) / 0.5.
    np.testing.assert_allclose(coordinates[:, 0], corners[:, 0] / 0.5, atol=1e-5)
    np.testing.assert_allclose(1.0 - coordinates[:, 1], corners[:, 2] / 0.5, atol=1e-5)


def test_materials_are_shared_and_their_colors_are_srgb(tmp_path: Path) -> None:
    model = load(CASES["two_tone"](), tmp_path / "mjcf")
    assert model.nmat == 2
    # Linear 0.8 and 0.1 are 0.906 and 0.349 in IEC 61966-2-1; the tint of the other is in its picture.
    np.testing.assert_allclose(model.material("glass_red").rgba, [0.906, 0.349, 0.349, 0.5], atol=1e-3)
    np.testing.assert_allclose(model.material("checks").rgba, 1.0)


def test_joints_and_surfaces_have_the_asset_numbers(tmp_path: Path) -> None:
    asset = cabinet_asset()
    ice = replace(asset.part("door"), material=Material("ice", 900.0, 0.03, 0.0))
    heavy = replace(asset.joint("door_hinge"), armature=0.004)
    asset = asset.with_parts({"door": ice}).with_joints({"door_hinge": heavy})
    model = load(asset, tmp_path / "mjcf", timestep=0.001)
    assert model.joint("door_hinge").armature == 0.004
    for joint in asset.joints:
        found = model.joint(joint.name)
        assert found.damping == joint.damping
        assert found.frictionloss == joint.friction
        assert found.armature == joint.armature
        np.testing.assert_array_equal(model.jnt_actfrcrange[found.id], [-joint.effort, joint.effort])
    np.testing.assert_array_equal(model.geom("door_collision_0").friction, [0.03, 0.005, 0.0001])
    np.testing.assert_array_equal(model.geom("body_collision_0").friction, [0.5, 0.005, 0.0001])
    assert model.opt.timestep == 0.001
    assert model.opt.integrator == mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    assert model.opt.tolerance == 1e-10  # else a handle of 0.1 kg creeps on a gate of 560 kg


def test_two_exports_are_identical_and_hold_no_absolute_path(tmp_path: Path) -> None:
    for case in ("textured", "painted", "two_tone", "sheet"):
        export(CASES[case](), tmp_path / case)
        export(CASES[case](), tmp_path / f"{case}_again")
        assert folder_hashes(tmp_path / case) == folder_hashes(tmp_path / f"{case}_again")
        assert absolute_paths(tmp_path / case) == []


def test_the_folder_can_be_moved(tmp_path: Path) -> None:
    export(cabinet_asset(), tmp_path / "here")
    shutil.move(tmp_path / "here", tmp_path / "there")
    assert read_mujoco(tmp_path / "there" / "cabinet.xml", [{}])[0].pictures == 3


@pytest.mark.parametrize("floating", [False, True])
def test_parts_that_overlap_at_rest_do_not_push_each_other(floating: bool, tmp_path: Path) -> None:
    asset = replace(overlapping_asset(), floating=floating)
    path = export(asset, tmp_path / "mjcf")
    assert min(contacts(mujoco.MjModel.from_xml_path(str(path))), default=0.0) > -1e-5

    spec = mujoco.MjSpec.from_file(str(path))
    # A root that is free is a parent as others are: MuJoCo leaves out its contacts with its children.
    excluded = {(e.bodyname1, e.bodyname2): e.name for e in spec.excludes}
    expected = {("door", "drawer"): "door_drawer_at_rest"}
    assert excluded == expected | ({} if floating else {("body", "door"): "body_door_at_rest"})
    for exclude in list(spec.excludes):
        spec.delete(exclude)
    assert min(contacts(spec.compile())) == pytest.approx(-0.002, abs=1e-4)

    told = [text for text in Mjcf().unsupported(asset) if "shapes overlap" in text]
    assert len(told) == 1
    words = [f"{' and '.join(pair)} (2 mm) at rest" for pair in expected]
    assert all(text in told[0] and text in path.read_text() for text in words)


def test_contact_stays_on_between_parts_that_do_not_overlap(tmp_path: Path) -> None:
    model = load(cabinet_asset(), tmp_path / "mjcf")
    data = mujoco.MjData(model)
    data.joint("drawer_slide").qpos[0] = -0.05  # into the back of the cabinet, past its limit
    mujoco.mj_forward(model, data)
    touching = {model.body(model.geom_bodyid[g]).name for c in data.contact for g in c.geom}
    assert touching == {"body", "drawer"}
    assert not any("drawer" in text for text in Mjcf().unsupported(cabinet_asset()) if "overlap" in text)


def opened_by_hand(model: mujoco.MjModel) -> float:
    """Angle of the cabinet's door after a push of 2 N*m for a second [rad]."""
    data = mujoco.MjData(model)
    data.joint("door_hinge").qfrc_applied[0] = -2.0
    while data.time < 1.0:
        mujoco.mj_step(model, data)
    return float(data.joint("door_hinge").qpos[0])


def test_a_door_opens_all_the_way_past_a_frame_that_it_grazes(tmp_path: Path) -> None:
    # The hinge is 10 mm behind the door's front and 5 mm from the side: the corner turns 5 mm into it.
    path = export(cabinet_asset(), tmp_path / "mjcf")
    assert opened_by_hand(mujoco.MjModel.from_xml_path(str(path))) == pytest.approx(-1.5, abs=0.01)
    assert any("body and door (5 mm) on the way" in text for text in Mjcf().unsupported(cabinet_asset()))

    spec = mujoco.MjSpec.from_file(str(path))
    assert [exclude.name for exclude in spec.excludes] == ["body_door_on_the_way"]
    for exclude in list(spec.excludes):
        spec.delete(exclude)
    assert opened_by_hand(spec.compile()) > -1.0


def test_a_floating_asset_falls_and_a_fixed_one_stays(tmp_path: Path) -> None:
    for floating, drop in ((True, 0.5 * 9.81 * 0.1**2), (False, 0.0)):
        model = load(replace(cabinet_asset(), floating=floating), tmp_path / f"mjcf_{floating}")
        data = mujoco.MjData(model)
        while data.time < 0.1 - 1e-9:
            mujoco.mj_step(model, data)
        assert data.body("body").xpos[2] == pytest.approx(-drop, abs=2e-3)


def test_ball_and_free_joints_move_as_in_the_asset(tmp_path: Path) -> None:
    turn = np.array([0.3, -0.4, 0.5])
    quaternion = np.zeros(4)
    mujoco.mju_axisAngle2Quat(quaternion, turn / np.linalg.norm(turn), np.linalg.norm(turn))
    ball, free = with_joint_kind("ball"), with_joint_kind("free")
    shift = np.array([0.1, 0.2, 0.3])
    origin = np.array(free.joint("door_hinge").origin)
    for asset, position, qpos in (
        (ball, turn, quaternion),
        (free, np.concatenate([shift, turn]), np.concatenate([origin + shift, quaternion])),
    ):
        model = load(asset, tmp_path / asset.joint("door_hinge").kind)
        data = mujoco.MjData(model)
        data.joint("door_hinge").qpos[:] = qpos
        mujoco.mj_kinematics(model, data)
        expected = forward(asset, {"door_hinge": position.tolist()})["door"]
        np.testing.assert_allclose(data.body("door").xpos, expected[:3, 3], atol=1e-9)
        np.testing.assert_allclose(data.body("door").xmat.reshape(3, 3), expected[:3, :3], atol=1e-9)
    assert any(re.search("against the world: door_hinge$", text) for text in Mjcf().unsupported(free))


def test_a_joint_without_travel_is_left_out(tmp_path: Path) -> None:
    asset = cabinet_asset()
    stuck = replace(asset.joint("door_hinge"), limits=Limits(0.0, 0.0))
    asset = asset.with_joints({"door_hinge": stuck})
    assert load(asset, tmp_path / "mjcf").njnt == 1
    assert "a joint without travel is written as fixed: door_hinge" in Mjcf().unsupported(asset)


def test_an_asset_without_physics_loads(tmp_path: Path) -> None:
    asset = cabinet_asset(physics=False)
    positions = random_positions(asset)
    reading = read_mujoco(export(asset, tmp_path / "mjcf"), [positions])[0]
    for name, pose in forward(asset, positions).items():
        np.testing.assert_allclose(reading.poses[name], pose, atol=1e-6)
    assert any("no mass is known" in text for text in Mjcf().unsupported(asset))


def test_a_part_whose_mass_mujoco_cannot_find_is_told(tmp_path: Path) -> None:
    """What moves must weigh something, and a cabinet of a tenth of a millimetre does not."""
    asset = cabinet_asset(physics=False)
    tiny = replace(asset, mesh=replace(asset.mesh, vertices=asset.mesh.vertices * 1e-4))
    with pytest.raises(BadInputError, match=r"no mass is given for .*door.*: add the modifier mass"):
        export(tiny, tmp_path / "none")


def test_flat_collision_shapes_and_specks_load(tmp_path: Path) -> None:
    square = ConvexMesh(
        np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]), np.array([[0, 1, 2], [0, 2, 3]])
    )
    asset = static_asset()
    mesh = asset.mesh
    speck = np.array([[0.0, 0.0, 0.0], [1e-6, 0.0, 0.0], [0.0, 1e-6, 0.0]])
    mesh = Mesh(
        np.concatenate([mesh.vertices, speck]),
        np.concatenate([mesh.faces, [[8, 9, 10]]]),
        materials=(VisualMaterial("wood"), VisualMaterial("dust")),
        face_material=np.repeat([0, 1], [12, 1]),
    )
    asset = replace(asset, mesh=mesh, face_part=np.zeros(13))
    asset = asset.with_parts({"body": replace(asset.parts[0], collision=(square,))})
    model = load(asset, tmp_path / "mjcf")
    assert [int(group) for group in model.geom_group] == [VISUAL, COLLISION]
    assert any(re.search("speck.*: body$", text) for text in Mjcf().unsupported(asset))


@pytest.mark.parametrize("step", [0.0, 1e-9, 1e-8, 1e-7, 1e-6])
def test_surfaces_that_are_flat_but_for_their_last_digits_load(step: float, tmp_path: Path) -> None:
    """A label on a slanted face, one corner of which is a little off its plane."""
    asset = static_asset()
    mesh, place = asset.mesh, len(asset.mesh.vertices)
    label = np.array([(0, 0, 0), (0.02, 0, 0), (0.02, 0.014, 0.028), (0, 0.014, 0.028 + step)]) + [
        0.3,
        0.5,
        0.7,
    ]
    mesh = Mesh(
        np.concatenate([mesh.vertices, label]),
        np.concatenate([mesh.faces, place + np.array([[0, 1, 2], [0, 2, 3]])]),
        materials=(VisualMaterial("wood"), VisualMaterial("paper")),
        face_material=np.repeat([0, 1], [12, 2]),
    )
    model = load(replace(asset, mesh=mesh, face_part=np.zeros(14)), tmp_path / "mjcf")
    assert sum(group == VISUAL for group in model.geom_group) == 2


def test_what_is_lost_is_told() -> None:
    pixels = np.full((2, 2, 4), 128, dtype=np.uint8)
    asset = static_asset()
    look = replace(asset.mesh.materials[0], base_color_image=Image.from_pixels(pixels))
    look = replace(look, normal_image=look.base_color_image)
    colors = np.full((len(asset.mesh.vertices), 4), 7)
    told = Mjcf().unsupported(replace(asset, mesh=replace(asset.mesh, colors=colors, materials=(look,))))
    for text in ("vertex colours", "normal, metallic and roughness", "transparency", "restitution"):
        assert any(text in sentence for sentence in told), text
    assert any(re.search("given a back.*: flag$", text) for text in Mjcf().unsupported(sheet_asset()))
