"""Hinges by geometry at the lines of which the network is sure."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from simart_kit_plugins.nano.placing import placed
from simart_kit_plugins.nano.proposals import Proposal

from simart_kit import Joint, Limits, PartGuess
from simart_kit.testing.meshes import boxes_mesh

# A door before a body; the diagonal is about 1.7 m.
MESH = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((0, -0.05, 0), (1, -0.001, 1))])
PIECE = np.repeat(np.arange(2), 12)
HINGE = Joint("j", "revolute", "body", "part", (0.0, -0.05, 0.0), (0.0, 0.0, 1.0), Limits(0.0, 1.5))
DOOR = Proposal(PIECE == 1, PartGuess("door", label="door"), HINGE, None)
SEEN = SimpleNamespace(face_piece=PIECE, size=1.0, center=np.zeros(3))


def told(x, *, confidence=0.9, axis=(0.0, 0.0, -1.0), kind="revolute", pieces=(1,), certainty=0.1):
    """A part of which the network says that it is hinged about the line at x; in doubt whether it moves."""
    part = SimpleNamespace(
        pieces=np.array(pieces),
        kind=kind,
        axis=np.array(axis),
        origin=np.array([x, -0.05, 0.3]),
        lower=0.0,
        upper=1.0,
        confidence=confidence,
        certainty=certainty,
    )
    return SimpleNamespace(parts=(), doubtful=(part,), recognised=False)


def line(said, one=DOOR):
    (found,) = placed(MESH, [one], said, SEEN)
    assert found.joint.limits == one.joint.limits
    assert found.joint.axis == one.joint.axis
    return found.joint.origin


def test_a_hinge_is_where_the_network_is_sure_that_it_is_whichever_way_it_opens():
    assert line(told(0.1)) == (0.1, -0.05, 0.3)
    assert line(told(0.1, axis=(0.0, 0.0, 1.0))) == (0.1, -0.05, 0.3)


def test_nearer_lines_are_one_which_geometry_has_exactly():
    assert line(told(0.01)) == HINGE.origin


def test_at_another_edge_it_is_only_in_what_is_recognised():
    assert line(told(0.9)) == HINGE.origin
    assert line(SimpleNamespace(**{**vars(told(0.9)), "recognised": True})) == (0.9, -0.05, 0.3)


@pytest.mark.parametrize(
    "said",
    [
        told(0.1, confidence=0.7),
        told(0.1, axis=(1.0, 0.0, 0.0)),
        told(0.1, kind="continuous"),
        told(0.1, pieces=(0,)),
    ],
    ids=["unsure", "along another axis", "of another kind", "of another part"],
)
def test_what_it_says_otherwise_moves_no_line(said):
    assert line(said) == HINGE.origin


def test_what_slides_has_no_line_to_be_moved():
    slide = replace(DOOR, joint=replace(HINGE, kind="prismatic"))
    assert line(told(0.1), slide) == HINGE.origin


# A case: its lid has two latches on its front edge, and nothing on the back one.
CASE = boxes_mesh(
    [
        ((0, 0, 0), (1, 1, 0.7)),
        ((0, 0, 0.71), (1, 1, 1)),
        ((0.2, -0.02, 0.6), (0.3, -0.001, 0.8)),
        ((0.7, -0.02, 0.6), (0.8, -0.001, 0.8)),
    ]
)
CASE_PIECE = np.repeat(np.arange(4), 12)
FRONT = Joint("j", "revolute", "body", "part", (0.5, -0.01, 0.75), (1.0, 0.0, 0.0), Limits(0.0, 1.5))
LID = Proposal(np.isin(CASE_PIECE, (1, 2, 3)), PartGuess("lid", label="lid"), FRONT, None)


def turning(piece, y, z, *, confidence, axis=(-1.0, 0.0, 0.0)):
    """A piece of the case of which the network says that it turns about the line at (y, z)."""
    return SimpleNamespace(
        pieces=np.array([piece]),
        kind="revolute",
        axis=np.array(axis),
        origin=np.array([0.5, y, z]),
        lower=0.0,
        upper=1.0,
        confidence=confidence,
    )


@pytest.mark.parametrize(
    ("latch", "recognised", "line"),
    [
        (turning(2, -0.01, 0.8, confidence=0.9), True, (0.5, 1.0, 0.7)),
        (turning(2, -0.01, 0.8, confidence=0.4), True, FRONT.origin),
        (turning(2, -0.01, 0.8, confidence=0.9), False, FRONT.origin),
        (turning(2, -0.01, 0.8, confidence=0.9, axis=(0.0, 1.0, 0.0)), True, FRONT.origin),
        (turning(0, -0.01, 0.8, confidence=0.9), True, FRONT.origin),
    ],
    ids=["a latch", "an unlikely one", "of something unknown", "a knob", "something large"],
)
def test_latches_are_no_hinges_in_what_is_recognised(latch, recognised, line):
    lid = turning(1, 1.0, 0.7, confidence=0.6)
    said = SimpleNamespace(parts=(lid, latch), doubtful=(), recognised=recognised)
    seen = SimpleNamespace(face_piece=CASE_PIECE, size=1.0, center=np.zeros(3))
    (found,) = placed(CASE, [LID], said, seen)
    assert found.joint.origin == line
