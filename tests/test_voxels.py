"""Voxelisation against an exact, independent judge: clipping the triangle to each closed box in fractions."""

from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from simart_kit.testing.meshes import box, cabinet_mesh
from simart_kit.voxels import GridFrame, VoxelGrid, cube_frame, voxelise

CELLS = 4
UNIT = GridFrame((0.0, 0.0, 0.0), 1.0, CELLS)


def clip(polygon, axis, sign, border):
    """What of a polygon of Fractions lies where sign * (coordinate - border) >= 0 (Sutherland-Hodgman)."""
    kept = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        height_a, height_b = sign * (a[axis] - border), sign * (b[axis] - border)
        if height_a >= 0:
            kept.append(a)
        if height_a * height_b < 0:
            share = height_a / (height_a - height_b)
            kept.append(tuple(p + share * (q - p) for p, q in zip(a, b, strict=True)))
    return kept


def touches(triangle, cell):
    polygon = [tuple(map(Fraction, corner)) for corner in triangle]
    for axis in range(3):
        for sign, border in ((1, cell[axis]), (-1, cell[axis] + 1)):
            polygon = clip(polygon, axis, sign, border) if polygon else polygon
    return bool(polygon)


def cells_touched(triangles):
    return {c for c in product(range(CELLS), repeat=3) if any(touches(t, c) for t in triangles)}


def found(triangles, frame=UNIT):
    return set(map(tuple, voxelise(np.array(triangles, dtype=np.float64), frame).indices.tolist()))


# Halves put many corners and faces on cell borders, and make segments and points common; floats are exact.
halves = st.integers(-2, 2 * CELLS + 2).map(lambda v: v / 2)
fine = st.integers(-64, 64 * (CELLS + 1)).map(lambda v: v / 64)


def triangles_of(coordinate):
    corner = st.tuples(coordinate, coordinate, coordinate)
    return st.lists(st.tuples(corner, corner, corner), min_size=1, max_size=2)


@settings(max_examples=60, deadline=None)
@given(triangles_of(halves))
def test_a_cell_is_on_exactly_when_its_closed_box_touches_a_triangle_on_the_grid(triangles):
    assert found(triangles) == cells_touched(triangles)


@settings(max_examples=60, deadline=None)
@given(triangles_of(fine))
def test_a_cell_is_on_exactly_when_its_closed_box_touches_a_triangle_anywhere(triangles):
    assert found(triangles) == cells_touched(triangles)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(1e-3, 1e3), st.floats(1e-18, 1e-6))
def test_no_point_of_a_sliver_is_missed(seed, size, thickness):
    rng = np.random.default_rng(seed)
    corners = rng.normal(size=(5, 3, 3)) * size + rng.normal(size=3) * 100 * size
    corners[:, 2] = corners[:, :2].mean(axis=1) + thickness * size * rng.normal(size=(5, 3))
    grid = voxelise(corners, cube_frame(np.array([corners.min((0, 1)), corners.max((0, 1))]), 20))
    weights = rng.dirichlet((1, 1, 1), size=200)
    points = np.einsum("pc,tcx->tpx", weights, corners).reshape(-1, 3)
    cells = np.clip(np.floor(grid.frame.to_grid(points)).astype(int), 0, 19)
    assert grid.occupancy[tuple(cells.T)].all()


def test_the_shell_of_a_box_is_on_and_its_inside_is_off():
    vertices, faces = box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    grid = voxelise(vertices[faces], cube_frame(np.array([[0.0] * 3, [1.0] * 3]), 8))
    hollow = np.ones((8, 8, 8), dtype=bool)
    hollow[1:-1, 1:-1, 1:-1] = False
    np.testing.assert_array_equal(grid.occupancy, hollow)


def test_a_large_grid_agrees_with_the_grid_of_half_its_resolution():
    # A coarse cell is the union of its eight fine cells, so it is on iff one of them is.
    mesh = cabinet_mesh()
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    triangles = mesh.triangles @ turn
    bounds = np.array([triangles.min((0, 1)), triangles.max((0, 1))])
    fine_grid, coarse = (voxelise(triangles, cube_frame(bounds, n)) for n in (256, 128))
    np.testing.assert_array_equal(np.unique(fine_grid.indices // 2, axis=0), coarse.indices)


def test_the_frame_is_a_cube_around_the_object_and_maps_both_ways():
    mesh = cabinet_mesh()
    frame = cube_frame(mesh.bounds, 64)
    assert frame.voxel_size == pytest.approx(0.8 / 64)
    low, high = frame.to_world(np.array([[0.0] * 3, [64.0] * 3]))
    np.testing.assert_allclose(high - low, 0.8)
    np.testing.assert_allclose((low + high) / 2, mesh.bounds.mean(axis=0), atol=1e-12)
    points = np.random.default_rng(0).uniform(-1, 1, (2, 5, 3))
    np.testing.assert_allclose(frame.to_world(frame.to_grid(points)), points, atol=1e-12)


def test_centers_lie_within_half_a_cell_of_the_surface_of_a_sphere():
    rng = np.random.default_rng(1)
    corners = rng.normal(size=(4000, 3))
    corners /= np.linalg.norm(corners, axis=1, keepdims=True)
    small = corners[:, None] + rng.normal(size=(4000, 3, 3)) * 1e-3
    grid = voxelise(small, cube_frame(np.array([[-1.1] * 3, [1.1] * 3]), 32))
    off = np.abs(np.linalg.norm(grid.centers, axis=1) - 1.0)
    assert off.max() <= np.sqrt(3) / 2 * grid.frame.voxel_size + 5e-3


def test_what_lies_outside_the_grid_is_cut_off():
    outside = np.array([[[9.0, 9.0, 9.0], [8.0, 9.0, 9.0], [9.0, 8.0, 9.0]]])
    grid = voxelise(outside, UNIT)
    assert grid.indices.shape == (0, 3)
    assert not grid.occupancy.any()


def test_values_are_read_only():
    grid = voxelise(cabinet_mesh().triangles, cube_frame(cabinet_mesh().bounds, 8))
    assert isinstance(grid, VoxelGrid)
    assert grid.indices.dtype == np.int32
    for array in (grid.indices, grid.occupancy):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


@pytest.mark.parametrize(("size", "cells"), [(0.0, 4), (float("nan"), 4), (1.0, 0)])
def test_a_grid_without_cells_is_refused(size, cells):
    with pytest.raises(ValueError, match="a grid needs cells"):
        GridFrame((0.0, 0.0, 0.0), size, cells)


def test_a_point_has_no_grid():
    with pytest.raises(ValueError, match="a point has no size"):
        cube_frame(np.zeros((2, 3)), 4)
