"""Which parts a description means, by their names, places, sizes and materials."""

import numpy as np
import pytest

from simart_kit.part_matching import match, nearest_name
from simart_kit.part_places import NamedPart
from simart_kit.part_words import one_form, synonyms, wanted

WHOLE = np.array([[-1.0, -1.0, 0.0], [1.0, 1.0, 4.0]])


def part(name, x=0.0, y=0.0, z=2.0, *, label="", area=1.0, material="wood", description=""):
    center = np.array([x, y, z])
    box = np.array([center - 0.1, center + 0.1])
    return NamedPart(name, label, description, material, box, WHOLE, area)


def found(description, parts):
    """Names of the chosen parts."""
    return [parts[i].name for i in match(description, parts).chosen]


# A chest: a column of four drawers named in no order, two doors, a body.
CHEST = [
    part("body", area=9.0),
    part("drawer", z=2.0),
    part("drawer_2", z=3.0),
    part("drawer_3", z=1.0, area=2.0),
    part("drawer_4", z=0.5),
    part("left_door", x=-0.5, y=-1, material="glass"),
    part("right_door", x=0.5, y=-1),
]
# Four doors in two rows, and a handle on each of the left ones.
GRID = [
    part("body"),
    part("door", x=-0.5, z=3),
    part("door_2", x=0.5, z=3),
    part("door_3", x=-0.5, z=1),
    part("door_4", x=0.5, z=1),
    part("knob", x=-0.3, z=3),
    part("knob_2", x=-0.3, z=1),
]
CAR = [
    part("body"),
    part("wheel", x=-0.9, y=-0.8),
    part("wheel_2", x=0.9, y=-0.8),
    part("wheel_3", x=-0.9, y=0.8),
    part("wheel_4", x=0.9, y=0.8),
    part("steering_wheel", x=-0.4, y=-0.4),
]


@pytest.mark.parametrize(
    ("description", "expected"),
    [
        ("the top drawer", ["drawer_2"]),
        ("the lowest drawer", ["drawer_4"]),
        ("second drawer from the top", ["drawer"]),
        ("the 3rd drawer from the top", ["drawer_3"]),
        ("second drawer from the bottom", ["drawer_3"]),
        ("last drawer from the top", ["drawer_4"]),
        ("drawer at the bottom", ["drawer_4"]),
        ("drawer 3", ["drawer_3"]),
        ("drawer number 3", ["drawer_3"]),
        ("the chest 01 wooden door", ["right_door"]),
        ("the drawer link at the top", ["drawer_2"]),
        ("the cabinet", ["body"]),
        ("the third drawer", ["drawer_3"]),
        ("the biggest drawer", ["drawer_3"]),
        ("the drawers", ["drawer", "drawer_2", "drawer_3", "drawer_4"]),
        ("the two lower drawers", ["drawer_3", "drawer_4"]),
        ("first two drawers from the top", ["drawer", "drawer_2"]),
        ("left door", ["left_door"]),
        ("the door on the right", ["right_door"]),
        ("both doors", ["left_door", "right_door"]),
        ("the glass door", ["left_door"]),
        ("the wooden door", ["right_door"]),
        ("right leaf", ["right_door"]),
        ("the housing", ["body"]),
        ("the carcass of the chest", ["body"]),
    ],
)
def test_a_chest(description, expected):
    assert found(description, CHEST) == expected


@pytest.mark.parametrize(
    ("description", "expected"),
    [
        ("upper left door", ["door"]),
        ("the lower right door", ["door_4"]),
        ("the left doors", ["door", "door_3"]),
        ("the upper doors", ["door", "door_2"]),
        ("all doors", ["door", "door_2", "door_3", "door_4"]),
        ("handle of the upper left door", ["knob"]),
        ("the grip on the lower left door", ["knob_2"]),
    ],
)
def test_a_grid_of_doors(description, expected):
    assert found(description, GRID) == expected


def test_a_steering_wheel_is_no_wheel_but_can_be_asked_for():
    assert found("front wheels", CAR) == ["wheel", "wheel_2"]
    assert found("the rear left wheel", CAR) == ["wheel_3"]
    assert found("the steering wheel", CAR) == ["steering_wheel"]
    assert found("all four tyres", CAR) == ["wheel", "wheel_2", "wheel_3", "wheel_4"]


def test_names_that_claim_a_side_are_believed_before_places():
    turned = [part("left_door", x=0.5), part("right_door", x=-0.5)]

    assert found("the left doors", turned) == ["left_door"]


def test_the_middle_one_lies_in_the_middle_of_its_row():
    shelves = [part("shelf", z=1), part("shelf_2", z=3), part("shelf_3", z=2)]

    assert found("the middle shelf", shelves) == ["shelf_3"]


@pytest.mark.parametrize(
    "description", ["the lid", "the fourth door", "a banana", "drawer of the moon base door", "???", ""]
)
def test_what_is_not_there_is_not_found(description):
    doors = [part("body"), part("left_door", x=-1), part("right_door", x=1)]

    assert match(description, doors).chosen == ()


def test_parts_that_fit_alike_share_the_certainty_and_the_largest_is_taken():
    doors = [part("body"), part("door_2", x=-1, area=1.0), part("door_3", x=1, area=2.0)]

    one = match("the door", doors)

    assert one.chosen == (2,)
    assert one.score == pytest.approx(0.5)  # 1 for the name, shared by two
    assert "2 parts fit alike" in one.reason


def test_a_name_with_numbered_siblings_is_not_certain():
    said = match("the drawer", CHEST)

    assert [CHEST[i].name for i in said.chosen] == ["drawer"]
    assert said.score == pytest.approx(1 / 4)


def test_a_synonym_scores_less_than_the_word_itself_and_more_than_a_misspelling():
    lids = [part("lid"), part("body")]

    own, other, wrong = (match(text, lids).score for text in ("a lid", "the cover", "a lit"))

    assert own == 1.0
    assert own > other > wrong
    assert match("left draweer", [part("drawer"), part("body")]).chosen == (0,)


def test_fewer_parts_than_were_counted_make_it_doubtful():
    assert match("both doors", [part("door"), part("body")]).score == pytest.approx(0.5)


def test_a_label_counts_as_a_name():
    parts = [part("part_1", label="lid"), part("part_2", label="body")]

    assert found("the lid", parts) == ["part_1"]


def test_a_description_that_mentions_the_thing_is_the_last_resort():
    parts = [part("flap", description="carries the nameplate"), part("body")]

    assert match("the nameplate", parts).chosen == (0,)
    assert match("the nameplate", parts).score == pytest.approx(0.4)


def test_scores_lie_between_0_and_1():
    for description in ("the drawer", "upper drawers", "big glass left door", "steel", "x y z"):
        scores = match(description, CHEST).scores
        assert ((scores >= 0) & (scores <= 1)).all()


def test_the_rival_goes_by_letters_alone():
    parts = [part("lower_door"), part("cover_plate"), part("lid")]

    assert nearest_name("the cover", parts) == 1  # shares "cover", where "lid" is meant as often


@pytest.mark.parametrize(
    ("plural", "singular"),
    [
        ("doors", "door"),
        ("shelves", "shelf"),
        ("leaves", "leaf"),
        ("feet", "foot"),
        ("boxes", "box"),
        ("latches", "latch"),
        ("batteries", "battery"),
        ("glass", "glass"),
        ("chassis", "chassis"),
        ("cases", "case"),
        ("hinges", "hinge"),
        ("axles", "axle"),
    ],
)
def test_one_form_of_a_noun(plural, singular):
    assert one_form(plural) == singular


def test_words_for_the_same_thing():
    assert synonyms("lid", "cover")
    assert synonyms("handle", "knob")
    assert not synonyms("lid", "door")


def test_a_description_taken_apart():
    said = wanted("the second big wooden cabinet doors from the left")

    assert said.things == ("cabinet", "door")
    assert (said.order, said.order_from, said.size, said.many) == (2, "left", 1, True)
    assert "plywood" in said.materials
    assert wanted("handle of the left door").context == "left door"
    assert wanted("door on the left").sides == ("left",)
