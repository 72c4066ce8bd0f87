"""Kinematic states: poses within limits, and joints that count from them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from simart_kit_plugins.simart.dataset.generated import GeneratedJob
from simart_kit_plugins.simart.dataset.source_object import UnusableError, check_usable
from simart_kit_plugins.simart.dataset.states import in_state, posed, state_count

from simart_kit.bench.articulation import Link, LinkJoint
from simart_kit.kinematics import rest_to_posed

from .dataset_objects import boxed, chest


def test_a_moved_joint_has_the_rest_of_its_travel_left_and_its_child_goes_along() -> None:
    made = chest()
    moved = posed(made.asset, {"drawer_joint": 0.3, "knob_joint": math.pi / 4})
    drawer, knob = moved.joint("drawer_joint"), moved.joint("knob_joint")
    assert drawer.limits is not None
    assert knob.limits is not None
    assert (drawer.limits.lower, drawer.limits.upper) == pytest.approx((-0.3, 0.1))
    assert (knob.limits.lower, knob.limits.upper) == pytest.approx((-3 * math.pi / 4, math.pi / 4))
    # The object is centred on its own box, y -0.55..0.6, so the knob's origin of y -0.5 is at -0.525 at rest.
    assert made.asset.joint("knob_joint").origin == pytest.approx((0.0, -0.525, 0.5))
    assert knob.origin == pytest.approx((0.0, -0.825, 0.5))
    assert knob.axis == pytest.approx((0.0, 1.0, 0.0))


def test_positions_of_a_state_are_those_of_the_source_less_what_is_spent() -> None:
    made = chest()
    spent = {"drawer_joint": 0.25, "knob_joint": 0.5}
    again = posed(made.asset, spent)
    further = rest_to_posed(again, {"drawer_joint": 0.1, "knob_joint": -0.2})["knob"]
    whole = rest_to_posed(made.asset, {"drawer_joint": 0.35, "knob_joint": 0.3})["knob"]
    before = rest_to_posed(made.asset, spent)["knob"]
    assert further @ before == pytest.approx(whole, abs=1e-12)


def test_states_lie_within_the_limits_and_differ() -> None:
    made = chest()
    states = [in_state(made, state, seed=4).asset for state in range(1, 20)]
    travels = [asset.joint("drawer_joint").limits for asset in states]
    spent = [-limits.lower for limits in travels if limits is not None]
    assert all(0.0 <= value <= 0.4 for value in spent)
    assert all(limits.upper - limits.lower == pytest.approx(0.4) for limits in travels if limits is not None)
    assert max(spent) - min(spent) > 0.2
    lows = [asset.mesh.bounds[0, 1] for asset in states]
    rest = made.asset.mesh.bounds[0, 1]
    # The knob is the foremost; as a box of 0.1 x 0.05 x 0.1 that turns about y it stays as deep as it is.
    assert [rest - low for low in lows] == pytest.approx(spent, abs=1e-9)


def test_state_0_is_the_source_and_a_seed_decides_the_others() -> None:
    made = chest()
    assert in_state(made, 0, seed=1) is made
    one, same, other = (in_state(made, 3, seed).asset.mesh.vertices for seed in (1, 1, 2))
    assert np.array_equal(one, same)
    assert not np.array_equal(one, other)


def test_only_objects_with_something_to_move_have_states() -> None:
    block = boxed([(Link("body"), (0, 0, 0), (1, 1, 1))])
    loose = boxed(
        [(Link("pot"), (0, 0, 0), (1, 1, 1)), (Link("lid", 0, LinkJoint("free")), (0, 0, 1), (1, 1, 1.1))]
    )
    assert [state_count(made, 20) for made in (chest(), block, loose)] == [20, 1, 1]


def test_every_kind_of_joint_can_be_posed() -> None:
    made = [GeneratedJob(name, 0, 0).make() for name in ("clamp", "fan", "teapot")]
    kinds = {joint.kind for one in made for joint in in_state(one, 1, 0).joints}
    assert {"revolute", "prismatic", "continuous", "ball", "free"} <= kinds


@pytest.mark.parametrize(
    ("joint", "reason"),
    [
        (LinkJoint("unknown"), "a joint of unknown kind"),
        (LinkJoint("revolute", (0, 0, 1), None, 0.0, 1.0), "a joint without a place"),
        (LinkJoint("revolute", (0, 0, 1), (0, 0, 0)), "a joint without limits"),
        (LinkJoint("prismatic", (0, 0, 1), (0, 0, 0), 0.5, -0.5), "a joint with reversed limits"),
    ],
)
def test_a_truth_that_leaves_open_how_a_part_moves_is_not_used(joint: LinkJoint, reason: str) -> None:
    with pytest.raises(UnusableError) as caught:
        boxed([(Link("body"), (0, 0, 0), (1, 1, 1)), (Link("door", 0, joint), (0, -0.1, 0), (1, 0, 1))])
    assert caught.value.reason == reason


def test_objects_of_too_many_parts_or_no_sensible_size_are_not_used() -> None:
    with pytest.raises(UnusableError, match="too many parts: test-boxes has 3, allowed are 2"):
        check_usable(chest(), max_parts=2)
    huge = boxed([(Link("body"), (0, 0, 0), (1e5, 1, 1))])
    with pytest.raises(UnusableError, match=r"absurd size: test-boxes is 1e\+05 m across"):
        check_usable(huge, max_parts=2)
    assert check_usable(chest(), max_parts=3).key == "test-boxes"


def test_limits_that_leave_out_the_pose_of_the_file_are_extended_to_it() -> None:
    slide = LinkJoint("prismatic", (0, -1, 0), (0, 0, 0), 0.1, 0.4)
    made = boxed([(Link("body"), (0, 0, 0), (1, 1, 1)), (Link("drawer", 0, slide), (0, -0.1, 0), (1, 0, 1))])
    limits = made.joints[0].limits
    assert limits is not None
    assert (limits.lower, limits.upper) == (0.0, 0.4)
