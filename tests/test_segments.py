"""Segments: components of a surface, patches where it is fused, and what spoils neither."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments
from simart_kit.testing.meshes import boxes_mesh, cabinet_mesh
from simart_kit.topology import weld

THREE = [((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (4, 2, 2)), ((5, 0, 0), (6.5, 1.5, 1.5))]
CUBE = boxes_mesh([((0, 0, 0), (1, 1, 1))])
seeds = st.integers(0, 2**32 - 1)


def unwelded(mesh: Mesh, noise: float = 0.0) -> Mesh:
    """Three vertices of its own for every face, off by up to `noise` [diagonals]."""
    corners = mesh.triangles.reshape(-1, 3)
    shift = np.random.default_rng(0).uniform(-noise, noise, corners.shape) * mesh.diagonal
    return Mesh(corners + shift, np.arange(3 * len(mesh.faces)).reshape(-1, 3))


def with_faces(mesh: Mesh, faces: Sequence[Sequence[int]], vertices: Sequence[Sequence[float]] = ()) -> Mesh:
    more = np.array(vertices, dtype=float).reshape(-1, 3)
    return Mesh(np.concatenate([mesh.vertices, more]), np.concatenate([mesh.faces, np.array(faces)]))


def same_partition(a: IntArray, b: IntArray) -> bool:
    pairs = len(np.unique(np.column_stack([a, b]), axis=0))
    return pairs == len(np.unique(a)) == len(np.unique(b))


def fused_steps() -> Mesh:
    """One closed surface: two steps, extruded along y. Six sides, and a riser and a tread more."""
    outline = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], dtype=float)
    front = np.column_stack([outline[:, 0], np.zeros(6), outline[:, 1]])
    back = front + [0, 3, 0]
    sides = [[[i, j, j + 6], [i, j + 6, i + 6]] for i, j in zip(range(6), [1, 2, 3, 4, 5, 0], strict=True)]
    cap = [[0, 1, 3], [1, 2, 3], [0, 3, 5], [3, 4, 5]]
    faces = np.array([f for side in sides for f in side] + cap + [[a + 6, c + 6, b + 6] for a, b, c in cap])
    return Mesh(np.concatenate([front, back]), faces)


class TestKeeping:
    def test_a_mesh_is_cut_once_in_each_way(self) -> None:
        mesh = cabinet_mesh()
        plain = find_segments(mesh)
        assert find_segments(mesh) is plain
        assert find_segments(mesh, crease=0.1) is not plain
        assert find_segments(mesh, relief=True) is find_segments(mesh, relief=True) is not plain
        assert find_segments(mesh, vertex=plain.vertex) is not plain

    def test_a_copy_is_cut_anew(self) -> None:
        mesh = cabinet_mesh()
        assert find_segments(replace(mesh)) is not find_segments(mesh)


class TestComponents:
    def test_boxes_apart_are_segments_largest_first(self) -> None:
        segments = find_segments(boxes_mesh(THREE))
        np.testing.assert_array_equal(segments.face_segment, np.repeat([2, 0, 1], 12))
        assert (segments.count, segments.duplicates, segments.degenerates) == (3, 0, 0)
        assert not segments.patches
        assert segments.describe() == "3 connected components"

    def test_boxes_that_touch_without_a_shared_vertex_stay_apart(self) -> None:
        """The five boards of the cabinet meet at corners; a handle lies on its panel between the corners."""
        segments = find_segments(cabinet_mesh())
        assert same_partition(segments.face_segment, np.repeat(range(5), [60, 12, 12, 12, 12]))

    @pytest.mark.parametrize(("open_by", "count"), [(0, 3), (1, 2)])
    def test_one_shared_vertex_joins_sheets_but_not_solids(self, open_by: int, count: int) -> None:
        mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((1, 1, 1), (2, 2, 2)), ((5, 0, 0), (6, 1, 1))])
        sheets = np.concatenate([np.arange(12 * k, 12 * (k + 1) - open_by) for k in range(3)])
        segments = find_segments(Mesh(mesh.vertices, mesh.faces[sheets]))
        assert segments.count == count

    @pytest.mark.parametrize("noise", [0.0, 1e-7])
    def test_split_vertices_make_no_difference(self, noise: float) -> None:
        """Seams of textures split vertices, and single precision moves them by 1e-7."""
        for mesh in (boxes_mesh(THREE), cabinet_mesh(), fused_steps()):
            whole, split = find_segments(mesh), find_segments(unwelded(mesh, noise))
            assert same_partition(whole.face_segment, split.face_segment)
            assert whole.count == split.count
            assert whole.patches == split.patches

    def test_a_gap_of_a_tenth_of_a_millimetre_a_metre_is_a_gap(self) -> None:
        near = [((0, 0, 0), (0.5, 0.5, 0.5)), ((0.5001, 0, 0), (1, 0.5, 0.5))]
        assert find_segments(boxes_mesh(near)).count == 2

    @given(seeds)
    @settings(max_examples=20, deadline=None)
    def test_the_order_of_faces_and_vertices_makes_no_difference(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        for mesh in (cabinet_mesh(), fused_steps(), boxes_mesh(THREE)):
            faces, vertices = rng.permutation(len(mesh.faces)), rng.permutation(len(mesh.vertices))
            moved = Mesh(mesh.vertices[vertices], np.argsort(vertices)[mesh.faces[faces]])
            shuffled = find_segments(moved).face_segment
            assert same_partition(shuffled, find_segments(mesh).face_segment[faces])

    @pytest.mark.parametrize("factor", [1e-3, 100.0])
    def test_the_unit_makes_no_difference(self, factor: float) -> None:
        for mesh in (cabinet_mesh(), fused_steps()):
            scaled = find_segments(Mesh(mesh.vertices * factor, mesh.faces))
            assert same_partition(scaled.face_segment, find_segments(mesh).face_segment)

    def test_vertices_are_numbered_by_position(self) -> None:
        vertex = find_segments(unwelded(CUBE)).vertex
        assert len(np.unique(vertex)) == 8
        corners = CUBE.triangles.reshape(-1, 3)
        for number in range(8):
            assert len(np.unique(corners[vertex == number], axis=0)) == 1

    def test_results_are_read_only(self) -> None:
        with pytest.raises(ValueError, match="read-only"):
            find_segments(CUBE).face_segment[0] = 1


class TestFaults:
    def test_duplicates_are_counted_and_share_the_label_of_the_first(self) -> None:
        mesh = boxes_mesh(THREE)
        doubled = with_faces(mesh, [*mesh.faces[:5], *mesh.faces[14:16, [1, 2, 0]], *mesh.faces[30:31, ::-1]])
        segments = find_segments(doubled)
        assert (segments.count, segments.duplicates, segments.degenerates) == (3, 8, 0)
        np.testing.assert_array_equal(segments.face_segment[36:], [2, 2, 2, 2, 2, 0, 0, 1])
        assert "8 duplicate and 0 degenerate faces not analysed" in segments.describe()

    def test_a_surface_that_is_there_twice_has_the_same_segments(self) -> None:
        for mesh in (boxes_mesh(THREE), fused_steps()):
            twice = find_segments(with_faces(mesh, [*mesh.faces, *mesh.faces[:, ::-1]]))
            once = find_segments(mesh)
            assert twice.duplicates == 2 * len(mesh.faces)
            np.testing.assert_array_equal(twice.face_segment, np.tile(once.face_segment, 3))

    @pytest.mark.parametrize("face", [[8, 8, 9], [10, 10, 10], [24, 11, 12]])
    def test_a_face_without_area_takes_its_neighbours_label(self, face: list[int]) -> None:
        """The last one is a sliver: vertex 24 lies in the middle between 11 and 12 of the second box."""
        mesh = boxes_mesh(THREE)
        middle = mesh.vertices[[11, 12]].mean(axis=0)
        segments = find_segments(with_faces(mesh, [face], [middle]))
        assert (segments.count, segments.duplicates, segments.degenerates) == (3, 0, 1)
        assert segments.face_segment[-1] == 0

    def test_faces_without_area_join_nothing(self) -> None:
        """As strips of triangles leave them when they jump from one piece to the next."""
        mesh = boxes_mesh(THREE)
        segments = find_segments(with_faces(mesh, [[0, 0, 8], [8, 16, 16], [0, 8, 8]]))
        assert segments.degenerates == 3
        np.testing.assert_array_equal(segments.face_segment[:36], np.repeat([2, 0, 1], 12))
        np.testing.assert_array_equal(segments.face_segment[36:], [0, 0, 0])

    def test_a_face_without_area_or_neighbours_is_no_segment(self) -> None:
        segments = find_segments(with_faces(boxes_mesh(THREE), [[24, 24, 24]], [[3.0, 5.0, 1.0]]))
        assert segments.count == 3
        assert segments.face_segment[-1] in range(3)

    def test_nothing_but_faces_without_area(self) -> None:
        segments = find_segments(
            Mesh(np.diag([0.0, 1, 0]) @ np.ones((3, 3)), np.array([[0, 1, 2], [0, 0, 1]]))
        )
        assert (segments.count, segments.degenerates) == (1, 2)


class TestPatches:
    def test_a_fused_surface_is_cut_at_its_creases(self) -> None:
        mesh = fused_steps()
        segments = find_segments(mesh)
        assert segments.patches
        assert segments.count == 8
        assert "8 crease-bounded patches of a fused surface" in segments.describe()
        for patch in range(8):
            normals = mesh.face_normals[segments.face_segment == patch]
            np.testing.assert_allclose(normals, np.broadcast_to(normals[0], normals.shape), atol=1e-12)

    def test_round_surfaces_stay_whole(self) -> None:
        can = trimesh.creation.cylinder(radius=1.0, height=2.0, sections=32)
        segments = find_segments(Mesh(can.vertices, can.faces))
        assert segments.patches
        assert segments.count == 3

    def test_the_crease_angle_can_be_set(self) -> None:
        prism = trimesh.creation.cylinder(radius=1.0, height=2.0, sections=12)
        mesh = Mesh(prism.vertices, prism.faces)
        assert find_segments(mesh, crease=np.deg2rad(31.0)).count == 3
        assert find_segments(mesh, crease=np.deg2rad(29.0)).count == 14

    def test_what_is_not_fused_stays_a_component(self) -> None:
        """A small knob beside a large block: the block spans everything, and only it is cut."""
        mesh = boxes_mesh([((0, 0, 0), (2, 2, 2)), ((0.9, -0.05, 0.9), (1.1, -0.001, 1.1))])
        segments = find_segments(mesh)
        assert segments.patches
        assert segments.count == 7
        assert len(np.unique(segments.face_segment[12:])) == 1

    def test_a_component_that_spans_without_most_of_the_surface_is_not_cut(self) -> None:
        """A case of six sides of 1 m2 each, and three boxes in it with 1.5 m2 each."""
        inner = [((0.1 * i, 0.2, 0.2), (0.1 * i + 0.5, 0.7, 0.7)) for i in (1, 2, 3)]
        segments = find_segments(boxes_mesh([((0, 0, 0), (1, 1, 1)), *inner]))
        assert not segments.patches
        np.testing.assert_array_equal(segments.face_segment[:12], np.zeros(12))
        assert segments.count == 4

    def test_most_of_the_surface_without_spanning_is_not_cut(self) -> None:
        segments = find_segments(boxes_mesh([((0, 0, 0), (1, 1, 1)), ((1.1, 0, 0), (1.2, 0.1, 0.1))]))
        assert not segments.patches
        assert segments.count == 2


class TestWeldedSolids:
    """A component that spans the object comes apart where more than two faces meet."""

    def test_boxes_that_share_walls_come_apart(self) -> None:
        """Six cubes in a row: a ring of sides each, the end caps on theirs, and the five walls between."""
        row = boxes_mesh([((i, 0, 0), (i + 1.0, 1, 1)) for i in range(6)])
        segments = find_segments(row)
        assert not segments.patches
        assert segments.duplicates == 10
        assert segments.count == 11
        lengths = [np.ptp(corners_of(row, segments.face_segment, i)[:, 0]) for i in range(11)]
        assert sorted(lengths) == [0.0] * 5 + [1.0] * 6

    def test_boxes_that_share_an_edge_come_apart(self) -> None:
        stairs = boxes_mesh([((i, 0, i), (i + 1.0, 1, i + 1.0)) for i in range(3)])
        segments = find_segments(stairs)
        assert not segments.patches
        assert same_partition(segments.face_segment, np.repeat([0, 1, 2], 12))

    @pytest.mark.parametrize("seed", range(5))
    def test_an_edge_with_more_than_two_faces_bounds_them_all(self, seed: int) -> None:
        """A shelf of two level halves, with a board that stands where they meet."""
        vertices = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0], [1, 0, 1], [1, 1, 1]]
        faces = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [1, 4, 7], [1, 7, 6]])
        order = np.random.default_rng(seed).permutation(6)
        segments = find_segments(Mesh(np.array(vertices, dtype=float), faces[order]))
        assert not segments.patches
        assert same_partition(segments.face_segment, np.array([0, 0, 1, 1, 2, 2])[order])

    def test_what_does_not_span_stays_whole(self) -> None:
        pair = [((0, 0, 0), (1, 1, 1)), ((1, 0, 1), (2, 1, 2))]
        segments = find_segments(boxes_mesh([*pair, ((5, 0, 0), (9, 4, 4))]))
        assert same_partition(segments.face_segment, np.repeat([0, 0, 1], 12))


class TestNodes:
    def joined_cubes(self) -> Mesh:
        mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((1, 1, 1), (2, 2, 2)), ((6, 0, 0), (8, 2, 2))])
        return replace(mesh, face_node=np.repeat([4, 7, 7], 12))

    def test_nodes_are_not_looked_at_unless_asked_for(self) -> None:
        assert find_segments(self.joined_cubes()).count == 2

    def test_the_hint_keeps_nodes_apart(self) -> None:
        segments = find_segments(self.joined_cubes(), node_hint=True)
        np.testing.assert_array_equal(segments.face_segment, np.repeat([1, 2, 0], 12))

    def test_the_hint_joins_nothing(self) -> None:
        mesh = replace(boxes_mesh(THREE), face_node=np.zeros(36, dtype=int))
        assert find_segments(mesh, node_hint=True).count == 3

    def test_a_mesh_without_nodes(self) -> None:
        assert find_segments(boxes_mesh(THREE), node_hint=True).count == 3


class TestWeld:
    def test_coincident_points_share_an_id(self) -> None:
        points = np.array([[0.0, 0, 0], [1, 0, 0], [1e-9, 0, 0], [1, 0, 0]])
        a, b, c, d = weld(points, 1e-6)
        assert a == c
        assert b == d
        assert a != b

    @given(st.lists(st.tuples(*[st.floats(-1e3, 1e3)] * 3), min_size=1, max_size=20), st.floats(1e-6, 1.0))
    @settings(max_examples=60, deadline=None)
    def test_equal_points_share_an_id_and_distant_ones_never(
        self, rows: list[tuple[float, float, float]], tolerance: float
    ) -> None:
        points = np.array(rows + rows[:1])
        ids = weld(points, tolerance)
        apart = np.abs(points[:, None] - points[None]).max(axis=2)
        same = ids[:, None] == ids[None]
        assert same[apart == 0].all()
        assert not same[apart > tolerance * (1 + 1e-6) + 1e-9].any()
        assert sorted(set(ids)) == list(range(ids.max() + 1))

    @pytest.mark.parametrize("tolerance", [0.0, 5e-324])
    def test_no_tolerance_at_all(self, tolerance: float) -> None:
        points = np.array([[0.0, 0, 0], [0, 0, 5e-324], [1, 0, 0]])
        a, b, c = weld(points, tolerance)
        assert a == b != c


def corners_of(mesh: Mesh, labels: IntArray, segment: int) -> FloatArray:
    return np.asarray(mesh.triangles[labels == segment].reshape(-1, 3))
