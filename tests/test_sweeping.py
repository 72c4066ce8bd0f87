"""Sweep: how far boxes move before they run into boxes, against numbers worked out by hand."""

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
import pytest

from simart_kit.arrays import FloatArray
from simart_kit.kinematics import rotation
from simart_kit.sweeping import BLOCKED, Motion, Sweep, move, sample_surface
from simart_kit.testing.meshes import boxes_mesh

Bounds = tuple[Sequence[float], Sequence[float]]

# A box with an open front (-y), inside 1 wide, 1 high and 0.8 deep, of boards 0.1 thick.
CASE: list[Bounds] = [
    ((-0.6, 0.0, -0.1), (-0.5, 0.9, 1.1)),
    ((0.5, 0.0, -0.1), (0.6, 0.9, 1.1)),
    ((-0.5, 0.0, -0.1), (0.5, 0.9, 0.0)),
    ((-0.5, 0.0, 1.0), (0.5, 0.9, 1.1)),
    ((-0.5, 0.8, 0.0), (0.5, 0.9, 1.0)),
]
DRAWER: list[Bounds] = [((-0.45, 0.0, 0.05), (0.45, 0.6, 0.95))]
DRAWER_SIZE = float(np.linalg.norm([0.9, 0.6, 0.9]))
DEEP = 0.003  # of the moving part's size: what may be passed before it counts


def triangles(bounds: Sequence[Bounds]) -> FloatArray:
    return boxes_mesh(bounds).triangles


def sweep_of(moving: FloatArray, still: FloatArray, seed: int = 0, holes: bool = False) -> Sweep:
    """Of (F, 3, 3) and (G, 3, 3) triangles, none of which share a vertex."""
    faces = np.arange(3 * (len(moving) + len(still))).reshape(-1, 3)
    vertices = np.concatenate([moving, still]).reshape(-1, 3)
    return Sweep(vertices, faces[: len(moving)], faces[len(moving) :], seed, holes=holes)


def along(*direction: float) -> Motion:
    def motion(travel: float) -> FloatArray:
        matrix = np.eye(4)
        matrix[:3, 3] = np.array(direction) * travel
        return matrix

    return motion


def about(axis: Sequence[float], origin: Sequence[float] = (0, 0, 0)) -> Motion:
    def motion(angle: float) -> FloatArray:
        matrix = np.eye(4)
        matrix[:3, :3] = rotation(np.array(axis, dtype=float) * angle)
        matrix[:3, 3] = origin - matrix[:3, :3] @ origin
        return matrix

    return motion


class TestDrawer:
    def test_it_comes_out_freely(self) -> None:
        assert sweep_of(triangles(DRAWER), triangles(CASE)).free(along(0, -1, 0), 0.6) == 0.6

    def test_inward_it_stops_at_the_back_wall(self) -> None:
        """Its back is at 0.6, the wall at 0.8: 0.2 of travel, and 0.003 of its size and a step of slop."""
        free = sweep_of(triangles(DRAWER), triangles(CASE)).free(along(0, 1, 0), 0.5, steps=200)
        assert 0.2 <= free <= 0.2 + DEEP * DRAWER_SIZE + 0.5 / 200

    @pytest.mark.parametrize(
        ("direction", "gap"), [((1, 0, 0), 0.05), ((-1, 0, 0), 0.05), ((0, 0, 1), 0.05), ((0, 0, -1), 0.05)]
    )
    def test_it_stops_at_every_wall(self, direction: tuple[float, float, float], gap: float) -> None:
        free = sweep_of(triangles(DRAWER), triangles(CASE)).free(along(*direction), 0.3, steps=150)
        assert gap <= free <= gap + DEEP * DRAWER_SIZE + 0.3 / 150

    def test_walls_that_it_grazes_do_not_count(self) -> None:
        """It fits exactly: sides, floor and ceiling are in the planes of the walls."""
        tight: list[Bounds] = [((-0.5, 0.0, 0.0), (0.5, 0.6, 1.0))]
        assert sweep_of(triangles(tight), triangles(CASE)).free(along(0, -1, 0), 0.6) == 0.6

    def test_a_millimetre_too_wide_is_modelling_slop(self) -> None:
        wide: list[Bounds] = [((-0.501, 0.0, 0.0), (0.501, 0.6, 1.0))]
        assert sweep_of(triangles(wide), triangles(CASE)).free(along(0, -1, 0), 0.6) == 0.6

    def test_shares_only_grow(self) -> None:
        stops = np.linspace(0.02, 0.6, 30)
        shares = sweep_of(triangles(DRAWER), triangles(CASE)).blocked(along(0, 1, 0), stops)
        assert (np.diff(shares) >= 0).all()
        assert shares[0] == 0.0
        # Its back, 0.81 of 3.78 m2 in all, has gone through the wall; the rest follows it.
        assert shares[-1] > 0.81 / 3.78 - 0.05
        assert 0.0 < BLOCKED < 0.81 / 3.78

    def test_the_same_seed_gives_the_same_shares(self) -> None:
        stops = np.linspace(0.1, 0.4, 7)
        one, two = (sweep_of(triangles(DRAWER), triangles(CASE), seed=3) for _ in range(2))
        np.testing.assert_array_equal(one.blocked(along(0, 1, 0), stops), two.blocked(along(0, 1, 0), stops))


class TestDoor:
    """A door 1 wide and 0.02 thick, along +x from its hinge at the origin, that opens towards -y."""

    door: ClassVar[list[Bounds]] = [((0.0, 0.0, 0.0), (1.0, 0.02, 1.0))]

    def test_it_swings_freely(self) -> None:
        post: list[Bounds] = [((-0.2, 0.0, 0.0), (-0.01, 0.3, 1.0))]
        assert sweep_of(triangles(self.door), triangles(post)).free(about((0, 0, -1)), np.pi / 2) == np.pi / 2

    @pytest.mark.parametrize(("distance", "degrees"), [(0.5, 30.0), (np.sqrt(0.5), 45.0)])
    def test_it_stops_at_a_wall_across_its_way(self, distance: float, degrees: float) -> None:
        """Its tip is at distance sin(angle); the points that must pass, 3 of 100, are up to 0.03 from it."""
        wall: list[Bounds] = [((-1.0, -distance - 0.1, -0.5), (2.0, -distance, 1.5))]
        sweep = sweep_of(triangles(self.door), triangles(wall))
        free = np.degrees(sweep.free(about((0, 0, -1)), np.pi / 2, steps=180))
        passed = np.degrees(np.arcsin((distance + DEEP * np.sqrt(2)) / 0.97))
        assert degrees <= free <= passed + 0.5

    def test_a_small_post_in_the_way_of_a_large_door_counts(self) -> None:
        """At 60 degrees; few points of the door meet it, but most of the post's own pass through the door."""
        post: list[Bounds] = [((0.24, -0.5, 0.2), (0.26, -0.43, 0.8))]
        free = sweep_of(triangles(self.door), triangles(post)).free(about((0, 0, -1)), np.pi / 2, steps=90)
        assert np.radians(57) < free < np.radians(66)

    def test_inward_it_stops_at_the_frame_behind_it(self) -> None:
        frame: list[Bounds] = [((0.9, 0.02, 0.0), (1.1, 0.3, 1.0))]
        assert sweep_of(triangles(self.door), triangles(frame)).free(about((0, 0, 1)), 1.0, steps=100) < 0.1

    def test_an_edge_that_grazes_its_jamb_comes_out_again(self) -> None:
        """Hung in the middle of its thickness of 0.06 it needs 0.00045 of play, and has 0.0003."""
        leaf: list[Bounds] = [((0.0, -0.03, 0.0), (1.0, 0.03, 1.0))]
        jamb: list[Bounds] = [((1.0003, -0.03, 0.0), (1.02, 0.1, 1.0))]
        assert sweep_of(triangles(leaf), triangles(jamb)).free(about((0, 0, -1)), np.pi / 2) == np.pi / 2

    def test_an_outline_filled_to_and_fro_is_no_obstacle(self) -> None:
        """The caps of a frame are fans from one corner: they cover its opening twice, with nothing behind."""
        outline = [(1.2, 1.2), (-0.2, 1.2), (-0.2, 0), (-0.1, 0), (-0.1, 1.1), (1.1, 1.1), (1.1, 0), (1.2, 0)]
        front, back = (np.array([(x, y, z) for x, z in outline]) for y in (0.0, 0.03))
        caps = [cap[[0, i, i + 1][::way]] for cap, way in ((front, 1), (back, -1)) for i in range(1, 7)]
        rim = [(i, (i + 1) % 8) for i in range(8)]
        sides = [[front[j], front[i], back[i]] for i, j in rim]
        sides += [[front[j], back[i], back[j]] for i, j in rim]
        frame = np.array([*caps, *sides])
        assert sweep_of(triangles(self.door), frame).free(about((0, 0, -1)), np.pi / 2) == np.pi / 2

    def test_a_board_thinner_than_what_counts_as_deep_stops_it(self) -> None:
        board: list[Bounds] = [((-1.0, -0.502, -0.5), (2.0, -0.5, 1.5))]
        free = sweep_of(triangles(self.door), triangles(board)).free(about((0, 0, -1)), np.pi / 2, steps=90)
        assert np.radians(30) <= free < np.radians(34)


class TestOverlapAtRest:
    """A block reaches 0.1 deep into a larger one, as hinge knuckles and handles do."""

    block: ClassVar[list[Bounds]] = [((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))]
    larger: ClassVar[list[Bounds]] = [((0.9, -0.5, -0.5), (2.0, 1.5, 1.5))]

    def test_leaving_is_free(self) -> None:
        assert sweep_of(triangles(self.block), triangles(self.larger)).free(along(-1, 0, 0), 1.0) == 1.0

    def test_going_deeper_is_not(self) -> None:
        free = sweep_of(triangles(self.block), triangles(self.larger)).free(along(1, 0, 0), 0.5, steps=50)
        assert free < 0.1

    def test_a_knuckle_that_turns_within_is_free(self) -> None:
        door: list[Bounds] = [((0.0, 0.0, 0.0), (1.0, 0.02, 1.0)), ((-0.03, -0.01, 0.4), (0.0, 0.01, 0.5))]
        post: list[Bounds] = [((-0.2, -0.1, 0.35), (-0.001, 0.1, 0.55))]
        free = sweep_of(triangles(door), triangles(post)).free(about((0, 0, -1)), np.pi / 2)
        assert free == np.pi / 2


class TestHoles:
    """A rod in a solid sleeve, whose hole nobody modelled; a collar keeps it from going in farther."""

    sleeve: ClassVar[list[Bounds]] = [((-0.2, -0.2, 0.0), (0.2, 0.2, 1.0))]
    rod: ClassVar[list[Bounds]] = [((-0.1, -0.1, 0.5), (0.1, 0.1, 2.0))]
    collar: ClassVar[Bounds] = ((-0.15, -0.15, 1.3), (0.15, 0.15, 1.4))

    def free(self, moving: Sequence[Bounds], way: Sequence[float], *, holes: bool = True) -> float:
        return sweep_of(triangles(moving), triangles(self.sleeve), holes=holes).free(along(*way), 0.5, 50)

    def test_a_rod_slides_in_its_sleeve_if_there_may_be_holes(self) -> None:
        assert self.free(self.rod, (0, 0, -1)) == 0.5
        assert self.free(self.rod, (0, 0, -1), holes=False) < 0.1

    def test_a_rod_that_ends_in_a_knob_does_as_well(self) -> None:
        knob: Bounds = ((-0.15, -0.15, 1.9), (0.15, 0.15, 2.2))
        assert self.free([*self.rod, knob], (0, 0, -1)) == 0.5

    def test_its_collar_stops_it(self) -> None:
        """The collar is 0.3 above the sleeve."""
        free = self.free([*self.rod, self.collar], (0, 0, -1))
        assert 0.3 <= free <= 0.3 + DEEP * 1.6 + 0.5 / 50

    def test_a_rod_that_only_touches_has_no_hole(self) -> None:
        assert self.free([((-0.1, -0.1, 1.0), (0.1, 0.1, 2.0))], (0, 0, -1)) < 0.1

    def test_a_rod_is_not_pushed_through_a_side_of_its_sleeve(self) -> None:
        assert self.free(self.rod, (1, 0, 0)) < 0.2

    def test_a_sleeve_moves_along_its_rod(self) -> None:
        assert (
            sweep_of(triangles(self.sleeve), triangles(self.rod), holes=True).free(along(0, 0, 1), 0.5) == 0.5
        )


class TestSunk:
    """A leaf that reaches a hundredth of its width through the front of a frame which closes nothing."""

    frame: ClassVar[FloatArray] = np.array(
        [[[-1.0, 0, -1], [2, 0, -1], [2, 0, 2]], [[-1, 0, -1], [2, 0, 2], [-1, 0, 2]]]
    )

    def free(self, back: float, *, front: float = -0.03, holes: bool = True) -> float:
        leaf: list[Bounds] = [((0.0, front, 0.0), (1.0, back, 1.0))]
        return sweep_of(triangles(leaf), self.frame, holes=holes).free(along(0, -1, 0), 0.5, 50)

    def test_it_leaves_the_frame(self) -> None:
        assert self.free(0.01) == 0.5

    def test_it_does_not_where_nothing_may_be_sunk(self) -> None:
        assert self.free(0.01, holes=False) < 0.1

    def test_what_stands_right_behind_the_frame_is_stopped(self) -> None:
        assert self.free(0.03, front=0.005) < 0.1

    def test_what_reaches_far_through_it_is_stopped(self) -> None:
        assert 0.1 < self.free(0.2) < 0.3

    def test_it_is_not_pushed_in(self) -> None:
        leaf: list[Bounds] = [((0.0, -0.03, 0.0), (1.0, 0.01, 1.0))]
        assert sweep_of(triangles(leaf), self.frame, holes=True).free(along(0, 1, 0), 0.5, 50) < 0.1


@pytest.mark.parametrize("seed", range(6))
def test_that_there_may_be_holes_never_stops_what_is_free_without(seed: int) -> None:
    """Boxes in boxes, some without a face, that turn about a line beside them and slide past each other."""
    rng = np.random.default_rng(seed)

    def heap() -> FloatArray:
        corners = rng.random((4, 3))
        boxes = triangles([(c, c + 0.1 + 0.5 * rng.random(3)) for c in corners])
        return boxes[rng.random(len(boxes)) < 0.9]

    moving, still, stops = heap(), heap(), np.linspace(0.02, 0.6, 30)
    for motion in (about((0, 0, 1), (-0.2, 0, 0)), along(*rng.standard_normal(3))):
        strict, lenient = (sweep_of(moving, still, holes=h).blocked(motion, stops) for h in (False, True))
        assert (lenient <= strict).all()
        assert strict[-1] > 0


def test_nothing_stands_in_the_way_of_nothing() -> None:
    empty = np.zeros((0, 3, 3))
    assert sweep_of(triangles(DRAWER), empty).free(along(0, 1, 0), 2.0) == 2.0
    far: list[Bounds] = [((50, 50, 50), (51, 51, 51))]
    assert sweep_of(triangles(DRAWER), triangles(far)).free(along(0, 1, 0), 2.0) == 2.0


def test_blocked_at_once() -> None:
    """A millimetre from a wall, in steps of ten: not even the first is free."""
    wall: list[Bounds] = [((-1, 0.601, -1), (1, 0.8, 2))]
    assert sweep_of(triangles(DRAWER), triangles(wall)).free(along(0, 1, 0), 0.3) == 0.0


@pytest.mark.parametrize(("degrees", "factor"), [(37.0, 1.0), (90.0, 100.0), (200.0, 0.01)])
def test_turning_moving_and_scaling_everything_changes_nothing(degrees: float, factor: float) -> None:
    turn = rotation(np.radians(degrees) * np.array([0.6, 0.0, 0.8]))
    shift = np.array([3.0, -2.0, 1.0])
    drawer, case = ((triangles(b) @ turn.T + shift) * factor for b in (DRAWER, CASE))
    sweep = sweep_of(drawer, case)
    assert sweep.free(along(*(turn @ [0, -1, 0])), 0.6 * factor) == 0.6 * factor
    inward = sweep.free(along(*(turn @ [0, 1, 0])), 0.5 * factor, steps=200) / factor
    assert 0.2 <= inward <= 0.2 + DEEP * DRAWER_SIZE + 0.5 / 200 + 1e-9


class TestSampling:
    def test_points_lie_on_the_surface_in_proportion_to_area(self) -> None:
        """A box of 1 x 2 x 3 has sides of 2, 3 and 6, each twice, of 22 in all."""
        points = sample_surface(triangles([((0, 0, 0), (1, 2, 3))]), 2200, np.random.default_rng(0))
        assert points.shape == (2200, 3)
        on = np.stack([np.isclose(points, 0.0), np.isclose(points, [1.0, 2.0, 3.0])])
        assert on.any(axis=(0, 2)).all()
        np.testing.assert_allclose(on.sum(axis=1), [[600, 300, 200], [600, 300, 200]], atol=5)

    def test_points_fill_a_triangle_evenly(self) -> None:
        corner = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
        points = sample_surface(corner, 4000, np.random.default_rng(0))
        assert (points >= 0).all()
        assert (points.sum(axis=1) <= 1 + 1e-12).all()
        np.testing.assert_allclose(points.mean(axis=0), [1 / 3, 1 / 3, 0], atol=0.02)

    @pytest.mark.parametrize("shape", [np.zeros((0, 3, 3)), np.ones((4, 3, 3))])
    def test_no_surface_no_points(self, shape: FloatArray) -> None:
        assert sample_surface(shape, 100, np.random.default_rng(0)).shape == (0, 3)

    def test_move(self) -> None:
        matrix = about((0, 0, 1))(np.pi / 2)
        matrix[:3, 3] = (1, 2, 3)
        np.testing.assert_allclose(move(matrix, np.array([[1.0, 0, 0]])), [[1, 3, 3]], atol=1e-15)


def test_parts_that_share_their_vertices_are_like_loose_ones() -> None:
    """A drawer whose front is welded to the board beside it: whose vertices they are decides nothing."""
    mesh = boxes_mesh([*CASE, *DRAWER, ((0.45, 0.0, 0.05), (0.5, 0.05, 0.95))])
    _, welded = np.unique(mesh.vertices, axis=0, return_inverse=True)
    points = np.unique(mesh.vertices, axis=0)
    faces = welded.reshape(-1)[mesh.faces]
    drawer = np.arange(len(faces)) // 12 == len(CASE)
    loose = sweep_of(mesh.triangles[drawer], mesh.triangles[~drawer])
    shared = Sweep(points, faces[drawer], faces[~drawer])
    assert len(points) < len(mesh.vertices)
    for way in (along(0, 1, 0), along(0, -1, 0), along(1, 0, 0)):
        stops = np.linspace(0.05, 0.5, 10)
        np.testing.assert_array_equal(shared.blocked(way, stops), loose.blocked(way, stops))
    assert loose.blocked(along(1, 0, 0), stops)[-1] > BLOCKED


def test_a_drawer_sunk_into_the_board_below_comes_out_of_it() -> None:
    """Its bottom lies in the board, whose own ends lie in the walls, as sloppy models have it."""
    drawer = boxes_mesh([((-0.2, -0.3, 0.09), (0.2, 0.3, 0.3))]).triangles
    board = ((-0.3, -0.29, 0.0), (0.3, 0.3, 0.1))
    walls = [((-0.3, -0.29, -0.1), (-0.21, 0.3, 0.4)), ((0.21, -0.29, -0.1), (0.3, 0.3, 0.4))]
    stop = ((-0.2, -0.55, 0.0), (0.2, -0.5, 0.4))
    inside = sweep_of(drawer, boxes_mesh([board, *walls]).triangles)
    assert inside.free(sliding, 0.4) == 0.4
    stopped = sweep_of(drawer, boxes_mesh([board, *walls, stop]).triangles)
    assert 0.18 <= stopped.free(sliding, 0.4, steps=40) <= 0.21


def sliding(travel: float) -> FloatArray:
    """Out of the case, along -y."""
    matrix = np.eye(4)
    matrix[1, 3] = -travel
    return matrix
