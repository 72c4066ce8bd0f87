"""Surfaces of thousands of pieces: what is large stays exact, what is small is put together by nearness."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from simart_kit.arrays import FloatArray, IntArray, units
from simart_kit.closing import MOST_PIECES
from simart_kit.decompose import Budget, Surface, decompose
from simart_kit.grouping import gathered
from simart_kit.hulls import volume
from simart_kit.sheets import LEAST_BOARDS, SHEET
from simart_kit.testing.meshes import boxes_mesh

from .furniture import carcass
from .test_decompose import inside, united

CUTS_ONLY = Budget(tool_seconds=0.0)
MANY = 3 * MOST_PIECES


def along_x(starts: list[float], size: float) -> FloatArray:
    return np.array([[(x, 0, 0), (x + size, size, size)] for x in starts], dtype=np.float64)


class TestGathering:
    def test_few_boxes_stay_by_themselves(self) -> None:
        assert gathered(along_x([0, 1, 2], 0.5), 3, 1) == [[0], [1], [2]]

    def test_small_ones_go_where_the_nearest_large_one_is_that_takes_any(self) -> None:
        boxes = np.concatenate([along_x([0.0], 2.0), along_x([5.0, 9.0], 1.0), along_x([1.0, 6.5, 8.5], 0.1)])
        assert gathered(boxes, 3, 1) == [[0], [1, 3, 4], [2, 5]]
        assert gathered(boxes, 3) == [[0, 3], [1, 4], [2, 5]]

    def test_none_at_all(self) -> None:
        assert gathered(np.zeros((0, 2, 3)), 4, 2) == []


def leaves(count: int) -> tuple[FloatArray, IntArray, FloatArray]:
    """Small tetrahedra behind a cupboard, and their middles."""
    middles = np.random.default_rng(0).uniform((-0.3, 0.3, 0.0), (0.3, 0.5, 0.7), (count, 3))
    corners = 0.002 * np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)])
    sides = np.array([(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])
    faces = sides + 4 * np.arange(count)[:, None, None]
    return (middles[:, None] + corners).reshape(-1, 3), faces.reshape(-1, 3), middles


def test_a_cupboard_stays_hollow_beside_thousands_of_leaves_which_all_have_a_shape() -> None:
    vertices, faces = united(carcass((-0.3, 0.3), (-0.2, 0.2), (0.0, 0.7)))
    points, sides, middles = leaves(MANY)
    surface = Surface(np.concatenate([vertices, points]), np.concatenate([faces, sides + len(vertices)]))
    assert len(surface.pieces) == MOST_PIECES
    found = decompose(surface.vertices, surface.faces, CUTS_ONLY).shapes
    assert len(found) <= 32
    assert not inside(found, (0.0, -0.1, 0.35))
    assert np.mean([inside(found, tuple(middle)) for middle in middles[::20]]) > 0.95


def test_leaves_that_share_a_hull_hold_what_they_held() -> None:
    points, sides, _ = leaves(MANY)
    held = sum(piece.volume for piece in Surface(points, sides).pieces)
    assert held == pytest.approx(MANY * 8 / 3 * 0.002**3)


def crumpled(rows: int) -> tuple[FloatArray, IntArray]:
    """Half of a tube, 1 m wide and long, each of whose squares looks another way than its neighbours."""
    i, j = (x.ravel() for x in np.mgrid[: rows + 1, : rows + 1])
    radius = 0.5 + 0.5 / rows * np.random.default_rng(0).uniform(-1, 1, len(i))
    corner = (np.arange(rows)[:, None] * (rows + 1) + np.arange(rows)).ravel()
    a, b, c, d = corner, corner + rows + 1, corner + rows + 2, corner + 1
    points = np.column_stack([radius * np.cos(np.pi * i / rows), j / rows, radius * np.sin(np.pi * i / rows)])
    return points, np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


@pytest.mark.slow
def test_a_crumpled_sheet_comes_apart_into_few_boards_that_follow_it() -> None:
    points, faces = crumpled(40)
    assert LEAST_BOARDS < len(Surface(points, faces, 256).pieces) <= 256
    shapes = decompose(points, faces, CUTS_ONLY).shapes
    assert not inside(shapes, (0.0, 0.5, 0.3))
    middles = points[faces[::20]].mean(axis=1)
    inwards = middles - 0.002 * units(middles * (1, 0, 1))
    assert np.mean([inside(shapes, tuple(point)) for point in inwards]) > 0.9


def test_a_small_sheet_beside_a_large_one_keeps_its_walls() -> None:
    large, faces = crumpled(40)
    (small,) = [boxes_mesh([((2.0, 0.0, 0.0), (2.1, 0.1, 0.1))])]
    open_top = small.faces[~(small.vertices[small.faces][:, :, 2] == 0.1).all(axis=1)]
    both = np.concatenate([large, small.vertices])
    pieces = Surface(both, np.concatenate([faces, open_top + len(large)]), 64).pieces
    walls = [piece for piece in pieces if piece.lower[0] > 1.5]
    assert len(walls) == 5
    assert sum(piece.volume for piece in walls) == pytest.approx(5 * 0.01 * SHEET, rel=0.01)


@pytest.mark.slow
def test_many_fine_solids_in_each_other_are_all_covered() -> None:
    ball = trimesh.creation.icosphere(subdivisions=2, radius=0.1)
    middles = np.random.default_rng(1).uniform(-0.05, 0.05, (80, 3))
    points = np.concatenate([ball.vertices + middle for middle in middles])
    faces = np.concatenate([ball.faces + k * len(ball.vertices) for k in range(len(middles))])
    found = decompose(points, faces, CUTS_ONLY).shapes
    assert all(inside(found, tuple(middle)) for middle in middles)
    hull = trimesh.convex.convex_hull(points)
    assert sum(map(volume, found)) < 2 * hull.volume
