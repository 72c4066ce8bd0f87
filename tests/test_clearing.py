"""Ranges end where collision shapes meet, and what they block is held fixed."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from simart_kit_plugins.modifiers.clear import Clear

import simart_kit as sk
from simart_kit.clearing import cleared
from simart_kit.fitting import aligned_box
from simart_kit.testing.meshes import boxes_mesh

Bounds = tuple[Sequence[float], Sequence[float]]
BASE: Bounds = ((0, 0, 0), (1, 0.5, 0.1))
DRAWER: Bounds = ((0.1, 0.0, 0.2), (0.5, 0.4, 0.3))


def slide(child: str, upper: float, axis: tuple[float, float, float] = (0, -1, 0)) -> sk.Joint:
    return sk.Joint(f"{child}_slide", "prismatic", "base", child, axis=axis, limits=sk.Limits(0.0, upper))


def assembled(joints: Sequence[sk.Joint], **parts: Bounds) -> sk.Asset:
    """An asset of boxes, each with its own shape."""
    bounds = {"base": BASE, **parts}
    shapes = {n: aligned_box(np.array(b[0], float), np.array(b[1], float)) for n, b in bounds.items()}
    made = tuple(sk.Part(name, collision=(shape,)) for name, shape in shapes.items())
    return sk.Asset(
        "thing", boxes_mesh(list(bounds.values())), np.repeat(range(len(bounds)), 12), made, tuple(joints)
    )


def wall(distance: float) -> Bounds:
    """Before the drawer, at a distance from its front."""
    return (0.0, -distance - 0.1, 0.15), (1.0, -distance, 0.5)


def fixed(child: str, parent: str = "base") -> sk.Joint:
    return sk.Joint(f"{child}_fixed", "fixed", parent, child)


def door(upper: float) -> sk.Joint:
    """Hung at the left of a wall that begins at y = -0.01, opening away from the drawer."""
    limits = sk.Limits(0.0, upper)
    return sk.Joint("wall_hinge", "revolute", "base", "wall", (0, -0.11, 0), (0, 0, -1), limits)


def test_what_is_free_stays_without_a_word() -> None:
    asset = assembled([slide("drawer", 0.3)], drawer=DRAWER)
    result = Clear().modify(asset)
    assert result.joints == asset.joints
    assert result.notes == ()


def test_a_slide_ends_before_a_shape_that_stands_still() -> None:
    """The wall moves, so it is not the drawer's own base, but without limits: it is never out of the way."""
    turning = sk.Joint("wall_spin", "continuous", "base", "wall", (5, 5, 0), (0, 0, 1))
    asset = assembled([slide("drawer", 0.3), turning], drawer=DRAWER, wall=wall(0.2))
    limits = Clear(Clear.Options(least=0.0)).modify(asset).joint("drawer_slide").limits
    assert limits is not None
    assert limits.upper == pytest.approx(0.2, abs=0.3 / 30 + 1e-6)
    assert limits.upper <= 0.2 + 1e-4


def test_what_a_door_takes_out_of_the_way_is_no_obstacle() -> None:
    asset = assembled([slide("drawer", 0.3), door(np.pi / 2)], drawer=DRAWER, wall=wall(0.01))
    assert cleared(asset, 0.25, 0.9) == (asset, {})


def test_what_hardly_moves_is_held_fixed_flagged_and_told() -> None:
    """Two drawers face each other across 2 cm, and one of them goes up by a millimetre only."""
    facing: Bounds = ((0.1, -0.42, 0.2), (0.5, -0.02, 0.3))
    joints = [slide("drawer", 0.3), slide("other", 0.001, (0, 0, 1))]
    doubtful = [replace(joint, confidence=0.6) for joint in joints]
    result = Clear().modify(assembled(doubtful, drawer=DRAWER, other=facing))
    joint = result.joint("drawer_slide")
    assert joint.kind == "fixed"
    assert joint.flags[0].startswith("clear: prismatic 0.000 m .. 0.300 m, collision shapes leave 0.000 m")
    assert result.joint("other_slide").kind == "prismatic"
    (note,) = result.notes
    assert (note.stage, note.level) == ("clear", "warning")


def test_a_rack_that_waits_for_a_door_whose_lip_grazes_it_keeps_its_joint_as_the_door_does() -> None:
    """The corner of the lip swings 3.6 mm into the rack, less than what surfaces may graze each other."""
    rack: Bounds = ((0.3005, 0.0, 0.2), (0.9, 0.4, 0.3))
    leaf: Bounds = ((0.0, -0.02, 0.15), (1.0, -0.001, 0.5))
    lip: Bounds = ((0.0, 0.0, 0.15), (0.3, 0.05, 0.5))
    hinge = sk.Joint("leaf_hinge", "revolute", "base", "leaf", (0, 0, 0), (0, 0, -1), sk.Limits(0.0, 1.5))
    joints = [hinge, fixed("lip", "leaf"), replace(slide("rack", 0.3), confidence=0.7)]
    asset = assembled(joints, leaf=leaf, lip=lip, rack=rack)
    assert Clear().modify(asset).joints == asset.joints


def test_a_joint_that_is_sure_is_not_held_fixed_by_coarse_shapes() -> None:
    facing: Bounds = ((0.1, -0.42, 0.2), (0.5, -0.02, 0.3))
    asset = assembled([slide("drawer", 0.3), slide("other", 0.001, (0, 0, 1))], drawer=DRAWER, other=facing)
    result = Clear().modify(asset)
    assert result.joints == asset.joints
    (note,) = result.notes
    assert note.level == "warning"
    assert note.text.startswith("drawer_slide is blocked by collision shapes")


def test_a_part_fixed_to_the_base_is_no_more_in_the_way_than_the_base() -> None:
    joints = [slide("drawer", 0.3), fixed("wall")]
    assert cleared(assembled(joints, drawer=DRAWER, wall=wall(0.2)), 0.25, 0.9)[1] == {}


def test_what_cannot_turn_round_turns_between_limits() -> None:
    """An arm of 0.5 m along +x about z; a post at +y stops it short of a quarter turn, and of three."""
    arm: Bounds = ((-0.02, -0.02, 1.0), (0.5, 0.02, 1.04))
    post: Bounds = ((-0.02, 0.3, 0.9), (0.02, 0.34, 1.1))
    joints = [
        sk.Joint("arm_spin", "continuous", "base", "arm", (0, 0, 0), (0, 0, 1)),
        sk.Joint("post_slide", "prismatic", "base", "post", axis=(0, 0, 1), limits=sk.Limits(0, 0.05)),
    ]
    asset = assembled(joints, arm=arm, post=post)
    joint = cleared(asset, 0.25, 0.9)[0].joint("arm_spin")
    assert joint.kind == "revolute"
    assert joint.limits is not None
    # Half widths of arm and post together, seen from 0.3 m away, are 8 degrees; steps are of 6.
    assert 70 <= np.degrees(joint.limits.upper) <= 83
    assert joint.limits.lower == pytest.approx(-np.pi)


def test_a_joint_without_travel_stays_as_it_is() -> None:
    """`sweep` leaves such where `stuck` is "flag"."""
    asset = assembled([slide("drawer", 0.3), slide("lock", 0.0)], drawer=DRAWER, lock=wall(0.4))
    assert Clear().modify(asset).joints == asset.joints


def test_parts_without_shapes_are_left_alone() -> None:
    asset = assembled([slide("drawer", 0.3)], drawer=DRAWER)
    bare = asset.with_parts({"drawer": sk.Part("drawer")})
    assert cleared(bare, 0.25, 0.9) == (bare, {})
