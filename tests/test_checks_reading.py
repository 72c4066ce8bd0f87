"""Mechanisms: files of three formats read back as what they say, against answers worked out by hand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from simart_kit.arrays import FloatArray
from simart_kit.checks.mechanism import WORLD, Body, Link, Mechanism, of_asset
from simart_kit.checks.reading import read_mechanism
from simart_kit.checks.round_shapes import capsule_points, cylinder_points, sphere_points
from simart_kit.errors import BadInputError
from simart_kit.kinematics import forward, rest_origin, sample_positions

from .checks_cases import SOUND, export

FORMATS = ("urdf", "mjcf", "usd")


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("name", SOUND)
def test_every_format_reads_as_its_asset(name: str, kind: str, tmp_path: Path) -> None:
    asset = SOUND[name]()
    expected, read = of_asset(asset), read_mechanism(kind, export(asset, tmp_path, kind))
    assert read.body.keys() == expected.body.keys()
    for body in expected.bodies:
        its = read.body[body.name]
        assert body.mass is not None
        assert its.mass is not None
        np.testing.assert_allclose(its.mass.mass, body.mass.mass, rtol=1e-6)
        np.testing.assert_allclose(its.mass.center, body.mass.center, atol=1e-6)
        np.testing.assert_allclose(its.mass.inertia, body.mass.inertia, atol=1e-6)
        for ours, theirs in zip(ordered(body), ordered(its), strict=True):
            np.testing.assert_allclose(theirs, ours, atol=1e-6)
    links = {link.child: link for link in read.links}
    assert links.keys() == {link.child for link in expected.links}
    for link in expected.links:
        its_link = links[link.child]
        assert (its_link.name, its_link.kind, its_link.parent) == (link.name, link.kind, link.parent)
        np.testing.assert_allclose(its_link.axis, link.axis, atol=1e-6)
        np.testing.assert_allclose(its_link.origin, link.origin, atol=1e-6)
        assert (its_link.lower, its_link.upper) == pytest.approx((link.lower, link.upper), abs=1e-6)
        if kind != "urdf":  # which has no armature, and friction on demand only
            assert its_link.friction == pytest.approx(link.friction)
            assert its_link.armature == pytest.approx(link.armature)
        assert its_link.damping == pytest.approx(link.damping, rel=1e-5)


def ordered(body: Body) -> list[FloatArray]:
    """(2, 3) bounds of its shapes, sorted."""
    bounds = [np.array([points.min(axis=0), points.max(axis=0)]) for points in body.colliders]
    return sorted(bounds, key=lambda b: tuple(np.round(b.ravel(), 4)))


@pytest.mark.parametrize(("kind", "passes"), [("urdf", True), ("mjcf", False), ("usd", True)])
def test_what_a_joint_connects_passes_unasked_but_in_mjcf(kind: str, passes: bool, tmp_path: Path) -> None:
    asset = SOUND["cabinet"]()
    read = read_mechanism(kind, export(asset, tmp_path, kind))
    pairs = {frozenset((joint.parent, joint.child)) for joint in asset.joints}
    assert read.passing == (pairs if passes else set())
    assert not read.excluded & pairs


@pytest.mark.parametrize("name", SOUND)
def test_poses_are_those_of_forward_kinematics(name: str) -> None:
    asset = SOUND[name]()
    positions = sample_positions(asset, np.random.default_rng(5))
    posed, expected = of_asset(asset).posed(positions), forward(asset, positions)
    for part, world_T_part in expected.items():
        rest = np.eye(4)
        rest[:3, 3] = rest_origin(asset, part)
        np.testing.assert_allclose(posed[part] @ rest, world_T_part, atol=1e-9)


class TestMechanism:
    def link(self, parent: str, child: str, kind: str = "revolute") -> Link:
        return Link(f"to_{child}", kind, parent, child, (0, 0, 0), (0, 0, 1), 0.0, 1.0)  # type: ignore[arg-type]

    def mechanism(self, *links: Link) -> Mechanism:
        return Mechanism(tuple(Body(name, None) for name in "cab"), links)

    def test_bodies_come_after_what_carries_them(self) -> None:
        chain = self.mechanism(self.link("b", "c"), self.link("a", "b"))
        assert [body.name for body in chain.order] == ["a", "b", "c"]
        hanging = self.mechanism(self.link(WORLD, "c"))
        assert [body.name for body in hanging.order] == ["c", "a", "b"]

    @pytest.mark.parametrize("links", [("ab", "ba"), ("ab", "cb"), ("aa",)])
    def test_a_loop_is_no_tree(self, links: tuple[str, ...]) -> None:
        with pytest.raises(BadInputError, match="no tree"):
            _ = self.mechanism(*[self.link(*pair) for pair in links]).order

    def test_what_moves(self) -> None:
        """A door, and the handle that is fixed to it, but not the foot that is fixed to the base."""
        bodies = tuple(Body(name, None) for name in ("handle", "door", "foot", "base"))
        links = (
            self.link("base", "door"),
            self.link("door", "handle", "fixed"),
            self.link("base", "foot", "fixed"),
        )
        assert Mechanism(bodies, links).moved == {"door", "handle"}

    def test_a_size_needs_something_to_measure(self) -> None:
        with pytest.raises(BadInputError, match="neither masses nor collision shapes"):
            _ = self.mechanism().diagonal

    def test_pose_of_a_door_by_hand(self) -> None:
        """A quarter turn about z at (1, 0): what is at (2, 0) comes to (1, 1)."""
        hinge = replace(self.link("a", "b"), origin=(1.0, 0.0, 0.0))
        posed = self.mechanism(hinge).posed({"to_b": np.pi / 2})
        np.testing.assert_allclose(posed["b"] @ [2, 0, 0, 1], [1, 1, 0, 1], atol=1e-12)
        np.testing.assert_array_equal(posed["a"], np.eye(4))


class TestRoundShapes:
    def test_they_end_where_they_should(self) -> None:
        for points, half in (
            (cylinder_points(0.2, 0.5), (0.2, 0.2, 0.5)),
            (sphere_points(0.2), (0.2, 0.2, 0.2)),
            (capsule_points(0.2, 0.5), (0.2, 0.2, 0.7)),
        ):
            np.testing.assert_allclose(points.max(axis=0), half, atol=1e-12)
            np.testing.assert_allclose(points.min(axis=0), -np.array(half), atol=1e-12)


BOX_URDF = """<robot name="box"><link name="base">{base}</link><link name="door">
<inertial><origin xyz="0.5 0 0" rpy="0 0 1.5707963267948966"/><mass value="2"/>
<inertia ixx="0.1" iyy="0.2" izz="0.25" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0.5 0 0"/><geometry><box size="1 0.2 0.4"/></geometry></collision></link>
<joint name="hinge" type="revolute"><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/><axis xyz="1 0 0"/>
<parent link="base"/><child link="door"/><limit lower="-1" upper="0.5" effort="1" velocity="1"/>
<dynamics damping="0.7" friction="0.3"/></joint></robot>"""
BASE = """<inertial><mass value="9"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><sphere radius="0.3"/></geometry></collision>"""


class TestUrdf:
    def test_turned_frames(self, write: Callable[[str, str], Path]) -> None:
        """The door's x is the world's y; its inertia is turned once more, to the world's -x."""
        read = read_mechanism("urdf", write("box.urdf", BOX_URDF.format(base=BASE)))
        (link,) = read.links
        assert (link.parent, link.child, link.kind) == ("base", "door", "revolute")
        np.testing.assert_allclose(link.origin, (1, 2, 3), atol=1e-9)
        np.testing.assert_allclose(link.axis, (0, 1, 0), atol=1e-9)
        assert (link.lower, link.upper, link.damping, link.friction) == pytest.approx((-1, 0.5, 0.7, 0.3))
        door = read.body["door"]
        assert door.mass is not None
        np.testing.assert_allclose(door.mass.center, (1, 2.5, 3), atol=1e-9)
        np.testing.assert_allclose(door.mass.inertia, np.diag([0.1, 0.2, 0.25]), atol=1e-9)
        (corners,) = door.colliders
        np.testing.assert_allclose(corners.min(axis=0), (0.9, 2.0, 2.8), atol=1e-9)
        np.testing.assert_allclose(corners.max(axis=0), (1.1, 3.0, 3.2), atol=1e-9)
        np.testing.assert_allclose(read.bounds[0], (-0.3, -0.3, -0.3), atol=1e-9)

    def test_an_empty_base_is_a_frame_of_the_world(self, write: Callable[[str, str], Path]) -> None:
        read = read_mechanism("urdf", write("box.urdf", BOX_URDF.format(base="")))
        assert list(read.body) == ["door"]
        assert read.links[0].parent == WORLD

    def test_what_mujoco_refuses_is_named(self, write: Callable[[str, str], Path]) -> None:
        with pytest.raises(BadInputError, match=r"MuJoCo does not load half\.urdf: "):
            read_mechanism("urdf", write("half.urdf", '<robot name="half"><link'))


MJCF = """<mujoco><compiler angle="radian"/><worldbody><geom type="plane" size="1 1 1"/>
<body name="base" pos="0 0 1"><freejoint/><geom type="capsule" size="0.1 0.2"/>
<body pos="0 0 1" quat="0.7071067811865476 0 0 0.7071067811865476"><joint type="slide" axis="1 0 0"/>
<geom type="cylinder" size="0.1 0.2"/>
<geom type="ellipsoid" size="0.1 0.2 0.3" contype="0" conaffinity="0"/></body>
<body name="knob"><joint name="turn" axis="0 1 0"/>
<geom type="box" size="0.1 0.2 0.3" mass="1"/></body></body>
</worldbody><contact><exclude body1="base" body2="knob"/></contact></mujoco>"""


def test_mjcf_without_names_and_with_a_floating_base(write: Callable[[str, str], Path]) -> None:
    read = read_mechanism("mjcf", write("made.xml", MJCF))
    assert list(read.body) == ["base", "body 2", "knob"]
    slide, turn = read.links
    assert (slide.name, slide.kind, slide.lower, slide.parent) == ("joint 0", "prismatic", None, "base")
    np.testing.assert_allclose(slide.axis, (0, 1, 0), atol=1e-9)
    assert (turn.kind, turn.lower, turn.upper) == ("continuous", None, None)
    assert read.excluded == {frozenset({"base", "knob"})}  # not the pair that MuJoCo filters for a free base
    np.testing.assert_allclose(read.bounds, [(-0.1, -0.2, 0.7), (0.1, 0.2, 2.2)], atol=1e-9)
    (cylinder,) = read.body["body 2"].colliders
    np.testing.assert_allclose(cylinder.max(axis=0), (0.1, 0.1, 2.2), atol=1e-9)
    knob = read.body["knob"].mass
    assert knob is not None
    np.testing.assert_allclose(np.diag(knob.inertia), np.array([13, 10, 5]) * 0.04 / 12, atol=1e-9)
