"""Metrics of joints and parts against hand-worked values and independent computations."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from simart_kit.bench.articulation import LinkJoint
from simart_kit.bench.metrics.joints import (
    angle,
    axis_error,
    direction_error,
    limits_iou,
    line_error,
    origin_error,
    range_error,
    same_coarse_type,
    same_type,
)
from simart_kit.bench.metrics.parts import detection, hierarchy, iou_matrix, match

HINGE = LinkJoint("revolute", (0, 0, 1), (0, 0, 0), 0.0, 1.0)


def hinge(axis=(0, 0, 1), origin=(0, 0, 0), lower=0.0, upper=1.0, kind="revolute"):
    return LinkJoint(kind, axis, origin, lower, upper)


@pytest.mark.parametrize("degrees", [0.0, 1e-5, 0.1, 37.0, 90.0])
def test_the_axis_error_is_the_angle_between_lines(degrees):
    turned = tuple(Rotation.from_euler("x", degrees, degrees=True).apply([0, 0, 1]))
    away = tuple(-np.array(turned))
    assert axis_error(HINGE, hinge(turned)) == pytest.approx(np.deg2rad(degrees), abs=1e-12)
    assert axis_error(HINGE, hinge(away)) == pytest.approx(np.deg2rad(degrees), abs=1e-12)


def test_the_angle_of_random_directions_is_that_of_the_rotation_between_them():
    rng = np.random.default_rng(0)
    for one, two in rng.normal(size=(50, 2, 3)):
        one, two = one / np.linalg.norm(one), two / np.linalg.norm(two)
        expected = Rotation.align_vectors([two], [one])[0].magnitude()
        assert angle(one, two) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize(
    ("axis", "lower", "upper", "expected"),
    [
        ((0, 0, 1), 0.0, 1.0, 0.0),
        ((0, 0, -1), -1.0, 0.0, 0.0),  # the same movement
        ((0, 0, -1), 0.0, 1.0, np.pi),
        ((0, 0, 1), -1.0, 0.0, np.pi),
        ((0, 0, 1), -0.1, 1.0, 0.0),  # a door that stands ajar
        ((1, 0, 0), 0.0, 1.0, np.pi / 2),
        ((0, 0, 1), -1.0, 1.0, None),  # opens to both sides
        ((0, 0, 1), None, None, None),
    ],
)
def test_the_direction_of_opening_takes_limits_into_account(axis, lower, upper, expected):
    error = direction_error(HINGE, hinge(axis, lower=lower, upper=upper))
    assert error == (None if expected is None else pytest.approx(expected))


def test_a_joint_that_opens_to_no_side_has_no_direction_to_miss():
    assert direction_error(hinge(lower=None, upper=None, kind="continuous"), HINGE) is None


def test_distances_of_the_origin_agree_with_a_search_along_the_line():
    rng = np.random.default_rng(1)
    for p, q, axis in rng.normal(size=(20, 3, 3)):
        true, predicted = hinge(tuple(axis), tuple(p)), hinge(origin=tuple(q))
        assert origin_error(true, predicted) == pytest.approx(np.sqrt(((p - q) ** 2).sum()))
        along = np.linspace(-20, 20, 400_001)[:, None] * (axis / np.linalg.norm(axis))
        nearest = np.linalg.norm(p + along - q, axis=1).min()
        assert line_error(true, predicted) == pytest.approx(nearest, abs=1e-4)


@pytest.mark.parametrize("kind", ["prismatic", "fixed", "ball", "free", "unknown"])
def test_the_origin_is_not_defined_for_joints_that_do_not_turn_about_an_axis(kind):
    other = LinkJoint(kind, (0, 0, 1), (5, 5, 5), 0.0, 1.0)
    assert origin_error(other, HINGE) is None
    assert origin_error(HINGE, other) is None
    assert line_error(other, HINGE) is None
    assert line_error(HINGE, other) is None


@pytest.mark.parametrize(
    ("predicted", "iou", "difference"),
    [
        (hinge(), 1.0, 0.0),
        (hinge(upper=0.5), 0.5, 0.5),
        (hinge(lower=-1.0), 0.5, 1.0),
        (hinge(lower=-0.5, upper=0.5), 1 / 3, 0.0),  # [0, 0.5] of [-0.5, 1]
        (hinge(axis=(0, 0, -1), lower=-1.0, upper=0.0), 1.0, 0.0),
        (hinge(axis=(0, 0, -1)), 0.0, 0.0),
        (hinge(lower=1.0, upper=0.0), 0.0, 1.0),  # reversed: no travel
        (hinge(lower=None, upper=None), 0.0, 1.0),
        (hinge(kind="prismatic"), 0.0, 1.0),
        (hinge(kind="continuous", lower=None, upper=None), 1 / (2 * np.pi), 2 * np.pi - 1),
    ],
)
def test_limits_are_compared_along_the_true_axis(predicted, iou, difference):
    assert limits_iou(HINGE, predicted) == pytest.approx(iou)
    assert range_error(HINGE, predicted) == pytest.approx(difference)


@pytest.mark.parametrize("kind", ["continuous", "ball", "fixed"])
def test_a_joint_without_limits_has_none_to_miss(kind):
    endless = LinkJoint(kind, (0, 0, 1), (0, 0, 0))
    assert limits_iou(endless, HINGE) is None
    assert range_error(endless, HINGE) is None


def test_continuous_is_revolute_by_the_coarse_type_only():
    endless = hinge(kind="continuous", lower=None, upper=None)
    assert (same_type(HINGE, endless), same_coarse_type(HINGE, endless)) == (0.0, 1.0)
    assert (same_type(HINGE, hinge(kind="prismatic")), same_coarse_type(HINGE, endless)) == (0.0, 1.0)
    assert same_coarse_type(HINGE, hinge(kind="prismatic")) == 0.0


def test_overlaps_agree_with_sets_counted_one_by_one():
    rng = np.random.default_rng(2)
    true, predicted = rng.integers(-1, 4, 300), rng.integers(-1, 5, 300)
    weights = rng.random(300)
    found = iou_matrix(true, predicted, weights, (4, 6))
    for a, b in itertools.product(range(4), range(6)):
        both = sum(w for t, p, w in zip(true, predicted, weights, strict=True) if t == a and p == b)
        either = sum(w for t, p, w in zip(true, predicted, weights, strict=True) if t == a or p == b)
        assert found[a, b] == pytest.approx(both / either)


def test_matching_finds_the_largest_sum_of_overlaps():
    rng = np.random.default_rng(3)
    for _ in range(30):
        iou = rng.random((3, 4))
        best = max(
            sum(iou[a, b] for a, b in enumerate(columns)) for columns in itertools.permutations(range(4), 3)
        )
        assert sum(iou[a, b] for a, b in match(iou)) == pytest.approx(best)


def test_parts_that_hardly_overlap_are_not_matched():
    assert match(np.array([[0.049, 0.0], [0.0, 0.05]])) == ((1, 1),)
    assert match(np.zeros((0, 3))) == ()


@pytest.mark.parametrize(
    ("iou", "expected"),
    [
        ([[0.9, 0.0], [0.0, 0.6]], (1.0, 1.0, 1.0)),
        ([[0.9, 0.0], [0.0, 0.4]], (0.5, 0.5, 0.5)),
        ([[0.9, 0.0, 0.0]], (1 / 3, 1.0, 0.5)),
        ([[0.5]], (1.0, 1.0, 1.0)),
        (np.zeros((2, 0)), (0.0, 0.0, 0.0)),
        (np.zeros((0, 2)), (0.0, 0.0, 0.0)),
        (np.zeros((0, 0)), (1.0, 1.0, 1.0)),
    ],
)
def test_precision_and_recall_count_pairs_that_overlap_by_half(iou, expected):
    table = np.array(iou, dtype=float)
    found = detection(table, match(table))
    assert (found.precision, found.recall, found.f1) == pytest.approx(expected)


def test_a_parent_is_right_when_it_is_the_match_of_the_true_parent():
    # True: a tray (1) on a door (0) on the body. Predicted: both on the body, in the other order.
    assert hierarchy([-1, 0], [-1, -1], [(0, 1), (1, 0)]) == [1.0, 0.0]
    assert hierarchy([-1, 0], [1, -1], [(0, 1), (1, 0)]) == [1.0, 1.0]
