"""Frames of the bench, faces found again in another order, and the samples that parts are compared by."""

import time
from itertools import permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simart_kit.bench.articulation import Articulation, Link, LinkJoint
from simart_kit.bench.cases import Prediction, Truth
from simart_kit.bench.frame import MISFIT, Placement, place, same_faces, unit_from_object
from simart_kit.bench.metrics.parts import iou_matrix
from simart_kit.bench.overlay import overlay
from simart_kit.errors import BadInputError
from simart_kit.testing.meshes import box

SLIDE = LinkJoint("prismatic", axis=(0.0, 1.0, 0.0), origin=(0.0, 0.0, 0.0), lower=0.0, upper=0.5)


def boxes(*bounds, subdivisions=0, name="boxes"):
    """Boxes as links, the first a root and the rest sliding on it; faces split in four so many times."""
    corners, labels = [], []
    for link, (lower, upper) in enumerate(bounds):
        vertices, faces = box(lower, upper)
        triangles = vertices[faces]
        for _ in range(subdivisions):
            triangles = split(triangles)
        corners.append(triangles)
        labels += [link] * len(triangles)
    links = tuple(Link(f"part{i}", 0 if i else -1, SLIDE if i else LinkJoint()) for i in range(len(bounds)))
    return soup(np.concatenate(corners), labels, links, name)


def soup(triangles, labels, links, name="soup"):
    return Articulation(
        name, triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3), labels, links
    )


def split(triangles):
    a, b, c = triangles.transpose(1, 0, 2)
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    pieces = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.concatenate([np.stack(piece, axis=1) for piece in pieces])


def shuffled(value, seed=0, flipped=0.0):
    """The same faces in another order, corners turned, a share flipped; and where each went: (F,) index."""
    rng = np.random.default_rng(seed)
    order = rng.permutation(len(value.faces))
    corners = (np.arange(3) + rng.integers(0, 3, (len(order), 1))) % 3
    corners = np.where(rng.random((len(order), 1)) < flipped, corners[:, ::-1], corners)
    triangles = np.take_along_axis(value.triangles[order], corners[:, :, None], axis=1)
    return soup(triangles, value.labels[order], value.links), np.argsort(order)


def cloud(points, labels):
    return Articulation("cloud", points, np.zeros((0, 3)), labels, (Link("a"), Link("b")))


def placed(prediction, truth, **placement):
    return place(
        Prediction(prediction), Truth("t", truth, up=placement.pop("true_up", "+z")), Placement(**placement)
    )


CABINET = boxes(((0, 0, 0), (2, 1, 3)), ((0, -0.1, 0), (2, 0, 3)))


def test_the_unit_frame_centres_a_box_and_makes_its_longest_side_1():
    # Sides 2, 4, 1 about (2, 4, 0.5): 1/4 of it, so lower (-1, -2, -0.5)/4.
    unit = unit_from_object(np.array([[1.0, 2.0, 0.0], [3.0, 6.0, 1.0]]))
    corners = np.array([[1, 2, 0, 1], [3, 6, 1, 1]]) @ unit.T
    np.testing.assert_allclose(corners, [[-0.25, -0.5, -0.125, 1], [0.25, 0.5, 0.125, 1]], atol=1e-15)


@pytest.mark.parametrize("corner", [0.0, np.inf, 1e308])
def test_a_box_without_a_finite_size_has_no_unit_frame(corner):
    bounds = np.array([[-corner] * 3, [corner] * 3])
    if np.isinf(corner):
        bounds[0] = 0.0
    with pytest.raises(BadInputError, match="the object has a box of size"):
        unit_from_object(bounds)


@pytest.mark.parametrize(
    ("placement", "text"),
    [
        (Placement(), "as is"),
        (Placement("+z"), "up +z"),
        (Placement(fit="box"), "fitted to the truth's box"),
        (Placement("-y", "box"), "up -y, fitted to the truth's box"),
    ],
)
def test_a_placement_says_what_it_does(placement, text):
    assert placement.text == text


def test_a_prediction_as_it_is_stays_where_it_is_and_gets_no_note():
    result = placed(CABINET, CABINET)
    np.testing.assert_array_equal(result.articulation.vertices, CABINET.vertices)
    assert result.notes == ()


def test_a_prediction_with_z_up_is_turned_to_a_truth_with_y_up():
    # glTF's (x, y, z) is our (x, -z, y): so our (x, y, z) is glTF's (x, z, -y).
    x, y, z = CABINET.vertices.T
    truth = Articulation("t", np.stack([x, z, -y], axis=1), CABINET.faces, CABINET.labels, CABINET.links)
    result = placed(CABINET, truth, up="+z", true_up="+y")
    np.testing.assert_allclose(result.articulation.vertices, truth.vertices, atol=1e-12)
    np.testing.assert_allclose(result.articulation.links[1].joint.axis, (0, 0, -1), atol=1e-12)
    assert result.notes == ()


def test_fitting_gives_a_prediction_the_centre_and_longest_side_of_the_truth_and_says_so():
    away = np.diag([0.1, 0.1, 0.1, 1.0])
    away[:3, 3] = (5, 6, 7)
    result = placed(CABINET.transformed(away), CABINET, fit="box")
    np.testing.assert_allclose(result.articulation.vertices, CABINET.vertices, atol=1e-9)
    assert result.articulation.links[1].joint.upper == pytest.approx(0.5)  # a slide grows with its object
    (note,) = result.notes
    assert note.startswith("fitted to the truth's box: scaled by 10,")


def test_a_box_far_from_the_truths_is_noted_and_one_near_it_is_not():
    for shift, noted in ((0.35, True), (0.25, False)):  # of a longest side of 3: a tenth is 0.3
        moved = np.eye(4)
        moved[1, 3] = shift
        notes = placed(CABINET.transformed(moved), CABINET).notes
        assert any("differs from the truth's by 0.12 of its size" in note for note in notes) == noted


def test_a_prediction_that_knows_its_frame_is_checked_and_not_told_of_options():
    moved = np.eye(4)
    moved[1, 3] = 0.35
    prediction = CABINET.transformed(moved)
    result = place(Prediction(prediction), Truth("t", CABINET), None)
    assert result.articulation is prediction
    (note,) = result.notes
    assert note.startswith(MISFIT)
    assert "--up" not in note
    assert "--up" in placed(prediction, CABINET).notes[0]


def test_fitting_what_has_no_size_is_refused():
    with pytest.raises(BadInputError, match="the prediction has a box of size 0"):
        placed(cloud([[1.0, 2.0, 3.0]], [0]), CABINET, fit="box")


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 60), st.sampled_from([0.0, 1e-7, 2e-5]))
def test_shuffled_faces_with_turned_corners_and_rounding_are_found(seed, count, noise):
    rng = np.random.default_rng(seed)
    value = soup(rng.uniform(size=(count, 3, 3)), np.zeros(count), (Link("a"),))
    other, where = shuffled(value, seed, flipped=0.5)
    rough = soup(other.triangles + noise * rng.uniform(-1, 1, (count, 3, 3)) / 2, other.labels, other.links)
    np.testing.assert_array_equal(same_faces(value, rough), where)


def test_faces_in_the_same_order_are_their_own_partners():
    np.testing.assert_array_equal(same_faces(CABINET, CABINET), np.arange(24))


def test_copies_of_a_face_get_a_partner_each_of_the_same_winding():
    one = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    other = one + (0, 0, 1)
    back = one[::-1]
    truth = soup(np.array([one, back, one, other]), [0, 1, 0, 0], (Link("a"), Link("b")))
    prediction = soup(np.array([other, back[[1, 2, 0]], one, one[[2, 0, 1]]]), [0, 1, 0, 0], truth.links)
    partner = same_faces(truth, prediction)
    np.testing.assert_array_equal(partner, [2, 1, 3, 0])
    np.testing.assert_array_equal(prediction.labels[partner], truth.labels)


def test_triangles_about_one_centre_are_told_apart():
    # Corners sum to 0: all centroids are exactly there.
    one = np.array([[3.0, 0, 0], [-3, 3, 0], [0, -3, 0]])
    value = soup(np.array([one, -one, 2 * one]), [0, 0, 0], (Link("a"),))
    for order in permutations(range(3)):
        other = soup(value.triangles[list(order)], [0, 0, 0], (Link("a"),))
        np.testing.assert_array_equal(same_faces(value, other), np.argsort(order))


def test_many_copies_of_a_face_do_not_take_for_ever():
    one = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    value = soup(
        np.concatenate([np.tile(one, (20_000, 1, 1)), [one + (0, 0, 1)]]), [0] * 20_001, (Link("a"),)
    )
    partner = same_faces(value, shuffled(value, flipped=0.5)[0])
    np.testing.assert_array_equal(np.sort(partner), np.arange(20_001))


def other_meshes():
    shifted = CABINET.triangles.copy()
    shifted[0] += (0, 0, -0.01)
    doubled = CABINET.triangles.copy()
    doubled[1] = doubled[0]
    return {
        "a face fewer": soup(CABINET.triangles[1:], CABINET.labels[1:], CABINET.links),
        "one face elsewhere": soup(shifted, CABINET.labels, CABINET.links),
        "one face twice, one missing": soup(doubled, CABINET.labels, CABINET.links),
        "points": cloud(CABINET.vertices, CABINET.labels.repeat(3)),
        "another size": CABINET.transformed(np.diag([1.01, 1.01, 1.01, 1.0])),
    }


@pytest.mark.parametrize("other", other_meshes().values(), ids=other_meshes())
def test_another_mesh_has_not_the_same_faces(other):
    assert same_faces(CABINET, other) is None
    assert same_faces(other, CABINET) is None


def test_200_000_shuffled_faces_are_found_in_seconds():
    rng = np.random.default_rng(0)
    corners = rng.uniform(size=(200_000, 1, 3)) + 1e-3 * rng.normal(size=(200_000, 3, 3))
    value = soup(corners, np.zeros(200_000), (Link("a"),))
    other, where = shuffled(value)
    start = time.perf_counter()
    partner = same_faces(value, other)
    assert time.perf_counter() - start < 8  # about 1 s on a machine with nothing else to do
    np.testing.assert_array_equal(partner, where)


def link_ious(laid, truth, prediction):
    shape = (len(truth.links), len(prediction.links))
    return iou_matrix(laid.true_labels, laid.predicted_labels, laid.weights, shape)


def test_shared_faces_count_by_area_and_their_points_are_the_same():
    # The door lies on the body: two faces of either are at one place, and differ in their winding.
    prediction, where = shuffled(CABINET)
    labels = prediction.labels.copy()
    labels[where[:2]] = 1  # two faces of the body are given to the door
    prediction = soup(prediction.triangles, labels, CABINET.links)
    laid = overlay(CABINET, prediction)
    given = CABINET.weights[:2].sum()
    door, body = CABINET.weights[CABINET.labels == 1].sum(), CABINET.weights[CABINET.labels == 0].sum()
    assert laid.shared
    expected = [[(body - given) / body, given / (body + door)], [0.0, door / (door + given)]]
    np.testing.assert_allclose(link_ious(laid, CABINET, prediction), expected, rtol=1e-12)
    np.testing.assert_array_equal(laid.truth.points, laid.prediction.points)
    # Points that disagree are those of the two faces, and weigh as much.
    differ = laid.truth.labels != laid.prediction.labels
    assert laid.truth.weights[differ].sum() == pytest.approx(given)
    assert laid.truth.weights.sum() == pytest.approx(CABINET.weights.sum())


def test_every_part_gets_points_however_small():
    value = boxes(((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (1.001, 0.001, 0.001)))
    for laid in (
        overlay(value, value, least=100),
        overlay(value, boxes(((0, 0, 0), (1.01, 1, 1))), least=100),
    ):
        small = laid.truth.of(1)
        assert len(small.points) == 100
        assert small.weights.sum() == pytest.approx(6e-6)
        # On the box: within it, and one coordinate at one of its sides.
        local = (small.points - (1, 0, 0)) / 0.001
        assert ((local > -1e-9) & (local < 1 + 1e-9)).all()
        assert (np.minimum(np.abs(local), np.abs(local - 1)).min(axis=1) < 1e-9).all()


@pytest.mark.parametrize("flipped", [False, True], ids=["wound alike", "wound the other way"])
@pytest.mark.parametrize("gap", [0.0, 0.002, 0.1])
def test_the_same_parts_in_another_tessellation_overlap_almost_wholly(gap, flipped):
    parts = ((0, 0, 0), (2, 1, 3)), ((0, -0.1 - gap, 0), (2, -gap, 3))
    truth, prediction = boxes(*parts), boxes(*parts, subdivisions=3)
    if flipped:
        prediction = soup(prediction.triangles[:, ::-1], prediction.labels, prediction.links)
    laid = overlay(truth, prediction)
    assert not laid.shared
    assert np.diag(link_ious(laid, truth, prediction)).min() > 0.97
    assert laid.weights.sum() == pytest.approx(2)  # each surface 1


def test_a_gap_thinner_than_samples_are_apart_does_not_mix_parts_up():
    # Sheets that face the same way, 0.002 apart; samples on them are 0.005 apart or more.
    sheet = np.array([[[0.0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]])
    sheets = np.concatenate([sheet, sheet + (0, 0, 0.002)])
    truth = soup(sheets, [0, 0, 1, 1], CABINET.links)
    prediction = soup(split(sheets), np.tile([0, 0, 1, 1], 4), CABINET.links)
    assert np.diag(link_ious(overlay(truth, prediction), truth, prediction)).min() > 0.97


def test_surface_that_the_other_has_not_counts_as_a_miss_on_both_sides():
    # Cubes of 1 at x = 0, 2 in truth and 0, 4 in prediction: half of either surface is missed.
    truth = boxes(((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1)))
    prediction = boxes(((0, 0, 0), (1, 1, 1)), ((4, 0, 0), (5, 1, 1)))
    laid = overlay(truth, prediction)
    np.testing.assert_allclose(link_ious(laid, truth, prediction), [[1, 0], [0, 0]], atol=1e-12)
    assert laid.weights[laid.predicted_labels == -1].sum() == pytest.approx(0.5)
    assert laid.weights[laid.true_labels == -1].sum() == pytest.approx(0.5)


def test_point_clouds_are_compared_by_their_own_points():
    rng = np.random.default_rng(0)
    points = rng.uniform(size=(3000, 3))
    truth = cloud(points, points[:, 0] > 0.5)
    prediction = cloud(points, points[:, 0] > 0.75)
    laid = overlay(truth, prediction)
    # Every point is its own nearest, so sets are counted: x > 0.75 within x > 0.5.
    half, quarter = (points[:, 0] > 0.5).sum(), (points[:, 0] > 0.75).sum()
    assert link_ious(laid, truth, prediction)[1, 1] == pytest.approx(quarter / half)
    fewer = overlay(truth, prediction, points=500, least=10)
    assert len(fewer.truth.points) <= 502
    assert (np.isin(fewer.truth.points, points)).all()
    assert fewer.truth.weights.sum() == pytest.approx(3000)


def test_a_cloud_is_compared_with_a_surface():
    mesh = boxes(((0, 0, 0), (1, 1, 1)), ((0, 0, 2), (1, 1, 3)))
    dense = overlay(mesh, mesh).truth
    laid = overlay(mesh, cloud(dense.points, dense.labels))
    np.testing.assert_allclose(link_ious(laid, mesh, mesh), np.eye(2), atol=1e-12)


def test_faces_without_area_labels_or_links_without_faces_break_nothing():
    flat = np.concatenate([CABINET.triangles, np.zeros((1, 3, 3)), np.ones((1, 3, 3))])
    links = (*CABINET.links, Link("empty"), Link("point"))
    value = soup(flat, [*np.where(CABINET.labels == 1, 1, -1), 3, 3], links)
    other = boxes(((0, -0.1, 0), (2, 1, 3)), subdivisions=1)
    for laid in (overlay(value, value), overlay(value, other), overlay(other, value)):
        assert np.isfinite(laid.weights).all()
        assert all(
            np.isfinite(c.points).all() and np.isfinite(c.weights).all()
            for c in (laid.truth, laid.prediction)
        )
    laid = overlay(value, value)
    assert [len(laid.truth.of(link).points) > 0 for link in range(-1, 4)] == [True, False, True, False, False]


def test_no_surface_at_all_is_refused():
    with pytest.raises(BadInputError, match="'nothing' has no surface"):
        soup(np.zeros((2, 3, 3)), [0, 0], (Link("a"),), name="nothing")


def test_equal_seeds_give_equal_samples_and_others_do_not():
    other = boxes(((0, -0.1, 0), (2, 1, 3)), subdivisions=1)
    one, two, three = overlay(CABINET, other), overlay(CABINET, other), overlay(CABINET, other, seed=1)
    for name in ("true_labels", "predicted_labels", "weights"):
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name))
    np.testing.assert_array_equal(one.prediction.points, two.prediction.points)
    assert (one.truth.points != three.truth.points).any()
