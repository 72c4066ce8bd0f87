"""Answers of the model: what is wrong with one is told in words that say how to mend it."""

import json

import numpy as np
import pytest
from pydantic import ValidationError
from simart_kit_plugins.marks.answers import (
    axis_answer,
    critic_answer,
    grounding_answer,
    object_answer,
    parts_answer,
)
from simart_kit_plugins.marks.linking import face_links, links_of, moved, unnamed

BODY = {"name": "Body", "label": "", "pieces": [0], "parent": "", "kind": "fixed"}
DOOR = {"name": "Left Door", "label": "door", "pieces": [1, 3], "parent": "body", "kind": "revolute"}
DRAWER = {"name": "drawer", "label": "Drawer", "pieces": [2], "parent": "body", "kind": "prismatic"}


def read(model, *links, **changes):
    full = [{"material": "wood", "confidence": 80, **link} for link in links]
    return model.model_validate_json(
        json.dumps({"category": "x", "longest_side_m": 1, "links": full} | changes)
    )


def test_links_have_clean_names_and_the_body_first():
    answer = read(object_answer(4), DOOR, BODY, DRAWER)
    body, door, drawer = links_of(answer, 4)
    assert (body.name, body.pieces, body.parent) == ("body", (0,), "")
    assert (door.name, door.parent, door.pieces, door.kind) == ("left_door", "body", (1, 3), "revolute")
    assert (drawer.label, drawer.score) == ("drawer", 0.8)


def test_pieces_that_are_not_named_are_the_body_s():
    answer = read(object_answer(6), BODY, DOOR)
    assert links_of(answer, 6)[0].pieces == (0, 2, 4, 5)
    assert unnamed(answer, 6) == (2, 4, 5)


@pytest.mark.parametrize(
    ("links", "told"),
    [
        ((BODY, DOOR, {**DRAWER, "pieces": [2, 3]}), "piece 3 is in two links"),
        ((BODY, DOOR, {**DRAWER, "pieces": [2, 4]}), "no piece 4: they are 0..3"),
        ((BODY, DOOR, {**DRAWER, "pieces": []}), "'drawer' has no piece"),
        (({**BODY, "pieces": []}, {**DOOR, "pieces": [0, 1, 3]}, DRAWER), "no piece is left for the body"),
        ((BODY, {**DOOR, "parent": "frame"}), "the parent 'frame' of 'Left Door' is no link"),
        ((BODY, {**DOOR, "parent": "drawer"}, {**DRAWER, "parent": "left_door"}), "carried by itself"),
        (({**BODY, "kind": "free"}, DOOR), "its kind must be fixed, not free"),
        ((BODY, {**DOOR, "parent": ""}), "one link, the body"),
        ((BODY, DOOR, {**DRAWER, "name": "left door"}), "two links are called 'left_door'"),
        ((BODY, {**DOOR, "material": "cheese"}), "'cheese' is not known: use one of"),
        ((BODY, {**DOOR, "axis": [0, 0, 1]}), "Extra inputs are not permitted"),
    ],
)
def test_a_wrong_answer_is_told_in_words(links, told):
    with pytest.raises(ValidationError) as error:
        read(object_answer(4), *links)
    assert told in str(error.value)


def test_given_parts_are_links_of_one_piece_each():
    assert len(read(parts_answer(2), BODY, {**DOOR, "pieces": [1]}).links) == 2
    with pytest.raises(ValidationError, match="make 2 links of one piece each"):
        read(parts_answer(2), {**BODY, "pieces": [0, 1]})


def test_only_letters_in_the_picture_can_be_chosen():
    model = axis_answer(("A", "C"))
    assert model.model_validate_json('{"letter": "C", "confidence": 50}').letter == "C"
    assert model.model_json_schema()["properties"]["letter"]["enum"] == ["A", "C"]
    with pytest.raises(ValidationError, match="no letter 'B' in the picture, only A, C"):
        model.model_validate_json('{"letter": "B", "confidence": 50}')


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ({"link": "lid", "wrong": "axis"}, "no link 'lid', only door"),
        ({"link": "door", "wrong": "pieces"}, "`add` must name the pieces"),
        ({"link": "door", "wrong": "pieces", "add": [9]}, "no piece 9"),
    ],
)
def test_faults_of_what_is_not_there_are_refused(fault, told):
    with pytest.raises(ValidationError, match=told):
        critic_answer(("door",), 4).model_validate_json(json.dumps({"faults": [fault]}))


def test_grounding_needs_an_entry_for_every_view():
    entry = {"piece": 0, "belongs": "yes", "confidence": 90}
    model = grounding_answer(2)
    with pytest.raises(ValidationError, match="no entry for 1"):
        model.model_validate_json(json.dumps({"matches": [entry]}))
    with pytest.raises(ValidationError, match="piece 0 is in two views"):
        model.model_validate_json(json.dumps({"matches": [entry, entry]}))


def test_moved_pieces_leave_no_link_empty():
    links = links_of(read(object_answer(4), BODY, DOOR, DRAWER), 4)
    body, door, drawer = moved(links, "drawer", [0, 3])
    assert (body.pieces, door.pieces, drawer.pieces) == ((0,), (1,), (2, 3))


def test_faces_get_the_link_of_their_piece():
    links = links_of(read(object_answer(4), BODY, DOOR, DRAWER), 4)
    assert face_links(np.array([3, 0, 2, 2, 1]), links).tolist() == [1, 0, 2, 2, 1]
