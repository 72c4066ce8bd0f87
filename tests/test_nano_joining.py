"""Pieces of one thing that slides, proposed as several."""

from dataclasses import replace

import numpy as np
import pytest
from simart_kit_plugins.nano.joining import joined
from simart_kit_plugins.nano.proposals import Proposal

from simart_kit import Joint, Limits, PartGuess
from simart_kit.testing.meshes import boxes_mesh

from .furniture import box

# A body, the box of a drawer, its front, a knob on that, and the front of another drawer below.
BOXES = [
    box((0.0, 1.0), (0.5, 0.6), (0.0, 1.0)),
    box((0.1, 0.9), (0.0, 0.45), (0.55, 0.9)),
    box((0.05, 0.95), (-0.02, -0.001), (0.51, 0.95)),
    box((0.45, 0.55), (-0.06, -0.021), (0.7, 0.75)),
    box((0.05, 0.95), (-0.02, -0.001), (0.05, 0.49)),
]
MESH = boxes_mesh(BOXES)
PIECE = np.repeat(np.arange(len(BOXES)), 12)
OUT = (0.0, -1.0, 0.0)


def slide(piece, label="drawer", axis=OUT, parent=None, kind="prismatic"):
    joint = Joint("j", kind, "body", "part", axis=axis, limits=Limits(0.0, 0.4))
    return Proposal(np.isin(PIECE, [piece]), PartGuess(label, label=label), joint, parent)


def pieces(proposals):
    return [np.unique(PIECE[proposal.faces]).tolist() for proposal in proposals]


def test_what_stops_another_at_once_and_slides_as_it_does_is_one_with_it():
    for order in ((1, 2), (2, 1)):
        (found,) = joined(MESH, [slide(piece) for piece in order])
        assert pieces([found]) == [[1, 2]]
        assert found.parent is None


def test_of_several_all_are_one_and_the_largest_gives_its_joint():
    largest = slide(1)
    largest = replace(largest, joint=replace(largest.joint, limits=Limits(0.0, 0.35)))
    (found,) = joined(MESH, [slide(3), slide(2), largest])
    assert pieces([found]) == [[1, 2, 3]]
    assert found.joint == largest.joint


def test_drawers_that_pass_each_other_stay_two():
    assert pieces(joined(MESH, [slide(2), slide(4)])) == [[2], [4]]


@pytest.mark.parametrize(
    "other",
    [
        slide(2, label="rack"),
        slide(2, axis=(1.0, 0.0, 0.0)),
        slide(2, kind="revolute"),
    ],
    ids=["called otherwise", "along another axis", "of another kind"],
)
def test_what_moves_otherwise_stays_apart(other):
    assert pieces(joined(MESH, [slide(1), other])) == [[1], [2]]


def test_what_stops_another_later_on_stays_apart():
    """Front and box of a drawer with as much between them as an eighth of its way."""
    far = box((0.1, 0.9), (0.05, 0.45), (0.55, 0.9))
    mesh = boxes_mesh([BOXES[0], far, *BOXES[2:]])
    assert pieces(joined(mesh, [slide(1), slide(2)])) == [[1], [2]]


def test_what_one_carries_the_whole_carries():
    knob = slide(3, label="knob", axis=(0.0, 0.0, 1.0), parent=1)
    found = joined(MESH, [slide(1), slide(2), knob, slide(4)])
    assert pieces(found) == [[1, 2], [3], [4]]
    assert [proposal.parent for proposal in found] == [None, 0, None]


def test_a_piece_that_was_carried_by_the_other_carries_no_more_of_itself():
    found = joined(MESH, [slide(1, parent=1), slide(2)])
    assert pieces(found) == [[1, 2]]
    assert found[0].parent is None


def test_what_different_things_carry_stays_apart():
    assert len(joined(MESH, [slide(1, parent=2), slide(2), slide(4)])) == 3


def test_of_nothing_nothing_is_made():
    assert joined(MESH, []) == []
