"""Checks of motion: `settle`, `gravity`, `push`, `energy`, `timestep` and `realtime`."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, cos, degrees, sqrt
from pathlib import Path

import pytest

from simart_kit import Subject
from simart_kit.testing.meshes import static_asset

from .checks_cases import cabinet, judged, mjcf, subject_in

LID = """<body name="box"><geom type="box" size="0.2 0.2 0.1"/></body>
<body name="lid" pos="0 0 0.12"><joint name="hinge" axis="0 -1 0" pos="-0.2 0 0" range="0 1"/>
<geom type="box" size="0.2 0.2 0.01"/></body>"""
DRAWER = """<body name="box"><geom type="box" size="0.2 0.2 0.1"/></body>
<body name="drawer" pos="0 0 0.3"><joint name="slide" type="slide" axis="1 0 0" range="0 0.2"/>
<geom type="box" size="0.1 0.1 0.05"/></body>"""
DOOR = """<body name="box"><geom type="box" size="0.2 0.2 0.1"/></body>
<body name="door" pos="0 -0.3 0"><joint name="hinge" axis="0 0 -1" pos="-0.2 0 0" range="0 1.5"/>
<geom type="box" size="0.2 0.01 0.1"/></body>"""
GRAVITY = 9.81
# MuJoCo's dry friction creeps by default, here by 0.03 rad/s.
FIRM = 'solimpfriction="0.9999 0.9999 0.001"'


class TestSettle:
    def test_without_collision_shapes_it_falls_through_the_floor(self) -> None:
        """After 3 s in free fall it is g t and g t^2 / 2 away, air or not."""
        asset = static_asset()
        asset = asset.with_parts({"body": replace(asset.root, collision=())})
        result = judged("settle", Subject({}, asset))
        assert not result.passed
        assert result.evidence["speed"] == pytest.approx(GRAVITY * 3, rel=0.01)
        assert result.evidence["sink"] == pytest.approx(GRAVITY * 9 / 2, rel=0.01)
        assert "it still moves at 29 m/s" in result.text

    def test_a_body_without_shapes_sinks_to_those_of_its_doors(self) -> None:
        """The door ends 25 mm above the floor on which the cabinet stood."""
        asset = cabinet()
        asset = asset.with_parts({"body": replace(asset.root, collision=())})
        subject = Subject({}, asset)
        lowest = subject.mechanism.bounds[0, 2]
        assert lowest == pytest.approx(0.025)
        assert not judged("settle", subject).passed

    def test_with_its_centre_of_mass_outside_its_base_it_falls_over(self) -> None:
        asset = static_asset()
        assert asset.root.mass is not None
        mass = replace(asset.root.mass, center=(0.6, 0.15, 0.25))
        result = judged("settle", Subject({}, asset.with_parts({"body": replace(asset.root, mass=mass)})))
        assert not result.passed
        assert result.evidence["tilt"] > 10
        assert "it tilts by" in result.text

    def test_tilt_is_seen_about_every_axis_and_turning_on_the_spot_is_none(self, tmp_path: Path) -> None:
        """Boxes whose own z lies down, one of which stands on its edge and tips over about that z."""
        lying = '<body name="b" quat="0.7071068 0.7071068 0 0"><geom type="box" size="0.1 0.2 {}"/>{}</body>'
        heavy = '<inertial pos="0.3 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>'
        assert judged("settle", mjcf(tmp_path / "a", lying.format(0.3, ""))).passed
        tipping = judged("settle", mjcf(tmp_path / "b", lying.format(0.3, heavy)))
        assert tipping.evidence["tilt"] > 10

    def test_a_spring_too_stiff_for_the_time_step(self, tmp_path: Path) -> None:
        """An explicit step stands no more than 2 / 0.002 s = 1000 rad/s; 2.4 kg on 1e7 N/m make 2040."""
        stiff = mjcf(tmp_path, DRAWER, 'stiffness="1e7" springref="0.1"', integrator="Euler")
        result = judged("settle", stiff)
        assert not result.passed
        assert result.evidence["warnings"] > 0
        assert "MuJoCo warned" in result.text

    def test_what_hangs_on_the_world_has_no_base_to_drop(self, tmp_path: Path) -> None:
        door = '<body name="d"><joint name="h" axis="0 0 1"/><geom type="box" size="0.2 0.01 0.1"/></body>'
        result = judged("settle", mjcf(tmp_path, door))
        assert (result.passed, result.text) == (True, "joints hang on the world: there is no base to drop")
        assert judged("realtime", mjcf(tmp_path / "r", door)).passed

    def test_warnings_stay_out_of_the_working_directory(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.chdir(tmp_path)
        stiff = mjcf(tmp_path / "made", DRAWER, 'stiffness="1e7" springref="0.1"', integrator="Euler")
        assert judged("settle", stiff).evidence["warnings"] > 0
        assert [path.name for path in tmp_path.iterdir()] == ["made"]

    TAP = """<body name="base"><geom type="box" size="0.05 0.05 0.1"/>
    <geom type="box" size="0.2 0.05 0.05" pos="0.25 0 0.15"/></body>"""

    def test_what_cannot_stand_is_mounted_while_its_base_is_fixed(self, tmp_path: Path) -> None:
        """Volumes of 0.002 at x = 0 and 0.004 m3 at 0.25: the centre at 0.1667, 0.1167 outside the base.

        It is 0.2 m up: the one is at 0.1, the other at 0.25 above the floor, together at 0.2.
        """
        result = judged("settle", mjcf(tmp_path, self.TAP))
        assert (result.passed, result.text) == (True, "does not stand by itself: keep its base fixed")
        assert result.evidence["tilt"] > 10
        assert result.evidence["stands"] == pytest.approx(degrees(atan2(-(0.5 / 3 - 0.05), 0.2)), abs=0.05)
        floating = mjcf(tmp_path / "f", self.TAP.replace('"base">', '"base"><freejoint/>'))
        assert not judged("settle", floating).passed
        assert not judged("settle", floating, stands=0.0).passed

    def test_how_badly_a_mounted_thing_stands_can_be_set(self, tmp_path: Path) -> None:
        """A board on its edge: its centre is 1 cm inside the edge and 0.2 m up, 2.9 degrees."""
        slim = """<body name="b"><geom type="box" size="0.01 0.2 0.2"/>
        <inertial pos="0.05 0 0" mass="1" diaginertia="0.01 0.01 0.01"/></body>"""
        subject = mjcf(tmp_path, slim)
        assert judged("settle", subject).evidence["stands"] == pytest.approx(
            degrees(atan2(0.01, 0.2)), abs=0.01
        )
        assert judged("settle", subject).passed
        assert not judged("settle", subject, stands=2.0).passed

    def test_what_would_stand_if_it_were_solid_is_not_mounted(self, tmp_path: Path) -> None:
        heavy = '<inertial pos="0.5 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>'
        bodies = f'<body name="b"><geom type="box" size="0.1 0.1 0.1"/>{heavy}</body>'
        result = judged("settle", mjcf(tmp_path, bodies))
        assert not result.passed
        assert result.evidence["stands"] == pytest.approx(45.0, abs=0.1)

    def test_a_round_bottom_is_no_foot(self, tmp_path: Path) -> None:
        """A bottle, a little heavier on one side: 5 mm up its bottom is 33 mm wide, but it rolls on it."""
        bottle = """<body name="b"><geom type="capsule" size="0.03 0.1"/>
        <inertial pos="0.004 0 0" mass="1" diaginertia="0.01 0.01 0.01"/></body>"""
        result = judged("settle", mjcf(tmp_path, bottle))
        assert result.evidence["tilt"] > 10
        assert (result.passed, result.text) == (True, "does not stand by itself: keep its base fixed")

    def test_feet_of_unequal_height_let_it_lean(self, tmp_path: Path) -> None:
        """One foot ends at x = -0.03 on the floor, the other at 0.05 and 4 mm up: 2.86 degrees."""
        body = """<body name="b"><freejoint/><geom type="box" size="0.05 0.05 0.01" pos="0 0 0.03"/>
        <geom type="box" size="0.01 0.05 0.01" pos="-0.04 0 0.01"/>
        <geom type="box" size="0.01 0.05 0.01" pos="0.04 0 {}"/></body>"""
        result = judged("settle", mjcf(tmp_path / "a", body.format(0.014)))
        assert result.passed
        assert result.evidence["leans"] == pytest.approx(degrees(atan2(0.004, 0.08)), abs=0.001)
        assert result.evidence["tilt"] == pytest.approx(result.evidence["leans"], abs=0.2)
        higher = judged("settle", mjcf(tmp_path / "b", body.format(0.018)))
        assert (higher.passed, higher.evidence["leans"]) == (False, 0.0)  # 8 mm up is no foot

    def test_thresholds(self) -> None:
        subject = Subject({}, cabinet())
        assert judged("settle", subject).passed
        assert not judged("settle", subject, tilt=1e-9).passed
        assert not judged("settle", subject, seconds=0.05).passed  # it falls for 0.064 s


class TestGravity:
    def test_a_spring_moves_what_gravity_does_not(self, tmp_path: Path) -> None:
        result = judged("gravity", mjcf(tmp_path, DRAWER, 'stiffness="100" damping="5"'))
        assert (result.passed, result.text) == (False, "drifts, and not by its weight: slide")
        row = result.evidence["joints"]["slide"]
        assert row["drift"] == pytest.approx(0.5, abs=0.01)  # from mid-range to its end at rest
        assert row["weight"] == pytest.approx(0.0, abs=1e-9)

    @pytest.mark.parametrize(("friction", "falls"), [(0.5, True), (12.0, False)])
    def test_a_heavy_lid_falls_and_is_listed(self, friction: float, falls: bool, tmp_path: Path) -> None:
        """1.92 kg, 0.2 m from the hinge, half a radian up."""
        result = judged("gravity", mjcf(tmp_path, LID, f'frictionloss="{friction}" {FIRM}'))
        assert result.passed
        row = result.evidence["joints"]["hinge"]
        assert row["weight"] == pytest.approx(0.4 * 0.4 * 0.02 * 600 * GRAVITY * 0.2 * cos(0.5), rel=1e-3)
        assert row["friction"] == friction
        assert ("by its own weight falls: hinge" in result.text) == falls
        assert (row["drift"] > 0.02) == falls

    @pytest.mark.parametrize(("travel", "holds"), [(0.00015, True), (0.0003, False)])
    def test_less_than_a_tenth_of_a_millimetre_is_no_drift(
        self, travel: float, holds: bool, tmp_path: Path
    ) -> None:
        """Solvers' friction creeps by hundredths, which may be much of a button's travel."""
        drawer = DRAWER.replace("0 0.2", f"0 {travel}")
        result = judged("gravity", mjcf(tmp_path, drawer, 'stiffness="100" damping="5"'))
        assert result.passed == holds
        assert result.evidence["joints"]["slide"]["drift"] == pytest.approx(0.5, abs=0.05)

    def test_a_lid_that_creeps_though_its_friction_is_enough(self, tmp_path: Path) -> None:
        result = judged("gravity", mjcf(tmp_path, LID, 'frictionloss="12"'))
        assert (result.passed, result.text) == (False, "drifts, and not by its weight: hinge")


class TestPush:
    def test_friction_of_10_newton_metres(self, tmp_path: Path) -> None:
        result = judged("push", mjcf(tmp_path, DOOR, f'frictionloss="10" {FIRM}'))
        assert not result.passed
        assert result.text == "5 N m or 20 N does not open hinge (0%)"
        assert result.fault is not None
        assert result.fault.positions == {"hinge": pytest.approx(0.0, abs=1e-3)}
        assert result.fault.point == pytest.approx((-0.2, -0.3, 0.0))
        assert judged("push", mjcf(tmp_path / "s", DOOR, 'frictionloss="10"'), torque=15.0).passed

    def test_a_lid_too_heavy_for_the_push_is_listed(self, tmp_path: Path) -> None:
        """1.92 kg, 0.2 m from the hinge: 3.77 N m when it is shut."""
        subject = mjcf(tmp_path, LID, 'damping="0.1"')
        assert judged("push", subject).passed
        weak = judged("push", subject, torque=3.0, person=8.0)  # 0.4 m from the axis: 3.2 N m
        assert weak.passed
        assert "0 joints open at a push" in weak.text
        assert "too heavy for it [N m | N]: hinge (3.8)" in weak.text
        stuck = judged("push", mjcf(tmp_path / "stuck", LID, f'frictionloss="9" {FIRM}'))
        assert not stuck.passed  # the push could lift it, were it not for friction

    @pytest.mark.parametrize(("friction", "passes"), [(6.4, True), (6.8, False)])
    def test_a_heavy_lid_is_lifted_by_what_its_weight_asks_for(
        self, friction: float, passes: bool, tmp_path: Path
    ) -> None:
        """3.77 N m of weight: 1.5 times that lifts it and 1.25 times overcomes what holds it, 10.36 N m.

        That is 6.59 N m more than its weight, and what friction beyond that holds is stuck.
        """
        result = judged("push", mjcf(tmp_path, LID, f'frictionloss="{friction}" damping="0.1" {FIRM}'))
        assert result.passed == passes
        row = result.evidence["joints"]["hinge"]
        assert row["weight"] == pytest.approx(0.4 * 0.4 * 0.02 * 600 * GRAVITY * 0.2, rel=1e-3)
        assert row["asked"] == pytest.approx(2.75 * row["weight"])
        assert row["lifted"]

    def test_what_falls_open_but_is_held_is_stuck(self, tmp_path: Path) -> None:
        """Its weight is no excuse: it pulls the way that the joint opens."""
        flap = LID.replace('axis="0 -1 0"', 'axis="0 1 0"').replace('pos="0 0 0.12"', 'pos="0.4 0 0.12"')
        assert judged("push", mjcf(tmp_path, flap, 'damping="1"')).passed
        stuck = judged("push", mjcf(tmp_path / "s", flap, f'frictionloss="90" {FIRM}'))
        assert not stuck.passed
        assert "does not open hinge" in stuck.text

    def test_a_limit_that_gives_way(self, tmp_path: Path) -> None:
        stops = 'damping="1" solreflimit="{} 1"'
        hard = judged("push", mjcf(tmp_path / "hard", DOOR, stops.format(0.02)))
        soft = judged("push", mjcf(tmp_path / "soft", DOOR, stops.format(0.5)))
        assert hard.passed
        assert not soft.passed
        assert "pushed over its limit: hinge by" in soft.text
        assert soft.evidence["joints"]["hinge"]["overshoot"] > 0.01

    def test_what_is_heavy_gets_the_time_that_it_takes(self, tmp_path: Path) -> None:
        """5 N m turn 140 kg m^2 by 1.1 rad in 8 s, by 1.4 rad in 9 s; a damper lets through 0.025 rad/s."""
        gate = judged("push", mjcf(tmp_path / "gate", DOOR, f'armature="140" {FIRM}'))
        assert gate.passed
        assert gate.evidence["joints"]["hinge"]["opened"] > 0.9
        damped = judged("push", mjcf(tmp_path / "damped", DOOR, f'armature="1" damping="200" {FIRM}'))
        assert not damped.passed
        assert damped.evidence["joints"]["hinge"]["reached"] == pytest.approx(0.2, abs=0.005)

    def test_a_range_below_rest_is_pushed_the_other_way(self, tmp_path: Path) -> None:
        below = DOOR.replace('range="0 1.5"', 'range="-1.5 0.1"').replace('axis="0 0 -1"', 'axis="0 0 1"')
        row = judged("push", mjcf(tmp_path, below, 'damping="0.5"')).evidence["joints"]["hinge"]
        assert row["opened"] == 1.0
        assert row["reached"] <= -1.5


class TestEnergyAndTimestep:
    def test_a_spring_that_swings_faster_than_the_step(self, tmp_path: Path) -> None:
        """2.4 kg on 1e6 N/m make 645 rad/s: a step of 1 ms is a tenth of a swing."""
        assert sqrt(1e6 / (0.2 * 0.2 * 0.1 * 600)) == pytest.approx(645, abs=1)
        subject = mjcf(tmp_path, DRAWER, 'stiffness="1e6"')
        energy, step = judged("energy", subject), judged("timestep", subject)
        assert not energy.passed
        assert energy.evidence["drift"] > 1e-6
        assert not step.passed
        assert step.evidence["difference"] > 1e-3

    def test_a_soft_spring_and_none(self, tmp_path: Path) -> None:
        for number, joints in enumerate(('stiffness="20" damping="2"', "")):
            subject = mjcf(tmp_path / str(number), DRAWER, joints)
            assert judged("energy", subject).passed
            assert judged("timestep", subject).passed

    def test_parts_that_half_open_stand_in_each_other_do_not_burst_apart(self, tmp_path: Path) -> None:
        """Either may go all the way alone; half open they share 0.2 m."""
        two = "".join(
            f'''<body name="part_{side}" pos="{side * 0.6} 0 0">
            <joint name="slide_{side}" type="slide" axis="{-side} 0 0" range="0 1"/>
            <geom type="box" size="0.2 0.2 0.2"/></body>'''
            for side in (-1, 1)
        )
        step = judged("timestep", mjcf(tmp_path, two, 'damping="1"'))
        assert step.passed
        assert step.evidence["difference"] < 1e-4

    def test_energy_is_kept_by_a_pendulum(self, tmp_path: Path) -> None:
        """Friction and damping of the file are taken out, so that only the integration can lose any."""
        result = judged("energy", mjcf(tmp_path, LID, 'frictionloss="3" damping="3"'))
        assert result.passed
        assert result.evidence["drift"] < 1e-9

    def test_thresholds(self, tmp_path: Path) -> None:
        subject = mjcf(tmp_path, DRAWER, 'stiffness="20"')
        assert not judged("energy", subject, drift=1e-18).passed
        assert not judged("timestep", subject, difference=1e-9, step=0.01).passed


class TestRealtime:
    def test_fast_enough_says_no_time(self, tmp_path: Path) -> None:
        results = [judged("realtime", Subject({}, cabinet())) for _ in range(2)]
        assert results[0] == results[1]
        assert results[0].evidence == {"factor": 20.0}
        assert results[0].passed

    def test_too_slow_says_how_fast(self) -> None:
        result = judged("realtime", Subject({}, cabinet()), factor=1e9, seconds=0.02)
        assert not result.passed
        assert 0 < result.evidence["measured"] < 1e9


@pytest.mark.parametrize("kind", ["urdf", "mjcf", "usd"])
def test_motion_is_that_of_the_file(kind: str, tmp_path: Path) -> None:
    """A cabinet whose file alone has friction that nobody overcomes is stuck."""
    asset = cabinet()
    stuck = asset.with_joints({"door_hinge": replace(asset.joint("door_hinge"), friction=10.0)})
    options = {"dynamics_friction": True} if kind == "urdf" else {}
    files = subject_in(tmp_path, stuck, kind, **options).files
    assert "does not open door_hinge" in judged("push", Subject(files, asset)).text
