"""URDF-Anything's protocol, flaws and all, on joints whose errors can be worked out by hand."""

import numpy as np
import pytest

from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.protocols.axis_lines import published_line_distance
from simart_kit.bench.protocols.urdf_anything import UrdfAnything

from .bench_boxes import BODY, boxes, hinge, prediction, slide, truth

X, Y, Z = np.eye(3)
SIDE = 2.0  # longest side of the object


def cupboard(*joints: LinkJoint, links: tuple[str, ...] = ()) -> Articulation:
    names = links or tuple(f"part_{i}" for i in range(len(joints)))
    parts = [Link(name, 0, joint) for name, joint in zip(names, joints, strict=True)]
    sizes = [((0, 0, 0), (1, SIDE, 1)), *[((1, 0, 0), (1.1, 1, 1))] * len(joints)]
    return boxes((BODY, *parts), sizes, range(len(sizes)))


def score(one: Articulation, two: Articulation) -> dict[str, float | None]:
    return dict(UrdfAnything().score(truth(one), prediction(two)).values)


def compared(true: LinkJoint, predicted: LinkJoint) -> dict[str, float | None]:
    return score(cupboard(true, links=("door",)), cupboard(predicted, links=("door",)))


def test_a_perfect_prediction_succeeds():
    one = cupboard(hinge((1, 0, 0), name="joint_0"), slide(name="joint_1"))
    values = score(one, one)
    assert set(values) == {metric.key for metric in UrdfAnything.metrics}
    assert [values[key] for key in ("success", "type_correct", "axis_within", "origin_within")] == [1] * 4
    assert values["axis_angle_error_rad"] == values["origin_xyz_error"] == 0
    assert (values["num_gt_joints"], values["num_pred_joints"], values["missing_joints"]) == (2, 2, 0)
    assert UrdfAnything().tag == "urdf-anything/1"


def test_joints_are_matched_by_name_and_by_that_of_the_link_where_they_have_none():
    one = cupboard(hinge((1, 0, 0), name="joint_0"), slide(), links=("a", "b"))
    two = cupboard(slide(), hinge((1, 0, 0), name="joint_0"), links=("b", "a"))
    renamed = cupboard(hinge((1, 0, 0), name="hinge"), slide(), links=("a", "b"))
    assert score(one, two)["success"] == 1
    assert (score(one, renamed)["success"], score(one, renamed)["missing_joints"]) == (0.5, 1)


def test_a_missing_joint_fails_everything_and_an_invented_one_costs_nothing():
    a, b = hinge((1, 0, 0), name="a"), hinge((1, 1, 0), name="b")
    missing = score(cupboard(a, b), cupboard(a))
    assert [missing[key] for key in ("success", "type_correct", "axis_within", "origin_within")] == [0.5] * 4
    assert missing["axis_angle_error_rad"] == 0  # of the joint that was found
    invented = score(cupboard(a), cupboard(a, b))
    assert (invented["success"], invented["num_pred_joints"]) == (1, 2)


def test_types_are_compared_word_by_word():
    turning = hinge((1, 0, 0), limits=None, kind="continuous")
    values = compared(hinge((1, 0, 0)), turning)
    assert (values["type_correct"], values["axis_within"], values["success"]) == (0, 1, 0)


@pytest.mark.parametrize(("angle", "right"), [(0.24, 1), (0.26, 0), (np.pi - 0.24, 1)])
def test_the_axis_may_be_a_quarter_radian_off_and_its_sign_is_ignored(angle, right):
    values = compared(hinge(), hinge(axis=(0, np.sin(angle), np.cos(angle))))
    assert values["axis_angle_error_rad"] == pytest.approx(min(angle, np.pi - angle))
    assert (values["axis_within"], values["success"]) == (right, right)


@pytest.mark.parametrize(("offset", "right"), [(0.19, 1), (0.21, 0)])
def test_half_the_origin_error_in_sides_of_the_object_may_be_five_hundredths(offset, right):
    # 0.05 * 2 for the half, * SIDE for the unit: 0.2. Of the axis Z, the y component is what is measured.
    values = compared(hinge(), hinge((0, offset, 0)))
    assert values["origin_xyz_error"] == pytest.approx(offset / SIDE)
    assert values["origin_combined_error"] == pytest.approx(offset / SIDE / 2)
    assert (values["origin_within"], values["success"]) == (right, right)


def test_a_hinge_on_the_other_side_has_no_error_where_axes_are_parallel():
    # The flaw: of Z, only the component along Z x X = Y is measured, and the other side is along X.
    values = compared(hinge((0, 0, 0)), hinge((1, 0, 0)))
    assert (values["origin_xyz_error"], values["success"]) == (0, 1)
    assert compared(hinge((0, 0, 0)), hinge((0.8, 0.6, 0)))["origin_xyz_error"] == pytest.approx(0.6 / SIDE)


def test_lines_that_cross_askew_have_their_true_distance():
    # X through the origin and Y at height 3: 3 apart, wherever the origins sit on them.
    assert published_line_distance(7 * X, X, 3 * Z - 5 * Y, Y) == pytest.approx(3)
    # At 45 degrees and in general: distance of the closest points by least squares.
    rng = np.random.default_rng(0)
    for p, a, q, b in rng.normal(size=(20, 4, 3)):
        a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
        along = np.linalg.lstsq(np.stack([a, -b], axis=1), q - p, rcond=None)[0]
        expected = np.linalg.norm(p + along[0] * a - q - along[1] * b)
        assert published_line_distance(p, a, q, b) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("true", "predicted", "expected"),
    [(X, X, 5), (-X, X, 5), (Y, Y, 5), (Z, Z, 3), (Z, -Z, 3), (X, -X, np.sqrt(4 + 9 + 25))],
    ids=["X x Y = Z", "-X x Y = -Z", "Y x X = -Z", "Z x X = Y", "-Z x X = -Y", "none: the origins"],
)
def test_of_parallel_lines_one_component_is_measured(true, predicted, expected):
    offset = np.array([2.0, 3.0, 5.0])
    assert published_line_distance(offset, true, np.zeros(3), predicted) == pytest.approx(expected)


def test_origins_of_slides_and_of_continuous_joints_are_compared_as_points():
    far = LinkJoint("prismatic", (1.0, 0.0, 0.0), (0.0, 0.6, 0.8), 0.0, 0.4)
    assert compared(slide(), far)["origin_xyz_error"] == pytest.approx(1 / SIDE)
    one, two = (hinge(at, limits=None, kind="continuous") for at in ((0, 0, 0), (0, 0, 1)))
    assert compared(one, two)["origin_xyz_error"] == pytest.approx(1 / SIDE)  # though on the same line
    unsaid = LinkJoint("prismatic", (1.0, 0.0, 0.0), None, 0.0, 0.4)
    assert compared(unsaid, unsaid)["success"] == 1


def test_a_joint_without_axis_is_a_right_angle_off_one_that_has_one():
    values = compared(hinge(), LinkJoint("free"))
    assert values["axis_angle_error_rad"] == pytest.approx(np.pi / 2)
    assert compared(LinkJoint("ball"), LinkJoint("ball"))["success"] == 1


def test_any_of_several_right_joints_may_be_predicted():
    link = Link("door", 0, hinge((0, 0, 0)), also=(hinge((0, 1, 0)),))
    one = boxes((BODY, link), [((0, 0, 0), (1, SIDE, 1)), ((1, 0, 0), (1.1, 1, 1))], (0, 1))
    assert score(one, cupboard(hinge((0, 1, 0)), links=("door",)))["success"] == 1
    assert score(one, cupboard(hinge((0, 0.5, 0)), links=("door",)))["success"] == 0


def test_a_failed_object_fails_all_of_its_joints_and_a_static_one_has_no_rates():
    one = cupboard(hinge(name="a"), slide(name="b"))
    failed = UrdfAnything().score(truth(one), None).values
    assert [failed[key] for key in ("success", "type_correct", "axis_within", "origin_within")] == [0] * 4
    assert (failed["num_gt_joints"], failed["missing_joints"]) == (2, 2)
    static = cupboard()
    assert score(static, one)["success"] is None
    assert UrdfAnything().score(truth(static), None).values["success"] == 0
    assert UrdfAnything().score(None, prediction(one)).values["success"] == 0


def test_the_size_and_place_of_the_object_change_nothing():
    one, two = cupboard(hinge((1, 0, 0))), cupboard(hinge((1.3, 0.3, 0), (0, 0.1, 1)))
    moved = np.diag([7.0, 7.0, 7.0, 1.0])
    moved[:3, 3] = (1, 2, 3)
    expected = score(one, two)
    assert score(one.transformed(moved), two.transformed(moved)) == pytest.approx(expected)
    assert expected["origin_xyz_error"] == pytest.approx(0.3 / SIDE)  # both lines run across X
