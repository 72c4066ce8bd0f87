"""The picture of a run: panels, legend, and marks of joints."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

from simart_kit.asset import Asset, Joint, Limits, Part
from simart_kit.drawing.joint_marks import joint_strokes
from simart_kit.drawing.legend import legend, part_entries, summary
from simart_kit.drawing.preview import PANEL, poses, preview_png
from simart_kit.kinematics import opened, rest_to_posed, rotation
from simart_kit.render import write_preview
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset, chain_asset, static_asset


def panels(png: bytes, count: int) -> list[np.ndarray]:
    pixels = np.asarray(Pillow.open(io.BytesIO(png))).astype(int)
    return [pixels[: PANEL[1], i * PANEL[0] : (i + 1) * PANEL[0]] for i in range(count)]


@pytest.fixture(scope="module")
def cabinet_png() -> bytes:
    return preview_png(cabinet_asset(textured=False))


def test_preview_shows_closed_half_open_and_open(cabinet_png: bytes) -> None:
    picture = Pillow.open(io.BytesIO(cabinet_png))
    closed, half, open_ = panels(cabinet_png, 3)
    # A grey cabinet: colour is paint or a joint's arrow.
    colour = [np.ptp(panel, axis=2) > 60 for panel in (closed, half, open_)]
    assert picture.size[0] == 3 * PANEL[0]
    assert colour[0].sum() == 0
    assert min(c.sum() for c in colour[1:]) > 10_000
    blue, orange = (open_[..., 2] > open_[..., 0] + 60).sum(), (open_[..., 0] > open_[..., 2] + 60).sum()
    assert min(blue, orange) > 3_000, "door and drawer have their own colours"
    assert (np.abs(half - open_).max(axis=2) > 20).sum() > 10_000
    # Only the casing of the joints' lines is this white.
    white = [(panel.min(axis=2) > 252).sum() for panel in (closed, half, open_)]
    assert white[0] == 0
    assert min(white[1:]) > 300
    # The body stands in all panels at the same place: its top, seen from the same camera.
    same = (np.abs(closed - open_).max(axis=2) < 6) & (np.ptp(closed, axis=2) <= 12) & (closed[..., 0] < 225)
    assert same.sum() > 5_000


def test_what_stands_open_in_its_file_is_not_called_closed() -> None:
    asset = cabinet_asset(textured=False)
    hinge = next(joint for joint in asset.joints if joint.turns)
    ajar = asset.with_joints({hinge.name: replace(hinge, limits=Limits(-0.4, 1.2))})
    wide = asset.with_joints({hinge.name: replace(hinge, limits=Limits(-1.5, 0.1))})
    assert list(poses(asset)) == list(poses(ajar)) == ["closed", "half open", "open"]
    assert list(poses(wide)) == ["as modelled", "half way", "all the way"]
    assert [panel.shape for panel in panels(preview_png(wide), 3)] == [(PANEL[1], PANEL[0], 3)] * 3


def test_preview_of_a_static_object_says_so(tmp_path: Path) -> None:
    path = write_preview(static_asset(), tmp_path / "preview.png")

    picture = Pillow.open(path)
    assert "static: nothing moves" in picture.info["Description"]
    assert picture.size[0] == 2 * PANEL[0]
    words = np.asarray(picture.convert("L"))[PANEL[1] + 40 :, :400]
    assert (words < 100).sum() > 100, "the words are in the picture, too"


def test_preview_names_parts_joints_and_ranges(cabinet_png: bytes) -> None:
    description = Pillow.open(io.BytesIO(cabinet_png)).info["Description"]

    assert "door: revolute, -86 to 0°" in description
    assert "drawer: prismatic, 0 to 30 cm" in description
    assert "cabinet: 3 parts, 2 joints" in description


def test_preview_has_the_same_bytes_every_time(tmp_path: Path) -> None:
    first, second = (write_preview(chain_asset(), tmp_path / f"{i}.png") for i in range(2))

    assert first.read_bytes() == second.read_bytes()


def test_many_joints_have_room_in_the_legend(cabinet_png: bytes) -> None:
    count = 30
    mesh = boxes_mesh([((0.2 * i, 0.0, 0.0), (0.2 * i + 0.1, 0.1, 0.1)) for i in range(count)])
    parts = tuple(Part(f"knob_number_{i}") for i in range(count))
    joints = tuple(Joint(f"j{i}", "continuous", parts[0].name, parts[i].name) for i in range(1, count))
    asset = Asset("many", mesh, np.arange(12 * count) // 12, parts, joints)

    picture = Pillow.open(io.BytesIO(preview_png(asset)))

    assert len(legend(asset)) == count - 1
    assert picture.size[1] > Pillow.open(io.BytesIO(cabinet_png)).size[1] + 60


def test_a_fixed_child_has_the_colour_of_what_carries_it() -> None:
    mesh = boxes_mesh([((i, 0.0, 0.0), (i + 0.5, 1.0, 1.0)) for i in range(4)])
    joints = (
        Joint("knob_fix", "fixed", "door", "knob"),
        Joint("hinge", "revolute", "body", "door", limits=Limits(0.0, 1.0)),
        Joint("foot_fix", "fixed", "body", "foot"),
    )
    parts = tuple(Part(n) for n in ("body", "door", "knob", "foot"))
    asset = Asset("cupboard", mesh, np.arange(48) // 12, parts, joints)

    entries = part_entries(asset)

    assert set(entries) == {"door", "knob"}
    assert entries["knob"] == entries["door"]
    assert [e.joint.name for e in legend(asset)] == ["hinge"]


def test_flagged_joints_are_named_so() -> None:
    asset = cabinet_asset()
    doubtful = replace(asset.joint("door_hinge"), flags=("hits the body",))

    texts = [e.text for e in legend(asset.with_joints({"door_hinge": doubtful}))]

    assert texts == ["door: revolute, -86 to 0°, flagged", "drawer: prismatic, 0 to 30 cm"]


def test_an_object_with_fixed_joints_only_is_static() -> None:
    mesh = boxes_mesh([((-0.5, -0.5, 0.0), (0.5, 0.5, 1.0)), ((1.0, 0.0, 0.0), (2.0, 1.0, 1.0))])
    joint = Joint("glue", "fixed", "a", "b")
    asset = Asset("block", mesh, np.arange(24) // 12, (Part("a"), Part("b")), (joint,))

    assert summary(asset) == "block, static: nothing moves"


def test_arc_of_a_hinge_is_the_way_of_a_point_of_the_door() -> None:
    asset = cabinet_asset()
    joint = asset.joint("door_hinge")
    door = asset.mesh.triangles[asset.face_part == 1].reshape(-1, 3)

    axis_line, arc = joint_strokes(joint, door, asset.mesh.diagonal)

    np.testing.assert_allclose(axis_line.points[:, :2], [[-0.275, -0.19]] * 2, atol=1e-12)
    assert axis_line.points[0, 2] < door[:, 2].min()
    assert axis_line.points[1, 2] > door[:, 2].max()
    origin = np.array(joint.origin)
    end = rotation(np.array([0.0, 0.0, -1.5])) @ (arc.points[0] - origin) + origin
    np.testing.assert_allclose(arc.points[-1], end, atol=1e-9)
    np.testing.assert_allclose(arc.points[0, 1], door[:, 1].mean(), atol=0.02)
    assert (arc.head, arc.tail) == (True, False)


def test_arrow_of_a_drawer_runs_along_its_travel() -> None:
    asset = cabinet_asset()
    drawer = asset.mesh.triangles[asset.face_part == 2].reshape(-1, 3)

    (arrow,) = joint_strokes(asset.joint("drawer_slide"), drawer, asset.mesh.diagonal)

    start, end = arrow.points
    assert start[1] == pytest.approx(drawer[:, 1].min())
    assert end[1] < start[1] - 0.3
    np.testing.assert_allclose(end[[0, 2]], start[[0, 2]], atol=1e-12)


def test_joints_that_move_parts_of_moving_parts_are_drawn_where_these_are() -> None:
    asset = chain_asset()
    joint = asset.joint("arm_hinge")
    arm = asset.mesh.triangles[asset.face_part == 2].reshape(-1, 3)
    post = rest_to_posed(asset, opened(asset, 0.5))["post"]

    stroke = joint_strokes(joint, arm, asset.mesh.diagonal)[0].moved(post)

    # Half of a full turn about +z: the axis leans to the other side.
    direction = np.subtract(*stroke.points[::-1])
    np.testing.assert_allclose(direction / np.linalg.norm(direction), [-0.6, 0.0, 0.8], atol=1e-9)
