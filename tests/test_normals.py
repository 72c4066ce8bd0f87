"""Normals for meshes without any: sharp on boxes, smooth on balls."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
import trimesh

from simart_kit.arrays import FloatArray
from simart_kit.mesh import Mesh
from simart_kit.normals import with_normals
from simart_kit.testing.meshes import boxes_mesh, cabinet_mesh


def corner_normals(mesh: Mesh) -> FloatArray:
    """(F, 3, 3) normal at each corner of each face."""
    normals = with_normals(mesh).normals
    assert normals is not None
    return normals[with_normals(mesh).faces]


def unwelded(mesh: Mesh) -> Mesh:
    return Mesh(mesh.triangles.reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3))


def roof(slope: float, width: float = 1.0) -> Mesh:
    """Two strips that meet in an edge along y: one level, one of some width falling at a slope [rad]."""
    down = width * np.array([np.cos(slope), 0, -np.sin(slope)])
    vertices = np.array([[-1, 0, 0], [-1, 1, 0], [0, 0, 0], [0, 1, 0], down, down + [0, 1, 0]])
    return Mesh(vertices, np.array([[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]]))


def test_a_box_has_sharp_edges_and_four_corners_a_side() -> None:
    mesh = boxes_mesh([((0, 0, 0), (1, 2, 3))])
    result = with_normals(mesh)
    assert result.vertices.shape == (24, 3)
    np.testing.assert_allclose(corner_normals(mesh), np.repeat(mesh.face_normals[:, None], 3, axis=1))


def test_a_ball_is_smooth_and_stays_welded() -> None:
    ball = trimesh.creation.icosphere(subdivisions=3)
    result = with_normals(Mesh(ball.vertices, ball.faces))
    assert len(result.vertices) == len(ball.vertices)
    assert result.normals is not None
    outward = result.vertices / np.linalg.norm(result.vertices, axis=1, keepdims=True)
    assert np.einsum("ij,ij->i", result.normals, outward).min() > np.cos(np.deg2rad(1.0))


def test_vertices_may_stand_apart() -> None:
    """Seams of a texture split vertices: the surface is as smooth across them."""
    ball = trimesh.creation.icosphere(subdivisions=2)
    for mesh in (Mesh(ball.vertices, ball.faces), cabinet_mesh()):
        np.testing.assert_allclose(corner_normals(unwelded(mesh)), corner_normals(mesh), atol=1e-3)


@pytest.mark.parametrize(("degrees", "smooth"), [(34.0, True), (36.0, False)])
def test_the_crease_angle_decides(degrees: float, smooth: bool) -> None:
    mesh = roof(np.deg2rad(degrees))
    assert (len(with_normals(mesh).vertices) == 6) is smooth


def test_the_crease_angle_can_be_set() -> None:
    mesh = roof(np.deg2rad(60.0))
    assert len(with_normals(mesh).vertices) == 8
    assert len(with_normals(mesh, crease=np.deg2rad(61.0)).vertices) == 6


def test_normals_are_weighted_by_area() -> None:
    """Corner 3 has one face of the level strip (area 1/2) and two of the falling one (area 3 in all)."""
    slope = np.deg2rad(30.0)
    mesh = roof(slope, width=3.0)
    total = 0.5 * np.array([0, 0, 1.0]) + 3.0 * np.array([np.sin(slope), 0, np.cos(slope)])
    np.testing.assert_allclose(corner_normals(mesh)[3, 0], total / np.linalg.norm(total), atol=1e-12)


def test_looks_follow_split_vertices_and_faces_keep_their_order() -> None:
    mesh = cabinet_mesh()
    mesh = replace(mesh, colors=np.arange(4 * len(mesh.vertices), dtype=np.uint8).reshape(-1, 4))
    result = with_normals(mesh)
    np.testing.assert_array_equal(result.triangles, mesh.triangles)
    assert result.uv is not None
    assert mesh.uv is not None
    assert result.colors is not None
    assert mesh.colors is not None
    np.testing.assert_array_equal(result.uv[result.faces], mesh.uv[mesh.faces])
    np.testing.assert_array_equal(result.colors[result.faces], mesh.colors[mesh.faces])
    np.testing.assert_array_equal(result.face_material, mesh.face_material)


def test_normals_that_are_there_stay() -> None:
    mesh = with_normals(cabinet_mesh())
    assert with_normals(mesh) is mesh


def test_faces_without_area_do_no_harm() -> None:
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 1], [5, 5, 5]])
    mesh = Mesh(vertices, np.array([[0, 1, 2], [0, 1, 1], [3, 3, 3]]))
    normals = corner_normals(mesh)
    np.testing.assert_allclose(normals[0], np.tile([0.0, -1, 0], (3, 1)))
    np.testing.assert_allclose(np.linalg.norm(normals, axis=2), 1.0)


def test_the_two_sides_of_a_sheet_keep_their_own_normals() -> None:
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    normals = corner_normals(Mesh(vertices, np.array([[0, 1, 2], [0, 2, 1]])))
    np.testing.assert_allclose(normals[0], np.tile([0, 0, 1.0], (3, 1)))
    np.testing.assert_allclose(normals[1], np.tile([0, 0, -1.0], (3, 1)))


def test_a_fan_of_thousands_at_a_crease_takes_memory_in_proportion() -> None:
    """Every pair of its faces would be 16 million numbers a column."""
    count = 4000
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)
    vertices = np.vstack([np.column_stack([np.cos(turn), np.sin(turn), np.zeros(count)]), [0.0, 0.0, 1.0]])
    rim = np.arange(count)
    cone = Mesh(vertices, np.column_stack([rim, np.roll(rim, -1), np.full(count, count)]))
    tracemalloc.start()
    normals = with_normals(cone).normals
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert normals is not None
    np.testing.assert_allclose(normals[:, 2], np.sqrt(0.5), atol=1e-3)
    assert peak < 20e6
