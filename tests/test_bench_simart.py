"""The SIMART protocol on a wardrobe whose faults are seeded, with values worked out by hand.

The wardrobe fills the unit cube: floor z = 0, back y = 1, a left door x in 0..0.6 and a right one x in 0.6..1
in the plane y = 0, hinged at their outer edges and opening to -y. Its diagonal is sqrt(3). The left door is
a lower quarter and an upper three quarters, 0.15 and 0.45 of area; the right door has 0.4.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.cases import Prediction, Truth
from simart_kit.bench.protocols.simart import Simart

ROOT3, PI = np.sqrt(3.0), np.pi
LEFT_HINGE = LinkJoint("revolute", (0, 0, -1), (0, 0, 0), 0.0, PI / 2)
RIGHT_HINGE = LinkJoint("revolute", (0, 0, 1), (1, 0, 0), 0.0, PI / 2)
BODY, LEFT, RIGHT = Link("body"), Link("left", 0, LEFT_HINGE), Link("right", 0, RIGHT_HINGE)
DOORS = (BODY, LEFT, RIGHT)
# Faces in order: floor, back, lower and upper piece of the left door, right door; two triangles each.
LABELS = (0, 0, 1, 1, 2)


def quad(corner: tuple[float, ...], one: tuple[float, ...], two: tuple[float, ...]) -> np.ndarray:
    a, u, v = np.array(corner, float), np.array(one, float), np.array(two, float)
    return np.array([a, a + u, a + u + v, a + v])


def wardrobe(links: tuple[Link, ...] = DOORS, labels: tuple[int, ...] = LABELS) -> Articulation:
    quads = [
        quad((0, 0, 0), (1, 0, 0), (0, 1, 0)),
        quad((0, 1, 0), (1, 0, 0), (0, 0, 1)),
        quad((0, 0, 0), (0.6, 0, 0), (0, 0, 0.25)),
        quad((0, 0, 0.25), (0.6, 0, 0), (0, 0, 0.75)),
        quad((0.6, 0, 0), (0.4, 0, 0), (0, 0, 1)),
    ]
    faces = np.concatenate([np.array([[0, 1, 2], [0, 2, 3]]) + 4 * i for i in range(len(quads))])
    return Articulation("wardrobe", np.concatenate(quads), faces, np.repeat(labels, 2), links)


def with_left(joint: LinkJoint) -> Articulation:
    return wardrobe((BODY, replace(LEFT, joint=joint), RIGHT))


def scored(predicted: Articulation, true: Articulation | None = None) -> dict[str, float | None]:
    truth = Truth("wardrobe", true or wardrobe())
    return dict(Simart().score(truth, Prediction(predicted)).values)


PERFECT = {
    "type": 1, "type_coarse": 1, "axis": 0, "direction": 0, "origin": 0, "origin_line": 0, "limits_iou": 1,
    "iou": 1, "iou_voxel": 1, "cd": 0, "articulated_cd": 0, "articulated_giou": 1, "hierarchy": 1,
    "body_iou": 1, "precision": 1, "recall": 1, "f1": 1, "range_turn_matched": 0,
}  # fmt: skip

CHANGED = "some other value"
MOVED = {"articulated_cd": CHANGED, "articulated_giou": CHANGED}
SHAPES = dict.fromkeys(("iou_voxel", "iou_voxel_matched", "cd", "cd_matched"), CHANGED)
# What differs from a perfect score, for each fault. The other door is right: numbers are halved.
FAULTS: dict[str, tuple[Articulation, dict[str, float | str | None]]] = {
    "nothing": (wardrobe(), {}),
    # Both describe the same movement.
    "axis and limits turned around": (
        with_left(replace(LEFT_HINGE, axis=(0, 0, 1), lower=-PI / 2, upper=0.0)),
        {},
    ),
    # 0.1 beside the axis and 0.2 along it: |d| = sqrt(0.05).
    "shifted origin": (
        with_left(replace(LEFT_HINGE, origin=(0.1, 0.0, 0.2))),
        {"origin": np.sqrt(0.05) / 2, "origin_line": 0.05, **MOVED},
    ),
    "origin elsewhere on the axis": (
        with_left(replace(LEFT_HINGE, origin=(0.0, 0.0, 0.8))),
        {"origin": 0.4, "origin_line": 0.0},
    ),
    # Opens inwards: the range [0, pi/2] about -z is [-pi/2, 0] about z and does not overlap.
    "flipped axis": (
        with_left(replace(LEFT_HINGE, axis=(0, 0, 1))),
        {"direction": PI / 2, "limits_iou": 0.5, **MOVED},
    ),
    "mirrored limits": (
        with_left(replace(LEFT_HINGE, lower=-PI / 2, upper=0.0)),
        {"direction": PI / 2, "limits_iou": 0.5, **MOVED},
    ),
    # Lower above upper is no travel: it opens to no side, and half of its quarter turn is wrong on average.
    "reversed limits": (
        with_left(replace(LEFT_HINGE, lower=PI / 2, upper=0.0)),
        {"direction": PI / 2, "direction_matched": 0.0, "limits_iou": 0.5, "range_turn_matched": PI / 4,
         **MOVED},
    ),
    "half the range": (
        with_left(replace(LEFT_HINGE, upper=PI / 4)),
        {"limits_iou": 0.75, "range_turn_matched": PI / 8, **MOVED},
    ),
    "axis tilted by 30 degrees": (
        with_left(replace(LEFT_HINGE, axis=(0.5, 0.0, -ROOT3 / 2))),
        {"axis": PI / 12, "direction": PI / 12, **MOVED},
    ),
    # A slide along the hinge's axis: no hinge line to compare, so that half the diagonal counts.
    "wrong type": (
        with_left(LinkJoint("prismatic", (0, 0, -1), (0, 0, 0), 0.0, 1.0)),
        {"type": 0.5, "type_matched": 0.5,
         "type_coarse": 0.5, "type_coarse_matched": 0.5,
         "origin": ROOT3 / 4, "origin_matched": 0.0, "origin_line": ROOT3 / 4, "origin_line_matched": 0.0,
         "limits_iou": 0.5, "range_turn_matched": PI / 4, **MOVED},
    ),
    # Right kind by the coarse measure; of [-pi, pi] a quarter is the true range.
    "continuous for revolute": (
        with_left(LinkJoint("continuous", (0, 0, -1), (0, 0, 0))),
        {"type": 0.5, "direction": PI / 2, "direction_matched": 0.0, "limits_iou": 0.625,
         "range_turn_matched": 0.75 * PI, **MOVED},
    ),
    # The hinge at the door's other edge, turned so that it opens outwards again.
    "mirrored hinge": (
        with_left(LinkJoint("revolute", (0, 0, 1), (0.6, 0, 0), 0.0, PI / 2)),
        {"origin": 0.3, "origin_line": 0.3, "direction": PI / 2, "limits_iou": 0.5,
         **MOVED},
    ),
    # Nothing to compare: the worst of everything, and no matched part.
    "body only": (
        wardrobe((BODY,), (0, 0, 0, 0, 0)),
        {"type": 0, "type_coarse": 0, "axis": PI / 2, "direction": PI, "origin": ROOT3 / 2,
         "origin_line": ROOT3 / 2, "limits_iou": 0, "iou": 0, "iou_voxel": 0, "cd": ROOT3 / 2,
         "articulated_cd": ROOT3 / 2, "articulated_giou": -1, "hierarchy": 0, "body_iou": 2 / 3,
         "precision": 0, "recall": 0, "f1": 0,
         "type_matched": None, "axis_matched": None, "iou_matched": None, "range_turn_matched": None},
    ),
    # One part of area 1 on the left hinge: IoU 0.6 with the left door; the right one is missed. Two entries,
    # the pair and the worst.
    "merged doors": (
        wardrobe((BODY, LEFT), (0, 0, 1, 1, 1)),
        {"type": 1 / 2, "type_coarse": 1 / 2, "axis": PI / 4, "direction": PI / 2,
         "origin": ROOT3 / 4, "origin_line": ROOT3 / 4, "limits_iou": 1 / 2, "iou": (0.6 + 0) / 2,
         "iou_matched": 0.6, **SHAPES, **MOVED, "hierarchy": 1 / 2, "recall": 0.5, "f1": 2 / 3},
    ),
    # The left door as two: IoU 0.75 with its upper piece, the lower one is invented. Three entries, two pairs
    # and the worst.
    "one part split in two": (
        wardrobe((BODY, LEFT, RIGHT, replace(LEFT, name="lower")), (0, 0, 3, 1, 2)),
        {"type": 2 / 3, "type_coarse": 2 / 3, "axis": PI / 6, "direction": PI / 3,
         "origin": ROOT3 / 6, "origin_line": ROOT3 / 6, "limits_iou": 2 / 3,
         "iou": (0.75 + 1 + 0) / 3, "iou_matched": 0.875, **SHAPES, **MOVED,
         "hierarchy": 2 / 3, "precision": 2 / 3, "f1": 0.8},
    ),
    # The floor slides: one part of three is invented. The body keeps the back, half of its area.
    "invented part": (
        wardrobe((*DOORS, Link("tray", 0, LinkJoint("prismatic", (0, 1, 0), (0, 0, 0), 0.0, 0.3))),
                 (3, 0, 1, 1, 2)),
        {"type": 2 / 3, "type_coarse": 2 / 3, "axis": PI / 6, "direction": PI / 3, "limits_iou": 2 / 3,
         "origin": ROOT3 / 6, "origin_line": ROOT3 / 6, "iou": 2 / 3, "iou_voxel": 2 / 3,
         "cd": ROOT3 / 6, "articulated_cd": ROOT3 / 6, "articulated_giou": 1 / 3,
         "hierarchy": 2 / 3, "body_iou": 0.5, "precision": 2 / 3, "f1": 0.8},
    ),
    "door that hangs on the other door": (
        wardrobe((BODY, LEFT, replace(RIGHT, parent=1))),
        {"hierarchy": 0.5, **MOVED},
    ),
    # A handle that is fixed to the door is a piece of it.
    "door of two links fixed to each other": (
        wardrobe((BODY, LEFT, RIGHT, Link("kick plate", 1)), (0, 0, 3, 1, 2)),
        {},
    ),
}  # fmt: skip


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_costs_what_it_should(fault):
    predicted, differs = FAULTS[fault]
    expected = {**PERFECT, **differs}
    scores = scored(predicted)
    unpenalised = {"body only", "merged doors", "one part split in two", "invented part"}
    for key, value in expected.items():
        if value == CHANGED:
            continue  # not worked out by hand; see the tests below
        assert scores[key] == (None if value is None else pytest.approx(value, abs=1e-9)), key
        twin = f"{key}_matched"
        if fault not in unpenalised and twin in scores and twin not in differs:
            assert scores[twin] == pytest.approx(value, abs=1e-9), twin


@pytest.mark.parametrize(
    "fault", [name for name, (_, differs) in FAULTS.items() if "articulated_cd" in differs]
)
def test_a_fault_shows_in_the_moved_parts(fault):
    scores = scored(FAULTS[fault][0])
    assert 0.0 < scores["articulated_cd"] <= ROOT3 / 2
    assert -1.0 <= scores["articulated_giou"] < 1.0


def test_a_part_that_moves_half_as_far_is_off_by_a_quarter_of_its_travel():
    # The left door slides out by 0.4, or by 0.2 as predicted. Over states 0, 1/4, .. 1 the distance of
    # the two parallel planes is 0, 0.05, .. 0.2, whose mean is 0.1; of the other door it is 0.
    true = with_left(LinkJoint("prismatic", (0, -1, 0), (0, 0, 0), 0.0, 0.4))
    predicted = with_left(LinkJoint("prismatic", (0, -1, 0), (0, 0, 0), 0.0, 0.2))
    scores = scored(predicted, true)
    assert scores["articulated_cd"] == pytest.approx(0.05)
    assert scores["range_slide_matched"] == pytest.approx(0.2)
    assert scores["limits_iou"] == pytest.approx(0.75)


def test_of_several_right_joints_the_one_that_was_predicted_counts():
    slide = LinkJoint("prismatic", (0, -1, 0), (0, 0, 0), 0.0, 0.4)
    true = wardrobe((BODY, replace(LEFT, also=(slide,)), RIGHT))
    assert scored(with_left(slide), true)["type"] == 1.0
    assert scored(with_left(slide), true)["articulated_cd"] == pytest.approx(0.0, abs=1e-12)
    assert scored(wardrobe(), true)["type"] == 1.0


def test_lengths_are_in_sizes_of_the_object_whatever_its_unit():
    predicted = with_left(replace(LEFT_HINGE, origin=(0.1, 0.0, 0.2)))
    in_millimetres = np.diag([1000.0, 1000.0, 1000.0, 1.0])
    moved = in_millimetres.copy()
    moved[:3, 3] = 7000.0
    scores = scored(predicted.transformed(moved), wardrobe().transformed(moved))
    assert scores["origin"] == pytest.approx(np.sqrt(0.05) / 2)
    assert scores["cd"] == pytest.approx(0.0, abs=1e-9)


STATIC = wardrobe((BODY,), (0, 0, 0, 0, 0))


def test_a_static_object_is_right_when_nothing_is_predicted():
    scores = scored(STATIC, STATIC)
    assert [scores[key] for key in ("type", "iou", "precision", "recall", "f1", "body_iou")] == [1.0] * 6
    assert scores["cd"] == 0.0
    assert scores["axis"] is None  # there is no joint to measure


def test_a_part_invented_on_a_static_object_scores_nothing():
    scores = scored(wardrobe((BODY, LEFT), (0, 0, 1, 1, 0)), STATIC)
    assert [scores[key] for key in ("type", "iou", "precision", "f1")] == [0.0] * 4
    assert scores["cd"] == pytest.approx(ROOT3 / 2)
    assert scores["axis"] is None  # truth has none: a number for it would be of other objects than another's


def test_a_match_costs_no_more_than_a_miss():
    # A right hinge whose origin is said to be 1000 away along the axis counts like half the diagonal.
    far = with_left(replace(LEFT_HINGE, origin=(0.0, 0.0, 1000.0)))
    assert scored(far)["origin"] == pytest.approx(ROOT3 / 4)
    assert scored(far)["origin_matched"] == pytest.approx(500.0)


def test_numbers_that_truth_does_not_have_are_not_defined_whatever_is_predicted():
    drawers = with_left(LinkJoint("prismatic", (0, -1, 0), (0, 0, 0), 0.0, 0.4))
    drawers = replace(drawers, links=(BODY, drawers.links[1], replace(RIGHT, joint=drawers.links[1].joint)))
    for predicted in (drawers, wardrobe(), STATIC):
        assert scored(predicted, drawers)["origin"] is None
        assert scored(predicted, drawers)["axis"] is not None


@pytest.mark.parametrize("flipped", [False, True])
def test_a_joint_that_swings_to_both_sides_is_compared_in_one_direction(flipped):
    # Neither limits nor axes tell at which end a swing starts: turning both around changes nothing.
    swing = replace(LEFT_HINGE, lower=-1.0, upper=1.0)
    wider = replace(LEFT_HINGE, lower=-1.0, upper=1.3)
    if flipped:
        swing = replace(swing, axis=(0, 0, 1))
        wider = replace(wider, axis=(0, 0, 1), lower=-1.3, upper=1.0)
    as_it_was = scored(
        with_left(replace(LEFT_HINGE, lower=-1.0, upper=1.3)),
        with_left(replace(LEFT_HINGE, lower=-1.0, upper=1.0)),
    )
    found = scored(with_left(wider), with_left(swing))
    assert found["articulated_cd"] == pytest.approx(as_it_was["articulated_cd"], abs=1e-9)
    assert 0.0 < found["articulated_cd"] < 0.05  # at most 0.3 rad off, and that at one end only


def test_where_truth_moves_an_asset_that_does_not_is_not_executable(tmp_path):
    file = tmp_path / "still.xml"
    file.write_text("<mujoco><worldbody><body><geom size='1'/></body></worldbody></mujoco>")
    for true, expected in ((wardrobe(), 0.0), (STATIC, 1.0)):
        scores = Simart().score(Truth("it", true), Prediction(STATIC, file)).values
        assert (scores["loads"], scores["executable"]) == (1.0, expected)


@pytest.mark.parametrize("static", [False, True], ids=["moving", "static"])
def test_a_failed_object_scores_no_better_than_one_for_which_nothing_was_found(static):
    true = STATIC if static else wardrobe()
    failed = dict(Simart().score(Truth("wardrobe", true), None).values)
    honest = scored(STATIC, true)
    for metric in Simart.metrics:
        mine, other = failed[metric.key], honest[metric.key]
        if other is None or mine is None or metric.key == "body_iou":
            continue
        assert mine <= other if metric.better == "higher" else mine >= other, metric.key
    assert failed["body_iou"] == 0.0
    assert failed["executable"] == 0.0


def test_an_object_whose_truth_cannot_be_read_scores_the_worst():
    values = Simart().score(None, None).values
    assert values["type"] == 0.0
    assert values["origin"] == pytest.approx(ROOT3 / 2)
    assert values["iou_matched"] is None


def test_a_failed_object_has_a_row_for_every_part_that_was_missed():
    parts = Simart().score(Truth("wardrobe", wardrobe()), None).parts
    assert [(row["outcome"], row["true"]) for row in parts] == [("missed", "left"), ("missed", "right")]


def test_every_part_has_a_row_that_says_how_it_ended():
    predicted = wardrobe((BODY, LEFT, Link("tray", 0, LEFT_HINGE)), (2, 0, 1, 1, 0))
    parts = Simart().score(Truth("wardrobe", wardrobe()), Prediction(predicted)).parts
    assert [(row["outcome"], row.get("true"), row.get("predicted")) for row in parts] == [
        ("matched", "left", "left"),
        ("missed", "right", None),
        ("invented", None, "tray"),
    ]
