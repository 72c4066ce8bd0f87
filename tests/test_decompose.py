"""The ladder: from primitives over exact cuts to voxels, within a budget."""

from __future__ import annotations

import manifold3d
import numpy as np
import pytest
import trimesh

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.asset import ConvexMesh
from simart_kit.decompose import Budget, decompose
from simart_kit.hulls import volume
from simart_kit.pieces import simpler, solid_body
from simart_kit.sheets import SHEET
from simart_kit.testing.meshes import box, boxes_mesh

from .furniture import carcass, drawer

Surface = tuple[FloatArray, IntArray]
Corner = tuple[float, float, float]
CUTS_ONLY = Budget(tool_seconds=0.0)


def united(boxes: list[tuple[Corner, Corner]]) -> Surface:
    """Boxes as one shell."""
    solids = [manifold3d.Manifold.cube(tuple(np.subtract(b, a))).translate(a) for a, b in boxes]
    mesh = manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add).to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)


def inside(shapes: tuple[ConvexMesh, ...], point: tuple[float, float, float]) -> bool:
    """Whether any shape holds a point, by the signed volumes of its faces."""
    for shape in shapes:
        a, b, c = (shape.vertices[shape.faces[:, i]] - point for i in range(3))
        if (np.einsum("ni,ni->n", a, np.cross(b, c)) > 0).all():
            return True
    return False


def of_boards(boxes: list[tuple[Corner, Corner]]) -> float:
    return float(sum(np.prod(np.subtract(b, a)) for a, b in boxes))


class TestOneShell:
    boards = carcass((-0.3, 0.3), (-0.2, 0.2), (0.0, 0.7))

    def test_a_carcass_becomes_its_five_boards_exactly(self) -> None:
        found = decompose(*united(self.boards), CUTS_ONLY)
        assert [s.primitive.kind for s in found.shapes if s.primitive] == ["box"] * 5
        assert sum(map(volume, found.shapes)) == pytest.approx(of_boards(self.boards), rel=1e-9)
        assert not inside(found.shapes, (0.0, -0.19, 0.35))
        assert inside(found.shapes, (0.0, 0.197, 0.35))

    def test_turned_and_wound_inside_out_it_is_the_same(self) -> None:
        vertices, faces = united(self.boards)
        turn = trimesh.transformations.rotation_matrix(0.7, [1, 2, 3])[:3, :3]
        found = decompose(vertices @ turn.T, faces[:, ::-1], CUTS_ONLY)
        assert len(found.shapes) == 5
        assert sum(map(volume, found.shapes)) == pytest.approx(of_boards(self.boards), rel=1e-6)

    def test_a_drawer_with_its_handle(self) -> None:
        boards = drawer((-0.2, 0.2), -0.2, 0.2, (0.1, 0.3))
        found = decompose(*united(boards), CUTS_ONLY)
        assert sum(map(volume, found.shapes)) == pytest.approx(of_boards(boards), rel=0.01)
        assert not inside(found.shapes, (0.0, 0.0, 0.2))

    def test_a_budget_is_kept(self) -> None:
        for most in (1, 3, 4):
            found = decompose(*united(self.boards), Budget(shapes=most, tool_seconds=0.0))
            assert len(found.shapes) <= most

    def test_a_ring_of_many_sides_opens(self) -> None:
        ring = trimesh.creation.annulus(0.06, 0.08, 0.05, sections=32)
        found = decompose(np.asarray(ring.vertices), np.asarray(ring.faces), CUTS_ONLY)
        assert not inside(found.shapes, (0.0, 0.0, 0.0))
        assert sum(map(volume, found.shapes)) == pytest.approx(ring.volume, rel=0.05)

    def test_what_cannot_be_cut_goes_to_the_tool(self) -> None:
        found = decompose(*united(self.boards), Budget(work=0, tool_seconds=60.0))
        assert len(found.shapes) > 4
        assert found.problem == ""
        assert not inside(found.shapes, (0.0, -0.1, 0.35))

    def test_a_tool_that_fails_leaves_the_hull(self) -> None:
        found = decompose(*united(self.boards), Budget(work=0, tool_seconds=0.01))
        (shape,) = found.shapes
        assert volume(shape) == pytest.approx(0.6 * 0.4 * 0.7)
        assert "took longer" in found.problem


def rough(boxes: list[tuple[Corner, Corner]], by: float, side: float = 0.011) -> Surface:
    """Boxes as one shell of faces with sides so long, whose vertices lie up to `by` [m] beside it."""
    fine = solid(united(boxes)).refine_to_length(side).to_mesh64()
    places = np.asarray(fine.vert_properties)[:, :3]
    shaken = np.random.default_rng(0).uniform(-by, by, places.shape)
    return places + shaken, np.asarray(fine.tri_verts).astype(np.int64)


def solid(surface: Surface) -> manifold3d.Manifold:
    body = solid_body(*surface)
    assert body is not None
    return body


def test_a_solid_of_many_faces_keeps_its_place_with_fewer() -> None:
    many = solid(rough([((0.0, 0.0, 0.0), (0.6, 0.4, 0.7))], 1e-4))
    found = simpler(many)
    assert found.num_tri() < many.num_tri() / 3
    assert found.volume() == pytest.approx(0.6 * 0.4 * 0.7, rel=0.01)
    np.testing.assert_allclose(found.bounding_box(), [0, 0, 0, 0.6, 0.4, 0.7], atol=0.002)
    assert simpler(found).num_tri() <= found.num_tri()


def test_thin_walls_stay_where_a_solid_loses_faces() -> None:
    board = ((0.0, 0.0, 0.0), (0.6, 0.004, 0.4))
    assert simpler(solid(rough([board], 1e-3))).volume() == pytest.approx(of_boards([board]), rel=0.15)


def test_a_rough_stool_is_open_between_its_legs() -> None:
    feet = [(x, y) for x in (0.0, 0.36) for y in (0.0, 0.36)]
    boxes = [((x, y, 0.0), (x + 0.04, y + 0.04, 0.46)) for x, y in feet]
    boxes += [((0.0, 0.0, 0.45), (0.4, 0.4, 0.48)), ((0.02, 0.01, 0.15), (0.38, 0.03, 0.18))]
    found = decompose(*rough(boxes, 1.5e-3, 0.006), CUTS_ONLY)
    assert not inside(found.shapes, (0.2, 0.2, 0.3))
    assert not inside(found.shapes, (0.2, 0.38, 0.1))
    assert inside(found.shapes, (0.2, 0.02, 0.165))
    assert sum(map(volume, found.shapes)) == pytest.approx(solid(united(boxes)).volume(), rel=0.1)


class TestOpenSurfaces:
    vertices, faces = box((0.0, 0.0, 0.0), (0.4, 0.5, 0.2))

    def without(self, axis: int, side: float) -> IntArray:
        return np.asarray(self.faces[~(self.vertices[self.faces][:, :, axis] == side).all(axis=1)])

    def test_a_sheet_without_a_top_becomes_five_boards_within_it(self) -> None:
        found = decompose(self.vertices, self.without(2, 0.2), CUTS_ONLY)
        assert len(found.shapes) == 5
        assert all(shape.primitive for shape in found.shapes)
        assert not inside(found.shapes, (0.2, 0.25, SHEET + 0.001))
        points = np.concatenate([shape.vertices for shape in found.shapes])
        np.testing.assert_allclose(points.min(axis=0), 0, atol=1e-9)
        np.testing.assert_allclose(points.max(axis=0), [0.4, 0.5, 0.2], atol=1e-9)

    @pytest.mark.parametrize("inward", [False, True])
    def test_whichever_way_it_is_wound(self, inward: bool) -> None:
        faces = self.without(1, 0.0)
        found = decompose(self.vertices, faces[:, ::-1] if inward else faces, CUTS_ONLY)
        points = np.concatenate([shape.vertices for shape in found.shapes])
        np.testing.assert_allclose(points.min(axis=0), 0, atol=1e-9)
        np.testing.assert_allclose(points.max(axis=0), [0.4, 0.5, 0.2], atol=1e-9)

    def test_walls_that_lack_a_rim_are_closed(self) -> None:
        outer, inner = box((0, 0, 0), (0.4, 0.5, 0.3)), box((0.02, 0.02, 0.02), (0.38, 0.48, 0.3))
        vertices = np.concatenate([outer[0], inner[0]])
        faces = np.concatenate([outer[1], inner[1][:, ::-1] + 8])
        rims = (vertices[faces][:, :, 2] == 0.3).all(axis=1)
        corners = {tuple(v[:2]): i for i, v in enumerate(vertices) if v[2] == 0.3}
        a, b, c, d = (corners[p] for p in ((0.0, 0.0), (0.4, 0.0), (0.38, 0.02), (0.02, 0.02)))
        one_rim = [(a, b, c), (a, c, d)]  # the other three are missing
        found = decompose(vertices, np.concatenate([faces[~rims], one_rim]), CUTS_ONLY)
        assert sum(map(volume, found.shapes)) == pytest.approx(0.06 - 0.36 * 0.46 * 0.28, rel=1e-6)

    def test_a_flat_sheet_is_a_thin_box(self) -> None:
        face = np.array([[0, 1, 2], [0, 2, 3]])
        square = np.array([[0, 0, 0], [0.4, 0, 0], [0.4, 0.3, 0], [0, 0.3, 0]], dtype=np.float64)
        (shape,) = decompose(square, face, CUTS_ONLY).shapes
        assert sorted(np.ptp(shape.vertices, axis=0)) == pytest.approx([SHEET, 0.3, 0.4])


def test_a_small_open_cap_is_hollow_and_a_bulged_sheet_of_its_size_is_not() -> None:
    vertices, faces = box((0.0, 0.0, 0.0), (0.03, 0.04, 0.03))
    open_end = faces[~(vertices[faces][:, :, 1] == 0.04).all(axis=1)]
    cap = decompose(vertices, open_end, CUTS_ONLY).shapes
    assert len(cap) == 5
    assert not inside(cap, (0.015, 0.02, 0.015))
    bulged = np.array([[0, 0, 0], [0.02, 0, 0], [0.02, 0.02, 0], [0, 0.02, 0], [0.01, 0.01, 0.0005]])
    fan = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    assert len(decompose(bulged, fan, CUTS_ONLY).shapes) == 1


def test_pieces_hidden_in_others_cost_nothing() -> None:
    mesh = boxes_mesh(
        [((0, 0, 0), (1, 0.1, 1)), ((0.1, 0.02, 0.1), (0.9, 0.08, 0.9)), ((3, 0, 0), (3.1, 1, 1))]
    )
    found = decompose(mesh.vertices, mesh.faces, CUTS_ONLY)
    assert [volume(shape) for shape in found.shapes] == pytest.approx([0.1, 0.1])


def test_a_hollow_piece_stays_hollow_among_a_hundred_crumbs() -> None:
    rng = np.random.default_rng(0)
    vertices, faces = united(carcass((-0.3, 0.3), (-0.2, 0.2), (0.0, 0.7)))
    corners = rng.uniform((-0.25, 0.22, 0.0), (0.25, 0.25, 0.7), (100, 3))
    crumbs = boxes_mesh([(tuple(c), tuple(c + 0.004)) for c in corners])
    both = np.concatenate([vertices, crumbs.vertices])
    found = decompose(both, np.concatenate([faces, crumbs.faces + len(vertices)]), CUTS_ONLY)
    assert len(found.shapes) <= 32
    assert not inside(found.shapes, (0.0, -0.1, 0.35))


def test_a_wheel_with_a_carved_hub_is_a_cylinder() -> None:
    wheel = manifold3d.Manifold.cylinder(0.04, 0.1, 0.1, 48)
    carved = wheel - manifold3d.Manifold.cylinder(0.02, 0.06, 0.06, 48).translate((0, 0, 0.03))
    mesh = carved.to_mesh64()
    vertices, faces = np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64)
    (shape,) = decompose(vertices, faces, CUTS_ONLY).shapes
    assert shape.primitive is not None
    assert shape.primitive.kind == "cylinder"
    assert shape.primitive.size == pytest.approx((0.2, 0.2, 0.04))


def test_a_pot_of_many_facets_is_not_filled_though_no_cuts_are_left_for_it() -> None:
    """Its handle takes most of the shapes, and one hull would stand for what it can hold."""
    outside = [(0.1 + 0.7 * np.sin(angle), -np.cos(angle)) for angle in np.linspace(0.1, 2.2, 14)]
    inside_ = [(0.94 * r, 0.94 * z) for r, z in reversed(outside)]
    pot = trimesh.creation.revolve([(0, -1.0), *outside, *inside_[:-1], (0, inside_[-1][1])], sections=20)
    handle = trimesh.creation.torus(0.4, 0.06, major_sections=24, minor_sections=8)
    handle.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0]))
    both = trimesh.util.concatenate([pot, handle.apply_translation([1.0, 0, 0])])
    found = decompose(both.vertices, both.faces, Budget(tool_seconds=60.0))
    assert len(found.shapes) <= 32
    for point in ((0.0, 0.0, 0.0), (0.3, 0.0, -0.2), (0.0, 0.3, 0.3)):
        assert not inside(found.shapes, point)
    hulls = [manifold3d.Manifold.hull_points(shape.vertices) for shape in found.shapes]
    filled = manifold3d.Manifold.batch_boolean(hulls, manifold3d.OpType.Add).volume()
    assert filled < 0.3 * both.convex_hull.volume
