"""Forward kinematics against hand-made matrices, and against scipy's rotations on random trees."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import simart_kit as sk
from simart_kit.arrays import FloatArray, unit, vec3
from simart_kit.errors import BadInputError
from simart_kit.kinematics import (
    carried,
    forward,
    joint_motion,
    moved_by,
    opened,
    ordered_joints,
    reach_box,
    rest_origin,
    rest_to_posed,
    rotation,
    sample_positions,
    span,
)
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset, chain_asset, static_asset

seeds = st.integers(0, 2**32 - 1)
turns = st.tuples(*[st.floats(-10, 10)] * 3).map(np.array)
KINDS = ("fixed", "revolute", "continuous", "prismatic", "ball", "free")


def moved(turn: Rotation, shift: FloatArray) -> FloatArray:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turn.as_matrix(), shift
    return matrix


def random_tree(seed: int, count: int = 7) -> tuple[sk.Asset, dict[str, Any]]:
    """A tree with joints of all kinds in random order, and a random position for each."""
    rng = np.random.default_rng(seed)
    joints, positions = [], {}
    for child in range(1, count):
        kind = KINDS[rng.integers(len(KINDS))]
        limits = sk.Limits(-4.0, 4.0) if kind in ("revolute", "prismatic") else None
        origin, axis = vec3(rng.normal(size=3)), vec3(unit(rng.normal(size=3)))
        name = f"j{child}"
        joints.append(sk.Joint(name, kind, f"p{rng.integers(child)}", f"p{child}", origin, axis, limits))  # type: ignore[arg-type]
        size = {"ball": 3, "free": 6}.get(kind)
        positions[name] = rng.uniform(-2, 2, size) if size else float(rng.uniform(-2, 2))
    mesh = boxes_mesh([((2.0 * i, 0, 0), (2.0 * i + 1, 1, 1)) for i in range(count)])
    shuffled = tuple(joints[i] for i in rng.permutation(len(joints)))
    parts = tuple(sk.Part(f"p{i}") for i in range(count))
    return sk.Asset("tree", mesh, np.repeat(range(count), 12), parts, shuffled), positions


def motion_about_origin(joint: sk.Joint, position: Any) -> FloatArray:
    """(4, 4) motion that a joint gives to points in the asset frame at rest, by scipy."""
    axis, origin = np.array(joint.axis), np.array(joint.origin)
    turn, shift = Rotation.identity(), np.zeros(3)
    if joint.kind in ("revolute", "continuous"):
        turn = Rotation.from_rotvec(axis * position)
    elif joint.kind == "prismatic":
        shift = axis * position
    elif joint.kind == "ball":
        turn = Rotation.from_rotvec(position)
    elif joint.kind == "free":
        shift, turn = position[:3], Rotation.from_rotvec(position[3:])
    return moved(turn, origin + shift - turn.apply(origin))


class TestRotation:
    def test_quarter_turn_about_z(self) -> None:
        np.testing.assert_allclose(
            rotation(np.array([0.0, 0.0, np.pi / 2])), [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-15
        )

    def test_no_turn_is_the_identity(self) -> None:
        np.testing.assert_array_equal(rotation(np.zeros(3)), np.eye(3))

    @given(turns)
    @settings(max_examples=60, deadline=None)
    def test_agrees_with_scipy(self, vector: FloatArray) -> None:
        np.testing.assert_allclose(rotation(vector), Rotation.from_rotvec(vector).as_matrix(), atol=1e-12)

    @given(turns)
    @settings(max_examples=60, deadline=None)
    def test_is_proper(self, vector: FloatArray) -> None:
        matrix = rotation(vector)
        np.testing.assert_allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(matrix) == pytest.approx(1.0)


class TestForward:
    def test_at_rest_the_frames_sit_at_the_joints(self) -> None:
        asset = chain_asset()
        frames = forward(asset)
        assert list(frames) == ["base", "post", "arm"]
        for part in asset.parts:
            np.testing.assert_array_equal(frames[part.name][:3, :3], np.eye(3))
            np.testing.assert_allclose(frames[part.name][:3, 3], rest_origin(asset, part.name), atol=1e-15)

    def test_a_door_opened_by_hand(self) -> None:
        """The hinge is at (-0.275, -0.19, 0) along z: a turn by -90 degrees takes +x to -y."""
        frames = forward(cabinet_asset(), {"door_hinge": -np.pi / 2})
        expected = np.array([[0, 1, 0, -0.275], [-1, 0, 0, -0.19], [0, 0, 1, 0], [0, 0, 0, 1]])
        np.testing.assert_allclose(frames["door"], expected, atol=1e-15)
        np.testing.assert_allclose(frames["drawer"][:3, 3], (0.0, -0.2, 0.65))

    def test_a_chain_by_hand(self) -> None:
        """The post turns by 90 degrees about z and takes the arm's hinge from (0.05, 0) to (0, 0.05)."""
        frames = forward(chain_asset(), {"post_spin": np.pi / 2, "arm_hinge": 0.5})
        np.testing.assert_allclose(frames["arm"][:3, 3], (0.0, 0.05, 0.33), atol=1e-15)
        spun = Rotation.from_rotvec([0, 0, np.pi / 2]) * Rotation.from_rotvec(0.5 * np.array([0.6, 0, 0.8]))
        np.testing.assert_allclose(frames["arm"][:3, :3], spun.as_matrix(), atol=1e-12)

    @given(seeds)
    @settings(max_examples=60, deadline=None)
    def test_random_trees_agree_with_a_product_of_rest_frame_motions(self, seed: int) -> None:
        asset, positions = random_tree(seed)
        posed_T_rest = rest_to_posed(asset, positions)
        frames = forward(asset, positions)
        for part in asset.parts:
            expected, name = np.eye(4), part.name
            while (joint := asset.joint_to(name)) is not None:
                expected = motion_about_origin(joint, positions[joint.name]) @ expected
                name = joint.parent
            np.testing.assert_allclose(posed_T_rest[part.name], expected, atol=1e-9)
            at = expected @ np.append(rest_origin(asset, part.name), 1.0)
            np.testing.assert_allclose(frames[part.name][:3, 3], at[:3], atol=1e-9)

    @given(seeds)
    @settings(max_examples=60, deadline=None)
    def test_the_order_of_joints_does_not_matter(self, seed: int) -> None:
        asset, positions = random_tree(seed)
        again = forward(replace(asset, joints=tuple(reversed(asset.joints))), positions)
        for name, frame in forward(asset, positions).items():
            np.testing.assert_array_equal(frame, again[name])

    def test_unknown_joints_are_named(self) -> None:
        with pytest.raises(BadInputError, match="no joint 'hatch': joints are door_hinge, drawer_slide"):
            forward(cabinet_asset(), {"hatch": 1.0})

    def test_nothing_to_move(self) -> None:
        np.testing.assert_array_equal(forward(static_asset())["body"], np.eye(4))


class TestJointMotion:
    @pytest.mark.parametrize(
        ("kind", "position", "said"),
        [
            ("revolute", (0.1, 0.2), r"is revolute: expected 1 value\(s\), got 2"),
            ("ball", 0.3, r"is ball: expected 3 value\(s\), got 1"),
            ("ball", (0.1, 0.2), r"is ball: expected 3 value\(s\), got 2"),
            ("free", (0.1, 0.2, 0.3), r"is free: expected 6 value\(s\), got 3"),
            ("continuous", (), r"is continuous: expected 1 value\(s\), got 0"),
        ],
    )
    def test_positions_of_a_wrong_size(self, kind: Any, position: Any, said: str) -> None:
        limits = sk.Limits(-1.0, 1.0) if kind == "revolute" else None
        with pytest.raises(BadInputError, match=f"joint 'j' {said}"):
            joint_motion(sk.Joint("j", kind, "a", "b", limits=limits), position)

    @pytest.mark.parametrize("kind", KINDS)
    def test_zero_is_rest_for_every_kind(self, kind: Any) -> None:
        limits = sk.Limits(-1.0, 1.0) if kind in ("revolute", "prismatic") else None
        joint = sk.Joint("j", kind, "a", "b", limits=limits)
        np.testing.assert_array_equal(joint_motion(joint, 0.0), np.eye(4))

    def test_ball_and_free_by_hand(self) -> None:
        quarter = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
        ball = joint_motion(sk.Joint("j", "ball", "a", "b"), (np.pi / 2, 0, 0))
        np.testing.assert_allclose(ball[:3, :3], quarter, atol=1e-15)
        np.testing.assert_array_equal(ball[:3, 3], np.zeros(3))
        free = joint_motion(sk.Joint("j", "free", "a", "b"), (1, 2, 3, np.pi / 2, 0, 0))
        np.testing.assert_allclose(free[:3, :3], quarter, atol=1e-15)
        np.testing.assert_array_equal(free[:3, 3], (1, 2, 3))

    def test_a_slide_keeps_its_direction(self) -> None:
        joint = sk.Joint("j", "prismatic", "a", "b", axis=(0.6, 0.0, 0.8), limits=sk.Limits(0.0, 1.0))
        np.testing.assert_allclose(joint_motion(joint, 0.5)[:3, 3], (0.3, 0.0, 0.4))


@given(seeds)
@settings(max_examples=30, deadline=None)
def test_ordered_joints_come_after_what_moves_their_parent(seed: int) -> None:
    asset, _ = random_tree(seed)
    placed = {asset.root.name}
    ordered = ordered_joints(asset)
    for joint in ordered:
        assert joint.parent in placed
        placed.add(joint.child)
    assert sorted(j.name for j in ordered) == sorted(j.name for j in asset.joints)
    for parent in placed:
        siblings = [j.name for j in asset.joints if j.parent == parent]
        assert [j.name for j in ordered if j.parent == parent] == siblings


def test_a_part_and_all_that_it_carries() -> None:
    assert carried(chain_asset(), "post") == {"post", "arm"}
    assert carried(chain_asset(), "base") == {"base", "post", "arm"}
    assert carried(chain_asset(), "arm") == {"arm"}
    assert carried(cabinet_asset(), "door") == {"door"}


def test_ranges_to_show() -> None:
    door, drawer = cabinet_asset().joints
    assert span(door) == (-1.5, 0.0)
    assert span(drawer) == (0.0, 0.3)
    assert span(sk.Joint("j", "continuous", "a", "b")) == (0.0, 2 * np.pi)
    assert span(sk.Joint("j", "ball", "a", "b")) == (0.0, 0.0)


def test_open_is_the_far_end_of_every_range() -> None:
    assert opened(cabinet_asset(), 1.0) == {"door_hinge": -1.5, "drawer_slide": 0.3}
    assert opened(cabinet_asset(), 0.5) == {"door_hinge": -0.75, "drawer_slide": 0.15}
    assert opened(chain_asset(), 1.0) == {"arm_hinge": 0.9, "post_spin": 2 * np.pi}
    assert opened(static_asset(), 1.0) == {}


def test_sampled_positions_lie_within_limits_and_follow_the_seed() -> None:
    tree, _ = random_tree(3)
    for asset in (cabinet_asset(), chain_asset(), tree):
        one, two = (sample_positions(asset, np.random.default_rng(7)) for _ in range(2))
        assert one == two
        assert set(one) == {j.name for j in asset.joints if j.turns or j.kind == "prismatic"}
        for name, value in one.items():
            lower, upper = span(asset.joint(name))
            assert lower <= value <= upper
    other = sample_positions(cabinet_asset(), np.random.default_rng(8))
    assert other != sample_positions(cabinet_asset(), np.random.default_rng(7))


@pytest.mark.parametrize("kind", ["revolute", "continuous", "prismatic"])
@given(seed=seeds)
@settings(max_examples=40, deadline=None)
def test_points_that_a_joint_moves_stay_in_its_reach_box(kind: Any, seed: int) -> None:
    rng = np.random.default_rng(seed)
    limits = None if kind == "continuous" else sk.Limits(-rng.uniform(0, 2), rng.uniform(0, 2))
    origin, axis = vec3(rng.normal(size=3)), vec3(unit(rng.normal(size=3)))
    joint = sk.Joint("joint", kind, "one", "two", origin, axis, limits)
    points = rng.normal(size=(5, 3)) * rng.uniform(0, 2)
    lower, upper = reach_box(joint, points)
    for position in [0.0, *np.linspace(*span(joint), 7).tolist()]:
        posed_T_rest = moved_by(joint, position)
        posed = points @ posed_T_rest[:3, :3].T + posed_T_rest[:3, 3]
        assert (posed >= lower - 1e-9).all()
        assert (posed <= upper + 1e-9).all()


def test_a_reach_box_is_no_larger_than_it_has_to_be() -> None:
    slide = sk.Joint("slide", "prismatic", "one", "two", axis=(0, 1, 0), limits=sk.Limits(-1, 3))
    np.testing.assert_allclose(reach_box(slide, np.array([[0, 0, 0], [1, 1, 1]])), [[0, -1, 0], [1, 4, 1]])
    hinge = sk.Joint("hinge", "continuous", "one", "two", origin=(5, 0, 0), axis=(0, 0, 1))
    np.testing.assert_allclose(reach_box(hinge, np.array([[5, 2, 1], [6, 0, 4]])), [[3, -2, 1], [7, 2, 4]])


def test_what_one_joint_moves_is_where_the_tree_has_it() -> None:
    asset = chain_asset()
    for joint in (joint for joint in asset.joints if span(joint) != (0.0, 0.0)):
        position = 0.6 * span(joint)[1]
        np.testing.assert_allclose(
            moved_by(joint, position), rest_to_posed(asset, {joint.name: position})[joint.child], atol=1e-12
        )
