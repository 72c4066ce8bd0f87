"""Primitives that stand for convex pieces, and their meshes."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from simart_kit.arrays import FloatArray, vec3
from simart_kit.asset import ConvexMesh
from simart_kit.fitting import _ROUND, fitted
from simart_kit.hulls import convex_hull, hull_of, volume
from simart_kit.kinematics import rotation
from simart_kit.primitive_meshes import pose, primitive_shape
from simart_kit.primitives import Primitive

TURN = rotation(np.array([0.4, -1.1, 0.7]))
SHIFT = np.array([0.3, -0.2, 1.0])
CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float64)


def placed(points: FloatArray) -> FloatArray:
    return np.asarray(points @ TURN.T + SHIFT)


def fit(points: FloatArray) -> ConvexMesh | None:
    """What fits the hull of points, which they are."""
    hull = hull_of(points)
    assert hull is not None
    return fitted(points, volume(hull))


def primitive(points: FloatArray) -> Primitive:
    shape = fit(points)
    assert shape is not None
    assert shape.primitive is not None
    return shape.primitive


def bevelled(size: tuple[float, float, float], cut: float) -> FloatArray:
    """The corners of a box whose upright edges are cut off at 45 degrees."""
    (x, y, z), b = size, cut
    outline = [(b, 0), (x - b, 0), (x, b), (x, y - b), (x - b, y), (b, y), (0, y - b), (0, b)]
    return np.array([(*p, h) for p in outline for h in (0.0, z)])


def test_a_turned_box_is_found_exactly() -> None:
    found = primitive(placed(CORNERS * [0.5, 0.02, 0.3]))
    assert found.kind == "box"
    assert sorted(found.size) == pytest.approx([0.02, 0.3, 0.5])
    np.testing.assert_allclose(found.asset_T_shape[:3, 3], placed(np.array([[0.25, 0.01, 0.15]]))[0])


def test_a_box_along_the_axes_has_the_axes_of_the_asset() -> None:
    found = primitive(CORNERS * [0.5, 0.02, 0.3])
    np.testing.assert_array_equal(found.asset_T_shape[:3, :3], np.eye(3))
    assert found.size == pytest.approx((0.5, 0.02, 0.3))


@pytest.mark.parametrize("turned", [False, True])
def test_a_board_with_small_bevels_is_a_box(turned: bool) -> None:
    points = bevelled((0.6, 0.02, 0.4), 0.004)
    found = primitive(placed(points) if turned else points)
    assert found.kind == "box"
    assert sorted(found.size) == pytest.approx([0.02, 0.4, 0.6])


def test_a_block_with_a_large_corner_cut_off_is_no_box() -> None:
    points = np.concatenate([CORNERS[:-1], [[1, 1, 0.4], [1, 0.4, 1], [0.4, 1, 1]]])
    assert fit(points) is None  # 0.6^3 / 6 = 3.6 % of it is missing, and the corner lies 0.35 outside


@pytest.mark.parametrize("sections", [16, 64])
def test_a_turned_cylinder(sections: int) -> None:
    found = primitive(placed(trimesh.creation.cylinder(0.05, 0.3, sections=sections).vertices))
    assert found.kind == "cylinder"
    assert found.size == pytest.approx((0.1, 0.1, 0.3))
    np.testing.assert_allclose(np.abs(found.asset_T_shape[:3, 2]), np.abs(TURN[:, 2]), atol=1e-9)
    np.testing.assert_allclose(found.asset_T_shape[:3, 3], SHIFT, atol=1e-9)


def test_a_prism_of_six_sides_stays_a_hull() -> None:
    assert fit(trimesh.creation.cylinder(0.05, 0.3, sections=6).vertices) is None


@pytest.mark.parametrize("top", [6, 7, 8])
def test_fewer_corners_than_are_asked_for_fill_no_cylinder(top: int) -> None:
    # Two polygons turned against each other fill more than a prism: their middle has twice as many sides.
    for twist in np.linspace(0, np.pi / 7, 9):
        ends = [(np.arange(n) / n * 2 * np.pi + twist * z, z) for n, z in ((15 - top, 0.0), (top, 1.0))]
        points = np.concatenate([np.stack([np.cos(a), np.sin(a), np.full(len(a), z)], 1) for a, z in ends])
        hull = convex_hull(points)
        assert len(hull.vertices) == _ROUND - 1
        assert volume(hull) < 0.93 * np.pi


def test_volume_that_was_counted_twice_makes_nothing_round() -> None:
    # Surfaces that lie inside each other, as of a clock's case and works: no solid fills more than its hull.
    corner = np.array([(0.5, 0.4), (0.4, 0.5), (-0.4, 0.5), (-0.5, 0.4)])
    ring = np.concatenate([corner, -corner])
    points = np.array([(x, y, z) for x, y in ring for z in (0.0, 0.2)])
    assert fitted(points, 2 * 0.98 * 0.2) is None


def test_a_sphere() -> None:
    found = primitive(placed(trimesh.creation.icosphere(3, 0.1).vertices))
    assert found.kind == "sphere"
    assert found.size == pytest.approx((0.2, 0.2, 0.2))
    np.testing.assert_allclose(found.asset_T_shape[:3, 3], SHIFT, atol=1e-9)


def test_a_solid_that_does_not_fill_the_box_gets_none() -> None:
    assert fitted(CORNERS, 0.94) is None
    assert fitted(CORNERS, 0.96) is not None
    assert fitted(CORNERS, 0.96, filled=0.99) is None


def test_flat_points_get_none() -> None:
    assert fitted(CORNERS[:4], 0.0) is None


SHAPES = [
    Primitive("box", vec3([0.1, 0.2, 0.3]), pose(TURN, SHIFT)),
    Primitive("cylinder", vec3([0.2, 0.2, 0.3]), pose(TURN, SHIFT)),
    Primitive("sphere", vec3([0.2, 0.2, 0.2]), pose(TURN, SHIFT)),
]


@pytest.mark.parametrize(("shape", "filled"), list(zip(SHAPES, [1.0, 0.99, 0.87], strict=True)))
def test_a_primitives_mesh_lies_in_it_and_is_small_and_closed(shape: Primitive, filled: float) -> None:
    mesh = primitive_shape(shape)
    assert mesh.primitive is shape
    assert len(mesh.vertices) <= 64
    local = np.abs((mesh.vertices - SHIFT) @ TURN) / np.array(shape.size) * 2
    reach = {
        "box": local.max(axis=1),
        "cylinder": np.maximum(np.hypot(local[:, 0], local[:, 1]), local[:, 2]),
        "sphere": np.linalg.norm(local, axis=1),
    }[shape.kind]
    np.testing.assert_allclose(reach, 1.0, atol=1e-9)
    assert filled - 1e-9 <= volume(mesh) / shape.volume <= 1 + 1e-9
    edges = np.sort(mesh.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
