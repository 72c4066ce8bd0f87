"""Complete conversions of real objects: every format says the same, in every tool that reads it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

import simart_kit as sk
from simart_kit.asset import Asset
from simart_kit.kinematics import forward, sample_positions

from .export_cases import absolute_paths, assert_same_robot, folder_hashes
from .looks import CENTRES, CORNERS, Floats, Look, mjcf_looks, source_look, urdf_looks, usd_looks
from .readers import URDF_READERS, read_mujoco
from .real_objects import ANY_SPEED, EXAMPLE, needs_data, source
from .recordings import contents
from .usd_readers import forward as usd_forward
from .usd_readers import open_stage, parsed, read_inertials, read_joints

Convert = Callable[[str], sk.Result]
Looks = Callable[[Path, Floats], dict[str, Look]]

NAMES = (
    "example",
    pytest.param("painted_wooden_cabinet", marks=[needs_data, pytest.mark.slow]),
    pytest.param("painted_wooden_cabinet_02", marks=[needs_data, pytest.mark.slow]),
    pytest.param("painted_wooden_stool", marks=[needs_data, pytest.mark.slow]),
)
FORMATS: dict[str, Looks] = {"urdf": urdf_looks, "mjcf": mjcf_looks, "usd": usd_looks}
POSES = 10


@pytest.fixture(params=NAMES)
def result(request: pytest.FixtureRequest, converted: Convert) -> sk.Result:
    return converted(request.param)


def poses(asset: Asset) -> list[dict[str, float]]:
    """The rest pose and random ones within the limits."""
    rng = np.random.default_rng(7)
    return [{}, *(sample_positions(asset, rng) for _ in range(POSES))]


@pytest.mark.parametrize("reader", URDF_READERS)
def test_urdf_is_the_asset_at_every_pose(reader: str, result: sk.Result) -> None:
    asked = poses(result.asset)
    for positions, found in zip(asked, URDF_READERS[reader](result.paths["urdf"], asked), strict=True):
        assert_same_robot(found, result.asset, positions)


def test_mjcf_is_the_asset_at_every_pose(result: sk.Result) -> None:
    asked = poses(result.asset)
    for positions, found in zip(asked, read_mujoco(result.paths["mjcf"], asked), strict=True):
        assert_same_robot(found, result.asset, positions)


def test_usd_is_the_asset_at_every_pose(result: sk.Result) -> None:
    asset, stage = result.asset, open_stage(result.paths["usd"])
    for positions in poses(asset):
        found, expected = usd_forward(stage, positions), forward(asset, positions)
        assert set(found) == set(expected)
        for name, pose in expected.items():
            np.testing.assert_allclose(found[name], pose, atol=1e-5, err_msg=name)
    inertials = read_inertials(stage)
    for part in asset.parts:
        assert part.mass is not None
        np.testing.assert_allclose(inertials[part.name].mass, part.mass.mass, rtol=1e-5)
        np.testing.assert_allclose(inertials[part.name].center, part.mass.center, atol=1e-5)
        np.testing.assert_allclose(inertials[part.name].inertia, part.mass.inertia, rtol=1e-5, atol=1e-5)


def test_the_physics_parser_of_openusd_finds_what_was_written(result: sk.Result) -> None:
    asset, stage = result.asset, open_stage(result.paths["usd"])
    found, joints = parsed(stage), read_joints(stage)
    assert set(found["RigidBody"]) == {part.name for part in asset.parts}
    assert len(found["Articulation"]) == 1
    shapes = {name: len(item.collisions) for name, item in found["RigidBody"].items()}
    assert shapes == {part.name: len(part.collision) for part in asset.parts}
    assert all(item.isValid for kind in found.values() for item in kind.values())
    descriptors = {
        name: item for kind in found if kind.endswith("Joint") for name, item in found[kind].items()
    }
    assert set(descriptors) == {joint.name for joint in asset.joints} | {"FixedBase"}
    for joint in asset.joints:
        assert joint.limits is not None
        unit = 180 / np.pi if joint.turns else 1.0
        limit = descriptors[joint.name].limit
        written = (joint.limits.lower * unit, joint.limits.upper * unit)
        assert limit.enabled
        assert (limit.lower, limit.upper) == pytest.approx(written, abs=1e-5)
        assert joints[joint.name].limits == pytest.approx((joint.limits.lower, joint.limits.upper), abs=1e-5)


@pytest.mark.parametrize("form", FORMATS)
def test_every_part_wears_the_texture_of_the_source(
    form: str, result: sk.Result, request: pytest.FixtureRequest
) -> None:
    name = request.node.callspec.params["result"]
    truth = source_look(source(name), result.asset.asset_from_source, CENTRES)
    assert truth.textured
    found = FORMATS[form](result.paths[form], CENTRES)
    assert all(look.textured for look in found.values())
    assert_looks_like(found, truth, result.asset)


def assert_looks_like(found: dict[str, Look], truth: Look, asset: Asset) -> None:
    """Every part shows its own triangles, each in the colours that the source has there."""
    assert {name: look.faces for name, look in found.items()} == {
        part.name: int((asset.face_part == index).sum()) for index, part in enumerate(asset.parts)
    }
    shown = cKDTree(truth.places)
    for name, look in found.items():
        distance, nearest = shown.query(look.places)
        assert np.max(distance) < 1e-2, name  # of unit normals: slivers turn a little when rounded
        assert np.abs(look.places - truth.places[nearest])[:, :3].max() < 1e-5, name
        off = np.abs(look.colors - truth.colors[nearest]).max(axis=1)
        assert off.max() < 2.0, f"{name}: {off.max():.1f} of 255"


@pytest.fixture(scope="module")
def painted(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, sk.Result]:
    """The example without its texture, with a colour a vertex that tells where it is."""
    mesh = trimesh.load(EXAMPLE, process=False, force="mesh")
    share = (mesh.vertices - mesh.bounds[0]) / np.ptp(mesh.bounds, axis=0)
    colors = np.column_stack([40 + 200 * share, np.full(len(share), 255)]).astype(np.uint8)
    folder = tmp_path_factory.mktemp("painted")
    bare = trimesh.Trimesh(mesh.vertices, mesh.faces, vertex_colors=colors, process=False)
    bare.export(folder / "painted.glb")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
        sets = ['modify=[{use="scale"}]']  # physics has no colours
        result = sk.convert(folder / "painted.glb", out=folder / "out", record=False, sets=sets)
    return folder / "painted.glb", result


@pytest.mark.parametrize("form", FORMATS)
def test_vertex_colours_are_on_every_part(form: str, painted: tuple[Path, sk.Result]) -> None:
    path, result = painted
    assert len(result.asset.parts) == 5
    truth = source_look(path, result.asset.asset_from_source, CORNERS)
    assert_looks_like(FORMATS[form](result.paths[form], CORNERS), truth, result.asset)


@pytest.fixture(scope="module")
def again(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the example converted by the command line, in a process that orders sets in its own way."""
    folder = tmp_path_factory.mktemp("again") / "out"
    options = ["--recipe", "geometric", "--out", str(folder), *(f"--set={text}" for text in ANY_SPEED)]
    command = [sys.executable, "-m", "simart_kit", "convert", str(EXAMPLE), *options]
    environment = {**os.environ, "PYTHONHASHSEED": "1"}
    subprocess.run(command, env=environment, check=True, capture_output=True, timeout=120)
    return folder


def test_two_runs_leave_the_same_bytes(again: Path, converted: Convert) -> None:
    own = {"provenance.json", "cabinet.rrd"}  # times of the run, and rows that rerun numbers at random
    left = [folder_hashes(folder) for folder in (converted("example").folder, again)]
    assert set(left[0]) == set(left[1]) > own
    one, two = ({name: found for name, found in files.items() if name not in own} for files in left)
    assert one == two
    record = json.loads((again / "provenance.json").read_text(encoding="utf-8"))
    assert {name: found for name, found in record["outputs"].items() if name not in own} == one


def test_two_recordings_say_the_same_but_for_how_long_it_took(again: Path, converted: Convert) -> None:
    one, two = (contents(p) for p in (converted("example").paths["recording"], again / "cabinet.rrd"))
    differ = {entity for entity, *_ in set(one) ^ set(two)}
    assert differ <= {"/report/timings", "/report/seconds"}
    assert len(one) > 40


def test_a_moved_folder_is_whole(again: Path, tmp_path: Path) -> None:
    folder = tmp_path / "elsewhere" / "moved"
    shutil.copytree(again, folder)
    asset = sk.load_asset(folder)
    positions = poses(asset)[1]
    assert_same_robot(read_mujoco(folder / "mjcf" / "cabinet.xml", [positions])[0], asset, positions)
    for reader in URDF_READERS.values():
        assert_same_robot(reader(folder / "urdf" / "cabinet.urdf", [positions])[0], asset, positions)
    looks = usd_looks(folder / "usd" / "cabinet.usda", CENTRES)
    assert set(looks) == {part.name for part in asset.parts}
    assert all(look.textured for look in looks.values())
    assert absolute_paths(folder) == []
    assert str(again) not in (folder / "usd" / "cabinet.usda").read_text(encoding="utf-8")


def simulate(model: mujoco.MjModel, seconds: float, push: dict[str, float]) -> tuple[Floats, float]:
    """Joint positions at the end, and the highest speed, under gravity and constant pushes [N | N*m]."""
    data, fastest = mujoco.MjData(model), 0.0
    for name, force in push.items():
        data.joint(name).qfrc_applied[0] = force
    while data.time < seconds:
        mujoco.mj_step(model, data)
        fastest = max(fastest, float(np.abs(data.qvel).max(initial=0.0)))
    assert not any(warning.number for warning in data.warning)
    return np.array(data.qpos), fastest


def test_nothing_moves_by_itself(result: sk.Result) -> None:
    model = mujoco.MjModel.from_xml_path(str(result.paths["mjcf"]))
    positions, fastest = simulate(model, 1.0, {})
    assert np.abs(positions).max(initial=0.0) < 1e-4
    assert fastest < 1e-3


def test_a_hand_opens_each_joint_to_its_limit_and_moves_no_other(result: sk.Result) -> None:
    model = mujoco.MjModel.from_xml_path(str(result.paths["mjcf"]))
    for joint in result.asset.joints:
        assert joint.limits is not None
        push = 5.0 if joint.turns else 20.0  # an arm's 5 N*m, at a drawer 25 cm away
        positions, fastest = simulate(model, 6.0, {joint.name: push})
        moved = positions[model.joint(joint.name).qposadr[0]]
        assert moved == pytest.approx(joint.limits.upper, abs=0.01), joint.name
        others = np.delete(positions, model.joint(joint.name).qposadr[0])
        assert np.abs(others).max(initial=0.0) < 1e-3, joint.name
        assert fastest < 20.0


def test_the_doors_of_the_example_open_clear_of_its_frame(converted: Convert) -> None:
    # Where shapes meet on the way, contact is switched off and told: here nothing has to be.
    result = converted("example")
    assert mujoco.MjModel.from_xml_path(str(result.paths["mjcf"])).nexclude == 0
    assert not any("overlap" in text for text in result.report.unsupported["mjcf"])
