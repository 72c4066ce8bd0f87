"""S2O's protocol on boxes whose hits can be counted by hand."""

import numpy as np
import pytest

from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.protocols.s2o import S2O, openable

from .bench_boxes import BODY, boxes, hinge, prediction, slide, truth

SIZES = [
    ((0, 0, 0), (1, 1, 1)),
    ((1, 0, 0), (1.1, 1, 1)),
    ((0, 1, 0), (1, 1.3, 0.4)),
    ((0, 0, 1), (1, 1, 1.1)),
]
DOOR = Link("door", 0, hinge((1, 0, 0)))
DRAWER = Link("drawer", 0, slide((0, 1, 0)))
LID = Link("lid", 0, hinge((0, 0, 1), (1, 0, 0)))
CABINET = boxes((BODY, DOOR, DRAWER, LID), SIZES, (0, 1, 2, 3))
DOOR_DIAGONAL = np.sqrt(0.1**2 + 1 + 1)


def score(one: Articulation, two: Articulation) -> dict[str, float | None]:
    return dict(S2O().score(truth(one), prediction(two)).values)


def one_door(joint: LinkJoint, also: tuple[LinkJoint, ...] = ()) -> Articulation:
    return boxes((BODY, Link("door", 0, joint, also)), SIZES[:2], (0, 1))


def levels(true: LinkJoint, predicted: LinkJoint, *also: LinkJoint) -> tuple[float | None, ...]:
    values = score(one_door(true, also), one_door(predicted))
    return tuple(values[key] for key in ("pd_f1", "m_f1", "ma_f1", "mao_f1"))


def tilted(degrees: float) -> LinkJoint:
    angle = np.deg2rad(degrees)
    return hinge((1, 0, 0), (np.sin(angle), 0, np.cos(angle)))


def test_a_perfect_prediction_hits_everything():
    values = score(CABINET, CABINET)
    assert set(values) == {metric.key for metric in S2O.metrics}
    for level in ("pd", "m", "ma", "mao"):
        assert [values[f"{level}_{key}"] for key in ("precision", "recall", "f1", "hits")] == [1, 1, 1, 3]
    assert (values["predictions"], values["truths"]) == (3, 3)
    assert S2O().tag == "s2o/1"


def test_a_missed_and_two_spurious_parts_are_counted():
    # The drawer is missed; the body's box and half of the lid are said to be doors; the door is right.
    spurious = Link("door_2", 0, hinge((0, 0, 0)))
    links = (BODY, DOOR, spurious, Link("door_3", 0, hinge((0, 1, 0))))
    two = boxes(links, SIZES, (2, 1, 0, 3))
    scores = S2O().score(truth(CABINET), prediction(two))
    values = scores.values
    assert (values["pd_hits"], values["predictions"], values["truths"]) == (1, 3, 3)
    assert values["pd_precision"] == pytest.approx(1 / 3)
    assert values["mao_recall"] == pytest.approx(1 / 3)
    assert values["mao_f1"] == pytest.approx(2 * 1 / (3 + 3))
    assert [row["outcome"] for row in scores.parts] == ["matched", *["missed"] * 2, *["invented"] * 2]


def test_precision_and_recall_differ_by_what_was_predicted():
    values = score(CABINET, boxes((BODY, DOOR), SIZES, (0, 1, 0, 0)))
    assert (values["m_precision"], values["m_recall"]) == (1, pytest.approx(1 / 3))
    assert values["m_f1"] == pytest.approx(0.5)  # 2 * 1 / (1 + 3)


@pytest.mark.parametrize(("degrees", "right"), [(4.9, 1), (5.1, 0), (175.1, 1), (174.9, 0), (180, 1)])
def test_the_axis_may_be_five_degrees_off_and_its_sign_is_ignored(degrees, right):
    assert levels(tilted(0), tilted(degrees)) == (1, 1, right, right)


@pytest.mark.parametrize(("share", "right"), [(0.09, 1), (0.11, 0)])
def test_the_origin_may_be_a_tenth_of_the_part_off_the_true_axis_line(share, right):
    off = share * DOOR_DIAGONAL
    assert levels(hinge((1, 0, 0)), hinge((1, off, 0.7))) == (1, 1, 1, right)  # along the axis is no error


def test_the_origin_of_a_slide_is_ignored_and_so_is_its_lack():
    far = LinkJoint("prismatic", (1.0, 0.0, 0.0), (9.0, 9.0, 9.0), 0.0, 0.4)
    unsaid = LinkJoint("prismatic", (1.0, 0.0, 0.0), None, 0.0, 0.4)
    assert levels(slide(), far) == levels(slide(), unsaid) == (1, 1, 1, 1)
    assert levels(hinge((1, 0, 0)), LinkJoint("revolute", (0.0, 0.0, 1.0))) == (1, 1, 1, 0)


def test_a_wrong_type_fails_m_and_all_after_it_and_continuous_is_revolute():
    assert levels(hinge((1, 0, 0)), slide((0, 0, 1))) == (1, 0, 0, 0)
    assert levels(hinge((1, 0, 0)), hinge((1, 0, 0), limits=None, kind="continuous")) == (1, 1, 1, 1)
    assert levels(hinge((1, 0, 0)), LinkJoint("unknown")) == (1, 0, 0, 0)


def test_any_of_several_right_joints_may_be_predicted():
    other = hinge((1, 1, 0))
    assert levels(hinge((1, 0, 0)), other) == (1, 1, 1, 0)
    assert levels(hinge((1, 0, 0)), other, slide(), other) == (1, 1, 1, 1)


def test_a_class_is_the_last_known_word_of_the_label_or_else_of_the_name():
    def kind(name: str, label: str = "", joint: LinkJoint | None = None) -> str | None:
        return openable(Link(name, 0, hinge() if joint is None else joint, label=label))

    assert kind("sliding_door", joint=slide()) == "door"  # "sliding" has no lid in it
    assert kind("x", "drawer door") == "door"
    assert kind("door1", "Lid") == "lid"
    assert kind("leftDoor2") == "door"
    assert kind("DOORS") == "door"
    assert kind("part_3", joint=slide()) == "drawer"
    assert kind("link_3") == "door"
    assert kind("solid", joint=slide()) == "drawer"  # has no lid in it
    assert kind("ROOM73B2-BODYSET7") == "door"
    assert kind("part_3", joint=LinkJoint("free")) is None
    assert kind("door", joint=LinkJoint()) is None


def test_parts_that_s2o_does_not_know_do_not_count():
    assert openable(Link("panel_2", 0, hinge(), label="panel")) is None
    assert openable(Link("button_link", 0, slide())) is None
    assert openable(Link("door_handle", 0, hinge(), label="handle")) is None


def test_another_class_is_no_match():
    two = boxes((BODY, Link("lid", 0, hinge((1, 0, 0)))), SIZES[:2], (0, 1))
    values = score(one_door(hinge((1, 0, 0))), two)
    assert (values["pd_hits"], values["predictions"], values["truths"]) == (0, 1, 1)


def door_slices(first: float, second: float) -> Articulation:
    """A door of six slabs, of which three each are said to be a door."""
    slabs = [((1, i, 0), (1.1, i + 1, 1)) for i in range(6)]
    doors = [
        Link("door_a", 0, hinge((1, 0, 0)), confidence=first),
        Link("door_b", 0, hinge((1, 6, 0)), confidence=second),
    ]
    return boxes((BODY, *doors), [((0, 0, 0), (1, 6, 1)), *slabs], (0, 1, 1, 1, 2, 2, 2))


@pytest.mark.parametrize(("first", "second", "mao"), [(0.9, 0.5, 1), (0.5, 0.9, 0), (1.0, 1.0, 1)])
def test_the_most_confident_prediction_is_matched_first(first, second, mao):
    halves = door_slices(first, second)
    # Each half has an IoU of exactly 0.5 with the whole door, so both could take it; hinges differ.
    whole = boxes(
        (BODY, Link("door", 0, hinge((1, 0, 0)))),
        [((0, 0, 0), (1, 6, 1)), *[((1, i, 0), (1.1, i + 1, 1)) for i in range(6)]],
        (0, *[1] * 6),
    )
    values = score(whole, halves)
    assert (values["pd_hits"], values["predictions"], values["mao_hits"]) == (1, 2, mao)


def test_merged_doors_are_one_hit_at_most():
    slabs = [((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (1.1, 0.6, 1)), ((1, 0.6, 0), (1.1, 1, 1))]
    one = boxes((BODY, DOOR, Link("door_2", 0, hinge((1, 1, 0)))), slabs, (0, 1, 2))
    values = score(one, boxes((BODY, DOOR), slabs, (0, 1, 1)))
    # Areas 1.52 and 1.08: IoU 0.58 with the larger door.
    assert (values["pd_hits"], values["pd_precision"], values["pd_recall"]) == (1, 1, 0.5)


def test_where_meshes_differ_points_are_counted():
    halves = [((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (1.1, 0.5, 1)), ((1, 0.5, 0), (1.1, 1, 1))]
    two = boxes((BODY, DOOR), halves, (0, 1, 1))
    assert score(one_door(hinge((1, 0, 0))), two)["mao_f1"] == 1


def test_links_without_surface_are_no_parts():
    one = boxes((BODY, Link("frame", 0, slide()), Link("door", 1, hinge((1, 0, 0)))), SIZES[:2], (0, 2))
    assert score(one, one)["truths"] == 1


def test_a_static_object_for_which_nothing_is_predicted_scores_one():
    box = boxes((BODY,), SIZES[:2], (0, 0))
    values = score(box, box)
    assert [values[key] for key in ("pd_f1", "m_precision", "mao_recall")] == [1, 1, 1]
    invented = score(box, one_door(hinge()))
    assert [invented[key] for key in ("pd_f1", "m_precision", "mao_recall")] == [0, 0, 0]


def test_a_failed_object_scores_zero_and_its_parts_count_as_missed():
    failed = S2O().score(truth(CABINET), None).values
    assert all(failed[f"{level}_{key}"] == 0 for level in ("pd", "m", "ma", "mao") for key in ("f1", "hits"))
    assert (failed["predictions"], failed["truths"]) == (0, 3)
    static = S2O().score(truth(boxes((BODY,), SIZES[:2], (0, 0))), None).values
    assert static["mao_f1"] == static["pd_precision"] == 0
    assert S2O().score(None, prediction(CABINET)).values["pd_f1"] == 0
