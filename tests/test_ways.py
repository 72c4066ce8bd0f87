"""What has to be out of a joint's way: `ways`, and the checks that ask it."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

from simart_kit import Subject
from simart_kit.checks.names import joint_name
from simart_kit.checks.simulation import contacts
from simart_kit.checks.ways import Ways, meet, moving_alone

from .checks_cases import judged, mjcf

# A case that is open in front (-y), 0.4 wide and 0.4 deep. Boards of 2 cm do not touch what is inside.
CASE = """<body name="case"><geom type="box" size="0.2 0.01 0.2" pos="0 0.2 0"/>
<geom type="box" size="0.01 0.2 0.2" pos="-0.21 0 0"/>
<geom type="box" size="0.01 0.2 0.2" pos="0.21 0 0"/></body>"""
RACK = """<body name="rack"><joint name="rack_slide" type="slide" axis="0 -1 0" range="0 0.3" damping="2"/>
<geom type="box" size="0.15 0.15 0.02"/></body>"""
DOOR = """<body name="door" pos="0 -0.22 0">
<joint name="door_hinge" axis="0 0 -1" pos="-0.2 -0.015 0" range="0 {}" damping="0.2"/>
<geom type="box" size="0.2 0.01 0.2"/></body>"""
POST = """<body name="post"><geom type="box" size="0.02 0.02 0.2" pos="0 -0.5 0"/></body>"""
# Two leaves in one opening, each in front of the other: neither can slide out first.
LOCKED = """<body name="base"><geom type="box" size="0.5 0.5 0.01" pos="0 0 -0.3"/></body>
<body name="one"><joint name="one_slide" type="slide" axis="0 -1 0" range="0 0.5"/>
<geom type="box" size="0.1 0.02 0.1"/><geom type="box" size="0.02 0.02 0.1" pos="0.2 0.1 0"/></body>
<body name="two"><joint name="two_slide" type="slide" axis="0 -1 0" range="0 0.5"/>
<geom type="box" size="0.1 0.02 0.1" pos="0.2 0 0"/>
<geom type="box" size="0.02 0.02 0.1" pos="0 0.1 0"/></body>"""


def cupboard(folder: Path, opens: float = 2.0, more: str = "") -> Subject:
    """A rack behind a door that opens so far [rad]."""
    return mjcf(folder, CASE + RACK + DOOR.format(opens) + more)


def opened_for(subject: Subject, name: str) -> tuple[str, ...]:
    ways: Ways = subject.simulation.ways
    joints = {joint_name(ways.model, joint): joint for joint in range(ways.model.njnt)}
    return ways.way(joints[name]).opened


class TestWay:
    def test_a_rack_waits_for_its_door_and_the_door_for_nothing(self, tmp_path: Path) -> None:
        subject = cupboard(tmp_path)
        assert opened_for(subject, "rack_slide") == ("door_hinge",)
        assert opened_for(subject, "door_hinge") == ()
        way = subject.simulation.ways.way(0)
        np.testing.assert_allclose(way.positions, [0.0, 2.0])  # the rack at rest, the door where it ends

    def test_a_door_waits_for_what_is_before_it(self, tmp_path: Path) -> None:
        """A bar slides away from the door, which then makes way for the rack."""
        bar = """<body name="bar" pos="0 -0.26 0"><joint name="bar_slide" type="slide" axis="0 0 1"
        range="0 0.6"/><geom type="box" size="0.2 0.01 0.1"/></body>"""
        assert opened_for(cupboard(tmp_path, more=bar), "rack_slide") == ("bar_slide", "door_hinge")

    def test_a_door_that_cannot_open_frees_nothing(self, tmp_path: Path) -> None:
        """The post, 0.5 m before the case, stops the door; and one that stands still never makes way."""
        post = POST.replace("-0.5", "-0.3")
        assert opened_for(cupboard(tmp_path, more=post), "rack_slide") == ()
        assert opened_for(mjcf(tmp_path / "p", CASE + RACK + POST), "rack_slide") == ()

    def test_two_that_wait_for_each_other_never_move(self, tmp_path: Path) -> None:
        subject = mjcf(tmp_path, LOCKED)
        assert opened_for(subject, "one_slide") == opened_for(subject, "two_slide") == ()


class TestMovingAlone:
    # Two that stand in each other, beside.
    BESIDE = "".join(
        f'''<body name="{name}" pos="5 0 {height}"><joint name="{name}_slide" type="slide" range="0 1"/>
        <geom type="box" size="0.1 0.1 0.1"/></body>'''
        for name, height in (("lower", 0.0), ("upper", 0.1))
    )

    def test_it_meets_what_it_would_among_all_others_and_nothing_else_does(self, tmp_path: Path) -> None:
        model = cupboard(tmp_path, more=self.BESIDE).simulation.model
        rack = model.joint("rack_slide")
        alone = moving_alone(model, rack.id)
        data, other = mujoco.MjData(model), mujoco.MjData(alone)
        data.qpos[rack.qposadr] = other.qpos[rack.qposadr] = 0.1
        mujoco.mj_forward(model, data)
        meet(alone, other)
        among_all, found = contacts(model, data), contacts(alone, other)
        assert set(among_all) == {("door", "rack"), ("lower", "upper")}
        assert found == {("door", "rack"): among_all["door", "rack"]}

    def test_masks_of_a_file_stay(self, tmp_path: Path) -> None:
        beside = self.BESIDE.replace("<geom", '<geom contype="2" conaffinity="4"')
        model = cupboard(tmp_path, more=beside).simulation.model
        alone = moving_alone(model, model.joint("rack_slide").id)
        np.testing.assert_array_equal(alone.geom_contype, model.geom_contype)
        np.testing.assert_array_equal(alone.geom_conaffinity, model.geom_conaffinity)


class TestChecks:
    def test_a_rack_behind_a_door_passes_and_says_when(self, tmp_path: Path) -> None:
        subject = cupboard(tmp_path)
        for name in ("sweep", "travel"):
            result = judged(name, subject)
            assert result.passed, result.text
            assert result.text.endswith("; rack_slide once door_hinge is open")
            assert result.evidence["waits"] == {"rack_slide": ("door_hinge",)}
        assert judged("gravity", subject).passed
        assert judged("push", subject).passed  # it pushes the door open before it

    def test_a_door_too_little_open_stays_in_the_way(self, tmp_path: Path) -> None:
        """At 0.5 rad its edge is 0.4 sin 0.5 = 0.19 m out, and the rack comes 0.3 m out: it hits the leaf."""
        subject = cupboard(tmp_path, opens=0.5)
        sweep = judged("sweep", subject)
        assert not sweep.passed
        assert sweep.fault is not None
        assert (sweep.fault.text, list(sweep.fault.positions)) == ("door in rack", ["rack_slide"])
        assert not judged("travel", subject).passed
        assert not judged("push", subject).passed

    @pytest.mark.parametrize("kind", ["sweep", "travel"])
    def test_what_goes_through_a_fixed_part_fails(self, kind: str, tmp_path: Path) -> None:
        """A rack that opens through the back of its case; the door, open or not, is no help."""
        back = mjcf(tmp_path, CASE + RACK.replace("0 -1 0", "0 1 0") + DOOR.format(2.0))
        result = judged(kind, back)
        assert not result.passed
        assert "rack_slide" in result.text

    def test_two_that_lock_each_other_fail(self, tmp_path: Path) -> None:
        result = judged("travel", mjcf(tmp_path, LOCKED))
        assert not result.passed
        assert "one_slide" in result.text
        assert "two_slide" in result.text
        assert not judged("sweep", mjcf(tmp_path / "s", LOCKED)).passed
