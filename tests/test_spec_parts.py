"""Parts as a spec states them: renamed, merged, split, collected from pieces or points, left out, counted."""

import numpy as np
import pytest

import simart_kit as sk
from simart_kit.errors import BadInputError
from simart_kit.segments import find_segments
from simart_kit.spec.choosing import Option, choose
from simart_kit.spec.moving import with_joints
from simart_kit.spec.pieces import nearest_face, whole_pieces
from simart_kit.spec.reading import read_spec
from simart_kit.spec.shaping import with_parts
from simart_kit.testing.meshes import boxes_mesh

# Boxes that lie apart, from large to small, so that each is the piece of its number.
SIZES = (1.0, 0.5, 0.4, 0.3, 0.2)
STARTS = (0.0, 2.0, 3.0, 4.0, 5.0)
MESH = boxes_mesh([((x, 0.0, 0.0), (x + s, s, s)) for x, s in zip(STARTS, SIZES, strict=True)])
NAMES = ("body", "door", "knob", "drawer")


def found(joints=None):
    """The body with the smallest box, and a part for each of the other three."""
    labels = np.repeat([0, 1, 2, 3, 0], 12).astype(np.int32)
    pieces = find_segments(MESH).face_segment
    assert pieces.tolist() == np.repeat(range(5), 12).tolist()
    guesses = tuple(sk.PartGuess(name, label=name, material="steel") for name in NAMES)
    return sk.Segmentation(labels, guesses, joints, pieces)


def shaped(joints=None, **keys):
    return with_parts(found(joints), MESH, read_spec({"schema": 1, **keys}))


def pieces_by_name(segmentation):
    """The pieces of each part."""
    return {
        guess.name: whole_pieces(segmentation.face_segment, segmentation.face_part == index)
        for index, guess in enumerate(segmentation.parts)
    }


def test_nothing_stated_leaves_all_as_it_is():
    assert pieces_by_name(shaped()) == {"body": (0, 4), "door": (1,), "knob": (2,), "drawer": (3,)}


def test_parts_are_renamed_and_may_swap_names():
    parts = [{"name": "drawer", "found_as": "door"}, {"name": "door", "found_as": "drawer", "label": "gate"}]
    result = shaped(parts=parts)
    assert pieces_by_name(result) == {"body": (0, 4), "drawer": (1,), "knob": (2,), "door": (3,)}
    assert [guess.label for guess in result.parts] == ["body", "door", "knob", "gate"]


def test_a_name_that_is_taken_makes_the_other_part_give_way():
    result = shaped(parts=[{"name": "knob", "found_as": "door"}])
    assert pieces_by_name(result) == {"body": (0, 4), "knob": (1,), "knob_found": (2,), "drawer": (3,)}


def test_parts_are_merged():
    result = shaped(merge=[{"into": "door", "parts": ["knob"]}])
    assert pieces_by_name(result) == {"body": (0, 4), "door": (1, 2), "drawer": (3,)}


def test_a_part_is_split_by_numbers_or_by_points():
    by_number = shaped(split=[{"part": "body", "name": "foot", "pieces": [4]}])
    by_point = shaped(split=[{"part": "body", "name": "foot", "points": [[5.1, 0.1, 0.25]]}])
    assert pieces_by_name(by_number)["foot"] == pieces_by_name(by_point)["foot"] == (4,)
    assert (by_number.parts[-1].label, by_number.parts[-1].material) == ("foot", "steel")


@pytest.mark.parametrize(("pieces", "share"), [([1], "none"), ([0, 4], "all")])
def test_a_split_that_divides_nothing_is_told(pieces, share):
    with pytest.raises(BadInputError, match=f"split of 'body': {share} of its faces would be of 'foot'"):
        shaped(split=[{"part": "body", "name": "foot", "pieces": pieces}])


def test_listed_pieces_are_all_of_a_part_and_the_rest_falls_to_the_body():
    result = shaped(parts=[{"name": "door", "pieces": [3]}, {"name": "flap", "pieces": [2]}])
    assert pieces_by_name(result) == {"body": (0, 1, 4), "door": (3,), "flap": (2,)}


def test_a_part_that_keeps_no_piece_is_told():
    with pytest.raises(BadInputError, match="part 'knob' has no face left"):
        shaped(parts=[{"name": "flap", "pieces": [2]}, {"name": "knob"}])


def test_a_point_means_the_part_found_there_else_the_piece():
    on_door, on_foot = [2.25, 0.25, 0.52], [5.1, 0.1, 0.21]
    result = shaped(parts=[{"name": "gate", "points": [on_door]}, {"name": "foot", "points": [on_foot]}])
    assert pieces_by_name(result) == {
        "body": (0,), "gate": (1,), "knob": (2,), "drawer": (3,), "foot": (4,)
    }  # fmt: skip
    assert pieces_by_name(shaped(parts=[{"name": "both", "points": [on_door, on_foot]}]))["both"] == (1, 4)


def test_points_may_be_shares_of_the_bounding_box():
    # The scene is 5.2 long in x: 2.25 of it lies on the door.
    result = shaped(coordinates="fraction", parts=[{"name": "gate", "points": [[2.25 / 5.2, 0.25, 0.52]]}])
    assert pieces_by_name(result)["gate"] == (1,)


def test_only_leaves_out_what_is_not_listed():
    result = shaped(only=True, parts=[{"name": "door"}])
    assert pieces_by_name(result) == {"body": (0, 2, 3, 4), "door": (1,)}


def test_hints_follow_names_and_lose_parts_that_are_gone():
    hints = (sk.Joint("a", "ball", "body", "door"), sk.Joint("b", "ball", "drawer", "knob"))
    hints += (sk.Joint("c", "ball", "body", "drawer"),)
    result = shaped(hints, parts=[{"name": "gate", "found_as": "door"}], kinds={"drawer": {"count": 0}})
    assert [(j.name, j.parent, j.child) for j in result.joints] == [
        ("a", "body", "gate"),
        ("b", "body", "knob"),
    ]


def test_a_listed_part_that_stands_still_is_none_of_the_count():
    parts = [{"name": "door", "joint": "fixed"}, {"name": "gate", "label": "door", "found_as": "drawer"}]
    result = shaped(parts=parts, kinds={"door": {"count": 1}})
    assert [guess.name for guess in result.parts] == ["body", "door", "knob", "gate"]


def moved(joints, **keys):
    """Parent and kind by part, as a spec has them of these joints."""
    spec = read_spec({"schema": 1, **keys})
    return {j.child: (j.parent, j.kind) for j in with_joints(joints, shaped(joints, **keys), MESH, spec)}


def test_a_parent_that_nobody_stated_gives_way_where_it_would_make_a_loop():
    said = (sk.Joint("a", "ball", "body", "door"), sk.Joint("b", "ball", "door", "knob"))
    parts = [{"name": "door", "parent": "knob"}]
    assert moved(said, parts=parts) == {"door": ("knob", "ball"), "knob": ("body", "ball")}


def test_another_root_carries_what_stands_still():
    said = (sk.Joint("a", "ball", "body", "door"), sk.Joint("b", "ball", "body", "knob"))
    assert moved(said, parts=[{"name": "door", "root": True}]) == {
        "knob": ("body", "ball"), "body": ("door", "fixed"), "drawer": ("door", "fixed")
    }  # fmt: skip


def test_counts_keep_the_surest_and_take_what_closes_a_front_for_another():
    spec = read_spec({"schema": 1, "kinds": {"doors": {"count": 2}, "drawer": {"count": 0}}})
    options = [
        Option("cabinet door", 0.5, 1.0),
        Option("drawer", 0.9, 3.0),
        Option("drawer", 0.8, 4.0),
        Option("wheel", 0.2, 1.0),
        Option("gate", 0.4, 1.0, sure=False),
        Option("lid", 0.3, 1.0, sure=False),
    ]
    # A gate is a door: in doubt, but better than a drawer; a wheel is none of this.
    assert choose(spec, options) == ("cabinet door", None, None, "wheel", "gate", None)
    assert choose(spec, options[:4]) == ("cabinet door", None, "doors", "wheel")
    three = [Option("door", score, 1.0) for score in (0.3, 0.9, 0.6)]
    assert choose(spec, three) == (None, "door", "door")
    assert choose(spec, [Option("door", 0.1, 1.0, pinned=True), *three[1:]]) == ("door", "door", None)


def test_the_nearest_face_is_by_its_surface_and_not_by_its_corners():
    # A large face with far corners before a small one with near corners.
    large = boxes_mesh([((-5.0, 0.0, -5.0), (5.0, 1.0, 5.0)), ((-0.1, -2.0, -0.1), (0.1, -1.9, 0.1))])
    face = nearest_face(large, np.array([1.0, -0.4, 1.0]))
    assert face < 12
    assert large.face_normals[face].tolist() == [0.0, -1.0, 0.0]
