"""Ranges of joints that wait for others, and buttons that sink into what carries them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from simart_kit_plugins.modifiers.sweep import Sweep

import simart_kit as sk
from simart_kit.testing.meshes import boxes_mesh
from simart_kit.waiting import free_ranges

Bounds = tuple[Sequence[float], Sequence[float]]
# Leaves a stuck joint what is free.
FLAGGING = Sweep(Sweep.Options(stuck="flag"))
# A case that is open in front (-y), inside 1 wide, 1 high and 0.8 deep.
CASE: list[Bounds] = [
    ((-0.6, 0.0, -0.1), (-0.5, 0.9, 1.1)),
    ((0.5, 0.0, -0.1), (0.6, 0.9, 1.1)),
    ((-0.5, 0.0, -0.1), (0.5, 0.9, 0.0)),
    ((-0.5, 0.0, 1.0), (0.5, 0.9, 1.1)),
    ((-0.5, 0.8, 0.0), (0.5, 0.9, 1.0)),
]
RACK: list[Bounds] = [((-0.45, 0.05, 0.4), (0.45, 0.75, 0.5))]
DOOR: list[Bounds] = [((-0.5, -0.05, 0.0), (0.5, 0.0, 1.0))]
BAR: list[Bounds] = [((-0.4, -0.12, 0.4), (0.4, -0.06, 0.6))]
POST: list[Bounds] = [((-0.1, -0.4, 0.0), (0.1, -0.2, 1.0))]


def made(parts: dict[str, list[Bounds]], *joints: sk.Joint) -> sk.Asset:
    mesh = boxes_mesh([bounds for rows in parts.values() for bounds in rows])
    face_part = np.repeat(np.arange(len(parts)), [12 * len(rows) for rows in parts.values()])
    return sk.Asset("thing", mesh, face_part, tuple(sk.Part(name) for name in parts), joints)


def slide(child: str, axis: tuple[float, float, float], travel: float) -> sk.Joint:
    limits = sk.Limits(0.0, travel)
    return sk.Joint(f"{child}_slide", "prismatic", "case", child, axis=axis, limits=limits)


def hinge(degrees: float) -> sk.Joint:
    """At the door's lower left edge in front, upright."""
    limits = sk.Limits(0.0, np.radians(degrees))
    origin, axis = (-0.5, -0.05, 0.0), (0.0, 0.0, -1.0)
    return sk.Joint("door_hinge", "revolute", "case", "door", origin=origin, axis=axis, limits=limits)


RACK_SLIDE = slide("rack", (0, -1, 0), 0.6)
PARTS = {"case": CASE, "rack": RACK, "door": DOOR}


class TestRack:
    def test_behind_a_door_it_keeps_its_range_and_says_so(self) -> None:
        result = Sweep().modify(made(PARTS, RACK_SLIDE, hinge(95)))
        rack = result.joint("rack_slide")
        assert rack.limits == RACK_SLIDE.limits
        assert rack.flags == ()
        assert rack.evidence == ("only when door is open",)
        assert result.joint("door_hinge") == hinge(95)
        assert [(n.stage, n.level, n.text) for n in result.notes] == [
            ("sweep", "info", "rack: only when door is open")
        ]

    def test_what_is_waited_for_is_far_open(self) -> None:
        found = free_ranges(made(PARTS, RACK_SLIDE, hinge(95)), 20, 0)
        assert found["rack_slide"].opened == {"door_hinge": np.radians(95)}
        assert found["rack_slide"].travel == 0.6
        assert found["door_hinge"].opened == {}

    def test_a_door_that_hardly_opens_is_no_way_out(self) -> None:
        """At 10 degrees its edge is 0.17 out: the rack still meets it before half its way."""
        result = FLAGGING.modify(made(PARTS, RACK_SLIDE, hinge(10))).joint("rack_slide")
        assert result.limits is not None
        assert result.limits.upper < 0.3
        assert result.evidence == ()

    def test_a_door_that_is_fixed_is_no_way_out(self) -> None:
        fixed = sk.Joint("door_mount", "fixed", "case", "door")
        result = FLAGGING.modify(made(PARTS, RACK_SLIDE, fixed)).joint("rack_slide")
        assert len(result.flags) == 1
        assert result.limits is not None
        assert result.limits.upper < 0.1

    def test_a_rack_that_would_go_through_the_back_comes_out_of_the_door(self) -> None:
        backwards = slide("rack", (0, 1, 0), 0.6)
        result = Sweep().modify(made(PARTS, backwards, hinge(95))).joint("rack_slide")
        assert result.axis == (0, -1, 0)
        assert result.flags == ()
        assert result.evidence == ("only when door is open",)

    def test_a_rack_that_goes_through_the_back_is_stuck_if_the_door_is(self) -> None:
        backwards = slide("rack", (0, 1, 0), 0.6)
        fixed = sk.Joint("door_mount", "fixed", "case", "door")
        result = Sweep().modify(made(PARTS, backwards, fixed)).joint("rack_slide")
        assert (result.kind, len(result.flags)) == ("fixed", 1)

    def test_a_blocker_that_waits_for_another(self) -> None:
        """A bar before the door has to be lifted first; a flap of 90 degrees down would hit it."""
        parts = PARTS | {"bar": BAR}
        found = free_ranges(made(parts, RACK_SLIDE, hinge(95), slide("bar", (0, 0, 1), 1.0)), 20, 0)
        assert found["bar_slide"].opened == {}
        assert found["door_hinge"].opened == {"bar_slide": 1.0}
        assert found["rack_slide"].opened == {"bar_slide": 1.0, "door_hinge": np.radians(95)}
        assert found["rack_slide"].travel == 0.6

    def test_what_is_half_free_waits_for_nothing(self) -> None:
        """A door 0.4 before the rack stops it after 0.4 + 0.05 of 0.6 m: that is its range."""
        far: list[Bounds] = [((-0.5, -0.45, 0.0), (0.5, -0.4, 1.0))]
        asset = made(PARTS | {"door": far}, RACK_SLIDE, hinge(95))
        result = Sweep().modify(asset).joint("rack_slide")
        assert result.limits is not None
        assert 0.45 - 0.6 / 30 <= result.limits.upper < 0.48
        assert result.evidence == ()


def test_two_that_wait_for_each_other_stay_stuck() -> None:
    """Each has a hook before the other."""
    one: list[Bounds] = [((-0.4, 0.1, 0.0), (-0.1, 0.2, 0.5)), ((0.2, 0.0, 0.0), (0.4, 0.05, 0.5))]
    two: list[Bounds] = [((0.1, 0.1, 0.0), (0.4, 0.2, 0.5)), ((-0.4, 0.0, 0.0), (-0.2, 0.05, 0.5))]
    asset = made(
        {"case": [((-1, 2, 0), (1, 2.1, 1))], "one": one, "two": two},
        slide("one", (0, -1, 0), 0.5),
        slide("two", (0, -1, 0), 0.5),
    )
    found = free_ranges(asset, 20, 0)
    for name in ("one_slide", "two_slide"):
        assert found[name].opened == {}
        assert found[name].travel < 0.1


class TestButton:
    WALL: Bounds = ((-1.0, 0.0, -1.0), (1.0, 0.5, 1.0))

    def pressed(self, travel: float, size: float = 0.05) -> sk.Asset:
        """A button, 4 cm deep, on a wall without a hole."""
        button: Bounds = ((-size, -0.04, -size), (size, 0.0, size))
        return made({"case": [self.WALL], "button": [button]}, slide("button", (0, 1, 0), travel))

    def test_it_sinks_into_its_wall(self) -> None:
        asset = self.pressed(0.03)
        result = Sweep().modify(asset)
        assert result.joints == asset.joints
        assert [note.text for note in result.notes] == ["button: sinks into case, which has no hole for it"]

    @pytest.mark.parametrize(("travel", "size"), [(0.05, 0.05), (0.03, 0.5)])
    def test_not_out_of_sight_and_nothing_large(self, travel: float, size: float) -> None:
        (joint,) = FLAGGING.modify(self.pressed(travel, size)).joints
        assert joint.limits is not None
        assert joint.limits.upper < 0.5 * travel

    def on_a_plate(self, plate: sk.Joint) -> sk.Asset:
        """A button of the wall's, on a plate between ledges that was taken for a part, too."""
        ledges: list[Bounds] = [((-0.5, -0.04, z), (0.5, -0.02, z + 0.1)) for z in (-0.5, 0.4)]
        board: Bounds = ((-0.5, -0.02, -0.5), (0.5, 0.0, 0.5))
        button: Bounds = ((-0.05, -0.06, -0.05), (0.05, -0.02, 0.05))
        parts = {"case": [self.WALL, *ledges], "button": [button], "plate": [board]}
        return made(parts, slide("button", (0, 1, 0), 0.03), plate)

    def test_it_sinks_into_what_is_held_fixed_on_its_wall(self) -> None:
        asset = self.on_a_plate(slide("plate", (0, 1, 0), 0.4))
        button, plate = Sweep().modify(asset).joints
        assert button == asset.joint("button_slide")
        assert (plate.kind, len(plate.flags)) == ("fixed", 1)
        assert [len(joint.flags) for joint in FLAGGING.modify(asset).joints] == [1, 1]

    def test_not_into_what_moves_on_its_wall(self) -> None:
        button, plate = FLAGGING.modify(self.on_a_plate(slide("plate", (1, 0, 0), 0.2))).joints
        assert (len(button.flags), len(plate.flags)) == (1, 0)

    def test_what_is_called_a_touchpad_may_be_large(self) -> None:
        asset = self.pressed(0.1, 0.5)
        named = asset.with_parts({"button": replace(asset.part("button"), label="touchpad")})
        assert Sweep().modify(named).joints == asset.joints

    def test_what_is_called_a_button_goes_as_far_as_it_is_deep(self) -> None:
        asset = self.pressed(0.05)
        named = asset.with_parts({"button": replace(asset.part("button"), label="red_button")})
        (joint,) = Sweep().modify(named).joints
        assert joint.limits is not None
        assert (joint.kind, joint.limits.lower) == ("prismatic", 0.0)
        assert joint.limits.upper == pytest.approx(0.04)

    @pytest.mark.parametrize(
        ("label", "middle", "turns"), [("dial", 0.0, True), ("dial", 0.05, False), ("lid", 0.0, False)]
    )
    def test_a_knob_turns_in_its_wall_about_its_middle(self, label: str, middle: float, turns: bool) -> None:
        limits = sk.Limits(0.0, np.radians(270))
        joint = sk.Joint("turn", "revolute", "case", "knob", (middle, 0, 0), (0, 1, 0), limits)
        knob: Bounds = ((-0.05, -0.04, -0.02), (0.05, 0.3, 0.02))
        tight: list[Bounds] = [  # a wall with a hole just as wide as the knob
            ((-1.0, 0.0, -1.0), (-0.052, 0.5, 1.0)),
            ((0.052, 0.0, -1.0), (1.0, 0.5, 1.0)),
            ((-0.052, 0.0, -1.0), (0.052, 0.5, -0.022)),
            ((-0.052, 0.0, 0.022), (0.052, 0.5, 1.0)),
        ]
        asset = made({"case": tight, "knob": [knob]}, joint)
        named = asset.with_parts({"knob": replace(asset.part("knob"), label=label)})
        assert (Sweep().modify(named).joints == (joint,)) == turns

    @pytest.mark.parametrize(("degrees", "sinks"), [(20, True), (60, False)])
    def test_a_trigger_turns_into_its_grip_by_little(self, degrees: float, sinks: bool) -> None:
        limits = sk.Limits(0.0, np.radians(degrees))
        joint = sk.Joint("pull", "revolute", "case", "trigger", (0, -0.1, 0.1), (1, 0, 0), limits)
        trigger: Bounds = ((-0.05, -0.2, -0.2), (0.05, 0.0, 0.1))
        asset = made({"case": [self.WALL], "trigger": [trigger]}, joint)
        assert (Sweep().modify(asset).joints == (joint,)) == sinks

    def test_what_it_meets_besides_stops_it(self) -> None:
        asset = self.pressed(0.03)
        key: Bounds = ((-0.04, 0.005, -0.04), (0.04, 0.03, 0.04))
        mount = sk.Joint("mount", "fixed", "case", "key")
        parts: dict[str, list[Bounds]] = {
            "case": [self.WALL],
            "button": [((-0.05, -0.04, -0.05), (0.05, 0.0, 0.05))],
            "key": [key],
        }
        (joint,) = (j for j in Sweep().modify(made(parts, *asset.joints, mount)).joints if j.name != "mount")
        assert len(joint.flags) == 1
