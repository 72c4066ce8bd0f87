"""How sure the network has to be of a part: less so where it reads the object alike from all sides."""

from dataclasses import replace

import numpy as np
import pytest
from simart_kit_plugins.nano.predicting import PredictedPart, Prediction
from simart_kit_plugins.nano.proposals import Proposal
from simart_kit_plugins.nano.trusting import enough, heeded, leads, settled, stands_still

from simart_kit import Joint, Limits, PartGuess

# Pieces.
BODY, DRAWER, LID = range(3)


def part(piece, certainty, kind="prismatic"):
    along = np.array([0.0, -1.0, 0.0])
    return PredictedPart(
        np.array([piece]), "drawer", 0.9, kind, along, np.zeros(3), 0.0, 0.5, 0, 0.9, certainty
    )


def said(*parts, discord=0.0015, novelty=1.5):
    moves = np.full(3, 0.9)
    return Prediction(parts, (), np.zeros(3, int), moves, "desk", discord, novelty, {}, (1.0, 1.0))


def kept(prediction, skin=False, alone=False):
    found = settled(prediction, enough(prediction, 0.8, skin, alone))
    assert len(found.parts) + len(found.doubtful) == len(prediction.parts)
    for number, one in enumerate(found.parts, start=1):
        assert (found.piece_part[one.pieces] == number).all()
    return [int(one.pieces[0]) for one in found.parts]


@pytest.mark.parametrize(("certainty", "found"), [(0.79, [DRAWER]), (0.41, [DRAWER]), (0.39, [])])
def test_half_is_enough_in_what_is_read_much_alike_from_all_sides(certainty, found):
    assert kept(said(part(DRAWER, certainty))) == found


def test_all_is_asked_where_each_side_says_something_else():
    assert kept(said(part(DRAWER, 0.79), discord=0.05)) == []
    assert kept(said(part(DRAWER, 0.81), discord=0.05)) == [DRAWER]


def test_five_eighths_are_enough_where_geometry_finds_nothing():
    new = said(part(DRAWER, 0.51), part(LID, 0.49), discord=0.05, novelty=1.3)
    assert kept(new) == []
    assert kept(new, alone=True) == [DRAWER]
    assert kept(new, alone=True, skin=True) == []
    assert kept(replace(new, discord=float("inf")), alone=True) == []  # seen from one side
    assert kept(replace(new, novelty=1.4), alone=True) == []  # like nothing that it knows


@pytest.mark.parametrize("discord", [0.0, 0.0015])
def test_all_is_asked_in_what_is_like_nothing_that_was_made(discord):
    alien = said(part(DRAWER, 0.81), part(LID, 0.79), discord=discord, novelty=1.8)
    assert kept(alien) == [DRAWER]
    assert kept(replace(alien, novelty=float("inf"))) == [DRAWER, LID]  # of weights without statistics


def test_all_is_asked_on_a_skin():
    assert kept(said(part(DRAWER, 0.79)), skin=True) == []
    assert kept(said(part(DRAWER, 0.81)), skin=True) == [DRAWER]


@pytest.mark.parametrize("skin", [False, True])
def test_a_quarter_is_enough_in_what_it_recognises_known_by_name_or_not(skin):
    known = said(part(DRAWER, 0.21), part(LID, 0.19), discord=0.0)
    assert kept(known, skin) == [DRAWER]
    assert kept(replace(known, category=""), skin) == [DRAWER]


def test_what_is_not_new_is_recognised_by_less():
    not_new = said(part(DRAWER, 0.21), discord=0.005, novelty=1.0)
    assert kept(not_new) == [DRAWER]
    assert kept(replace(not_new, novelty=1.5)) == []
    assert kept(replace(not_new, discord=0.015)) == []


def test_half_is_enough_in_what_is_made_as_what_was_trained_on_whatever_each_side_says():
    usual = said(part(DRAWER, 0.41), part(LID, 0.39), discord=0.015, novelty=1.0)
    assert not usual.recognised
    assert kept(usual) == [DRAWER]
    assert kept(replace(usual, novelty=1.5)) == []
    assert kept(replace(usual, discord=0.05)) == []  # the sides are quite at odds
    assert kept(usual, skin=True) == []


def test_what_hangs_on_a_part_in_doubt_hangs_on_the_body():
    on_it = replace(part(LID, 0.7), parent=1)
    (found,) = settled(said(part(DRAWER, 0.3), on_it), 0.4).parts
    assert (int(found.pieces[0]), found.parent) == (LID, 0)


def test_geometry_has_no_say_in_what_surely_stands_still():
    piece, areas = np.array([BODY, DRAWER, LID]), np.ones(3)
    joint = Joint("j", "prismatic", "body", "part", axis=(0.0, -1.0, 0.0), limits=Limits(0.0, 0.5))
    drawer, lid = (
        Proposal(piece == k, PartGuess("part", label="part"), joint, parent)
        for k, parent in ((DRAWER, None), (LID, 0))
    )
    unsure = replace(said(), moves=np.array([0.0, 0.01, 0.3]))
    (left,) = heeded(unsure, [drawer, lid], piece, areas)
    assert left.faces.tolist() == lid.faces.tolist()
    assert left.parent is None  # what carried it is gone
    # Who says something else from each side is not asked.
    assert len(heeded(replace(unsure, discord=0.05), [drawer, lid], piece, areas)) == 2


def proposal(kind):
    limits = None if kind == "continuous" else Limits(0.0, 0.5)
    joint = Joint("j", kind, "body", "part", axis=(0.0, -1.0, 0.0), limits=limits)
    return Proposal(np.array([True]), PartGuess("part", label="part"), joint, None)


def test_the_network_leads_in_what_it_recognises_unless_geometry_finds_as_many():
    slide, turn = proposal("prismatic"), proposal("revolute")
    quite, rather = said(discord=0.002, novelty=1.0), said(discord=0.008, novelty=1.0)
    assert leads(rather, [slide, turn], [slide])
    assert not leads(rather, [turn], [slide])
    assert not leads(rather, [slide, turn], [turn, slide])
    assert leads(quite, [slide, turn], [turn, slide])


def test_geometry_leads_in_what_is_not_recognised_if_it_finds_anything():
    new = said(discord=0.008, novelty=1.5)
    assert not leads(new, [proposal("prismatic")], [proposal("revolute")])
    assert leads(new, [proposal("prismatic")], [])


def test_what_is_recognised_and_has_nothing_moving_is_static_more_readily():
    planter = said(discord=0.004, novelty=1.0)
    assert [stands_still(planter, chance) for chance in (0.65, 0.75, 0.96)] == [False, True, True]
    for other in (said(part(LID, 0.4), discord=0.004, novelty=1.0), said(discord=0.004, novelty=1.5)):
        assert [stands_still(other, chance) for chance in (0.65, 0.75, 0.96)] == [False, False, True]
