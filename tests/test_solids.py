"""What surfaces weigh: closed solids against their formulas, open and nested ones by the stated rules."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from simart_kit.arrays import FloatArray, IntArray, vec3
from simart_kit.asset import MassProperties
from simart_kit.capping import capped
from simart_kit.kinematics import rotation
from simart_kit.materials import Build
from simart_kit.physics import MIN_MASS, as_stated, mass_properties
from simart_kit.shells import find_shells
from simart_kit.solids import solid
from simart_kit.testing.meshes import box as box_between

RHO = 500.0
WALL, SOLID_UP_TO = 0.016, 0.045
Piece = tuple[FloatArray, IntArray]
numbers = st.floats(-2, 2, allow_nan=False)


def box(lower: ArrayLike, upper: ArrayLike) -> Piece:
    return box_between(vec3(np.asarray(lower)), vec3(np.asarray(upper)))


def joined(*pieces: Piece) -> Piece:
    offsets = np.cumsum([0] + [len(v) for v, _ in pieces])
    faces = [f + offset for (_, f), offset in zip(pieces, offsets[:-1], strict=True)]
    return np.concatenate([v for v, _ in pieces]), np.concatenate(faces)


def inverted(piece: Piece) -> Piece:
    return piece[0], piece[1][:, ::-1]


def without(piece: Piece, axis: int, value: float) -> Piece:
    """The surface without its faces in a plane."""
    vertices, faces = piece
    gone = (np.abs(vertices[faces][:, :, axis] - value) < 1e-12).all(axis=1)
    return vertices, faces[~gone]


def weighed(piece: Piece) -> MassProperties:
    """As wood is built, but at a round density."""
    return mass_properties(*piece, RHO, WALL, SOLID_UP_TO)


def assert_valid(mass: MassProperties) -> None:
    assert mass.mass >= MIN_MASS
    small, middle, large = np.linalg.eigvalsh(np.array(mass.inertia))
    assert small > 0
    assert small + middle >= large * (1 - 1e-9)


def assert_close(mass: MassProperties, kilograms: float, center: ArrayLike, inertia: ArrayLike) -> None:
    assert mass.mass == pytest.approx(kilograms, rel=1e-9)
    np.testing.assert_allclose(mass.center, center, atol=1e-9)
    np.testing.assert_allclose(mass.inertia, inertia, rtol=1e-9, atol=1e-9 * kilograms)


def ring(radius: float, sides: int) -> FloatArray:
    angle = 2 * np.pi * np.arange(sides) / sides
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def fan(bottom: float, top: float, height: float, sides: int) -> Piece:
    """A regular prism, or a pyramid where `top` is 0, standing on z = 0."""
    foot = np.column_stack([ring(bottom, sides), np.zeros(sides)])
    head = np.column_stack([ring(top, sides), np.full(sides, height)])
    vertices = np.concatenate([foot, head, [[0, 0, 0], [0, 0, height]]])
    here, there = np.arange(sides), (np.arange(sides) + 1) % sides
    walls = [(here, there, there + sides), (here, there + sides, here + sides)]
    ends = [
        (there, here, np.full(sides, 2 * sides)),
        (here + sides, there + sides, np.full(sides, 2 * sides + 1)),
    ]
    return vertices, np.concatenate([np.column_stack(t) for t in walls + ends])


def prism(radius: float, height: float, sides: int) -> tuple[float, float, float]:
    """Volume of a regular prism, and its second moments per volume about and across its axis."""
    angle = 2 * np.pi / sides
    volume = height * sides / 2 * radius**2 * np.sin(angle)
    about = radius**2 / 6 * (2 + np.cos(angle))
    return volume, about, about / 2 + height**2 / 12


class TestAnalyticSolids:
    def test_tetrahedron(self) -> None:
        a, b, c = 0.3, 0.5, 0.7
        vertices = np.array([[0, 0, 0], [a, 0, 0], [0, b, 0], [0, 0, c]])
        faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        m = RHO * a * b * c / 6
        squares = np.array([a, b, c]) ** 2
        # About the right corner: integral of x^2 is m a^2 / 10 and of x y is m a b / 20; then to the centre.
        center = np.array([a, b, c]) / 4
        second = np.diag(m * squares / 10) + (1 - np.eye(3)) * m / 20 * np.outer([a, b, c], [a, b, c])
        second -= m * np.outer(center, center)
        inertia = np.trace(second) * np.eye(3) - second
        assert_close(mass_properties(vertices, faces, RHO), m, center, inertia)

    @pytest.mark.parametrize("sides", [3, 8, 64])
    def test_cylinder(self, sides: int) -> None:
        volume, about, across = prism(0.2, 0.6, sides)
        inertia = np.diag([across, across, about]) * RHO * volume
        mass = mass_properties(*fan(0.2, 0.2, 0.6, sides), RHO)
        assert_close(mass, RHO * volume, [0, 0, 0.3], inertia)

    @pytest.mark.parametrize("sides", [4, 48])
    def test_cone(self, sides: int) -> None:
        """A pyramid has 3/5 of the prism's polar moment per mass, and 3/80 h^2 along its axis."""
        height = 0.6
        volume, about, _ = prism(0.2, height, sides)
        m = RHO * volume / 3
        polar = 0.6 * m * about
        across = polar / 2 + 3 / 80 * m * height**2
        mass = mass_properties(*fan(0.2, 0.0, height, sides), RHO)
        assert_close(mass, m, [0, 0, height / 4], np.diag([across, across, polar]))

    def test_a_fine_sphere_nears_the_formula(self) -> None:
        ball = trimesh.creation.icosphere(5, radius=0.3)
        mass = mass_properties(ball.vertices, ball.faces, RHO)
        assert mass.mass == pytest.approx(RHO * 4 / 3 * np.pi * 0.3**3, rel=1e-3)
        np.testing.assert_allclose(np.diag(mass.inertia), 0.4 * mass.mass * 0.09, rtol=1e-3)

    def test_tube(self) -> None:
        """Outside less inside, both exact prisms."""
        outer, inner = fan(0.2, 0.2, 0.6, 32), inverted(fan(0.15, 0.15, 0.5, 32))
        inner = (inner[0] + [0, 0, 0.05], inner[1])
        (v, about, across), (hole, hole_about, hole_across) = prism(0.2, 0.6, 32), prism(0.15, 0.5, 32)
        polar = RHO * (v * about - hole * hole_about)
        side = RHO * (v * across - hole * hole_across)
        mass = mass_properties(*joined(outer, inner), RHO)
        assert_close(mass, RHO * (v - hole), [0, 0, 0.3], np.diag([side, side, polar]))

    def test_an_l_shape_is_two_boxes(self) -> None:
        """Drawn as one prism over an L, weighed as the two boxes that it consists of."""
        outline = np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 2], [0, 2]]) * 0.1
        flat = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]])
        vertices = np.concatenate([np.c_[outline, np.zeros(6)], np.c_[outline, np.full(6, 0.5)]])
        here, there = np.arange(6), (np.arange(6) + 1) % 6
        walls = np.concatenate([np.c_[here, there, there + 6], np.c_[here, there + 6, here + 6]])
        mass = mass_properties(vertices, np.concatenate([flat[:, ::-1], flat + 6, walls]), RHO)
        sizes, centers = np.array([[0.3, 0.1, 0.5], [0.1, 0.1, 0.5]]), np.array([[0.15, 0.05], [0.05, 0.15]])
        masses = RHO * sizes.prod(axis=1)
        center = np.r_[masses @ centers / masses.sum(), 0.25]
        inertia = np.zeros((3, 3))
        for m, size, at in zip(masses, sizes, centers, strict=True):
            arm = np.r_[at, 0.25] - center
            inertia += np.diag(m / 12 * (size @ size - size**2))
            inertia += m * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        assert_close(mass, masses.sum(), center, inertia)


@settings(max_examples=40, deadline=None)
@given(
    vector=st.tuples(numbers, numbers, numbers),
    shear=st.lists(numbers, min_size=9, max_size=9),
    squeeze=st.sampled_from([1.0, 1e-3, 1e-6, 0.0]),
    gone=st.integers(0, 11),
)
def test_inertia_is_possible_however_a_box_is_turned_sheared_flattened_and_torn(
    vector: tuple[float, float, float], shear: list[float], squeeze: float, gone: int
) -> None:
    vertices, faces = box((-0.3, -0.2, -0.4), (0.3, 0.2, 0.4))
    vertices = vertices @ np.array(shear).reshape(3, 3) * [1, 1, squeeze] @ rotation(np.array(vector)).T
    assert_valid(weighed((vertices, faces[gone:])))


class TestDoors:
    """A door of 0.6 x 0.8 m weighs like one of a board or a board and a bit, however it is drawn."""

    size = np.array([0.6, 0.018, 0.8])
    least, most = RHO * 0.6 * 0.8 * 0.008, RHO * 0.6 * 0.8 * 0.024

    def check(self, piece: Piece) -> MassProperties:
        mass = weighed(piece)
        assert self.least < mass.mass < self.most, mass.method
        assert_valid(mass)
        return mass

    def test_one_quad(self) -> None:
        corners = np.array([[0, 0, 0], [0.6, 0, 0], [0.6, 0, 0.8], [0, 0, 0.8]])
        mass = self.check((corners, np.array([[0, 1, 2], [0, 2, 3]])))
        assert mass.mass == pytest.approx(RHO * 0.48 * WALL)

    @pytest.mark.parametrize("axis", [0, 1, 2])
    def test_a_box_without_a_face(self, axis: int) -> None:
        self.check(without(box((0, 0, 0), self.size), axis, 0.0))

    def test_two_sheets_without_edges(self) -> None:
        piece = box((0, 0, 0), self.size)
        for axis in (0, 2):
            for value in (0.0, float(self.size[axis])):
                piece = without(piece, axis, value)
        self.check(piece)

    def test_a_panel_with_a_handle(self) -> None:
        handle = box((0.5, -0.03, 0.3), (0.52, 0.0, 0.5))
        mass = self.check(joined(box((0, 0, 0), self.size), handle))
        assert mass.mass == pytest.approx(RHO * (self.size.prod() + 0.02 * 0.03 * 0.2), rel=1e-9)

    def test_a_film_around_a_void_is_walls(self) -> None:
        outer, inner = box((0, 0, 0), (0.6, 0.05, 0.8)), box((1e-3,) * 3, (0.599, 0.049, 0.799))
        mass = weighed(joined(outer, inverted(inner)))
        area = 2 * (0.6 * 0.05 + 0.6 * 0.8 + 0.05 * 0.8)
        assert mass.mass == pytest.approx(RHO * area * WALL, rel=1e-9)
        assert mass.method == "hollow shell with walls of 16 mm"


class TestHollow:
    size = np.array([0.6, 0.5, 0.8])
    area = 2 * (0.6 * 0.5 + 0.6 * 0.8 + 0.5 * 0.8)

    def test_a_block_too_thick_to_be_solid_has_walls(self) -> None:
        mass = weighed(box((0, 0, 0), self.size))
        assert mass.mass == pytest.approx(RHO * self.area * WALL, rel=1e-9)
        np.testing.assert_allclose(mass.center, self.size / 2, atol=1e-9)
        assert 40 < mass.mass / self.size.prod() < 350  # [kg/m^3] of the room that furniture takes

    @pytest.mark.parametrize("turned", [False, True])
    def test_whichever_way_it_is_wound(self, turned: bool) -> None:
        piece = box((0, 0, 0), self.size)
        mass = weighed(inverted(piece) if turned else piece)
        lower, upper = WALL / 2, self.size - WALL / 2
        # The walls lie inside: the second moments are those of sheets half a wall in.
        assert float(np.trace(np.array(mass.inertia))) < RHO * self.area * WALL * float(
            (upper - lower) @ upper
        )
        assert mass.mass == pytest.approx(RHO * self.area * WALL, rel=1e-9)

    def test_boards_and_beams_stay_solid(self) -> None:
        for size in ((2.0, 1.0, 0.04), (0.08, 0.08, 2.0), (0.12, 0.12, 0.12)):
            mass = weighed(box((0, 0, 0), size))
            assert mass.mass == pytest.approx(RHO * math.prod(size), rel=1e-9)
            assert mass.method == "closed mesh"

    def test_what_a_hollow_block_holds_counts(self) -> None:
        shelf = box((0.02, 0.02, 0.4), (0.58, 0.48, 0.418))
        mass = weighed(joined(box((0, 0, 0), self.size), shelf))
        assert mass.mass == pytest.approx(RHO * (self.area * WALL + 0.56 * 0.46 * 0.018), rel=1e-9)
        assert mass.method == "closed mesh + hollow shell with walls of 16 mm"

    def test_walls_that_are_drawn_count_as_drawn(self) -> None:
        inner = inverted(box((0.03,) * 3, self.size - 0.03))
        mass = weighed(joined(box((0, 0, 0), self.size), inner))
        assert mass.mass == pytest.approx(RHO * (self.size.prod() - (self.size - 0.06).prod()), rel=1e-9)

    def test_a_screw_hole_does_not_make_a_block_solid(self) -> None:
        hole = inverted(box((0.3, 0.2, 0.3), (0.31, 0.21, 0.34)))
        mass = weighed(joined(box((0, 0, 0), self.size), hole))
        assert mass.mass == pytest.approx(RHO * self.area * WALL, rel=1e-9)

    def test_a_body_in_a_body_wound_alike_is_two(self) -> None:
        mass = weighed(joined(box((0, 0, 0), self.size), box((0.02,) * 3, self.size - 0.02)))
        small = self.size - 0.04
        inside = 2 * (small[0] * small[1] + small[0] * small[2] + small[1] * small[2])
        assert mass.mass == pytest.approx(RHO * WALL * (self.area + inside), rel=1e-9)

    def test_walls_never_exceed_the_solid(self) -> None:
        mass = mass_properties(*box((0, 0, 0), (0.3, 0.3, 0.3)), RHO, 0.2, 0.05)
        assert mass.mass == pytest.approx(RHO * 0.027, rel=1e-9)


class TestOpenAndOverlapping:
    def test_a_drawer_of_five_faces_weighs_its_boards(self) -> None:
        size = np.array([0.4, 0.45, 0.15])
        mass = weighed(without(box((0, 0, 0), size), 2, 0.15))
        area = 0.4 * 0.45 + 2 * (0.4 + 0.45) * 0.15
        assert mass.mass == pytest.approx(RHO * area * WALL, rel=1e-9)
        assert mass.method == "sheet of 16 mm"

    def test_crossing_boards_count_their_crossing_twice_and_no_more(self) -> None:
        one, two = box((0, 0, 0), (1, 0.02, 0.5)), box((0.49, -0.4, 0), (0.51, 0.4, 0.5))
        mass = weighed(joined(one, two))
        union = 0.02 * 0.5 * (1 + 0.8 - 0.02)
        assert mass.mass == pytest.approx(RHO * (union + 0.02 * 0.02 * 0.5), rel=1e-9)

    def test_many_overlapping_bodies_never_exceed_their_hull(self) -> None:
        shifts = np.linspace(0, 0.009, 10)
        pieces = [box((0, 0, x), (0.04, 0.04, 0.04 + x)) for x in shifts]
        mass = weighed(joined(*pieces))
        assert mass.mass == pytest.approx(RHO * 0.04**2 * 0.049, rel=1e-9)
        assert mass.method == "convex hull of 10 overlapping shells"

    def test_a_small_hole_gets_a_cap(self) -> None:
        vertices, faces = fan(0.2, 0.2, 0.05, 48)
        mass = mass_properties(vertices, np.delete(faces, 100, axis=0), RHO)
        volume, about, across = prism(0.2, 0.05, 48)
        inertia = np.diag([across, across, about]) * RHO * volume
        assert_close(mass, RHO * volume, [0, 0, 0.025], inertia)

    def test_two_holes_get_a_cap_each(self) -> None:
        vertices, faces = fan(0.2, 0.2, 0.05, 48)
        shells = capped(find_shells(vertices, np.delete(faces, [100, 160], axis=0)), 0.004)
        assert shells.closed.all()
        assert len(shells.faces) == len(faces) - 2 + 6

    def test_a_sheet_with_two_sides_gets_none(self) -> None:
        vertices, faces = box((0, 0, 0), (0.5, 1e-4, 0.7))
        opened = without((vertices, faces), 0, 0.0)
        assert not capped(find_shells(*opened), 0.004).closed.any()
        assert solid(*opened, Build(WALL, SOLID_UP_TO)).guessed == 1.0


def test_a_stated_mass_scales_the_inertia_and_nothing_else() -> None:
    found = weighed(box((0, 0, 0), (0.5, 0.02, 0.5)))
    stated = as_stated(found, 7.5)
    assert stated.mass == 7.5
    assert stated.center == found.center
    np.testing.assert_allclose(stated.inertia, np.array(found.inertia) * 7.5 / 2.5, rtol=1e-12)
    assert stated.method == "closed mesh, as stated"
