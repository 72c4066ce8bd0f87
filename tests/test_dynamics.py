"""The modifier `dynamics`: what is let go stays, a push moves it, and nothing droops."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from simart_kit_exporters.mjcf import Mjcf
from simart_kit_plugins.modifiers.dynamics import Dynamics, push_needed
from simart_kit_plugins.modifiers.mass import Mass

import simart_kit as sk
from simart_kit.arrays import Vec3
from simart_kit.loads import GRAVITY, load, rolling_resistance
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset, chain_asset

UP, SIDE = (0.0, 0.0, 1.0), (-1.0, 0.0, 0.0)


def hinged(axis: Vec3 = SIDE, kilograms: float = 2.0, **changes: Any) -> sk.Asset:
    """A plate of 0.5 x 0.4 x 0.02 m on a chest, hinged along its lower back edge."""
    mesh = boxes_mesh([((0, 0, 0), (0.5, 0.4, 0.1)), ((0, 0, 0.1), (0.5, 0.4, 0.12))])
    values: dict[str, Any] = {"kind": "revolute", "limits": sk.Limits(0.0, 1.5)}
    joint = sk.Joint(
        "lid_joint", parent="body", child="lid", origin=(0.0, 0.4, 0.1), axis=axis, **values | changes
    )
    parts = (sk.Part("body"), sk.Part("lid", stated_mass=kilograms))
    return Mass().modify(sk.Asset("chest", mesh, np.repeat([0, 1], 12), parts, (joint,)))


def resisting(asset: sk.Asset, **options: float) -> sk.Joint:
    return Dynamics(Dynamics.Options(**options)).modify(asset).joint("lid_joint")


def warnings(asset: sk.Asset) -> list[str]:
    return [n.text for n in Dynamics().modify(asset).notes if n.level == "warning"]


class TestLoads:
    def test_a_plate_about_its_long_edge(self) -> None:
        moved = load(hinged(), hinged().joint("lid_joint"))
        assert moved.mass == pytest.approx(2.0)
        assert moved.inertia == pytest.approx(2.0 * (0.4**2 + 0.02**2) / 3)

    def test_gravity_on_a_lid_follows_the_cosine(self) -> None:
        """The centre is 0.2 m in front of the hinge and 0.01 m above it."""
        asset = hinged()
        moved = load(asset, asset.joint("lid_joint"))
        expected = -2.0 * GRAVITY * (0.2 * np.cos(moved.positions) - 0.01 * np.sin(moved.positions))
        np.testing.assert_allclose(moved.gravity, expected, atol=1e-12)
        assert moved.most == pytest.approx(2.0 * GRAVITY * 0.2)

    def test_none_about_the_vertical_or_on_level_runners(self) -> None:
        for changes in ({"axis": UP}, {"axis": (0.0, -1.0, 0.0), "kind": "prismatic"}):
            asset = hinged(**changes)
            assert load(asset, asset.joint("lid_joint")).most == pytest.approx(0.0, abs=1e-12)

    def test_the_weight_on_upright_runners(self) -> None:
        asset = hinged(UP, kind="prismatic")
        moved = load(asset, asset.joint("lid_joint"))
        np.testing.assert_allclose(moved.gravity, -2.0 * GRAVITY)
        assert moved.inertia == pytest.approx(2.0)

    def test_what_hangs_on_a_part_is_moved_with_it(self) -> None:
        asset = chain_asset()
        alone = asset.with_joints({"arm_hinge": replace(asset.joint("arm_hinge"), parent="base")})
        spin = asset.joint("post_spin")
        post, arm = asset.part("post").mass, asset.part("arm").mass
        assert post is not None
        assert arm is not None
        assert load(asset, spin).mass == pytest.approx(post.mass + arm.mass)
        assert load(alone, spin).mass == pytest.approx(post.mass)

    def test_rest_is_among_the_positions(self) -> None:
        asset = hinged(limits=sk.Limits(-0.37, 1.1))
        assert 0.0 in load(asset, asset.joint("lid_joint")).positions


class TestResistance:
    def test_a_door_by_its_inertia(self) -> None:
        joint = resisting(hinged(UP, kilograms=4.0))
        inertia = 4.0 * (0.5**2 + 0.4**2) / 3
        assert joint.friction == pytest.approx(0.3 * inertia)
        assert joint.damping == pytest.approx(1.0 * inertia)
        assert joint.armature == pytest.approx(0.01 * inertia)

    def test_a_drawer_by_its_mass(self) -> None:
        joint = resisting(hinged((0.0, -1.0, 0.0), 4.0, kind="prismatic"))
        assert (joint.friction, joint.damping) == pytest.approx((0.5 * 4.0, 2.0 * 4.0))
        assert joint.armature == pytest.approx(0.04)

    @pytest.mark.parametrize("kilograms", [80.0, 8000.0])
    def test_friction_leaves_most_of_a_push_however_heavy_the_door(self, kilograms: float) -> None:
        joint = resisting(hinged(UP, kilograms))
        assert joint.friction == pytest.approx(0.4 * 5.0)
        assert (5.0 - joint.friction) / joint.damping >= 0.5 - 1e-9  # rad/s

    def test_light_things_get_the_least(self) -> None:
        joint = resisting(hinged(UP, 0.0005))
        assert (joint.friction, joint.damping, joint.armature) == (1e-3, 1e-4, 1e-5)

    def test_a_light_lid_is_held_everywhere_and_opens(self) -> None:
        asset = hinged(kilograms=0.7)
        joint, moved = resisting(asset), load(asset, asset.joint("lid_joint"))
        assert joint.friction == pytest.approx(1.2 * moved.most)
        assert push_needed(joint, moved) < 5.0
        assert warnings(asset) == []

    def test_a_middling_lid_opens_and_sinks_slowly(self) -> None:
        asset = hinged(kilograms=1.5)
        joint, moved = resisting(asset), load(asset, asset.joint("lid_joint"))
        assert push_needed(joint, moved) == pytest.approx(4.0)
        assert (moved.most - joint.friction) / joint.damping <= 1.0 + 1e-9  # rad/s
        (text,) = warnings(asset)
        assert text.startswith("lid_joint: gravity exerts up to 2.94 N*m, friction holds 1.06 N*m")

    def test_a_lid_that_a_push_cannot_lift_stays_where_it_is_put(self) -> None:
        asset = hinged(kilograms=8.0)
        joint, moved = resisting(asset), load(asset, asset.joint("lid_joint"))
        assert joint.friction == pytest.approx(moved.most + 2.0)
        (text,) = warnings(asset)
        assert text == "lid_joint: takes 33.4 N*m to open, more than a push of 5 N*m"  # 2 x 15.7 + 2
        assert resisting(asset, torque=50.0).friction == pytest.approx(1.2 * moved.most)

    def test_a_flap_that_gravity_opens_does_not_droop_and_can_be_pushed(self) -> None:
        """A trapdoor drawn half-way, 2 kg: gravity pulls it open with up to 3.9 N*m."""
        asset = hinged((1.0, 0.0, 0.0), limits=sk.Limits(-0.1, 0.7))
        joint, moved = resisting(asset), load(asset, asset.joint("lid_joint"))
        assert moved.most < joint.friction
        assert push_needed(joint, moved) <= 4.0 + 1e-9

    def test_a_tailgate_drawn_open_does_not_fall_shut(self) -> None:
        """6 kg held level: gravity pulls with 11.8 N*m at rest; friction exceeds that by 0.4 of a push."""
        asset = hinged(kilograms=6.0, limits=sk.Limits(-1.5, 0.1))
        joint = resisting(asset)
        assert joint.friction == pytest.approx(6.0 * GRAVITY * 0.2 + 2.0)

    def test_a_limit_that_holds_a_flap_at_rest_leaves_friction_to_the_push(self) -> None:
        asset = hinged(kilograms=1.5, limits=sk.Limits(0.0, 1.5))
        assert resisting(asset).friction < 1.5 * GRAVITY * 0.2

    def test_values_that_are_given_stay(self) -> None:
        given = {"damping": 0.7, "friction": 0.3, "armature": 0.02, "effort": 9.0, "velocity": 0.4}
        asset = hinged(**given)
        assert Dynamics().modify(asset).joints == asset.joints

    def test_effort_and_velocity_by_kind(self) -> None:
        door, wheel = resisting(hinged(UP)), resisting(hinged(UP, kind="continuous", limits=None))
        assert (door.effort, door.velocity) == (10.0, 2.0)  # twice the push
        assert wheel.velocity == 20.0
        assert resisting(hinged(kilograms=8.0)).effort == pytest.approx(2 * (2 * 8 * GRAVITY * 0.2 + 2))

    def test_fixed_and_free_joints_get_nothing(self) -> None:
        for kind in ("fixed", "free"):
            asset = hinged(kind=kind, limits=None)
            assert Dynamics().modify(asset).joints == asset.joints
            assert warnings(asset) == []

    def test_an_arm_on_an_arm_is_held_in_every_pose(self) -> None:
        """The second turns about the vertical at rest, but the first may tilt it."""
        asset = chain_asset()
        tilting = replace(asset.joint("post_spin"), axis=(1.0, 0.0, 0.0))
        upright = replace(asset.joint("arm_hinge"), axis=UP)
        asset = asset.with_joints({"post_spin": tilting, "arm_hinge": upright})
        arm = asset.part("arm").mass
        assert arm is not None
        reach = np.hypot(arm.center[0] - 0.05, arm.center[1])
        assert load(asset, upright).most == pytest.approx(arm.mass * GRAVITY * reach)


@pytest.mark.parametrize("kilograms", [0.3, 0.8])
def test_in_simulation_a_lid_holds_opens_and_stays(tmp_path: Path, kilograms: float) -> None:
    """Without contacts; MuJoCo's dry friction is soft and creeps unless told to be stiff."""
    import mujoco

    asset = Dynamics().modify(hinged(kilograms=kilograms, limits=sk.Limits(-1.0, 1.5)))
    model = mujoco.MjModel.from_xml_path(str(Mjcf().export(asset, tmp_path)))
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    model.dof_solimp[:, :2] = 0.9999
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 1500)
    assert abs(data.qpos[0]) < 2e-3
    while data.qpos[0] < 0.7 and data.time < 20:
        data.qfrc_applied[0] = 5.0 if data.qvel[0] < 2.0 else 0.0
        mujoco.mj_step(model, data)
    assert data.time < 20
    data.qfrc_applied[0] = 0.0
    mujoco.mj_step(model, data, 500)
    released = float(data.qpos[0])
    mujoco.mj_step(model, data, 1500)
    assert released > 0.5
    assert data.qpos[0] == pytest.approx(released, abs=2e-3)


def test_the_cabinet_opens_without_a_doubt() -> None:
    asset = cabinet_asset(physics=False)
    loose = replace(asset, joints=tuple(replace(j, damping=0.0, friction=0.0) for j in asset.joints))
    result = Dynamics().modify(Mass().modify(loose))
    (note,) = [n for n in result.notes if n.stage == "dynamics"]
    assert (note.level, note.text) == (
        "info",
        "damping and friction in proportion to what moves: door_hinge, drawer_slide",
    )


def trolley(**changes: Any) -> sk.Asset:
    """A board of 8 kg on two rollers of 1 kg, whose axles are 0.1 m above the floor."""
    board = ((-0.5, -0.3, 0.2), (0.5, 0.3, 0.25))
    rollers = [((x - 0.1, -0.3, 0.0), (x + 0.1, 0.3, 0.2)) for x in (-0.4, 0.4)]
    mesh = boxes_mesh([board, *rollers])
    values: dict[str, Any] = {"axis": (0.0, 1.0, 0.0)} | changes
    joints = tuple(
        sk.Joint(f"{name}_spin", "continuous", "board", name, (x, 0.0, 0.1), **values)
        for name, x in (("front", -0.4), ("rear", 0.4))
    )
    parts = (
        sk.Part("board", stated_mass=8.0),
        sk.Part("front", stated_mass=1.0),
        sk.Part("rear", stated_mass=1.0),
    )
    return Mass().modify(sk.Asset("trolley", mesh, np.repeat([0, 1, 2], 12), parts, joints))


class TestWheels:
    def test_they_share_the_rolling_resistance_of_what_they_carry(self) -> None:
        """A fiftieth of 10 kg on two wheels of 0.1 m."""
        asset = trolley()
        expected = {f"{name}_spin": 0.02 * 10 * GRAVITY / 2 * 0.1 for name in ("front", "rear")}
        assert rolling_resistance(asset, asset.joints) == pytest.approx(expected)
        made = Dynamics().modify(asset)
        assert all(made.joint(name).friction >= value for name, value in expected.items())

    def test_what_turns_upright_is_no_wheel(self) -> None:
        asset = trolley(axis=UP)
        assert rolling_resistance(asset, asset.joints) == {}

    def test_what_does_not_reach_the_floor_carries_nothing(self) -> None:
        mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((0.4, 0.4, 1), (0.6, 0.6, 1.2))])
        spin = sk.Joint("spin", "continuous", "body", "drum", (0.5, 0.5, 1.1), (1.0, 0.0, 0.0))
        asset = sk.Asset("mill", mesh, np.repeat([0, 1], 12), (sk.Part("body"), sk.Part("drum")), (spin,))
        assert rolling_resistance(Mass().modify(asset), (spin,)) == {}
