"""Rough open skins as walls: how many, where, and what is kept free."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.decompose import Budget, decompose
from simart_kit.hulls import volume
from simart_kit.sheets import SHEET

SIZE, CELL, ROUGH = np.array([0.6, 0.5, 0.8]), 0.025, 0.003
DEEP = 0.015


def cells(rows: int, columns: int) -> IntArray:
    """(F, 3) two triangles for each cell of a grid of points, row by row."""
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    a, b, c, d = corner, corner + columns + 1, corner + columns + 2, corner + 1
    return np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def grid(axis: int, side: float) -> tuple[FloatArray, IntArray]:
    """A side of a box as a fine grid of triangles that look out of it."""
    u, v = (axis + 1) % 3, (axis + 2) % 3
    rows, columns = (round(SIZE[k] / CELL) for k in (u, v))
    i, j = (x.ravel() for x in np.mgrid[: rows + 1, : columns + 1])
    points = np.zeros((len(i), 3))
    points[:, axis], points[:, u], points[:, v] = side * SIZE[axis], i * CELL, j * CELL
    faces = cells(rows, columns)
    return points, faces if side else faces[:, ::-1]


def rough_box(inside_out: bool) -> tuple[FloatArray, IntArray]:
    """A box without its front (y = 0), whose vertices are off by up to 3 mm."""
    sides = [grid(axis, side) for axis, side in ((0, 0), (0, 1), (1, 1), (2, 0), (2, 1))]
    starts = np.cumsum([0, *(len(points) for points, _ in sides)])
    points = np.concatenate([points for points, _ in sides])
    faces = np.concatenate([faces + start for (_, faces), start in zip(sides, starts, strict=False)])
    first, same = np.unique(
        np.round(points / CELL).astype(int), axis=0, return_index=True, return_inverse=True
    )[1:]
    shaken = points[first] + np.random.default_rng(0).uniform(-ROUGH, ROUGH, (len(first), 3))
    corners = same.ravel()[faces]
    return shaken, corners[:, ::-1] if inside_out else corners


@pytest.mark.parametrize("inside_out", [False, True])
def test_a_rough_box_without_a_front_becomes_its_five_walls_and_stays_hollow(inside_out: bool) -> None:
    found = decompose(*rough_box(inside_out), Budget(tool_seconds=0.0))
    x, y, z = SIZE
    walls, deep = SHEET * (2 * y * z + x * z + 2 * x * y), SHEET + 4 * ROUGH
    large = [shape for shape in found.shapes if volume(shape) > 0.1 * walls]
    assert len(large) == 5
    assert sum(map(volume, large)) == pytest.approx(walls, rel=0.15)
    ends = np.array([(shape.vertices.min(axis=0), shape.vertices.max(axis=0)) for shape in found.shapes])
    np.testing.assert_allclose(ends[:, 0].min(axis=0), 0, atol=2 * ROUGH)
    np.testing.assert_allclose(ends[:, 1].max(axis=0), SIZE, atol=2 * ROUGH)
    assert ((ends[:, 1] < deep) | (ends[:, 0] > SIZE - deep)).any(axis=1).all()  # each lies along a side


def outside(corners: FloatArray, point: FloatArray) -> float:
    """How far a point lies outside the hull of (N, 3) corners; negative within it."""
    planes = ConvexHull(corners).equations
    return float((planes[:, :3] @ point + planes[:, 3]).max())


def rough_front() -> tuple[FloatArray, IntArray]:
    """A drawer's front that looks along +y, a grid off by up to 1 mm, its field 15 mm deeper."""
    cell, columns, rows = 0.008, 75, 25
    i, j = (x.ravel() for x in np.mgrid[: rows + 1, : columns + 1])
    field = (i > 5) & (i < rows - 5) & (j > 5) & (j < columns - 5)
    points = np.column_stack([j * cell, np.where(field, 0.0, DEEP), i * cell])
    points += np.random.default_rng(1).uniform(-0.001, 0.001, points.shape)
    return points, cells(rows, columns)


def test_a_rough_front_becomes_few_boards_that_leave_its_field_free() -> None:
    vertices, faces = rough_front()
    found = decompose(vertices, faces, Budget(tool_seconds=0.0))
    assert len(found.shapes) <= 16
    over_field = np.array([0.3, DEEP - 0.003, 0.1])
    assert all(outside(shape.vertices, over_field) > 0 for shape in found.shapes)
    middles = vertices[faces].mean(axis=1)
    gaps = [min(outside(shape.vertices, point) for shape in found.shapes) for point in middles]
    assert np.mean(np.maximum(gaps, 0)) < 0.002
