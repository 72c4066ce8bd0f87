"""Distances and overlaps of parts against brute force and numbers worked out by hand."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist
from scipy.spatial.transform import Rotation

from simart_kit.bench.articulation import Articulation, Link
from simart_kit.bench.frame import unit_from_object
from simart_kit.bench.grounding import score_grounding
from simart_kit.bench.metrics.shape import box_giou, box_iou, chamfer, chamfer_moved, chamfer_squared
from simart_kit.bench.metrics.voxel_shape import part_grids, voxel_iou
from simart_kit.bench.overlay import overlay
from simart_kit.bench.reconstruction import score_reconstruction
from simart_kit.bench.sampling import Cloud
from simart_kit.errors import BadInputError
from simart_kit.testing.meshes import box, boxes_mesh
from simart_kit.voxels import cube_frame, voxelise

seeds = st.integers(0, 2**32 - 1)
LINKS = (Link("body"), Link("door", 0), Link("empty", 0))


def cloud(points, weights=None):
    points = np.asarray(points, dtype=np.float64)
    return Cloud(points, np.zeros(len(points), int), np.ones(len(points)) if weights is None else weights)


def square(height, labels=(0, 0)):
    """The unit square at z = height as two triangles."""
    corners = [[0, 0, height], [1, 0, height], [1, 1, height], [0, 1, height]]
    return Articulation("square", corners, [[0, 1, 2], [0, 2, 3]], labels, LINKS)


@settings(max_examples=40, deadline=None)
@given(seeds, st.integers(1, 30), st.integers(1, 30))
def test_chamfer_distances_agree_with_all_pairs(seed, n, m):
    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=(n, 3)), rng.normal(size=(m, 3))
    u, v = rng.uniform(0.1, 1, n), rng.uniform(0.1, 1, m)
    pairs = cdist(a, b)
    there, back = pairs.min(axis=1), pairs.min(axis=0)
    expected = ((u * there).sum() / u.sum() + (v * back).sum() / v.sum()) / 2
    assert chamfer(cloud(a, u), cloud(b, v)) == pytest.approx(expected)
    assert chamfer_squared(a, b) == pytest.approx((there**2).mean() + (back**2).mean())


def test_chamfer_of_two_points_by_hand():
    # There: distances 0 and 3, mean 1.5; back: 0. Half the sum 0.75; squared: 9/2 + 0.
    a, b = [[0, 0, 0], [3, 0, 0]], [[0, 0, 0]]
    assert chamfer(cloud(a), cloud(b)) == 0.75
    assert chamfer_squared(np.array(a, float), np.array(b, float)) == 4.5
    # With weight 2 on the far point the mean there is 2.
    assert chamfer(cloud(a, np.array([1.0, 2.0])), cloud(b)) == 1.0


def test_without_points_there_is_no_finite_distance():
    nothing, something = cloud(np.zeros((0, 3))), cloud([[0, 0, 0]])
    assert chamfer(nothing, something) == chamfer(something, nothing) == math.inf
    assert chamfer_squared(nothing.points, something.points) == math.inf


def test_equal_parts_are_at_distance_0_at_rest_and_moved_alike():
    laid = overlay(square(0, (0, 1)), square(0, (0, 1)))
    turn = np.eye(4)
    turn[:2, :2] = [[0.6, -0.8], [0.8, 0.6]]
    turn[:3, 3] = (0.1, 0.2, 0.3)
    for link in (0, 1):
        true, predicted = laid.truth.of(link), laid.prediction.of(link)
        assert chamfer(true, predicted) == 0.0
        assert chamfer_moved(true, predicted, [(turn, turn)]) == pytest.approx([0.0], abs=1e-12)


@pytest.mark.parametrize("height", [0.01, 0.5])
def test_squares_above_each_other_are_as_far_apart_as_they_are(height):
    laid = overlay(square(0), square(height))
    # Samples are about 0.007 apart, so the nearest lies a little to the side.
    assert chamfer(laid.truth.of(0), laid.prediction.of(0)) == pytest.approx(height, abs=0.004)


def test_a_part_moved_away_is_as_far_as_the_motion_takes_it():
    part = overlay(square(0), square(0)).truth.of(0)
    lift, drop = np.eye(4), np.eye(4)
    lift[2, 3], drop[2, 3] = 0.25, -0.5
    poses = [(np.eye(4), np.eye(4)), (np.eye(4), lift), (drop, lift)]
    assert chamfer_moved(part, part, poses) == pytest.approx([0.0, 0.25, 0.75])


def test_distances_of_moved_points_agree_with_moving_and_measuring_them():
    rng = np.random.default_rng(4)
    one, two = rng.random((40, 3)), rng.random((60, 3))
    turns = [np.eye(4), np.eye(4)]
    for turn in turns:
        turn[:3, :3] = Rotation.random(random_state=rng).as_matrix()
        turn[:3, 3] = rng.random(3)
    placed = [points @ turn[:3, :3].T + turn[:3, 3] for points, turn in zip((one, two), turns, strict=True)]
    apart = np.linalg.norm(placed[0][:, None] - placed[1][None], axis=2)
    expected = (apart.min(axis=1).mean() + apart.min(axis=0).mean()) / 2
    assert chamfer_moved(cloud(one), cloud(two), [(turns[0], turns[1])]) == pytest.approx([expected])
    squared = (apart.min(axis=1) ** 2).mean() + (apart.min(axis=0) ** 2).mean()
    assert chamfer_squared(one, two, np.linalg.inv(turns[0]) @ turns[1]) == pytest.approx(squared)


@pytest.mark.parametrize(
    ("other", "iou", "giou"),
    [
        ([[0, 0, 0], [1, 1, 1]], 1, 1),
        # Half of a unit cube: 0.5 / 1.5, no room left in the box about both.
        ([[0.5, 0, 0], [1.5, 1, 1]], 1 / 3, 1 / 3),
        # Shares 1/8, union 15/8, the box about both has 27/8: 12/27 of it is empty.
        ([[0.5, 0.5, 0.5], [1.5, 1.5, 1.5]], 1 / 15, 1 / 15 - 12 / 27),
        # One away: union 2 of 3.
        ([[2, 0, 0], [3, 1, 1]], 0, -1 / 3),
        # Inside: 1/8.
        ([[0, 0, 0], [0.5, 0.5, 0.5]], 1 / 8, 1 / 8),
        # A flat box inside has no volume.
        ([[0, 0, 0.5], [1, 1, 0.5]], 0, 0),
    ],
)
def test_overlap_of_a_unit_cube_and_another_box(other, iou, giou):
    cube, other = np.array([[0.0] * 3, [1.0] * 3]), np.array(other, dtype=np.float64)
    for a, b in ((cube, other), (other, cube)):
        assert box_iou(a, b) == pytest.approx(iou)
        assert box_giou(a, b) == pytest.approx(giou)


def test_boxes_without_volume_get_the_worst():
    flat = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]])
    assert (box_iou(flat, flat), box_giou(flat, flat)) == (0.0, -1.0)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.lists(st.integers(0, 6), min_size=3, max_size=3), min_size=4, max_size=4))
def test_overlap_of_boxes_agrees_with_counting_cells(corners):
    a, b = (np.sort(np.array(pair), axis=0) for pair in (corners[:2], corners[2:]))
    cells = np.stack(np.meshgrid(*[np.arange(6)] * 3, indexing="ij"), axis=-1) + 0.5
    inside = [((cells > low) & (cells < high)).all(axis=-1) for low, high in (a, b)]
    shared, union = (inside[0] & inside[1]).sum(), (inside[0] | inside[1]).sum()
    hull = np.prod(np.maximum(a[1], b[1]) - np.minimum(a[0], b[0]))
    floats = a.astype(np.float64), b.astype(np.float64)
    assert box_iou(*floats) == pytest.approx(shared / union if union else 0)
    assert box_giou(*floats) == pytest.approx(shared / union - (hull - union) / hull if union else -1)


def test_grids_of_parts_are_what_voxelising_each_gives():
    corners, faces = box((0, 0, 0), (2, 1, 1))
    others, _ = box((0, 1, 0), (2, 1.5, 1))
    labels = np.repeat([0, 1], 12)
    value = Articulation(
        "x", np.concatenate([corners, others]), np.concatenate([faces, faces + 8]), labels, LINKS
    )
    unit = value.transformed(unit_from_object(value.bounds))
    grids = part_grids(unit, 16)
    frame = cube_frame(np.array([[-0.5] * 3, [0.5] * 3]), 16)
    for link in (0, 1):
        expected = voxelise(unit.triangles[labels == link], frame).occupancy
        np.testing.assert_array_equal(grids[link], expected)
        assert expected.any()
    assert grids.shape == (3, 16, 16, 16)
    assert not grids[2].any()


def test_points_turn_on_their_cells_and_those_outside_none():
    points = [[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5], [0.1, 0.1, 0.1], [0.6, 0, 0]]
    value = Articulation("x", points, np.zeros((0, 3)), [0, 0, 1, 1], LINKS)
    # Cells of a quarter: 0.1 lies in the third.
    grids = part_grids(value, 4)
    assert [np.argwhere(grid).tolist() for grid in grids] == [[[0, 0, 0], [3, 3, 3]], [[2, 2, 2]], []]


def test_what_lies_outside_the_cube_is_cut_off():
    value = square(0.2).transformed(np.diag([4.0, 4.0, 1.0, 1.0]))
    # The square 0..4 at z = 0.2 covers the upper quarter of layer 2 of 4; x = 0 is a border, which counts.
    grid = part_grids(value, 4)[0]
    assert np.argwhere(grid).tolist() == [[i, j, 2] for i in (1, 2, 3) for j in (1, 2, 3)]


@settings(max_examples=30, deadline=None)
@given(seeds)
def test_overlap_of_grids_agrees_with_sets_of_cells(seed):
    a, b = np.random.default_rng(seed).random((2, 3, 3, 3)) > 0.5
    one, two = set(map(tuple, np.argwhere(a))), set(map(tuple, np.argwhere(b)))
    assert voxel_iou(a, b) == pytest.approx(len(one & two) / len(one | two))
    assert voxel_iou(a, a) == 1.0


def test_empty_grids_are_alike_and_one_empty_grid_is_a_miss():
    empty, full = np.zeros((2, 2, 2), dtype=bool), np.ones((2, 2, 2), dtype=bool)
    assert voxel_iou(empty, empty) == 1.0
    assert voxel_iou(empty, full) == 0.0


# Two cubes of side 1, 1 apart: longest side 3, 12 faces each.
CUBES = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1))])
FIRST = np.arange(24) < 12


def test_the_described_part_itself_scores_perfect():
    found = score_grounding(CUBES, FIRST, FIRST)
    assert (found.iou, found.cd) == (1.0, 0.0)


def test_choosing_everything_halves_the_overlap():
    found = score_grounding(CUBES, FIRST, np.ones(24, dtype=bool))
    assert found.iou == pytest.approx(0.5)
    # True points are on chosen ones. Back: the second cube's points are 1 (side at 2), 2 (side at 3) and on
    # average 1.5 (the others) from the first: 1.5, halved by the first cube's, and by the way there: 0.375.
    assert found.cd == pytest.approx(0.375 / 3, abs=1e-3)


def test_choosing_nothing_costs_half_the_diagonal():
    found = score_grounding(CUBES, FIRST, np.zeros(24, dtype=bool))
    # Sides 3, 1, 1: diagonal sqrt(11), longest side 3.
    assert (found.iou, found.cd) == (0.0, pytest.approx(math.sqrt(11) / 6))


@pytest.mark.parametrize(
    ("true", "predicted", "message"),
    [
        (np.zeros(24, dtype=bool), FIRST, "true_faces chooses no surface"),
        (FIRST, FIRST[:-1], "predicted_faces has shape"),
        (FIRST.astype(int), FIRST, "one bool for each of 24 faces"),
    ],
)
def test_masks_that_do_not_fit_are_refused(true, predicted, message):
    with pytest.raises(BadInputError, match=message):
        score_grounding(CUBES, true, predicted)


@settings(max_examples=20, deadline=None)
@given(seeds)
def test_reconstruction_agrees_with_all_pairs_of_cells(seed):
    rng = np.random.default_rng(seed)
    true, predicted = rng.random((5, 5, 5)) > 0.7, rng.random((5, 5, 5))
    score = score_reconstruction(true, predicted)
    pairs = cdist(np.argwhere(true), np.argwhere(predicted > 0.5)) / 5
    assert score.mse == pytest.approx(sum((predicted.ravel() - true.ravel()) ** 2) / 125)
    assert score.cd == pytest.approx((pairs.min(axis=1).mean() + pairs.min(axis=0).mean()) / 2)
    assert score.iou == pytest.approx((true & (predicted > 0.5)).sum() / (true | (predicted > 0.5)).sum())


def test_reconstruction_by_hand():
    true, predicted = np.zeros((2, 4, 4, 4), dtype=bool)
    true[0, 0, 0] = predicted[0, 0, 2] = True
    # Two of 64 cells are wrong; cells are a quarter of the side, two apart.
    score = score_reconstruction(true, predicted)
    assert (score.mse, score.cd, score.iou) == (2 / 64, 0.5, 0.0)
    perfect = score_reconstruction(true, true.astype(np.float32))
    assert (perfect.mse, perfect.cd, perfect.iou) == (0.0, 0.0, 1.0)


def test_decoding_nothing_costs_half_the_diagonal_of_the_cube():
    score = score_reconstruction(np.ones((2, 2, 2), dtype=bool), np.full((2, 2, 2), 0.5))
    assert (score.mse, score.cd, score.iou) == (0.25, math.sqrt(0.75), 0.0)


FULL = np.ones((2, 2, 2), dtype=bool)


@pytest.mark.parametrize(
    ("true", "predicted", "message"),
    [
        (np.ones((2, 2, 3), dtype=bool), FULL, "a cube of bools"),
        (np.array(True), FULL, "a cube of bools"),
        (FULL * 1.0, FULL, "a cube of bools"),
        (FULL, np.ones((3, 3, 3), dtype=bool), "the decoded grid has shape"),
        (~FULL, FULL, "the true grid is empty"),
        (FULL, FULL * 1, "probabilities or bools"),
        (FULL, FULL * 3.0, "not logits"),
        (FULL, FULL * np.nan, "outside 0..1"),
    ],
)
def test_grids_that_do_not_fit_are_refused(true, predicted, message):
    with pytest.raises(BadInputError, match=message):
        score_reconstruction(true, predicted)
