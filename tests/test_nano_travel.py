"""Joints for which the network says no travel get what is usual; all others stay as they are."""

import numpy as np
import pytest
from simart_kit_plugins.nano.proposals import Proposal
from simart_kit_plugins.nano.travel import with_travel

import simart_kit as sk
from simart_kit.testing.meshes import boxes_mesh

BODY = ((0, 0, 0), (1, 1, 1))
BUTTON = ((0.4, -0.04, 0.4), (0.5, 0.0, 0.5))  # before the front, at -y
DRAWER = ((0.1, -0.02, 0.1), (0.9, 0.8, 0.3))


def limits_of(box, kind, axis, limits, label="", beside=()):
    mesh = boxes_mesh([BODY, *beside, box])
    joint = sk.Joint("j", kind, "body", "part", (0, 0, 0), axis, limits and sk.Limits(*limits))
    own = np.arange(len(mesh.faces)) >= len(mesh.faces) - 12
    proposal = Proposal(own, sk.PartGuess("part", label=label), joint, None)
    (found,) = with_travel(mesh, [proposal])
    return found.joint.limits and (found.joint.limits.lower, found.joint.limits.upper)


@pytest.mark.parametrize(("y", "expected"), [(1, (0.0, 0.02)), (-1, (-0.02, 0.0))])
def test_a_small_thing_is_pressed_in_by_half_its_depth(y, expected):
    assert limits_of(BUTTON, "prismatic", (0, y, 0), (0.0, 0.0)) == pytest.approx(expected)


@pytest.mark.parametrize(("y", "expected"), [(1, (-0.41, 0.0)), (-1, (0.0, 0.41))])
def test_a_large_thing_is_pulled_out_by_half_its_depth(y, expected):
    assert limits_of(DRAWER, "prismatic", (0, y, 0), (0.0, 0.01)) == pytest.approx(expected)


@pytest.mark.parametrize(("y", "expected"), [(1, (0.0, 0.008)), (-1, (-0.008, 0.0))])
@pytest.mark.parametrize("limits", [(-0.003, 0.008), (-0.008, 0.0), (0.0, 0.008)])
def test_a_button_goes_in_and_not_out(y, expected, limits):
    assert limits_of(BUTTON, "prismatic", (0, y, 0), limits, "button") == pytest.approx(expected)


@pytest.mark.parametrize(("y", "expected"), [(1, (0.0, 0.008)), (-1, (-0.008, 0.0))])
def test_a_button_goes_into_what_is_behind_it_wherever_that_is_on_the_object(y, expected):
    bowl = ((0, -2.0, 0), (1, -1.0, 0.3))  # before the front that the button is on, and below it
    found = limits_of(BUTTON, "prismatic", (0, y, 0), (-0.008, 0.008), "button", [bowl])
    assert found == pytest.approx(expected)


def test_what_is_called_a_button_and_is_large_goes_where_it_goes():
    assert limits_of(DRAWER, "prismatic", (0, 1, 0), (-0.3, 0.1), "button") == (-0.3, 0.1)


def test_what_does_not_turn_turns_by_a_quarter():
    assert limits_of(DRAWER, "revolute", (0, 0, 1), (0.0, 0.0)) == pytest.approx((0.0, np.pi / 2))


@pytest.mark.parametrize(
    ("kind", "limits"),
    [
        ("prismatic", (0.0, 0.01)),
        ("prismatic", (-0.005, 0.0)),
        ("revolute", (-0.1, 0.0)),
        ("continuous", None),
    ],
)
def test_what_has_travel_keeps_it(kind, limits):
    assert limits_of(BUTTON, kind, (0, 1, 0), limits) == limits
