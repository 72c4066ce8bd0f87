"""Particulate's protocol on clouds and boxes whose numbers can be worked out by hand."""

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.protocols.particulate import Particulate
from simart_kit.bench.protocols.particulate_clouds import part_clouds, travel
from simart_kit.bench.protocols.particulate_pairs import moved_giou

from .bench_boxes import BODY, boxes, cloud, corners, hinge, prediction, slide, truth

CUBE = corners((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))  # with it, the unit frame is the object's own
REST, MOVED = "rest_per_part_avg_", "fully_per_part_articulated_avg_"
PUNISHED = [f"{when}{what}" for when in (REST, MOVED) for what in ("chamfer", "giou", "mIoU")]
DOOR = corners((0, 0, 0), (0.2, 0.2, 0.2))


def score(one: Articulation, two: Articulation) -> dict[str, float | None]:
    return dict(Particulate().score(truth(one), prediction(two)).values)


def door(points: np.ndarray = DOOR, joint: LinkJoint | None = None, name: str = "door"):
    return Link(name, 0, slide() if joint is None else joint), points


def chamfer_by_brute_force(a: np.ndarray, b: np.ndarray) -> float:
    squared = cdist(a, b, "sqeuclidean")
    return float(squared.min(axis=1).mean() + squared.min(axis=0).mean())


def test_the_protocol_gives_exactly_the_metrics_it_declares():
    protocol = Particulate()
    keys = [metric.key for metric in protocol.metrics]
    assert protocol.tag == "particulate/1"
    assert len(set(keys)) == len(keys) == 14
    assert set(score(cloud((BODY, CUBE)), cloud((BODY, CUBE)))) == set(keys)


@pytest.mark.slow
def test_a_perfect_prediction_is_perfect_whatever_its_scale_place_and_order_of_faces():
    links = (BODY, Link("door", 0, hinge((1, 1, 0))), Link("drawer", 0, slide((0, -1, 0))))
    sizes = [((0, 0, 0), (2, 1, 1)), ((2, 0, 0), (2.2, 1, 1)), ((0, -0.4, 0), (1, 0, 0.5))]
    one = boxes(links, sizes, (0, 1, 2))
    shuffled = np.random.default_rng(3).permutation(36)
    two = Articulation("p", one.vertices, one.faces[shuffled], one.labels[shuffled], links)
    moved = np.diag([3.0, 3.0, 3.0, 1.0])
    moved[:3, 3] = (5, -2, 1)
    for key, value in score(one, two.transformed(moved)).items():
        assert value == pytest.approx(0.0 if "chamfer" in key else 1.0, abs=1e-6), key


def test_a_shifted_part_has_the_overlap_and_distance_of_its_box():
    values = score(cloud((BODY, CUBE), door()), cloud((BODY, CUBE), door(DOOR + (0.1, 0, 0))))
    # Boxes 0..0.2 and 0.1..0.3: IoU 1/3, and they fill their enclosing box. Each corner is 0.1 off, both
    # ways: 2 * 0.01. The body is right and is half of the parts.
    assert values[f"{REST}mIoU"] == pytest.approx((1 + 1 / 3) / 2)
    assert values[f"{REST}giou"] == pytest.approx((1 + 1 / 3) / 2)
    assert values[f"{REST}chamfer"] == pytest.approx(0.02 / 2)
    assert values[f"{REST}mIoU_nopunish"] == values[f"{REST}mIoU"]
    # Both move alike, so every state has what the rest has.
    assert values[f"{MOVED}chamfer"] == pytest.approx(0.02 / 2)
    assert values[f"{MOVED}giou"] == pytest.approx((1 + 1 / 3) / 2)
    assert values[f"{MOVED}mIoU"] == pytest.approx((1 + 1 / 3) / 2)


def test_boxes_with_a_gap_have_a_negative_giou():
    values = score(cloud((BODY, CUBE), door()), cloud((BODY, CUBE), door(DOOR + (0.3, 0, 0))))
    # 0..0.2 and 0.3..0.5: nothing shared, 0.4 of 0.5 filled: -0.1 / 0.5.
    assert values[f"{REST}giou"] == pytest.approx((1 - 0.2) / 2)


@pytest.mark.parametrize("missed", [True, False], ids=["missed", "invented"])
def test_a_part_without_partner_is_punished_in_one_of_the_two_directions(missed):
    more = cloud((BODY, CUBE), door(), door(DOOR - 0.3, name="other"))
    less = cloud((BODY, CUBE), door())
    values = score(more, less) if missed else score(less, more)
    # One direction: two of three parts perfect; the other: two of two. Half the predicted cube's diagonal.
    assert values[f"{REST}mIoU"] == pytest.approx((2 / 3 + 1) / 2)
    assert values[f"{REST}giou"] == pytest.approx(((1 + 1 - 1) / 3 + 1) / 2)
    assert values[f"{REST}chamfer"] == pytest.approx((np.sqrt(3) / 2 / 3 + 0) / 2)
    assert values[f"{MOVED}chamfer"] == pytest.approx((np.sqrt(3) / 2 / 3 + 0) / 2)
    assert values[f"{REST}chamfer_nopunish"] == pytest.approx(0)
    assert values[f"{REST}giou_nopunish"] == pytest.approx(1)
    assert values[f"{MOVED}mIoU_nopunish"] == pytest.approx(1)


def test_the_penalty_is_half_the_diagonal_of_the_predicted_cloud_not_of_the_true_one():
    flat = corners((-0.5, -0.5, -0.25), (0.5, 0.5, 0.25))  # diagonal 1.5
    values = score(cloud((BODY, CUBE), door()), cloud((BODY, flat)))
    # Body against body: every corner 0.25 off, both ways: 0.125. True parts have 0.125 and 0.75, predicted
    # ones 0.125.
    assert values[f"{REST}chamfer_nopunish"] == pytest.approx(0.125)
    assert values[f"{REST}chamfer"] == pytest.approx(((0.125 + 0.75) / 2 + 0.125) / 2)


def test_parts_are_matched_by_the_means_of_their_points_not_by_name():
    one = cloud((BODY, CUBE), door(DOOR, name="a"), door(DOOR - 0.4, name="b"))
    two = cloud((BODY, CUBE), door(DOOR - 0.4, name="a"), door(DOOR, name="b"))
    rows = Particulate().score(truth(one), prediction(two)).parts
    assert {(row["true"], row["predicted"]) for row in rows} == {("body", "body"), ("a", "b"), ("b", "a")}


def test_a_slide_the_wrong_way_is_right_at_rest_and_wrong_when_open():
    at = np.array([[0.1, 0.2, 0.0]])
    values = score(
        cloud((BODY, CUBE), door(at, slide((1, 0, 0), 0.4))),
        cloud((BODY, CUBE), door(at, slide((-1, 0, 0), 0.4))),
    )
    # In state f the one point is 0.8 f off, both ways: 2 * 0.64 f^2. Of 0, 1/4, 1/2, 3/4 and 1, f^2 has a
    # mean of 0.375.
    assert values[f"{REST}chamfer"] == 0
    assert values[f"{MOVED}chamfer"] == pytest.approx((0 + 2 * 0.64 * 0.375) / 2)
    whole = [
        chamfer_by_brute_force(
            np.concatenate([CUBE, at + (0.4 * f, 0, 0)]), np.concatenate([CUBE, at - (0.4 * f, 0, 0)])
        )
        for f in (0, 0.25, 0.5, 0.75, 1)
    ]
    assert values["rest_overall_chamfer"] == 0
    assert values["fully_articulated_overall_chamfer_distances"] == pytest.approx(np.mean(whole))


def test_states_go_from_lower_to_upper_and_not_from_rest_outwards():
    at = np.array([[0.4, 0.0, 0.0]])
    values = score(
        cloud((BODY, CUBE), door(at, hinge(limits=(0.0, np.pi / 2)))),
        cloud((BODY, CUBE), door(at, hinge(limits=(-np.pi / 2, 0.0)))),
    )
    # A right angle apart in every state: 2 * 0.16 squared, both ways.
    assert values[f"{MOVED}chamfer_nopunish"] == pytest.approx((0 + 2 * 0.32) / 2)


def test_a_continuous_joint_without_limits_makes_one_turn():
    at = np.array([[0.4, 0.0, 0.0]])
    turning, still = hinge(limits=None, kind="continuous"), hinge(limits=None)
    values = score(cloud((BODY, CUBE), door(at, turning)), cloud((BODY, CUBE), door(at, still)))
    # 0, 90, 180, 270, 360 degrees: squared chords 2 * 0.16 * (1 - cos) = 0, 0.32, 0.64, 0.32, 0, both ways.
    assert values[f"{MOVED}chamfer_nopunish"] == pytest.approx((0 + 2 * 1.28 / 5) / 2)
    assert travel(hinge(limits=(-1.0, 2.0), kind="continuous")) == (-1.0, 2.0)


def test_a_part_moves_with_the_one_that_carries_it():
    at = np.array([[0.4, 0.0, 0.0]])
    arm = corners((0.0, 0.2, 0.0), (0.1, 0.3, 0.1))
    quarter = hinge(limits=(0.0, np.pi / 2))
    carried = cloud((BODY, CUBE), (Link("arm", 0, quarter), arm), (Link("tip", 1, slide(upper=0.1)), at))
    loose = cloud((BODY, CUBE), (Link("arm", 0, quarter), arm), (Link("tip", 0, slide(upper=0.1)), at))
    tips = [
        row for row in Particulate().score(truth(carried), prediction(loose)).parts if row["true"] == "tip"
    ]
    # The carried tip is turned by f * 90 degrees as well, 0.4 + 0.1 f away from the hinge.
    f = np.linspace(0, 1, 5)
    expected = 2 * 2 * (0.4 + 0.1 * f) ** 2 * (1 - np.cos(f * np.pi / 2))
    assert tips[0][f"{MOVED}chamfer"] == pytest.approx(expected.mean())


def test_boxes_that_part_when_moved_keep_the_giou_of_the_boxes_at_rest():
    box = np.array([[0, 0, 0], [0.2, 0.2, 0.2]])
    away, half = np.eye(4), np.eye(4)
    away[0, 3], half[0, 3] = 0.4, 0.1
    # Moved apart: IoU 0, union 2 v, but the enclosing box at rest has v only: 0 - (v - 2 v) / v.
    assert moved_giou(box, box, away) == pytest.approx(1.0)
    # Half shared: IoU 1/3, union 1.5 v: 1/3 + 0.5; from 2048 points in each box.
    assert moved_giou(box, box, half) == pytest.approx(1 / 3 + 0.5, abs=0.02)


def test_a_pair_of_flat_boxes_has_giou_minus_one():
    panel = corners((0, 0, 0.1), (0.2, 0.2, 0.1))
    values = score(cloud((BODY, CUBE), door(panel)), cloud((BODY, CUBE), door(panel)))
    assert values[f"{REST}giou"] == 0  # the mean of 1, of the body, and -1
    assert values[f"{REST}giou_nopunish"] == 0
    assert values[f"{REST}chamfer"] == 0


def test_surfaces_are_sampled_by_area_and_small_parts_that_get_no_point_are_no_parts():
    links = (BODY, Link("door", 0, slide()), Link("screw", 0, slide()))
    sizes = [((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (2, 1, 1)), ((0.5, 0.5, 0.5), (0.5005, 0.5005, 0.5005))]
    one, two = part_clouds(boxes(links, sizes, (0, 1, 2)), boxes(links[:2], sizes[:2], (0, 1)))
    assert one.parts == two.parts == (0, 1)  # the screw has 1e-7 of the area
    assert [len(points) for points in one.part_points] == [50_000, 50_000]
    assert np.abs(one.points).max() == pytest.approx(0.5, abs=1e-6)


@pytest.mark.slow
def test_another_mesh_of_the_same_shape_is_nearly_perfect():
    links = (BODY, Link("door", 0, slide((0, 1, 0), 0.1)))
    one = boxes(links, [((0, 0, 0), (2, 1, 1)), ((2, 0, 0), (2.5, 1, 1))], (0, 1))
    sizes = [((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (2, 1, 1)), ((2, 0, 0), (2.5, 1, 1))]
    values = score(one, boxes(links, sizes, (0, 0, 1)))  # an inner wall more
    assert values[f"{REST}mIoU"] == pytest.approx(1, abs=0.01)
    assert 0 < values[f"{REST}chamfer"] < 0.02
    assert values[f"{MOVED}giou"] == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("height", [1.0, 0.1])
def test_a_failed_object_is_never_better_than_one_of_which_only_the_body_was_found(height):
    links = (BODY, Link("a", 0, slide(upper=0.0)), Link("b", 0, slide(upper=0.0)))
    sizes = [((0, 0, 0), (1, 1, height)), ((1, 0, 0), (1.1, 1, 0.1)), ((1.1, 0, 0), (1.2, 1, 0.1))]
    one = boxes(links, sizes, (0, 1, 2))
    honest = score(one, boxes((BODY,), sizes, (0, 0, 0)))
    failed = dict(Particulate().score(truth(one), None).values)
    unread = dict(Particulate().score(None, prediction(one)).values)
    assert failed == unread
    for metric in Particulate.metrics:
        a, b = honest[metric.key], failed[metric.key]
        if metric.key.endswith("_nopunish"):
            assert b is None
        else:
            assert a is not None
            assert b is not None
            assert b >= a if metric.better == "lower" else b <= a
    assert failed[f"{REST}giou"] == -1


def test_a_prediction_that_labels_nothing_gets_the_worst_for_its_parts():
    one = cloud((BODY, CUBE), door())
    empty = Articulation("e", one.vertices, one.faces, np.full(len(one.vertices), -1), (BODY,))
    values = score(one, empty)
    assert [values[key] for key in PUNISHED] == pytest.approx([np.sqrt(3) / 2, -1, 0] * 2)
    assert values["rest_overall_chamfer"] == 0
