"""What words say of an axis, on a block with a panel on its front, side and top, straight or turned."""

import numpy as np
import pytest

import simart_kit as sk
from simart_kit.kinematics import rotation
from simart_kit.spec.moving import axis_words, wished
from simart_kit.spec.places import fits, part_places
from simart_kit.spec.wishes import Wish
from simart_kit.testing.meshes import boxes_mesh

BOXES = [
    ((-0.5, -0.3, 0.0), (0.5, 0.3, 1.0)),
    ((-0.49, -0.32, 0.0), (-0.01, -0.3, 1.0)),  # left front
    ((0.01, -0.32, 0.0), (0.49, -0.3, 1.0)),  # right front
    ((0.5, -0.2, 0.0), (0.52, 0.2, 1.0)),  # right side
    ((-0.5, -0.3, 1.0), (0.5, 0.3, 1.02)),  # top
    ((-0.3, -0.9, 0.4), (0.3, -0.35, 0.6)),  # a box that stands out of the front
]
LABELS = ("body", "door", "door", "hatch", "lid", "drawer")
MESH = boxes_mesh(BOXES)
FACE_PART = np.repeat(range(6), 12)
BODY, LEFT, RIGHT, SIDE, TOP, BOX = part_places(MESH, FACE_PART, LABELS)


def hinge(origin, axis):
    return sk.Joint("hinge", "revolute", "body", "part", origin, axis, sk.Limits(0, 1))


def slide(axis):
    return sk.Joint("slide", "prismatic", "body", "part", (0.0, 0.0, 0.0), axis, sk.Limits(0, 1))


def test_parts_open_to_the_side_that_they_close():
    assert [place.facing for place in (LEFT, SIDE, TOP, BOX)] == ["front", "right", "top", "front"]


@pytest.mark.parametrize(
    ("place", "word", "point", "along"),
    [
        (LEFT, "left edge", (-0.49, -0.31, 0.5), "z"),
        (LEFT, "right edge", (-0.01, -0.31, 0.5), "z"),
        (LEFT, "outer edge", (-0.49, -0.31, 0.5), "z"),
        (RIGHT, "outer edge", (0.49, -0.31, 0.5), "z"),
        (RIGHT, "inner edge", (0.01, -0.31, 0.5), "z"),
        (LEFT, "top edge", (-0.25, -0.31, 1.0), "x"),
        (LEFT, "bottom edge", (-0.25, -0.31, 0.0), "x"),
        (SIDE, "left edge", (0.51, -0.2, 0.5), "z"),  # as seen from the right
        (SIDE, "back edge", (0.51, 0.2, 0.5), "z"),
        (TOP, "back edge", (0.0, 0.3, 1.01), "x"),
        (TOP, "front edge", (0.0, -0.3, 1.01), "x"),
    ],
)
def test_edges_are_lines_and_positive_opens(place, word, point, along):
    (edge, *_) = place.edges(word)
    axis, on = place.line(edge)
    assert on == pytest.approx(point)
    assert np.abs(axis).tolist() == pytest.approx(np.eye(3)["xyz".index(along)])
    # A little turn moves the far side outward.
    far = 2 * (place.center - on) + on
    assert (rotation(0.1 * axis) @ (far - on) - (far - on)) @ place.axes[2] > 0
    assert fits(hinge(tuple(on), tuple(axis)), word, place)


def test_a_line_elsewhere_or_along_another_way_is_not_on_the_edge():
    up = (0.0, 0.0, 1.0)
    assert fits(hinge((-0.45, 0.0, 0.0), up), "left edge", LEFT)
    assert not fits(hinge((-0.25, -0.31, 0.0), up), "left edge", LEFT)
    assert not fits(hinge((-0.49, -0.31, 0.0), (1.0, 0.0, 0.0)), "left edge", LEFT)
    assert not fits(slide(up), "left edge", LEFT)
    assert LEFT.edges("back edge") == ()


def test_slides_have_a_sense_and_turns_have_none():
    front, back = (0.0, -1.0, 0.0), (0.0, 1.0, 0.0)
    assert fits(slide(front), "front", BOX)
    assert not fits(slide(back), "front", BOX)
    assert fits(hinge((0.0, 0.0, 0.0), back), "front", BOX)
    assert fits(slide(front), "horizontal", BOX)
    assert fits(slide((0.0, 0.0, -1.0)), "vertical", BOX)
    assert not fits(slide((0.0, 0.0, 1.0)), "down", BOX)
    assert not fits(sk.Joint("b", "ball", "body", "part"), "vertical", BOX)


def test_words_follow_an_object_that_is_turned_in_its_file():
    turn = rotation(np.array([0.0, 0.0, np.deg2rad(20)]))
    matrix = np.eye(4)
    matrix[:3, :3] = turn
    place = part_places(MESH.transformed(matrix), FACE_PART, LABELS)[1]
    axis, on = place.line(place.edges("outer edge")[0])
    assert on == pytest.approx(turn @ (-0.49, -0.31, 0.5))
    assert place.way("front") == pytest.approx(turn @ (0.0, -1.0, 0.0))
    assert axis == pytest.approx((0.0, 0.0, -1.0))


def test_a_joint_gets_the_word_that_says_most():
    assert axis_words(hinge((-0.49, -0.31, 0.5), (0.0, 0.0, -1.0)), LEFT) == "left edge"
    assert axis_words(slide((0.0, -1.0, 0.0)), BOX) == "front"
    assert axis_words(hinge((0.0, 0.0, 0.5), (0.0, -1.0, 0.0)), BOX) == "front"
    assert axis_words(hinge((-0.25, -0.31, 0.5), (0.0, 0.6, 0.8)), LEFT) is None


def test_a_wish_that_is_granted_leaves_the_joint_alone():
    said = hinge((-0.48, -0.3, 0.2), (0.0, 0.0, -1.0))
    assert (
        wished(said, Wish("revolute", "outer edge", (0.0, 1.0), parent="body"), LEFT, "part", "body") == said
    )
    assert wished(said, Wish(), LEFT, "part", "body") == said


@pytest.mark.parametrize(
    ("wish", "kind", "axis", "limits"),
    [
        (Wish("revolute"), "revolute", (0, 0, -1), (0, np.pi / 2)),
        (Wish(axis="top edge"), "revolute", (-1, 0, 0), (0, np.pi / 2)),
        (Wish("revolute", "vertical", (-0.5, 1.0)), "revolute", (0, 0, -1), (-0.5, 1.0)),
        (Wish("prismatic"), "prismatic", (0, -1, 0), (0, 0.6)),  # half of the 1.2 m from y = -0.9 to 0.3
        (Wish("prismatic", "left", (0.0, 0.2)), "prismatic", (-1, 0, 0), (0, 0.2)),
        (Wish("continuous"), "continuous", (0, -1, 0), None),
        (Wish("ball"), "ball", (0, -1, 0), None),
    ],
)
def test_a_part_without_a_joint_gets_the_one_wished(wish, kind, axis, limits):
    joint = wished(None, wish, LEFT, "part", "body")
    assert (joint.kind, joint.parent, joint.child) == (kind, "body", "part")
    assert joint.axis == pytest.approx(axis)
    assert (joint.limits and (joint.limits.lower, joint.limits.upper)) == pytest.approx(limits)


def test_a_wish_to_stand_still_takes_the_joint_away():
    said = hinge((-0.49, -0.31, 0.5), (0.0, 0.0, -1.0))
    still = wished(said, Wish("fixed"), LEFT, "part", "body")
    assert (still.kind, still.parent) == ("fixed", "body")
    assert wished(None, Wish("fixed"), LEFT, "part", "body") is None


def test_a_point_on_the_axis_moves_the_line():
    said = hinge((-0.49, -0.31, 0.5), (0.0, 0.0, -1.0))
    assert wished(said, Wish(through=(-0.4, -0.3, 0.0)), LEFT, "part", "body").origin == (-0.4, -0.3, 0.0)
