"""Part boundaries of a skin: moved to creases and seams of colour, and cut through large faces."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from simart_kit_plugins.nano.boundaries import refining
from simart_kit_plugins.nano.boundaries.cutting import cut
from simart_kit_plugins.nano.boundaries.halving import halved, undivided
from simart_kit_plugins.nano.boundaries.islands import without_islands
from simart_kit_plugins.nano.boundaries.links import links
from simart_kit_plugins.nano.boundaries.min_cut import min_cut
from simart_kit_plugins.nano.boundaries.patch_parts import patch_parts, patch_size
from simart_kit_plugins.nano.boundaries.polygons import triangulated
from simart_kit_plugins.nano.boundaries.refining import refined
from simart_kit_plugins.nano.boundaries.region import region_of
from simart_kit_plugins.nano.superfaces import superfaces

from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import box
from simart_kit.topology import edges, weld

CELLS = 40


def sheet(height=lambda x: 0 * x) -> Mesh:
    """A sheet of 1 x 1 m in cells of two triangles, z by x; no two triangles share a vertex."""
    i, j = (index.ravel() for index in np.mgrid[:CELLS, :CELLS])
    corner = [np.stack([i + a, j + b], axis=1) / CELLS for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    flat = np.stack(
        [np.stack([corner[k] for k in three], axis=1) for three in ((0, 1, 2), (0, 2, 3))], axis=1
    )
    flat = flat.reshape(-1, 2)
    points = np.column_stack([flat, height(flat[:, 0])])
    return Mesh(points, np.arange(len(points)).reshape(-1, 3))


def painted(mesh: Mesh, dark) -> Mesh:
    """The mesh with faces in two greys."""
    grey = np.repeat(np.where(dark, 60, 200), 3).astype(np.uint8)
    colors = np.stack([grey, grey, grey, np.full_like(grey, 255)], axis=1)
    return Mesh(mesh.vertices, mesh.faces, colors=colors)


def middles(mesh: Mesh):
    return mesh.triangles.mean(axis=1)


def ragged(mesh: Mesh):
    """Two parts whose end swings to and fro about x = 0.5, by 0.1 m."""
    x, y, _ = middles(mesh).T
    return (x > 0.5 + 0.1 * np.sign(np.sin(20 * y))).astype(np.int32)


def end_length(mesh: Mesh, label) -> float:
    around = links(mesh)
    return float(around.length[label[around.left] != label[around.right]].sum())


def test_an_end_moves_to_the_seam_of_colour_beside_it():
    mesh = sheet()
    right = middles(mesh)[:, 0] > 0.5
    mesh = painted(mesh, right)
    assert np.array_equal(refined(mesh, ragged(mesh), 0.4), right)


def test_an_end_moves_to_the_concave_crease_beside_it():
    mesh = sheet(lambda x: np.abs(x - 0.5))
    assert np.array_equal(refined(mesh, ragged(mesh), 0.4), middles(mesh)[:, 0] > 0.5)


def test_a_concave_crease_is_preferred_to_a_sharper_convex_one():
    # Up 45 degrees until 0.4 and down 30 until 0.6: convex by 75 degrees at 0.4, concave by 30 at 0.6.
    down = np.tan(np.deg2rad(30))
    mesh = sheet(lambda x: np.minimum(x, 0.4) - down * np.clip(x - 0.4, 0, 0.2))
    assert np.array_equal(refined(mesh, ragged(mesh), 0.6), middles(mesh)[:, 0] > 0.6)


def test_an_end_on_plain_surface_gets_shorter():
    mesh = sheet()
    before = ragged(mesh)
    assert end_length(mesh, refined(mesh, before, 0.2)) < 0.8 * end_length(mesh, before)


def test_what_is_far_from_an_end_keeps_its_part():
    mesh = sheet()
    right = middles(mesh)[:, 0] > 0.5
    mesh = painted(mesh, middles(mesh)[:, 0] > 0.8)
    assert np.array_equal(refined(mesh, right.astype(np.int32), 0.1), right)


def test_three_parts_end_at_their_seams():
    mesh = sheet()
    x, y, _ = middles(mesh).T
    right, top = x > 0.5, y > 0.5
    mesh = painted(mesh, np.where(right, True, top))
    truth = np.where(right, 2, np.where(top, 1, 0))
    rough = np.where(x > 0.55, 2, np.where(y > 0.55, 1, 0)).astype(np.int32)
    result = refined(mesh, rough, 0.2)
    agree = (result == truth) | (right & top)  # these two look alike where they meet
    assert mesh.face_areas[~agree].sum() < 0.005
    assert set(result) == {0, 1, 2}


def test_a_part_of_one_face_is_kept():
    mesh = sheet()
    label = np.zeros(len(mesh.faces), dtype=np.int32)
    label[1000] = 1
    assert refined(mesh, label, 0.2)[1000] == 1


def test_faces_broader_than_the_band_are_kept():
    mesh = Mesh(*box((0, 0, 0), (1, 1, 1)))
    label = (np.arange(12) == 4).astype(np.int32)
    assert np.array_equal(refined(mesh, label, 0.5), label)


def test_one_part_and_one_face_need_no_cut():
    mesh = sheet()
    assert not refined(mesh, np.zeros(len(mesh.faces), np.int32), 0.2).any()
    single = Mesh(mesh.vertices[:3], np.array([[0, 1, 2]]))
    assert refined(single, np.zeros(1, np.int32), 0.2).tolist() == [0]


def test_the_band_is_narrowed_where_it_holds_too_many_faces(monkeypatch):
    monkeypatch.setattr(refining, "MOST_FREE", 400)
    mesh = painted(sheet(), middles(sheet())[:, 0] > 0.5)
    before = ragged(mesh)
    assert 0 < (refined(mesh, before, 0.4) != before).sum() <= 400


def test_min_cut_is_as_cheap_as_the_best_of_all_ways():
    generator = np.random.default_rng(3)
    count = 7
    for _ in range(20):
        left, right = generator.integers(count, size=(2, 12))
        left, right = left[left != right], right[left != right]
        cost = generator.random(len(left))
        stays, leaves = generator.random((2, count)) * 2

        def total(side, left=left, right=right, cost=cost, stays=stays, leaves=leaves):
            return cost[side[left] != side[right]].sum() + stays[~side].sum() + leaves[side].sum()

        best = min(total(np.array(side)) for side in itertools.product([False, True], repeat=count))
        assert total(min_cut(left, right, cost, stays, leaves)) == pytest.approx(best, abs=1e-3)


def test_an_island_goes_to_the_part_with_which_it_shares_most_edge():
    mesh = sheet()
    x, y, _ = middles(mesh).T
    island = (x > 0.4) & (x < 0.55) & (y > 0.4) & (y < 0.6)
    label = np.where(island, 2, x > 0.5).astype(np.int32)
    result = without_islands(label, island, links(mesh))
    assert (result[island] == 0).all()  # 2/3 of it lie at x < 0.5
    assert np.array_equal(result[~island], label[~island])


def test_turns_are_positive_where_the_surface_is_concave():
    around = links(Mesh(*box((0, 0, 0), (1, 1, 1))))
    assert len(around.left) == 18
    assert sorted(np.rint(np.rad2deg(around.turn)).tolist()) == [-90] * 12 + [0] * 6


def test_a_triangle_with_corners_on_its_sides_is_divided_without_slivers_of_no_area():
    points = np.array([[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [2, 2], [1, 3], [0, 4], [0, 1]], dtype=float)
    sides = [0b101, 1, 1, 1, 0b011, 2, 2, 0b110, 4]
    triangles = triangulated(np.column_stack([points, np.zeros(9)]), sides)
    a, b, c = points[triangles].transpose(1, 0, 2)
    area = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    assert len(triangles) == 7
    assert (area > 0.1).all()
    assert area.sum() == pytest.approx(8.0)


def test_halved_faces_meet_corner_to_corner_and_know_where_they_are_from():
    mesh = Mesh(*box((0, 0, 0), (1, 2, 3)))
    pieces = undivided(region_of(mesh, np.arange(12)))
    for step in range(4):
        sides = np.random.default_rng(step).random(pieces.mesh.faces.shape) < 0.2
        pieces = halved(pieces, sides)
    assert len(pieces.mesh.faces) > 50
    assert (np.bincount(edges(pieces.vertex[pieces.mesh.faces]).ravel()) == 2).all()
    assert pieces.mesh.face_areas.sum() == pytest.approx(22.0)
    assert np.allclose(pieces.weights @ mesh.triangles[pieces.source], pieces.mesh.triangles)


def door_at(mesh: Mesh):
    """The part at a place of a cube: 1 in a door of 0.6 x 0.7 m amid its front."""

    def at(face, weights):
        x, y, z = np.einsum("nk,nkx->nx", weights, mesh.triangles[face]).T
        return ((np.abs(x - 0.5) < 0.3) & (np.abs(z - 0.5) < 0.35) & (y < 1e-9)).astype(np.int32)

    return at


def unshared(mesh: Mesh) -> Mesh:
    """The mesh with corners of their own for each face, as at seams of a texture everywhere."""
    return mesh.on_vertices(mesh.faces.ravel(), np.arange(mesh.faces.size).reshape(-1, 3))


@pytest.mark.parametrize("seams", [False, True])
def test_a_door_is_cut_out_of_a_cube_of_twelve_triangles(seams):
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    normals = (vertices - 0.5) / np.linalg.norm(vertices - 0.5, axis=1, keepdims=True)
    mesh = Mesh(vertices, faces, normals=normals, uv=vertices[:, [0, 2]], face_node=np.arange(12))
    mesh = unshared(mesh) if seams else mesh
    made = cut(mesh, np.zeros(12, np.int32), door_at(mesh), 0.1)
    corners = weld(made.mesh.vertices, 1e-6)[made.mesh.faces]
    assert (np.bincount(edges(corners).ravel()) == 2).all()
    assert made.mesh.face_areas.sum() == pytest.approx(6.0)
    assert made.mesh.face_areas[made.face_part == 1].sum() == pytest.approx(0.42, rel=0.05)
    assert np.allclose(made.mesh.uv, made.mesh.vertices[:, [0, 2]])
    assert np.allclose(np.linalg.norm(made.mesh.normals, axis=1), 1)
    assert (np.diff(made.face_source) >= 0).all()
    assert np.array_equal(made.mesh.face_node, made.face_source)
    assert np.allclose(made.mesh.face_normals, mesh.face_normals[made.face_source])
    # Only the front's two triangles hold the door; four others share a side with them.
    pieces = np.bincount(made.face_source)
    assert pieces[[4, 5]].min() > 10
    assert (pieces > 1).sum() <= 6


def test_a_mesh_that_needs_no_cut_comes_back_itself():
    mesh = sheet()
    right = (middles(mesh)[:, 0] > 0.5).astype(np.int32)

    def at(face, weights):
        return (np.einsum("nk,nkx->nx", weights, mesh.triangles[face])[:, 0] > 0.5).astype(np.int32)

    made = cut(mesh, right, at, 0.2)
    assert made.mesh is mesh
    assert np.array_equal(made.face_part, right)
    assert np.array_equal(made.face_source, np.arange(len(mesh.faces)))


def test_places_have_the_part_of_the_nearest_patch():
    mesh = painted(sheet(), middles(sheet())[:, 0] > 0.5)
    points = middles(mesh) - [0.5, 0.5, 0]
    grey = np.where(points[:, :1] > 0, 60 / 255, 200 / 255) * np.ones((1, 3))
    _, patches = superfaces(points, mesh.face_normals, grey, 30, np.random.default_rng(0))
    at = patch_parts(mesh, patches, (patches[:, 0] > 0).astype(np.int32))
    face = np.arange(len(mesh.faces))
    said = at(face, np.full((len(face), 3), 1 / 3))
    assert (said == (points[:, 0] > 0)).mean() > 0.95  # patches are not cut exactly at the seam
    assert patch_size(mesh, 25) == pytest.approx(0.2)
