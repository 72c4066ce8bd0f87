"""Fewer faces: how many, and where they are."""

import numpy as np
import trimesh

from simart_kit.coarsening import coarsened

BALL = trimesh.creation.icosphere(subdivisions=6)  # 81,920 faces


def test_a_surface_with_few_faces_comes_back_as_it_is():
    vertices, faces = coarsened(BALL.vertices, BALL.faces, 81_920)
    assert vertices is BALL.vertices
    assert faces is BALL.faces


def test_a_ball_keeps_its_shape_closed_and_wound_outward():
    vertices, faces = coarsened(BALL.vertices, BALL.faces, 20_000)
    assert 4_000 < len(faces) <= 20_000
    made = trimesh.Trimesh(vertices, faces, process=False)
    assert made.is_watertight
    np.testing.assert_allclose(np.linalg.norm(vertices[np.unique(faces)], axis=1), 1.0, atol=1e-9)
    assert abs(made.volume - 4 / 3 * np.pi) < 0.05


def test_a_flat_sheet_stays_where_it_is():
    side = np.linspace(0, 1, 201)
    x, y = np.meshgrid(side, side, indexing="ij")
    vertices = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, 0.3)])
    corner = (np.arange(200)[:, None] * 201 + np.arange(200)).ravel()
    faces = np.concatenate(
        [
            np.column_stack([corner, corner + 201, corner + 202]),
            np.column_stack([corner, corner + 202, corner + 1]),
        ]
    )
    points, kept = coarsened(vertices, faces, 10_000)
    assert len(kept) <= 10_000
    assert (points[:, 2] == 0.3).all()
    assert np.ptp(points[np.unique(kept)], axis=0)[:2].min() > 1 - 2 / 64
    normals = np.cross(points[kept[:, 1]] - points[kept[:, 0]], points[kept[:, 2]] - points[kept[:, 0]])
    assert (normals[:, 2] >= 0).all()


def test_the_same_surface_gives_the_same_faces():
    one, two = (coarsened(BALL.vertices, BALL.faces, 5_000) for _ in range(2))
    np.testing.assert_array_equal(one[0], two[0])
    np.testing.assert_array_equal(one[1], two[1])
