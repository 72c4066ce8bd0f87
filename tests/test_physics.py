"""Mass properties against solids with known answers, and shapes against what a simulator needs."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray, IntArray, vec3
from simart_kit.asset import MassProperties
from simart_kit.decompose import Budget, decompose
from simart_kit.hulls import convex_hull, hull_of, volume
from simart_kit.kinematics import rotation
from simart_kit.physics import MIN_MASS, mass_properties
from simart_kit.shells import find_shells
from simart_kit.solids import solid
from simart_kit.testing.meshes import box as box_between
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset, cabinet_mesh

RHO = 500.0
SIZE = np.array([0.6, 0.4, 0.8])
numbers = st.floats(-2, 2, allow_nan=False)
points3 = st.lists(st.tuples(numbers, numbers, numbers), min_size=4, max_size=12)


def box(lower: ArrayLike, upper: ArrayLike) -> tuple[FloatArray, IntArray]:
    return box_between(vec3(np.asarray(lower)), vec3(np.asarray(upper)))


def box_inertia(mass: float, size: FloatArray) -> FloatArray:
    return np.diag(mass / 12 * (size @ size - size**2))


def joined(*pieces: tuple[FloatArray, IntArray]) -> tuple[FloatArray, IntArray]:
    offsets = np.cumsum([0] + [len(v) for v, _ in pieces])
    faces = [f + offset for (_, f), offset in zip(pieces, offsets[:-1], strict=True)]
    return np.concatenate([v for v, _ in pieces]), np.concatenate(faces)


def inverted(piece: tuple[FloatArray, IntArray]) -> tuple[FloatArray, IntArray]:
    return piece[0], piece[1][:, ::-1]


def rectangle(width: float, height: float) -> tuple[FloatArray, IntArray]:
    corners = np.array([[0, 0, 0], [width, 0, 0], [width, 0, height], [0, 0, height]], dtype=float)
    return corners, np.array([[0, 1, 2], [0, 2, 3]])


def assert_valid(mass: MassProperties) -> None:
    assert mass.mass >= MIN_MASS
    inertia = np.array(mass.inertia)
    assert np.isfinite(inertia).all()
    np.testing.assert_array_equal(inertia, inertia.T)
    small, middle, large = np.linalg.eigvalsh(inertia)
    assert small > 0
    assert small + middle >= large * (1 - 1e-9)


def assert_box(mass: MassProperties, lower: FloatArray, size: FloatArray, density: float = RHO) -> None:
    expected = density * size.prod()
    assert mass.mass == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(mass.center, lower + size / 2, atol=1e-9)
    np.testing.assert_allclose(mass.inertia, box_inertia(expected, size), rtol=1e-8, atol=1e-9)


class TestClosed:
    def test_a_box_anywhere(self) -> None:
        lower = np.array([3.0, -2.0, 7.0])
        mass = mass_properties(*box(lower, lower + SIZE), RHO)
        assert_box(mass, lower, SIZE)
        assert mass.method == "closed mesh"

    def test_a_sphere_is_the_polyhedron_that_it_is(self) -> None:
        ball = trimesh.creation.icosphere(3, radius=0.2)
        mass = mass_properties(ball.vertices, ball.faces, RHO)
        ball.density = RHO
        assert mass.mass == pytest.approx(ball.mass, rel=1e-9)
        np.testing.assert_allclose(mass.inertia, ball.moment_inertia, rtol=1e-9, atol=1e-12)
        perfect = RHO * 4 / 3 * np.pi * 0.2**3
        assert 0.98 * perfect < mass.mass < perfect
        np.testing.assert_allclose(np.diag(mass.inertia), 0.4 * perfect * 0.2**2, rtol=0.03)

    def test_a_cylinder_is_an_exact_prism(self) -> None:
        sides, radius, height = 24, 0.1, 0.5
        mesh = trimesh.creation.cylinder(radius, height, sections=sides)
        mass = mass_properties(mesh.vertices, mesh.faces, RHO)
        angle = 2 * np.pi / sides
        expected = RHO * height * sides / 2 * radius**2 * np.sin(angle)
        polar = expected * radius**2 / 6 * (2 + np.cos(angle))
        across = polar / 2 + expected * height**2 / 12
        assert mass.mass == pytest.approx(expected, rel=1e-9)
        np.testing.assert_allclose(mass.inertia, np.diag([across, across, polar]), rtol=1e-9, atol=1e-12)

    @pytest.mark.parametrize("turn_all", [False, True])
    def test_a_hollow_box_weighs_its_walls(self, turn_all: bool) -> None:
        outer, inner = box((0, 0, 0), SIZE), inverted(box([0.05] * 3, SIZE - 0.05))
        pieces = [inverted(outer), inverted(inner)] if turn_all else [outer, inner]
        mass = mass_properties(*joined(*pieces), RHO)
        whole, hole = RHO * SIZE.prod(), RHO * (SIZE - 0.1).prod()
        assert mass.mass == pytest.approx(whole - hole, rel=1e-9)
        expected = box_inertia(whole, SIZE) - box_inertia(hole, SIZE - 0.1)
        np.testing.assert_allclose(mass.inertia, expected, rtol=1e-9, atol=1e-9)
        assert mass.method == "closed mesh with 1 void"

    def test_what_is_buried_in_a_solid_adds_nothing(self) -> None:
        pieces = joined(box((0, 0, 0), SIZE), box([0.1] * 3, SIZE - 0.1))
        assert_box(mass_properties(*pieces, RHO), np.zeros(3), SIZE)

    def test_a_body_in_a_void_counts(self) -> None:
        void, body = inverted(box([0.05] * 3, SIZE - 0.05)), box([0.1] * 3, [0.2] * 3)
        mass = mass_properties(*joined(box((0, 0, 0), SIZE), void, body), RHO)
        expected = RHO * (SIZE.prod() - (SIZE - 0.1).prod() + 0.1**3)
        assert mass.mass == pytest.approx(expected, rel=1e-9)

    def test_a_shell_in_a_notch_is_not_taken_for_a_void(self) -> None:
        u_shape = [box((x, y, 0), (x + 1, y + 1, 1)) for x, y in ((0, 0), (1, 0), (2, 0), (0, 1), (2, 1))]
        in_the_notch = inverted(box((1.4, 1.4, 0.4), (1.6, 1.6, 0.6)))
        mass = mass_properties(*joined(*u_shape, in_the_notch), RHO)
        assert mass.mass == pytest.approx(RHO * (5 + 0.008), rel=1e-9)
        assert mass.method == "2 closed shells"

    def test_two_boxes_add_up_by_the_parallel_axis_theorem(self) -> None:
        size, far = np.array([0.2, 0.3, 0.4]), np.array([2.0, 1.0, -1.0])
        mass = mass_properties(*joined(box((0, 0, 0), SIZE), inverted(box(far, far + size))), RHO)
        masses = RHO * np.array([SIZE.prod(), size.prod()])
        centers = np.array([SIZE / 2, far + size / 2])
        center = masses @ centers / masses.sum()
        inertia = np.zeros((3, 3))
        for m, extent, arm in zip(masses, (SIZE, size), centers - center, strict=True):
            inertia += box_inertia(m, extent) + m * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        assert mass.mass == pytest.approx(masses.sum(), rel=1e-9)
        np.testing.assert_allclose(mass.center, center, atol=1e-9)
        np.testing.assert_allclose(mass.inertia, inertia, rtol=1e-9)
        assert mass.method == "2 closed shells"

    def test_boxes_that_share_a_wall_are_closed_together(self) -> None:
        pieces = joined(box((0, 0, 0), SIZE), box(SIZE * [1, 0, 0], SIZE * [2, 1, 1]))
        assert_box(mass_properties(*pieces, RHO), np.zeros(3), SIZE * [2, 1, 1])

    def test_the_cabinet_weighs_what_its_boards_do(self) -> None:
        asset = cabinet_asset()
        for index, part in enumerate(asset.parts):
            found = mass_properties(asset.mesh.vertices, asset.mesh.faces[asset.face_part == index], 600.0)
            assert part.mass is not None
            assert found.mass == pytest.approx(part.mass.mass, rel=1e-9)
            np.testing.assert_allclose(found.center, part.mass.center, atol=1e-9)
            np.testing.assert_allclose(found.inertia, part.mass.inertia, rtol=1e-6, atol=1e-9)


class TestDamagedButClosed:
    vertices, faces = box((0, 0, 0), SIZE)

    def check(self, vertices: FloatArray, faces: IntArray) -> None:
        assert_box(mass_properties(vertices, faces, RHO), np.zeros(3), SIZE)

    def test_inside_out(self) -> None:
        self.check(self.vertices, self.faces[:, ::-1])

    @pytest.mark.parametrize("turned", [[0], [3, 7], [0, 1, 2, 3, 4], list(range(7))])
    def test_some_faces_wound_the_wrong_way(self, turned: list[int]) -> None:
        faces = self.faces.copy()
        faces[turned] = faces[turned, ::-1]
        self.check(self.vertices, faces)

    def test_no_shared_vertices(self) -> None:
        noise = np.random.default_rng(0).uniform(-1e-10, 1e-10, (36, 3))
        self.check(self.vertices[self.faces].reshape(-1, 3) + noise, np.arange(36).reshape(12, 3))

    def test_repeated_faces_do_not_double_it(self) -> None:
        self.check(self.vertices, np.concatenate([self.faces, self.faces[3:], self.faces[:2]]))

    def test_degenerate_faces(self) -> None:
        middle = (self.vertices[0] + self.vertices[1]) / 2
        faces = np.concatenate([self.faces, [[2, 2, 5], [0, 1, 0], [0, 8, 1]]])
        self.check(np.concatenate([self.vertices, [middle]]), faces)

    def test_a_t_junction_closed_by_a_sliver(self) -> None:
        a, b, c = self.faces[0]
        middle = (self.vertices[a] + self.vertices[b]) / 2
        faces = np.concatenate([self.faces[1:], [[a, 8, c], [8, b, c], [a, b, 8]]])
        self.check(np.concatenate([self.vertices, [middle]]), faces)


class TestOpen:
    def test_a_rectangle_is_a_board(self) -> None:
        mass = mass_properties(*rectangle(0.5, 0.7), RHO, thickness=0.018)
        assert_box(mass, np.array([0, -0.009, 0]), np.array([0.5, 0.018, 0.7]))
        assert mass.method == "sheet of 18 mm"

    def test_both_sides_of_a_sheet_are_one_board(self) -> None:
        vertices, faces = rectangle(0.5, 0.7)
        mass = mass_properties(vertices, np.concatenate([faces, faces[:, [1, 0, 2]]]), RHO, thickness=0.018)
        assert mass.mass == pytest.approx(RHO * 0.5 * 0.7 * 0.018, rel=1e-9)

    def test_a_small_sheet_is_thinner(self) -> None:
        mass = mass_properties(*rectangle(0.03, 0.03), RHO, thickness=0.018)
        assert mass.mass == pytest.approx(RHO * 0.03**2 * 0.003, rel=1e-9)
        assert mass.method == "sheet of 3 mm"

    def test_a_triangle(self) -> None:
        vertices, faces = rectangle(0.6, 0.6)
        mass = mass_properties(vertices, faces[:1], RHO)
        assert mass.mass == pytest.approx(RHO * 0.18 * 0.01, rel=1e-9)
        np.testing.assert_allclose(mass.center, [0.4, 0, 0.2], atol=1e-12)
        assert_valid(mass)

    def test_a_large_open_box_is_a_shell(self) -> None:
        vertices, faces = box((0, 0, 0), SIZE)
        top = (vertices[faces][:, :, 2] == SIZE[2]).all(axis=1)
        mass = mass_properties(vertices, faces[~top], RHO)
        x, y, z = SIZE
        area = x * y + 2 * (x + y) * z
        assert mass.mass == pytest.approx(RHO * area * 0.01, rel=1e-9)
        assert mass.center[2] == pytest.approx((x + y) * z * z / area, rel=1e-9)
        assert_valid(mass)

    def test_a_thin_door_without_a_back_is_no_thicker_than_it_looks(self) -> None:
        size = np.array([0.5, 0.006, 0.7])
        vertices, faces = box((0, 0, 0), size)
        back = (vertices[faces][:, :, 1] == size[1]).all(axis=1)
        mass = mass_properties(vertices, faces[~back], RHO)
        assert_box(mass, np.zeros(3), size)
        assert mass.method == "convex hull"

    def test_a_dented_sheet_weighs_like_a_board_not_like_a_film(self) -> None:
        vertices, faces = rectangle(0.5, 0.7)
        vertices[0, 1] = 0.001
        mass = mass_properties(vertices, faces, RHO)
        assert mass.mass == pytest.approx(RHO * 0.35 * 0.01, rel=0.01)

    def test_loose_sides_of_a_thin_board_never_exceed_the_board(self) -> None:
        size = np.array([0.5, 0.008, 0.7])
        vertices, faces = box((0, 0, 0), size)
        sides = [np.abs(np.ptp(vertices[faces], axis=1)).argmin(axis=1) == axis for axis in range(3)]
        mass = mass_properties(vertices, faces[sides[1]], RHO)
        assert_box(mass, np.zeros(3), size)

    def test_a_hole_is_told(self) -> None:
        vertices, faces = box((0, 0, 0), SIZE)
        assert solid(vertices, faces).guessed == 0.0
        assert solid(vertices, faces[1:]).guessed == 1.0

    @pytest.mark.parametrize("third", [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (1.0, 0.0, 0.0)])
    def test_no_area_at_all_is_still_a_valid_body(self, third: tuple[float, float, float]) -> None:
        mass = mass_properties(np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), third]), np.array([[0, 1, 2]]))
        assert mass.mass == MIN_MASS
        assert_valid(mass)

    def test_a_crumb_has_the_least_mass(self) -> None:
        mass = mass_properties(*box((0, 0, 0), [1e-4] * 3), RHO)
        assert mass.mass == MIN_MASS
        assert "at least 1 g" in mass.method
        np.testing.assert_allclose(mass.inertia, box_inertia(MIN_MASS, np.full(3, 1e-4)), atol=1e-18)


@settings(max_examples=25, deadline=None)
@given(vector=st.tuples(numbers, numbers, numbers), offset=st.tuples(numbers, numbers, numbers))
@pytest.mark.parametrize("faces", [slice(None), slice(5, None)], ids=["closed", "open"])
def test_turning_and_moving_the_surface_turns_and_moves_the_mass(
    faces: slice, vector: tuple[float, float, float], offset: tuple[float, float, float]
) -> None:
    mesh = cabinet_mesh()
    at_rest = mass_properties(mesh.vertices, mesh.faces[faces], RHO)
    turn = rotation(np.array(vector))
    moved = mass_properties(mesh.vertices @ turn.T + offset, mesh.faces[faces], RHO)
    assert moved.mass == pytest.approx(at_rest.mass, rel=1e-6)
    np.testing.assert_allclose(moved.center, turn @ at_rest.center + offset, atol=1e-6)
    np.testing.assert_allclose(moved.inertia, turn @ np.array(at_rest.inertia) @ turn.T, atol=1e-5)


@settings(max_examples=60, deadline=None)
@given(points=points3, seed=st.integers(0, 1000))
def test_any_faces_at_all_make_a_valid_body(points: list[tuple[float, float, float]], seed: int) -> None:
    faces = np.random.default_rng(seed).integers(0, len(points), (2 * len(points), 3))
    assert_valid(mass_properties(np.array(points), faces))


def test_boards_that_touch_along_an_edge_stay_apart() -> None:
    mesh = cabinet_mesh()
    shells = find_shells(mesh.vertices, mesh.faces[:60])
    assert shells.count == 5
    assert shells.closed.all()


class TestHulls:
    def test_the_hull_of_a_box_is_the_box_with_outward_faces(self) -> None:
        vertices, _ = box((1, 1, 1), 1 + SIZE)
        inner = np.random.default_rng(0).uniform(1, 1 + SIZE, (100, 3))
        hull = convex_hull(np.concatenate([inner, vertices]))
        assert len(hull.vertices) == 8
        assert volume(hull) == pytest.approx(SIZE.prod(), rel=1e-12)

    @pytest.mark.parametrize(
        ("points", "extents"),
        [
            (rectangle(0.5, 0.7)[0], [0.5, 0.002, 0.7]),
            (np.array([[0.0, 0, 0], [0, 0.3, 0], [0, 0.1, 0]]), [0.002, 0.3, 0.002]),
            (np.zeros((3, 3)), [0.002, 0.002, 0.002]),
        ],
        ids=["flat", "line", "point"],
    )
    def test_thin_things_get_a_thickness(self, points: FloatArray, extents: list[float]) -> None:
        shape = convex_hull(points)
        np.testing.assert_allclose(np.ptp(shape.vertices, axis=0), extents, atol=1e-9)
        assert volume(shape) == pytest.approx(np.prod(extents), rel=1e-6)

    @pytest.mark.parametrize("subdivisions", [3, 6], ids=["642 points", "40962 points"])
    def test_a_round_hull_keeps_few_vertices_and_its_extents(self, subdivisions: int) -> None:
        ball = trimesh.creation.icosphere(subdivisions, radius=0.3)
        hull = convex_hull(ball.vertices, max_vertices=48)
        assert len(hull.vertices) <= 48
        np.testing.assert_allclose(np.ptp(hull.vertices, axis=0), 0.6, rtol=1e-9)
        assert 0.85 < volume(hull) / ball.volume <= 1.0

    def test_points_in_a_plane_have_no_hull(self) -> None:
        assert hull_of(rectangle(1, 1)[0]) is None


class TestDecompose:
    def test_a_cabinet_of_boards_stays_hollow(self) -> None:
        mesh = cabinet_mesh()
        shapes = decompose(mesh.vertices, mesh.faces[:60]).shapes
        boards = [0.02 * 0.4 * 0.8] * 2 + [0.56 * 0.4 * 0.02] * 2 + [0.56 * 0.02 * 0.76]
        assert sorted(map(volume, shapes)) == pytest.approx(sorted(boards), rel=1e-9)

    def test_pieces_that_fill_their_hull_share_it(self) -> None:
        mesh = boxes_mesh([((0, 0, 0), (0.5, 1, 1)), ((0.5, 0, 0), (1, 1, 1))])
        (shape,) = decompose(mesh.vertices, mesh.faces).shapes
        assert volume(shape) == pytest.approx(1.0, rel=1e-9)

    @pytest.mark.parametrize("count", [40, 400])
    def test_many_pieces_share_few_shapes_that_cover_them_all(self, count: int) -> None:
        rng = np.random.default_rng(1)
        corners = rng.uniform(0, 1, (count, 3))
        mesh = boxes_mesh([(c, c + 0.01) for c in corners])
        shapes = decompose(mesh.vertices, mesh.faces, Budget(shapes=8)).shapes
        assert len(shapes) <= 8
        lower = np.array([s.vertices.min(axis=0) for s in shapes]) - 1e-9
        upper = np.array([s.vertices.max(axis=0) for s in shapes]) + 1e-9
        for vertex in mesh.vertices:
            assert ((vertex >= lower) & (vertex <= upper)).all(axis=1).any()

    def test_large_boards_are_not_joined_while_crumbs_can_be(self) -> None:
        boards = [((0.0, 0.0, 0.0), (1.0, 0.02, 1.0)), ((0.0, 0.98, 0.0), (1.0, 1.0, 1.0))]
        crumbs = [((0.1 * i, 0.03, 0.5), (0.1 * i + 0.01, 0.04, 0.51)) for i in range(8)]
        mesh = boxes_mesh(boards + crumbs)
        shapes = decompose(mesh.vertices, mesh.faces, Budget(shapes=3)).shapes
        assert len(shapes) == 3
        assert max(map(volume, shapes)) < 0.05
