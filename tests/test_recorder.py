"""The recorder, fed through its hooks with real values; rerun's own reader and tools judge the recordings."""

import json
import subprocess
import sys
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from simart_kit_plugins.recorder import Recorder

from simart_kit.errors import StageError
from simart_kit.kinematics import rest_to_posed
from simart_kit.mesh import Image, Mesh, canonical
from simart_kit.normals import with_normals
from simart_kit.recipe import Recipe
from simart_kit.report import Report
from simart_kit.testing.meshes import cabinet_asset, chain_asset, static_asset
from simart_kit.voxels import cube_frame, voxelise

from .recordings import (
    CHECKS,
    bars,
    before_snap,
    chunks,
    contents,
    failed,
    paths_in,
    positions,
    recipe,
    recorded,
    rerun_rrd,
    run_in,
    text,
    told,
    transforms,
    values,
    views,
)


@pytest.fixture(scope="module")
def cabinet(tmp_path_factory):
    return recorded(cabinet_asset(), tmp_path_factory.mktemp("cabinet"))


@pytest.fixture(scope="module")
def chain(tmp_path_factory):
    return recorded(chain_asset(), tmp_path_factory.mktemp("chain"))


def test_a_finished_run_shows_every_stage(cabinet):
    found = paths_in(cabinet)
    parts, joints = ("body", "door", "drawer"), ("door_hinge", "drawer_slide")
    expected = {"/source/mesh/surface", "/voxels", "/segments", "/part_labels"}
    expected |= {f"/report/{name}" for name in ("summary", "checks", "modifiers", "timings", "recipe")}
    for part in parts:
        expected |= {f"/parts/{part}", f"/asset/parts/{part}/surface", f"/collision/{part}"}
    for joint in joints:
        for above in ("/asset/joints", "/modifiers/snap/after"):
            expected |= {f"{above}/{joint}/{drawing}" for drawing in ("axis", "travel", "label")}
        expected |= {f"/modifiers/snap/before/{joint}/axis", f"/joint_positions/{joint}"}
    assert expected <= found
    assert not any(path.startswith("/failure") for path in found)


def test_only_motion_has_times(cabinet):
    timed = {chunk.entity_path for chunk in chunks(cabinet) if not chunk.is_static}
    assert timed == {
        "/asset/parts/door",
        "/asset/parts/drawer",
        "/joint_positions/door_hinge",
        "/joint_positions/drawer_slide",
    }
    assert all(list(c.timeline_names) == ["sweep"] for c in chunks(cabinet) if not c.is_static)


def test_times_are_whole_microseconds_which_pyarrow_reads_without_pandas(cabinet):
    timed = [chunk.to_record_batch().column("sweep") for chunk in chunks(cabinet) if not chunk.is_static]
    stamps = np.concatenate([np.array(column.cast("int64")) for column in timed])
    assert len(stamps) > 20
    assert not (stamps % 1000).any()


@pytest.mark.parametrize(
    ("asset", "joint", "part"),
    [
        (cabinet_asset(), "door_hinge", "door"),
        (cabinet_asset(), "drawer_slide", "drawer"),
        (chain_asset(), "post_spin", "post"),
        (chain_asset(), "post_spin", "arm"),
        (chain_asset(), "arm_hinge", "arm"),
    ],
)
def test_parts_move_over_the_sweep_as_forward_kinematics_says(asset, joint, part, tmp_path):
    path = recorded(asset, tmp_path)
    joint_times, joint_values = positions(path, joint)
    inner = slice(1, -1)  # the ends of the plot repeat the rest position
    joint_times, joint_values = joint_times[inner], joint_values[inner]
    if asset.joint(joint).turns:
        joint_values = np.deg2rad(joint_values)
    times, posed = transforms(path, f"/asset/parts/{part}")
    assert len(joint_times) > 20
    for time, value in zip(joint_times, joint_values, strict=True):
        expected = rest_to_posed(asset, {joint: value})[part]
        np.testing.assert_allclose(posed[np.abs(times - time).argmin()], expected, atol=1e-5)


def test_each_joint_visits_both_limits_and_returns_to_rest_before_the_next(cabinet):
    asset, ends = cabinet_asset(), []
    for joint in asset.joints:
        times, shown = positions(cabinet, joint.name)
        lower, upper = joint.limits.lower, joint.limits.upper
        if joint.turns:
            lower, upper = np.rad2deg([lower, upper])
        assert (shown.min(), shown.max()) == (pytest.approx(lower), pytest.approx(upper))
        assert (shown[0], shown[-1]) == (0.0, 0.0)
        moving = times[shown != 0.0]
        ends.append((moving.min(), moving.max()))
    assert ends[0][1] < ends[1][0]


def test_the_drawing_of_a_joint_rides_on_the_part_that_carries_it(chain):
    for of_drawing, of_part in zip(
        transforms(chain, "/asset/joints/arm_hinge"), transforms(chain, "/asset/parts/post"), strict=True
    ):
        np.testing.assert_array_equal(of_drawing, of_part)


def test_surfaces_of_the_parts_are_those_of_the_asset(cabinet):
    asset, corners = cabinet_asset(), []
    for index, part in enumerate(asset.parts):
        entity = f"/asset/parts/{part.name}/surface"
        vertices = np.array(values(cabinet, entity, "Mesh3D:vertex_positions")[0][0])
        faces = np.array(values(cabinet, entity, "Mesh3D:triangle_indices")[0][0])
        corners = vertices[faces]
        np.testing.assert_allclose(corners, asset.mesh.triangles[asset.face_part == index], atol=1e-6)


def test_the_texture_is_recorded_with_v_from_the_top(cabinet):
    asset = cabinet_asset()
    mesh = with_normals(asset.mesh)
    uv = np.array(values(cabinet, "/source/mesh/surface", "Mesh3D:vertex_texcoords")[0][0])
    faces = np.array(values(cabinet, "/source/mesh/surface", "Mesh3D:triangle_indices")[0][0])
    expected = mesh.uv[mesh.faces]
    np.testing.assert_allclose(uv[faces][..., 0], expected[..., 0], atol=1e-6)
    np.testing.assert_allclose(uv[faces][..., 1], 1.0 - expected[..., 1], atol=1e-6)
    pixels = values(cabinet, "/source/mesh/surface", "Mesh3D:albedo_texture_buffer")[0][0][0]
    assert bytes(pixels) == asset.mesh.materials[0].base_color_image.pixels[:, :, :3].tobytes()


def test_vertex_colours_are_recorded(tmp_path):
    asset = static_asset()
    colors = np.tile(np.array([10, 200, 30, 255], dtype=np.uint8), (len(asset.mesh.vertices), 1))
    painted = replace(asset, mesh=Mesh(asset.mesh.vertices, asset.mesh.faces, colors=colors))
    path = recorded(painted, tmp_path)
    shown = values(path, "/asset/parts/body/surface", "Mesh3D:vertex_colors")[0][0]
    assert set(shown) == {0x0AC81EFF}


def test_a_large_texture_is_shrunk_and_keeps_its_colour(tmp_path):
    asset = static_asset()
    picture = Image.from_pixels(np.full((3000, 3000, 3), (200, 100, 50), dtype=np.uint8))
    look = replace(asset.mesh.materials[0], base_color_image=picture)
    path = recorded(replace(asset, mesh=replace(asset.mesh, materials=(look,))), tmp_path)
    pixels = np.frombuffer(
        bytes(values(path, "/source/mesh/surface", "Mesh3D:albedo_texture_buffer")[0][0][0]), np.uint8
    )
    assert len(pixels) <= 3 << 22
    assert set(map(tuple, pixels.reshape(-1, 3)[::1000].tolist())) == {(200, 100, 50)}


def test_voxels_are_those_of_the_source_at_64(cabinet):
    mesh = cabinet_asset().mesh
    grid = voxelise(mesh.triangles, cube_frame(mesh.bounds, 64))
    indices = values(cabinet, "/voxels", "VoxelGridMap:voxel_indices")[0][0]
    assert set(map(tuple, indices)) == set(map(tuple, grid.indices.tolist()))
    size = values(cabinet, "/voxels", "VoxelGridMap:voxel_size")[0][0][0]
    np.testing.assert_allclose(size, [0.8 / 64] * 3, rtol=1e-6)


def test_every_segment_has_one_colour_and_keeps_its_surface(cabinet):
    asset = cabinet_asset()
    vertices = np.array(values(cabinet, "/segments", "Mesh3D:vertex_positions")[0][0])
    faces = np.array(values(cabinet, "/segments", "Mesh3D:triangle_indices")[0][0])
    colors = np.array(values(cabinet, "/segments", "Mesh3D:vertex_colors")[0][0])
    np.testing.assert_allclose(vertices[faces], asset.mesh.triangles, atol=1e-6)
    of_segment = [set(colors[faces[i : i + 12]].ravel().tolist()) for i in range(0, len(faces), 12)]
    assert all(len(found) == 1 for found in of_segment)
    assert len(set.union(*of_segment)) == 9


def test_a_joint_says_name_kind_limits_confidence_and_evidence(tmp_path):
    asset = before_snap(cabinet_asset())
    path = recorded(asset, tmp_path)
    label = values(path, "/asset/joints/door_hinge/label", "Points3D:labels")[0][0][0]
    assert label == "door_hinge\nrevolute -43° to 0° (75%)"
    slide = values(path, "/asset/joints/drawer_slide/label", "Points3D:labels")[0][0][0]
    assert slide == "drawer_slide\nprismatic 0 to 0.15 m (75%)"
    evidence = values(path, "/asset/joints/door_hinge/label", "evidence")[0][0][0]
    assert evidence == "handle far from the hinge"


def test_the_arc_of_a_door_ends_where_the_door_ends(cabinet):
    asset = cabinet_asset()
    strip = np.array(values(cabinet, "/asset/joints/door_hinge/travel", "LineStrips3D:strips")[0][0][0])
    arc = strip[:-1]  # the last point is the hinge, for the spoke
    hinge = np.array(asset.joint("door_hinge").origin)
    radius = np.linalg.norm((arc - hinge)[:, :2], axis=1)
    door = asset.mesh.vertices[np.unique(asset.mesh.faces[asset.face_part == 1])]
    np.testing.assert_allclose(radius, np.linalg.norm((door - hinge)[:, :2], axis=1).max(), rtol=1e-5)
    posed_T_rest = rest_to_posed(asset, {"door_hinge": -1.5})["door"]
    np.testing.assert_allclose(posed_T_rest[:3, :3] @ arc[0] + posed_T_rest[:3, 3], arc[-1], atol=1e-5)


def test_modifiers_say_what_they_changed(cabinet):
    found = text(cabinet, "/report/modifiers")
    assert "### snap" in found
    assert "**door_hinge**: travel -43° to 0° → -86° to 0°" in found
    assert "**drawer**: mass" in found
    assert "the hinge now lies on the edge" in found


def test_a_modifier_that_scales_is_drawn_over_parts_of_the_loaded_size(tmp_path):
    asset = cabinet_asset()
    doubled, asset_from_source = canonical(asset.mesh, metres_per_unit=2.0)
    big = replace(asset, mesh=doubled, asset_from_source=asset_from_source)
    run, recorder = run_in(tmp_path), Recorder()
    told(asset, run, recorder, ("load", "segment", "joints"))
    recorder.stage_finished(run, "modify", "scale", big, 0.1)
    recorder.run_finished(run, Report(run.name, big, CHECKS, (), {}, ()))
    path = tmp_path / "cabinet.rrd"
    _, (loaded_T_step,) = transforms(path, "/modifiers/scale")
    corners = doubled.vertices @ loaded_T_step[:3, :3].T + loaded_T_step[:3, 3]
    np.testing.assert_allclose(corners, asset.mesh.vertices, atol=1e-6)
    shown = values(path, "/asset/parts/body/surface", "Mesh3D:vertex_positions")[0][0]
    assert np.ptp(np.array(shown)[:, 2]) == pytest.approx(1.6)


def test_the_report_names_checks_losses_times_and_the_recipe(cabinet):
    checks = text(cabinet, "/report/checks")
    assert "| **failed** | mass | the door is heavy for its size |" in checks
    assert "**urdf**: no ball joint" in checks
    assert "**Failed checks: mass.**" in text(cabinet, "/report/summary")
    assert "| 2 | segment | geometric | 0.500 s |" in text(cabinet, "/report/timings")
    assert bars(cabinet, "/report/seconds") == [0.25, 0.5, 0.75, 1.0, 1.25]


def test_the_recipe_is_shown_as_toml_that_resolves_to_the_same_recipe(cabinet):
    toml = text(cabinet, "/report/recipe").split("```toml\n")[1].split("\n```")[0]
    assert Recipe.model_validate_json(json.dumps(tomllib.loads(toml))) == recipe()


def test_the_preview_is_shown_if_there_is_one(tmp_path):
    picture = Image.from_pixels(np.zeros((4, 6, 3), dtype=np.uint8))
    (tmp_path / "preview.png").write_bytes(picture.png)
    path = recorded(cabinet_asset(), tmp_path)
    assert bytes(values(path, "/preview", "EncodedImage:blob")[0][0][0]) == picture.png


def test_a_static_object_is_recorded_without_motion(tmp_path):
    path = recorded(static_asset(), tmp_path)
    assert all(chunk.is_static for chunk in chunks(path))
    assert "nothing moves" in text(path, "/report/summary")


def test_a_failed_run_shows_what_there_was_and_why_it_ended(tmp_path):
    try:
        raise ValueError("no hinge anywhere")
    except ValueError as cause:
        error = StageError("modifier", "snap", "my.plugin", "my-dist", "1.2", cause)
    path = failed(cabinet_asset(), tmp_path, ("load", "segment", "joints"), error)
    why = text(path, "/failure")
    assert "Failed in stage: modify" in why
    assert "modifier 'snap' failed (plugin my.plugin, my-dist 1.2): ValueError: no hinge anywhere" in why
    assert "test_recorder.py" in why
    assert 'raise ValueError("no hinge anywhere")' in why
    assert "**Given:** 3 parts, 2 moving joints, 108 faces" in why
    assert {"/source/mesh/surface", "/voxels", "/parts/door", "/asset/parts/door/surface"} <= paths_in(path)
    assert rerun_rrd("verify", path)[0] == 0


@pytest.mark.parametrize("stages", [(), ("load",), ("load", "segment")])
def test_a_run_that_fails_early_still_says_why(stages, tmp_path):
    path = failed(cabinet_asset(), tmp_path, stages, ValueError("broken"))
    assert "broken" in text(path, "/failure")
    assert ("/voxels" in paths_in(path)) == ("load" in stages)
    assert ("/parts/door" in paths_in(path)) == ("segment" in stages)


def test_text_that_the_viewer_cannot_draw_is_written_as_codes(tmp_path):
    path = failed(cabinet_asset(), tmp_path, ("load",), ValueError("no door in 柜子.glb 😀, 90°"))
    assert "no door in \\u67dc\\u5b50.glb \\u1f600, 90°" in text(path, "/failure")


def test_the_layout_shows_everything_that_was_recorded(cabinet):
    found = views(cabinet)
    assert found["3D"] == {"asset", "source", "voxels", "segments", "parts", "modifiers/snap", "collision"}
    assert {f"report/{n}" for n in ("summary", "checks", "modifiers", "timings", "recipe")} == found[
        "TextDocument"
    ]
    assert len(found["TimeSeries"]) == 1
    assert found["BarChart"] == {"report/seconds"}


def test_the_layout_of_a_failed_run_shows_the_failure(tmp_path):
    path = failed(cabinet_asset(), tmp_path, ("load",), ValueError("broken"))
    assert "failure" in views(path)["TextDocument"]
    assert views(path)["3D"] == {"source", "voxels"}


def test_rerun_verifies_the_file(cabinet):
    code, output = rerun_rrd("verify", cabinet)
    assert code == 0
    assert "1 file verified" in output


@pytest.mark.slow
def test_two_runs_of_one_input_are_equal(cabinet, chain, tmp_path):
    again = recorded(cabinet_asset(), tmp_path)
    code, output = rerun_rrd("compare", "--unordered", cabinet, again)
    assert code == 0, output
    assert rerun_rrd("compare", "--unordered", cabinet, chain)[0] != 0
    assert contents(again) == contents(cabinet) != contents(chain)


def test_the_time_of_the_run_is_not_recorded(cabinet):
    # `rrd compare` overlooks properties, so they are looked at here.
    (properties,) = (c for c in chunks(cabinet) if c.entity_path == "/__properties")
    assert set(properties.to_record_batch().schema.names) == {"rerun.controls.RowId", "RecordingInfo:name"}


def test_the_recording_id_follows_name_and_recipe(cabinet, tmp_path):
    from rerun.chunk import RrdReader

    (first,) = RrdReader(cabinet).recordings()
    (again,) = RrdReader(recorded(cabinet_asset(), tmp_path / "a")).recordings()
    (other,) = RrdReader(recorded(static_asset(), tmp_path / "b")).recordings()
    assert first.application_id == "simart-kit"
    assert first.recording_id == again.recording_id != other.recording_id


def test_nothing_is_written_without_record(tmp_path):
    run, recorder = run_in(tmp_path, record=False), Recorder()
    told(cabinet_asset(), run, recorder)
    recorder.run_failed(run, "modify", ValueError("broken"))
    recorder.run_finished(run, Report(run.name, cabinet_asset(), (), (), {}, ()))
    assert list(tmp_path.iterdir()) == []


def test_two_runs_at_once_do_not_mix(tmp_path):
    recorder = Recorder()
    one, two = run_in(tmp_path / "one", "cabinet"), run_in(tmp_path / "two", "block")
    told(cabinet_asset(), one, recorder, ("load", "segment"))
    told(static_asset(), two, recorder, ("load", "segment"))
    recorder.run_failed(one, "joints", ValueError("first"))
    recorder.run_failed(two, "joints", ValueError("second"))
    assert "first" in text(tmp_path / "one" / "cabinet.rrd", "/failure")
    assert "second" in text(tmp_path / "two" / "block.rrd", "/failure")
    assert "/parts/door" not in paths_in(tmp_path / "two" / "block.rrd")


def test_rerun_is_imported_only_to_write():
    code = (
        "import sys; from simart_kit_plugins.recorder import Recorder; Recorder();"
        "sys.exit(any(m.split('.')[0] in ('rerun', 'PIL', 'pyarrow', 'scipy') for m in sys.modules))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False, timeout=60).returncode == 0
