"""Where a joint candidate takes its part, by which the network tells the two senses of an axis apart."""

import numpy as np
import pytest
from simart_kit_plugins.nano.candidates import EDGE, SLIDE, Candidates
from simart_kit_plugins.nano.ways import WAY_NUMBERS, ways

UP, OUTWARD, FROM_REST, FROM_BESIDE, TO_GRIP = range(WAY_NUMBERS)
# A door at -y of a body that is open there, and of a post that stands before it, farther off.
DOOR = np.array([[x, y, z] for x in (-0.3, 0.3) for y in (-0.32, -0.3) for z in (-0.3, 0.3)])
BODY = np.array([[x, y, z] for x in (-0.3, 0.3) for y in (-0.29, 0.3) for z in (-0.3, 0.3)])
HANDLE = np.array([0.25, -0.36, 0.0])


def told(axis, origin, source=EDGE, rest=BODY, grip=HANDLE):
    found = Candidates(
        np.array([axis], dtype=float),
        np.array([origin], dtype=float),
        np.array([source]),
        np.zeros(1, dtype=int),
        np.zeros(1),
    )
    (numbers,) = ways(found, DOOR, rest, np.array(grip))
    return numbers


def test_a_door_that_opens_goes_outward_away_from_its_body_and_to_the_side_of_its_handle():
    opening = told((0, 0, -1), (-0.3, -0.31, 0))
    assert opening[UP] == 0
    assert (opening[[OUTWARD, FROM_REST, FROM_BESIDE]] > 0.9).all()
    # The handle is 0.05 before the middle of the leaf, of 0.2 of its size that count as far out.
    assert opening[TO_GRIP] == pytest.approx(0.05 / (0.2 * 0.6))


def test_a_slide_has_the_way_of_its_axis():
    assert told((0, 0, 1), (0, 0, 0), SLIDE)[UP] == 1
    pulled = told((0, -1, 0), (0, 0, 0), SLIDE)
    assert pulled[UP] == 0
    assert (pulled[[OUTWARD, FROM_REST, FROM_BESIDE, TO_GRIP]] > 0.4).all()


@pytest.mark.parametrize("source", [SLIDE, EDGE])
def test_the_other_sense_of_an_axis_goes_the_other_way(source):
    axis, origin = np.array([0.36, -0.48, 0.8]), (-0.3, -0.2, 0.1)
    one = told(axis, origin, source)
    assert (one != 0).all()
    assert np.allclose(told(-axis, origin, source), -one)


def test_a_turn_about_the_middle_of_a_part_takes_it_nowhere():
    assert np.allclose(told((0, 0, 1), (0, -0.31, 0)), 0)


def test_what_is_far_off_counts_less_than_what_is_beside_the_part():
    post = np.array([[0.0, -0.9, z] for z in (-0.3, 0.3)])
    opening = told((0, 0, -1), (-0.3, -0.31, 0), rest=np.concatenate([BODY, *[post] * 4]))
    assert opening[FROM_REST] < 0 < opening[FROM_BESIDE]


def test_a_part_alone_and_without_a_grip_has_only_the_middle_of_the_object_to_go_away_from():
    alone = told((0, 0, -1), (-0.3, -0.31, 0), rest=BODY[:0], grip=(0, -0.31, 0))
    assert np.allclose(alone[[FROM_REST, FROM_BESIDE, TO_GRIP]], 0)
    assert alone[OUTWARD] > 0.9
