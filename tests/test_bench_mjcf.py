"""MJCF as truth: numbers worked out by hand, our own exports, and files that are damaged."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from simart_kit_exporters.mjcf import Mjcf

from simart_kit.asset import Asset
from simart_kit.bench.articulation import Articulation
from simart_kit.bench.formats.mjcf import MjcfTruth
from simart_kit.bench.states import posed
from simart_kit.errors import BadInputError
from simart_kit.kinematics import rest_to_posed, sample_positions
from simart_kit.testing.meshes import cabinet_asset, chain_asset

BOX = '<geom type="box" size=".5 .5 .5"/>'


def write(path: Path, world: str, head: str = "") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'<mujoco model="x">{head}<worldbody>{world}</worldbody></mujoco>')
    return path


def read(tmp_path: Path, world: str, head: str = "") -> Articulation:
    return MjcfTruth().read(write(tmp_path / "a.xml", world, head)).articulation


def bounds(found: Articulation, link: int) -> np.ndarray:
    corners = found.triangles[found.labels == link].reshape(-1, 3)
    return np.array([corners.min(axis=0), corners.max(axis=0)])


def test_degrees_euler_defaults_and_ref_are_resolved(tmp_path: Path) -> None:
    head = (
        '<compiler angle="degree"/><default><default class="door">'
        '<joint type="hinge" axis="1 0 0" range="-10 80" ref="20"/></default></default>'
    )
    # The door's frame stands at (1, 0, 0): its x is the world's y, its y the world's -x.
    world = (
        f'<body name="body">{BOX}<body name="door" pos="1 0 0" euler="0 0 90" childclass="door">'
        f'<joint name="hinge" pos="0 1 0"/><geom type="box" size=".1 .2 .3"/></body></body>'
    )
    found = read(tmp_path, world, head)
    body, door = found.links
    assert (body.name, body.parent, body.joint.kind) == ("body", -1, "fixed")
    assert (door.name, door.parent, door.joint.kind, door.joint.name) == ("door", 0, "revolute", "hinge")
    np.testing.assert_allclose(door.joint.axis, (0, 1, 0), atol=1e-12)
    np.testing.assert_allclose(door.joint.origin, (0, 0, 0), atol=1e-12)
    # The file shows it at 20 degrees: 30 below and 60 above remain.
    assert door.joint.lower == pytest.approx(-math.radians(30))
    assert door.joint.upper == pytest.approx(math.radians(60))
    np.testing.assert_allclose(bounds(found, 1), [(0.8, -0.1, -0.3), (1.2, 0.1, 0.3)], atol=1e-12)


def test_kinds_of_joints(tmp_path: Path) -> None:
    bodies = {
        "spin": '<joint type="hinge" axis="0 0 2"/>',
        "slide": '<joint type="slide" axis="0 1 0" range="-.1 .4"/>',
        "endless": '<joint type="slide" axis="0 1 0"/>',
        "ball": '<joint type="ball" pos="0 0 1"/>',
        "both": '<joint name="in" type="slide" range="0 1"/><joint name="on" type="hinge" axis="1 0 0"/>',
        "knob": "",
    }
    inner = "".join(f'<body name="{name}">{joint}{BOX}</body>' for name, joint in bodies.items())
    truth = MjcfTruth().read(write(tmp_path / "a.xml", f'<body name="root">{BOX}{inner}</body>'))
    joints = {link.name: link.joint for link in truth.articulation.links}
    found = {name: (joints[name].kind, joints[name].lower, joints[name].upper) for name in bodies}
    assert found == {
        "spin": ("continuous", None, None),
        "slide": ("prismatic", -0.1, 0.4),
        "endless": ("prismatic", None, None),
        "ball": ("ball", None, None),
        "both": ("prismatic", 0.0, 1.0),
        "knob": ("fixed", None, None),
    }
    assert joints["ball"].origin == (0, 0, 1)
    both = truth.articulation.links[5]
    assert [(j.name, j.kind, j.axis) for j in both.also] == [("on", "continuous", (1, 0, 0))]
    assert truth.notes == ("bodies with several joints, any of which is right to predict: both",)


def test_visual_shapes_are_read_and_floors_and_colliders_are_not(tmp_path: Path) -> None:
    visual = 'contype="0" conaffinity="0"'
    found = read(
        tmp_path,
        f'<geom type="plane" size="5 5 .1"/><body name="base"><geom type="sphere" size="9"/>'
        f'<geom type="box" size="9 9 9" rgba="1 0 0 0" {visual}/>'
        f'<geom type="box" size=".1 .2 .3" pos="1 0 0" {visual}/></body>',
    )
    assert [link.name for link in found.links] == ["base"]
    np.testing.assert_allclose(found.bounds, [(0.9, -0.2, -0.3), (1.1, 0.2, 0.3)])


def test_primitives_have_their_sizes(tmp_path: Path) -> None:
    shapes = {
        '<geom type="sphere" size="2"/>': (2, 2, 2),
        '<geom type="ellipsoid" size="1 2 3"/>': (1, 2, 3),
        '<geom type="cylinder" size=".5 3"/>': (0.5, 0.5, 3),
        '<geom type="capsule" size=".5 3"/>': (0.5, 0.5, 3.5),
    }
    found = read(tmp_path, "".join(f"<body>{shape}</body>" for shape in shapes))
    assert [link.name for link in found.links] == ["body_1", "body_2", "body_3", "body_4"]
    for index, half in enumerate(shapes.values()):
        np.testing.assert_allclose(bounds(found, index), [-np.array(half), half], rtol=0.02)


def test_the_world_is_a_link_where_it_has_shapes(tmp_path: Path) -> None:
    found = read(tmp_path, f'{BOX}<body name="door"><joint/>{BOX}</body>')
    assert [(link.name, link.parent) for link in found.links] == [("world", -1), ("door", 0)]
    assert found.moving == (1,)
    alone = read(tmp_path / "alone", f'<body name="door"><joint/>{BOX}</body>')
    assert [(link.name, link.parent, link.joint.kind) for link in alone.links] == [("door", -1, "continuous")]


def test_a_free_root_stands_still_and_loose_parts_are_free(tmp_path: Path) -> None:
    free = "<freejoint/>"
    found = read(tmp_path, f'<body name="pan">{free}{BOX}</body><body name="lid">{free}{BOX}</body>')
    assert [link.joint.kind for link in found.links] == ["fixed", "free"]
    beside = read(tmp_path / "b", f'<body name="pan">{BOX}</body><body name="lid">{free}{BOX}</body>')
    assert [link.joint.kind for link in beside.links] == ["fixed", "free"]


def test_a_mesh_lies_where_the_file_puts_it(tmp_path: Path) -> None:
    # Not symmetric, so that MuJoCo moves and turns it to its own frame of inertia.
    corners = np.array([(1, 1, 1), (4, 1, 1), (1, 3, 1), (1, 1, 2)], dtype=float)
    text = " ".join(str(v) for v in corners.ravel())
    head = (
        f'<compiler angle="radian"/><asset><mesh name="m" scale="2 1 1" vertex="{text}" '
        'face="0 2 1 0 1 3 0 3 2 1 2 3"/></asset>'
    )
    found = read(tmp_path, '<body pos="0 0 5"><joint/><geom type="mesh" mesh="m"/></body>', head)
    expected = corners * (2, 1, 1) + (0, 0, 5)
    for corner in expected:
        assert np.abs(found.vertices - corner).sum(axis=1).min() < 1e-5
    assert len(found.vertices) == 4
    # A sixth of the three edges' product, positive where the faces look outward.
    assert np.linalg.det(found.triangles - found.vertices.mean(axis=0)).sum() / 6 == pytest.approx(
        2.0, rel=1e-5
    )


def test_a_flat_drawn_mesh_without_mass_is_read(tmp_path: Path) -> None:
    head = '<asset><mesh name="m" vertex="0 0 0 1 0 0 1 1 0 0 1 0" face="0 1 2 0 2 3"/></asset>'
    shape = '<geom type="mesh" mesh="m" contype="0" conaffinity="0" mass="0"/>'
    found = read(tmp_path, f'<body>{BOX}<body name="flag"><joint/>{shape}</body></body>', head)
    np.testing.assert_allclose(bounds(found, 1), [(0, 0, 0), (1, 1, 0)], atol=1e-6)


@pytest.mark.parametrize("build", [cabinet_asset, chain_asset])
def test_our_own_export_reads_back_as_the_asset(tmp_path: Path, build: object) -> None:
    asset: Asset = build()  # type: ignore[operator]
    found = MjcfTruth().read(Mjcf(Mjcf.Options()).export(asset, tmp_path)).articulation
    assert {link.name for link in found.links} == {part.name for part in asset.parts}
    positions = sample_positions(asset, np.random.default_rng(2))
    by_child = {j.child: positions.get(j.name, 0.0) for j in asset.joints}
    poses = posed(found, [by_child.get(link.name, 0.0) for link in found.links])
    for index, (link, pose) in enumerate(zip(found.links, poses, strict=True)):
        np.testing.assert_allclose(pose, rest_to_posed(asset, positions)[link.name], atol=1e-6)
        mine = asset.face_part == asset.part_index(link.name)
        corners = asset.mesh.triangles[mine].reshape(-1, 3)
        np.testing.assert_allclose(
            bounds(found, index), [corners.min(axis=0), corners.max(axis=0)], atol=1e-6
        )
        assert found.weights[found.labels == index].sum() == pytest.approx(
            asset.mesh.face_areas[mine].sum(), rel=1e-5
        )
        expected = asset.joint_to(link.name)
        if expected is not None:
            limits = (expected.limits.lower, expected.limits.upper) if expected.limits else (None, None)
            assert (link.joint.kind, link.joint.name) == (expected.kind, expected.name)
            assert (link.joint.lower, link.joint.upper) == (
                pytest.approx(limits[0]),
                pytest.approx(limits[1]),
            )


@pytest.mark.parametrize(
    ("world", "words"),
    [
        (f'<body><joint axis="nan 0 0"/>{BOX}</body>', "holds NaN"),
        (f'<body><joint axis="0 0 0"/>{BOX}</body>', "axis too small"),
        (f'<body><joint type="hing"/>{BOX}</body>', "invalid keyword"),
        ('<body><geom type="mesh" mesh="gone"/></body>', "MuJoCo does not load it"),
        ('<geom type="plane" size="1 1 1"/>', "no body has a shape"),
        ("<body", "no well-formed XML"),
    ],
)
def test_a_damaged_file_is_named_with_what_is_wrong(
    world: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    with pytest.raises(BadInputError) as caught:
        read(tmp_path, world)
    assert words in str(caught.value)
    assert "a.xml" in str(caught.value)
    assert "\n" not in str(caught.value)
    assert list((tmp_path / "here").iterdir()) == []  # MuJoCo likes to leave a log


def test_other_files_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.xml").write_text('<!DOCTYPE m [<!ENTITY a "b">]><mujoco/>')
    with pytest.raises(BadInputError, match="DOCTYPE"):
        MjcfTruth().read(tmp_path / "a.xml")
    with pytest.raises(BadInputError, match="no variant 'other'"):
        MjcfTruth().read(write(tmp_path / "b.xml", BOX), "other")
    head = '<asset><mesh name="m" file="gone.obj"/></asset>'
    with pytest.raises(BadInputError, match=r"gone\.obj"):
        read(tmp_path / "c", '<body><geom type="mesh" mesh="m"/></body>', head)


def test_truths_are_found_by_folder_or_by_file(tmp_path: Path) -> None:
    expected = {
        "oven": write(tmp_path / "oven" / "model.xml", BOX),
        "lamp": write(tmp_path / "lamp" / "lamp.xml", BOX),
        "left": write(tmp_path / "pair" / "left.xml", BOX),
        "right": write(tmp_path / "pair" / "right.xml", BOX),
        "cup": write(tmp_path / "cup" / "robot.xml", BOX, '<include file="parts.xml"/>'),
    }
    write(tmp_path / "lamp" / "scene.xml", BOX)
    write(tmp_path / "cup" / "parts.xml", "")
    (tmp_path / "oven" / "package.xml").write_text("<package/>")
    assert MjcfTruth().find(tmp_path) == expected
    assert MjcfTruth().find(expected["left"]) == {"left": expected["left"]}
    assert MjcfTruth().find(tmp_path / "oven" / "package.xml") == {}
    assert [MjcfTruth().read(expected[name]).name for name in ("oven", "left", "cup")] == [
        "oven",
        "left",
        "cup",
    ]
