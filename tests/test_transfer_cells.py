"""What the transfer leaves out to save time changes nothing: parts far from a cell, faces that differ."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist

from simart_kit.topology import edge_ends, first_alike, half_edges
from simart_kit.transfer.cells import cells_of
from simart_kit.transfer.part_seeds import PartSeeds
from simart_kit.triangles import areas, cosines, crosses, unit_normals

NUMBERS = st.integers(0, 2**32 - 1)


def by_the_formula(seeds, part, points, sigma):
    """P ~ exp(-d^2 / 2 sigma^2) by measuring every seed, zero under a thousandth of the nearest part's."""
    distance = cdist(points, seeds)
    nearest = np.stack([distance[:, part == p].min(axis=1) for p in range(part.max() + 1)], axis=1)
    kernel = np.exp((nearest.min(axis=1, keepdims=True) ** 2 - nearest**2) / (2 * sigma**2))
    kernel[kernel < 1e-3] = 0
    return kernel / kernel.sum(axis=1, keepdims=True)


@settings(max_examples=40, deadline=None)
@given(
    NUMBERS, st.floats(1e-4, 1.0), st.integers(1, 5), st.sampled_from([(1, 1, 1), (1, 0.01, 0), (9, 1, 1)])
)
def test_parts_that_a_cell_rules_out_have_no_chance_there(number, sigma, parts, shape):
    rng = np.random.default_rng(number)
    part = np.r_[np.arange(parts), rng.integers(0, parts, 60)]
    seeds, points = rng.random((len(part), 3)) * shape, (rng.random((400, 3)) * 1.2 - 0.1) * shape
    found = PartSeeds(seeds, part, parts, sigma).probabilities(points)
    np.testing.assert_allclose(found, by_the_formula(seeds, part, points, sigma), atol=1e-6)


def test_where_one_part_is_far_inside_its_own_surface_the_row_is_exactly_one():
    # Two boards side by side: 1000 points on each, the seeds among them, and sigma far below their size.
    rng = np.random.default_rng(5)
    points = rng.random((2000, 3)) * [1, 1, 0.0] + np.repeat([[0.0, 0, 0], [1, 0, 0]], 1000, axis=0)
    part = np.repeat([0, 1], 1000)
    found = PartSeeds(points[::2], part[::2], 2, 0.02).probabilities(points)
    inside = np.abs(points[:, 0] - 1) > 0.3  # 15 sigma from the border
    assert inside.sum() > 1000
    assert (found[inside] == np.eye(2)[part[inside]]).all()
    np.testing.assert_allclose(found, by_the_formula(points[::2], part[::2], points, 0.02), atol=1e-6)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_few_points_have_their_chances_too(count):
    seeds = PartSeeds(np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([0, 1]), 2, 0.1)
    assert (
        seeds.probabilities(np.array([[0.0, 0, 0], [1, 0, 0]])[:count]).tolist() == np.eye(2)[:count].tolist()
    )


@settings(max_examples=40, deadline=None)
@given(NUMBERS, st.floats(1e-9, 2.0), st.integers(1, 300))
def test_every_point_lies_within_its_cell_and_there_are_no_more_cells_than_points(number, edge, count):
    points = np.random.default_rng(number).random((count, 3)) * [3, 1, 0] + 100
    cells = cells_of(points, edge)
    assert (np.linalg.norm(points - cells.centers[cells.of_point], axis=1) <= cells.radius * (1 + 1e-9)).all()
    assert len(cells.centers) <= count
    assert sorted(set(cells.of_point.tolist())) == list(range(len(cells.centers)))


@settings(max_examples=40, deadline=None)
@given(NUMBERS, st.integers(3, 9), st.integers(0, 60))
def test_the_first_face_with_the_same_corners_is_found_whatever_their_order(number, vertices, count):
    faces = np.random.default_rng(number).integers(0, vertices, (count, 3))
    seen: dict[tuple[int, ...], int] = {}
    expected = [seen.setdefault(tuple(sorted(face)), place) for place, face in enumerate(faces.tolist())]
    assert first_alike(faces).tolist() == expected


def test_edges_are_listed_once_with_their_number_of_faces():
    faces = np.array([[0, 1, 2], [2, 1, 3], [1, 2, 4]])
    low, high, shared = edge_ends(faces, half_edges(faces)[1])
    found = dict(zip(zip(low.tolist(), high.tolist(), strict=True), shared.tolist(), strict=True))
    assert found == {(0, 1): 1, (0, 2): 1, (1, 2): 3, (1, 3): 1, (2, 3): 1, (1, 4): 1, (2, 4): 1}


def test_normals_in_pieces_are_those_of_numpy():
    # More than are worked at once, and some without area.
    triangles = np.random.default_rng(1).normal(size=(10_000, 3, 3))
    triangles[::1000] = triangles[::1000, :1]
    expected = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(expected, axis=1)
    np.testing.assert_array_equal(crosses(triangles), expected)
    np.testing.assert_allclose(areas(triangles), length / 2, rtol=1e-15)
    normals = unit_normals(triangles)
    assert (normals[::1000] == 0).all()
    flat = np.flatnonzero(length)
    np.testing.assert_allclose(normals[flat], expected[flat] / length[flat, None], rtol=1e-15)
    left, right = np.arange(9_999), np.arange(1, 10_000)
    np.testing.assert_allclose(
        cosines(normals, left, right), (normals[left] * normals[right]).sum(1), atol=1e-15
    )
