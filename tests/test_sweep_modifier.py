"""Modifier `sweep`: ranges end where surfaces meet, and what is stuck is told."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from simart_kit_plugins.modifiers.sweep import Sweep

import simart_kit as sk
from simart_kit.asset import JointKind
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset

Bounds = tuple[Sequence[float], Sequence[float]]

POST: Bounds = ((-0.2, 0.0, 0.0), (-0.01, 0.3, 1.0))
# 1 wide and 0.02 thick; hinged at the origin it opens towards -y.
DOOR: Bounds = ((0.0, 0.0, 0.0), (1.0, 0.02, 1.0))
FRAME: Bounds = ((0.5, 0.03, 0.0), (1.2, 0.3, 1.0))  # close behind the door
FAR: Bounds = ((5, 5, 0), (5.1, 5.1, 0.1))


def wall(distance: float) -> Bounds:
    """Before the door, parallel to it when closed: met at the angle whose sine is the distance."""
    return (-1.0, -distance - 0.1, -0.5), (2.0, -distance, 1.5)


def assembled(joint: sk.Joint, moving: Sequence[Bounds], still: Sequence[Bounds]) -> sk.Asset:
    mesh = boxes_mesh([*still, *moving])
    face_part = np.repeat([0, 1], [12 * len(still), 12 * len(moving)])
    return sk.Asset("thing", mesh, face_part, (sk.Part("body"), sk.Part("door")), (joint,))


def hinge(lower: float, upper: float, **more: Any) -> sk.Joint:
    limits = sk.Limits(np.radians(lower), np.radians(upper))
    return sk.Joint("hinge", "revolute", "body", "door", axis=(0, 0, -1), limits=limits, **more)


def slide(lower: float, upper: float) -> sk.Joint:
    return sk.Joint("slide", "prismatic", "body", "door", axis=(0, -1, 0), limits=sk.Limits(lower, upper))


def test_a_free_joint_keeps_its_range_without_a_word() -> None:
    asset = assembled(hinge(0, 90), [DOOR], [POST])
    result = Sweep().modify(asset)
    assert result.joints == asset.joints
    assert result.notes == ()


def test_a_hinge_ends_at_the_wall() -> None:
    """Sine 0.5 is 30 degrees; three of a hundred points of the door pass by 31.1, and steps are of 1."""
    asset = assembled(hinge(0, 90), [DOOR], [POST, wall(0.5)])
    result = Sweep(Sweep.Options(steps=90)).modify(asset)
    limits = result.joint("hinge").limits
    assert limits is not None
    assert limits.lower == 0.0
    assert 30.0 <= np.degrees(limits.upper) <= 32.1
    assert result.joint("hinge").flags == ()
    (note,) = result.notes
    assert (note.stage, note.level) == ("sweep", "info")
    assert note.text.startswith("hinge: 0 degrees .. 90 degrees shortened to 0 degrees .. 3")


def test_a_slide_ends_at_the_wall() -> None:
    asset = assembled(slide(0.0, 0.5), [DOOR], [POST, wall(0.4)])
    result = Sweep(Sweep.Options(steps=100)).modify(asset)
    limits = result.joint("slide").limits
    assert limits is not None
    assert 0.4 <= limits.upper <= 0.4 + 0.003 * np.sqrt(2) + 0.5 / 100
    (note,) = result.notes
    assert note.text.startswith("slide: 0.000 m .. 0.500 m shortened to 0.000 m .. 0.4")


def test_each_side_of_the_range_is_looked_at() -> None:
    """A frame close behind the door stops it on the way in, the wall on the way out."""
    asset = assembled(hinge(-45, 90), [DOOR], [POST, FRAME, wall(np.sin(np.radians(60)))])
    limits = Sweep(Sweep.Options(steps=90)).modify(asset).joint("hinge").limits
    assert limits is not None
    assert -3.0 < np.degrees(limits.lower) <= 0.0
    assert 60.0 <= np.degrees(limits.upper) <= 65.0


def test_the_range_ends_at_a_step() -> None:
    asset = assembled(hinge(0, 90), [DOOR], [POST, wall(0.5)])
    limits = Sweep(Sweep.Options(steps=9)).modify(asset).joint("hinge").limits
    assert limits is not None
    assert np.degrees(limits.upper) == pytest.approx(30.0)


class TestStuck:
    def asset(self, **more: Any) -> sk.Asset:
        """A wall 0.1 before the door: 6 of 90 degrees; and a frame behind it."""
        return assembled(hinge(0, 90, **more), [DOOR], [POST, FRAME, wall(0.1)])

    def test_it_goes_no_farther_than_is_free_and_is_flagged(self) -> None:
        asset = self.asset()
        result = Sweep(Sweep.Options(stuck="flag")).modify(asset).joint("hinge")
        assert result.limits is not None
        assert result.limits.lower == 0.0
        assert 5.0 <= np.degrees(result.limits.upper) <= 9.0
        (flag,) = result.flags
        assert flag.startswith("sweep: revolute blocked after ")
        assert flag.endswith(" degrees of 0 degrees .. 90 degrees")
        assert replace(result, flags=(), limits=asset.joint("hinge").limits) == asset.joint("hinge")

    def test_unless_asked_otherwise_it_is_held_fixed_and_keeps_its_flag(self) -> None:
        result = Sweep().modify(self.asset()).joint("hinge")
        assert (result.kind, result.limits) == ("fixed", None)
        assert result.flags[0].startswith("sweep: revolute blocked after ")

    def test_a_warning_says_so(self) -> None:
        (note,) = Sweep().modify(self.asset()).notes
        assert (note.stage, note.level) == ("sweep", "warning")
        assert note.text.startswith("hinge is blocked after ")
        assert note.text.endswith("held fixed: its axis may be wrong, look at it")

    def test_earlier_flags_stay(self) -> None:
        assert Sweep().modify(self.asset(flags=("doubtful",))).joint("hinge").flags[0] == "doubtful"

    def test_what_counts_as_stuck_can_be_set(self) -> None:
        joint = Sweep(Sweep.Options(least=0.02)).modify(self.asset()).joint("hinge")
        assert joint.flags == ()
        assert joint.limits is not None
        assert joint.limits.upper < np.radians(10)


class TestTheOtherWay:
    def test_a_hinge_that_is_free_the_other_way_turns_so(self) -> None:
        asset = assembled(hinge(0, 70), [DOOR], [POST, wall(0.1)])
        result = Sweep().modify(asset)
        joint = result.joint("hinge")
        assert joint == replace(asset.joint("hinge"), axis=(0.0, 0.0, 1.0))
        assert [(note.level, note.text) for note in result.notes] == [
            ("info", "hinge: blocked at once, opens the other way")
        ]

    def test_not_if_it_goes_half_as_far_that_way_already(self) -> None:
        asset = assembled(hinge(-45, 90), [DOOR], [POST, FRAME, wall(0.1)])
        assert Sweep().modify(asset).joint("hinge").kind == "fixed"

    def test_not_if_it_hardly_comes_farther_there(self) -> None:
        asset = assembled(hinge(0, 90), [DOOR], [POST, wall(0.1), ((0.5, 0.2, 0.0), (1.2, 0.3, 1.0))])
        assert Sweep().modify(asset).joint("hinge").kind == "fixed"

    def test_what_was_given_no_way_has_no_other_one(self) -> None:
        asset = assembled(hinge(0, 0), [DOOR], [POST])
        assert [note.level for note in Sweep().modify(asset).notes] == ["warning"]

    def test_what_slides_does_so_as_well_if_it_is_no_button(self) -> None:
        asset = assembled(slide(0.0, 0.5), [DOOR], [POST, wall(0.01)])
        joint = Sweep().modify(asset).joint("slide")
        assert joint == replace(asset.joint("slide"), axis=(0.0, 1.0, 0.0))

    def test_a_button_that_does_not_go_in_does_not_come_out(self) -> None:
        button: Bounds = ((0.0, 0.0, 0.0), (0.1, 0.1, 0.1))
        asset = assembled(slide(0.0, 0.5), [button], [POST, wall(0.01)])
        assert Sweep().modify(asset).joint("slide").kind == "fixed"


class TestOnOnePin:
    """A magazine under a cover, as of a stapler, both hinged on a line along x at the back; -x lifts them."""

    BASE: Bounds = ((0.0, -1.0, 0.0), (0.3, 0.1, 0.1))
    MAGAZINE: Bounds = ((0.0, -1.0, 0.1), (0.3, 0.1, 0.2))
    COVER: Bounds = ((0.0, -1.0, 0.2), (0.3, 0.1, 0.3))
    SHELF: Bounds = ((0.35, -1.0, 0.2), (0.6, 0.1, 0.3))  # of the base, beside the cover
    PIN = (0.0, 0.1, 0.1)

    def stapler(self, cover: tuple[float, float, float] = PIN, magazine: Bounds = MAGAZINE) -> sk.Asset:
        """The cover turns about a line through this point, not so far that the magazine could wait for it."""
        joints = [
            sk.Joint(f"{name}_hinge", "revolute", "base", name, origin, (-1, 0, 0), sk.Limits(0.0, most))
            for name, origin, most in (("magazine", self.PIN, 1.0), ("cover", cover, 0.4))
        ]
        mesh = boxes_mesh([self.BASE, self.SHELF, magazine, self.COVER])
        face_part = np.repeat([0, 1, 2], [24, 12, 12])
        parts = tuple(map(sk.Part, ("base", "magazine", "cover")))
        return sk.Asset("stapler", mesh, face_part, parts, tuple(joints))

    def test_what_holds_a_part_down_goes_along_with_it(self) -> None:
        asset = self.stapler()
        result = Sweep().modify(asset)
        assert result.joint("magazine_hinge") == asset.joint("magazine_hinge")
        assert result.joint("cover_hinge") == replace(asset.joint("cover_hinge"), parent="magazine")
        assert [(n.level, n.text) for n in result.notes] == [
            ("info", "cover: on one pin with magazine, goes along with it")
        ]

    def test_not_if_it_turns_about_another_line(self) -> None:
        asset = self.stapler(cover=(0.0, 0.1, 0.3))
        result = Sweep().modify(asset)
        assert result.joint("cover_hinge") == asset.joint("cover_hinge")
        assert result.joint("magazine_hinge").kind == "fixed"

    def test_not_if_that_frees_nothing(self) -> None:
        """A magazine that reaches below the shelf stays down without the cover."""
        asset = self.stapler(magazine=((0.0, -1.0, 0.1), (0.6, 0.1, 0.2)))
        result = Sweep().modify(asset)
        assert result.joint("cover_hinge") == asset.joint("cover_hinge")
        assert result.joint("magazine_hinge").kind == "fixed"


def test_a_joint_that_was_given_no_way_is_held_fixed() -> None:
    result = Sweep().modify(assembled(slide(0, 0), [DOOR], [POST]))
    assert result.joint("slide").kind == "fixed"
    assert "sweep: prismatic blocked after 0 mm" in result.joint("slide").flags[0]


def test_a_way_of_less_than_a_tenth_of_a_millimetre_is_none() -> None:
    little, none = (assembled(slide(0, way), [DOOR], [POST]) for way in (2e-4, 5e-5))
    assert Sweep().modify(little).joint("slide").kind == "prismatic"
    result = Sweep().modify(none).joint("slide")
    assert result.kind == "fixed"
    assert "blocked after 0.05 mm of 0 mm .. 0.05 mm" in result.flags[0]


def test_what_a_part_carries_meets_walls_for_it() -> None:
    """A block, 0.4 deep, at the door's edge: sin + 0.4 cos is 0.5 at 5.9 degrees, the door's alone at 30."""
    block: Bounds = ((0.8, -0.4, 0.0), (1.0, 0.0, 1.0))
    parts = tuple(sk.Part(n) for n in ("body", "door", "block"))
    mount = sk.Joint("mount", "fixed", "door", "block")
    mesh = boxes_mesh([POST, wall(0.5), DOOR, block])
    asset = sk.Asset("thing", mesh, np.repeat([0, 1, 2], [24, 12, 12]), parts, (mount, hinge(0, 20)))
    limits = Sweep(Sweep.Options(steps=80)).modify(asset).joint("hinge").limits
    assert limits is not None
    assert 5.75 <= np.degrees(limits.upper) <= 7.5


def test_what_hangs_on_the_door_does_not_block_it() -> None:
    """The handle lies against the door; were it part of what stands still, the door could not open."""
    handle: Bounds = ((0.4, -0.1, 0.3), (0.5, 0.0, 0.7))
    parts = tuple(sk.Part(n) for n in ("body", "door", "handle"))
    mount = sk.Joint("mount", "fixed", "door", "handle")
    mesh = boxes_mesh([POST, DOOR, handle])
    asset = sk.Asset("thing", mesh, np.repeat([0, 1, 2], 12), parts, (mount, hinge(0, 90)))
    assert Sweep().modify(asset).joints == asset.joints


@pytest.mark.parametrize("kind", ["fixed", "continuous", "ball", "free"])
def test_joints_without_limits_are_left_alone(kind: JointKind) -> None:
    asset = assembled(sk.Joint("joint", kind, "body", "door"), [DOOR], [POST, wall(0.1)])
    result = Sweep().modify(asset)
    assert result.joints == asset.joints
    assert result.notes == ()


def test_the_cabinet_is_free() -> None:
    asset = cabinet_asset()
    assert Sweep().modify(asset).joints == asset.joints


@pytest.mark.parametrize("wrong", [{"steps": 1}, {"steps": 2.5}, {"least": 1.5}, {"least": -0.1}])
def test_senseless_options_are_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Sweep.Options(**wrong)
