"""Rays: which triangle is met first, how far away, and where on it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simart_kit.arrays import FloatArray, vec3
from simart_kit.rays import Rays
from simart_kit.testing.meshes import box, boxes_mesh

# Two squares of two triangles each, at x = 1 (faces 0, 1) and x = 3 (faces 2, 3).
SQUARES = np.array(
    [
        [[x, a, b] for a, b in corners]
        for x in (1.0, 3.0)
        for corners in (((-1, -1), (1, -1), (1, 1)), ((-1, -1), (1, 1), (-1, 1)))
    ]
)
AT = np.array([[0.0, 0.5, -0.5]])  # straight before the first triangle of each pair


def rays(triangles: FloatArray) -> Rays:
    """Of (F, 3, 3) triangles, none of which share a vertex."""
    return Rays(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))


def test_the_nearest_triangle_is_met() -> None:
    faces, distance = rays(SQUARES).first(AT, np.array([1.0, 0, 0]))
    assert faces.tolist() == [0]
    assert distance.tolist() == pytest.approx([1.0])


def test_triangles_are_met_from_either_side() -> None:
    faces, distance = rays(SQUARES).first(AT + [5, 0, 0], np.array([-1.0, 0, 0]))
    assert faces.tolist() == [2]
    assert distance.tolist() == pytest.approx([2.0])


def test_distance_counts_lengths_of_the_direction() -> None:
    _, distance = rays(SQUARES).first(AT, np.array([0.25, 0, 0]))
    assert distance.tolist() == pytest.approx([4.0])


@pytest.mark.parametrize("direction", [(-1.0, 0, 0), (0, 1.0, 0), (1.0, 3.0, 0)])
def test_what_is_missed_is_infinitely_far(direction: tuple[float, float, float]) -> None:
    faces, distance = rays(SQUARES).first(AT, np.array(direction))
    assert faces.tolist() == [-1]
    assert distance.tolist() == [np.inf]


def test_every_ray_may_have_its_own_direction() -> None:
    origins = np.repeat(AT + [2, 0, 0], 3, axis=0)
    faces, distance = rays(SQUARES).first(origins, np.array([[1.0, 0, 0], [-2.0, 0, 0], [0, 0, 1.0]]))
    assert faces.tolist() == [2, 0, -1]
    assert distance.tolist() == pytest.approx([1.0, 0.5, np.inf])


def test_nothing_to_meet_and_nothing_to_cast() -> None:
    faces, distance = rays(np.zeros((0, 3, 3))).first(np.zeros((2, 3)), np.array([0, 0, 1.0]))
    assert faces.tolist() == [-1, -1]
    assert distance.tolist() == [np.inf, np.inf]
    faces, distance = rays(SQUARES).first(np.zeros((0, 3)), np.array([0, 0, 1.0]))
    assert faces.shape == distance.shape == (0,)


def test_many_rays_at_once() -> None:
    count = 300_000
    heights = np.linspace(-0.99, 0.99, count)
    origins = np.column_stack([np.zeros(count), np.zeros(count), heights])
    faces, distance = rays(SQUARES).first(origins, np.array([1.0, 0, 0]))
    np.testing.assert_array_equal(faces[heights < -0.001], 0)
    np.testing.assert_array_equal(faces[heights > 0.001], 1)
    np.testing.assert_allclose(distance, 1.0, atol=1e-5)


@pytest.mark.parametrize("offset", [1e3, 1e5])
def test_far_from_the_origin_nothing_is_lost(offset: float) -> None:
    """Single precision ends at a centimetre there."""
    move = np.array([offset, -offset, offset])
    faces, distance = rays(SQUARES + move).first(AT + move, np.array([1.0, 0, 0]))
    assert faces.tolist() == [0]
    assert distance.tolist() == pytest.approx([1.0], abs=1e-4)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=25, deadline=None)
def test_a_box_is_met_where_the_slabs_say(seed: int) -> None:
    """From outside a box, towards a point in it: the last of the three pairs of planes to be entered."""
    rng = np.random.default_rng(seed)
    lower, upper = rng.uniform(-2, 0, 3), rng.uniform(0.2, 2, 3)
    inside = lower + rng.uniform(0.05, 0.95, (50, 3)) * (upper - lower)
    towards = rng.normal(size=(50, 3))
    origins = inside - 20 * towards / np.linalg.norm(towards, axis=1, keepdims=True)
    directions = inside - origins
    planes = np.stack([lower - origins, upper - origins]) / directions
    vertices, faces = box(vec3(lower), vec3(upper))
    met, distance = Rays(vertices, faces).first(origins, directions)
    assert (met >= 0).all()
    np.testing.assert_allclose(distance, planes.min(axis=0).max(axis=1), atol=1e-5)


def test_weights_find_the_place_again() -> None:
    mesh = boxes_mesh([((0, 0, 0), (1, 2, 3))])
    rng = np.random.default_rng(0)
    origins = rng.uniform((-1, -1, 4), (2, 3, 5), (200, 3))
    directions = rng.uniform((0.1, 0.1, 0.1), (0.9, 1.9, 2.9), (200, 3)) - origins
    hits = Rays(mesh.vertices, mesh.faces).hits(origins, directions)
    assert (hits.face >= 0).all()
    places = np.einsum("ni,nij->nj", hits.weights, mesh.triangles[hits.face])
    np.testing.assert_allclose(places, origins + hits.distance[:, None] * directions, atol=1e-5)


def test_vertices_that_no_face_uses_change_nothing() -> None:
    far = np.array([[1e9, -1e9, 1e9]])
    vertices = np.concatenate([far, SQUARES.reshape(-1, 3), far])
    crowded = Rays(vertices, 1 + np.arange(12).reshape(-1, 3))
    alone = rays(SQUARES)
    np.testing.assert_array_equal(crowded.center, alone.center)
    assert crowded.size == alone.size
    assert crowded.first(AT, np.array([1.0, 0, 0]))[1].tolist() == pytest.approx([1.0])


def test_faces_that_share_corners_are_met_like_loose_ones() -> None:
    mesh = boxes_mesh([((0, 0, 0), (1, 2, 3)), ((1.5, 0, 0), (2, 1, 1))])
    origins = np.random.default_rng(1).uniform(-1, 4, (500, 3))
    directions = np.random.default_rng(2).normal(size=(500, 3))
    shared, loose = (
        one.hits(origins, directions) for one in (Rays(mesh.vertices, mesh.faces), rays(mesh.triangles))
    )
    assert (shared.face >= 0).any()
    np.testing.assert_array_equal(shared.face, loose.face)
    np.testing.assert_array_equal(shared.distance, loose.distance)


def test_hits_of_some_rays_and_of_others() -> None:
    origins = AT + [[0.0, 0, 0], [2, 0, 0], [5, 0, 0]]
    hits = rays(SQUARES).hits(origins, np.array([1.0, 0, 0]))
    turned = hits.only(np.array([False, True, True])).joined(hits.only(np.array([True, False, False])))
    assert turned.face.tolist() == [2, -1, 0]
    assert turned.distance.tolist() == pytest.approx([1.0, np.inf, 1.0])
    np.testing.assert_allclose(turned.weights[0], hits.weights[1])


@pytest.mark.parametrize(("reach", "met"), [(None, True), (1.01, True), (0.99, False)])
def test_what_is_in_the_way_within_reach(reach: float | None, met: bool) -> None:
    assert rays(SQUARES).blocked(AT, np.array([1.0, 0, 0]), reach).tolist() == [met]


def test_nothing_is_in_the_way_of_nothing() -> None:
    empty: FloatArray = np.zeros((0, 3, 3))
    assert rays(empty).blocked(AT, np.array([1.0, 0, 0])).tolist() == [False]
