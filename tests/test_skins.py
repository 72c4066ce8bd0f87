"""Closed skins: cut where the solids met that they were made of."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from simart_kit_plugins.geometric.segmenter import Geometric
from simart_kit_plugins.shapes.surface_nets import surface_nets

from simart_kit.arrays import BoolArray, FloatArray
from simart_kit.loading import read_source
from simart_kit.mesh import Mesh
from simart_kit.plugins import Plugins
from simart_kit.segments import Segments, find_segments
from simart_kit.skins.graph import skin_graph

from .real_objects import DATA, needs_data

Box = tuple[tuple[int, int, int], tuple[int, int, int]]


def skin(solid: Sequence[Box], hollow: Sequence[Box] = ()) -> Mesh:
    """The closed skin of boxes, and of boxes taken out of them, in cells of a hundredth of a metre."""
    grid = np.ones(np.max([high for _, high in solid], axis=0) + 12)
    for boxes, value in ((solid, -1.0), (hollow, 1.0)):
        for low, high in boxes:
            grid[tuple(slice(a + 5, b + 5) for a, b in zip(low, high, strict=True))] = value
    vertices, faces = surface_nets(grid)
    return Mesh(vertices / 100, faces)


def at(mesh: Mesh, segments: Segments, place: FloatArray | tuple[float, ...]) -> int:
    """The segment of the face nearest to a place, in cells as `skin` takes them."""
    middles = mesh.triangles.mean(axis=1) * 100 - 5 + 0.5
    return int(segments.face_segment[np.linalg.norm(middles - np.asarray(place), axis=1).argmin()])


SLAB: list[Box] = [((0, 10, 0), (60, 60, 100)), ((0, 4, 20), (60, 10, 80))]
FRAME: list[Box] = [((0, 0, 0), (60, 60, 100))]
PANELS: list[Box] = [((8, 0, 8), (52, 1, 46)), ((8, 0, 54), (52, 1, 92))]


class TestGrooves:
    def test_a_slab_before_a_block_is_a_piece(self) -> None:
        mesh = skin(SLAB)
        segments = find_segments(mesh, relief=True)
        assert segments.patches
        above, slab, below = (at(mesh, segments, (30, y, z)) for y, z in ((10, 92), (4, 50), (10, 8)))
        assert len({above, slab, below}) == 3
        area = mesh.face_areas[segments.face_segment == slab].sum()
        assert area == pytest.approx(0.60 * 0.60, rel=0.25)  # its front, and some of its narrow sides

    def test_roughness_makes_no_pieces(self) -> None:
        mesh = skin(SLAB)
        rng = np.random.default_rng(0)
        rough = Mesh(mesh.vertices + rng.normal(0, 0.001, mesh.vertices.shape), mesh.faces)
        smooth, found = find_segments(mesh, relief=True), find_segments(rough, relief=True)
        assert found.count == smooth.count
        assert (found.face_segment == smooth.face_segment).mean() > 0.9

    def test_pieces_do_not_depend_on_pose_and_size(self) -> None:
        mesh = skin(SLAB)
        turn = Rotation.from_euler("zyx", (20, 10, 50), degrees=True).as_matrix()
        turned = Mesh(40 * mesh.vertices @ turn.T, mesh.faces)
        one, other = (
            find_segments(mesh, relief=True).face_segment,
            find_segments(turned, relief=True).face_segment,
        )
        # The radius goes by the longest side of the box around it, which turning changes.
        pairs = np.bincount(one * (int(other.max()) + 1) + other)
        assert np.sort(pairs)[-(int(one.max()) + 1) :].sum() > 0.95 * len(one)

    def test_every_face_has_a_segment_largest_first(self) -> None:
        mesh = skin(SLAB)
        segments = find_segments(mesh, relief=True)
        areas = np.bincount(segments.face_segment, mesh.face_areas)
        assert len(areas) == segments.count
        assert (np.diff(areas) <= 0).all()


class TestSeams:
    def colored(self, where: FloatArray) -> Mesh:
        mesh = skin(FRAME)
        colors = np.full((len(mesh.vertices), 4), 255, dtype=np.uint8)
        colors[where_in(mesh, where), :3] = (90, 60, 40)
        return Mesh(mesh.vertices, mesh.faces, colors=colors)

    def test_a_region_of_another_colour_is_a_piece(self) -> None:
        mesh = self.colored(np.array([[10, -1, 20], [50, 1, 60]]))
        segments = find_segments(mesh, relief=True)
        assert at(mesh, segments, (30, 0, 40)) != at(mesh, segments, (30, 0, 90))

    def test_speckles_all_over_part_nothing_and_hide_no_seam(self) -> None:
        mesh = self.colored(np.array([[10, -1, 20], [50, 1, 60]]))
        assert mesh.colors is not None
        colors = mesh.colors.copy()
        colors[np.random.default_rng(0).random(len(colors)) < 0.14, :3] = 160
        segments = find_segments(Mesh(mesh.vertices, mesh.faces, colors=colors), relief=True)
        assert segments.count == find_segments(mesh, relief=True).count
        assert at(mesh, segments, (30, 0, 40)) != at(mesh, segments, (30, 0, 90))

    def test_a_stain_is_none(self) -> None:
        mesh = self.colored(np.array([[30, -1, 40], [33, 1, 43]]))
        segments = find_segments(mesh, relief=True)
        assert at(mesh, segments, (31, 0, 41)) == at(mesh, segments, (30, 0, 90))


def test_medians_take_lone_values_and_leave_borders() -> None:
    mesh = skin([((0, 0, 0), (20, 20, 20))])
    graph = skin_graph(mesh.vertices, mesh.faces, mesh.face_normals, mesh.face_areas)
    right = mesh.vertices[:, 0] > 0.15
    values = np.column_stack([right, ~right]).astype(np.float64)
    lone = np.array([3, 700, 1500])
    speckled = values.copy()
    speckled[lone] = 1 - values[lone]
    beside_border = np.zeros(len(right), dtype=np.bool_)
    beside_border[graph.edges[right[graph.edges[:, 0]] != right[graph.edges[:, 1]]]] = True
    found = graph.medians(speckled)
    np.testing.assert_array_equal(found[~beside_border], values[~beside_border])
    assert (found[:, 0] != values[:, 0]).mean() < 0.1 * beside_border.mean()


def where_in(mesh: Mesh, box: FloatArray) -> BoolArray:
    """(V,) whether vertices lie in a box of cells."""
    cells = mesh.vertices * 100 - 5 + 0.5
    return np.asarray(((cells >= box[0]) & (cells <= box[1])).all(axis=1))


class TestFrames:
    def test_a_frame_is_shared_out_among_the_panels_set_in_it(self) -> None:
        mesh = skin(FRAME, PANELS)
        segments = find_segments(mesh, relief=True)
        low, high = at(mesh, segments, (4, 0, 27)), at(mesh, segments, (4, 0, 73))
        assert low != high
        front = np.isin(segments.face_segment, (low, high)) & (mesh.face_normals[:, 1] < -0.9)
        height = mesh.triangles[front].mean(axis=1)[:, 2] * 100 - 5
        assert height[segments.face_segment[front] == low].max() == pytest.approx(50, abs=2)
        assert height[segments.face_segment[front] == high].min() == pytest.approx(50, abs=2)

    def test_slabs_that_stand_out_leave_their_frame_whole(self) -> None:
        slabs: list[Box] = [((8, -3, 8), (52, 0, 46)), ((8, -3, 54), (52, 0, 92))]
        mesh = skin([((0, 0, 0), (60, 60, 100)), *slabs])
        segments = find_segments(mesh, relief=True)
        assert at(mesh, segments, (4, 0, 27)) == at(mesh, segments, (4, 0, 73))


def test_the_two_faces_of_a_board_are_one_piece() -> None:
    mesh = skin([((0, 0, 0), (60, 40, 6)), ((0, 36, 6), (60, 40, 50))])
    segments = find_segments(mesh, relief=True)
    before, back, low = (at(mesh, segments, place) for place in ((30, 36, 30), (30, 40, 30), (30, 16, 6)))
    assert before == back != low


class TestPartedSides:
    SLABS: Sequence[Box] = [((2, -3, low), (50, 0, low + 18)) for low in (2, 24)]

    def labels(self, more: Sequence[Box]) -> list[str]:
        """Labels of what is found on a block with more boxes on it."""
        return [guess.label for guess in Geometric().segment(skin([((0, 0, 0), (52, 14, 44)), *more])).parts]

    def test_wide_slabs_above_one_another_before_a_plain_block_are_drawers(self) -> None:
        assert self.labels(self.SLABS) == ["body", "drawer", "drawer"]

    def test_a_block_that_is_parted_alike_on_both_sides_stays(self) -> None:
        behind: list[Box] = [((x, 14, z), (u, 17, w)) for (x, _, z), (u, _, w) in self.SLABS]
        assert self.labels([*self.SLABS, *behind]) == ["body"]

    def test_knobs_on_both_sides_of_the_middle_are_those_of_two_doors(self) -> None:
        assert self.labels([((x, -3, 20), (x + 3, 0, 24)) for x in (19, 30)]) == ["body", "door", "door"]

    def test_bars_nearly_as_long_as_the_doors_are_handles(self) -> None:
        bars: list[Box] = [((x, -4, 5), (x + 3, -2, 39)) for x in (19, 30)]
        posts: list[Box] = [((x, -2, z), (x + 3, 0, z + 3)) for x in (19, 30) for z in (8, 33)]
        assert self.labels([*bars, *posts]) == ["body", "door", "door"]


def test_two_boards_side_by_side_in_two_tracks_slide() -> None:
    leaves: list[Box] = [((2, 0, 3), (31, 4, 57)), ((29, 4, 3), (58, 8, 57))]
    rails: list[Box] = [((0, -3, 0), (60, 11, 3)), ((0, -3, 57), (60, 11, 60))]
    found = Geometric().segment(skin([*leaves, *rails]))
    assert [guess.label for guess in found.parts] == ["body", "sliding_door", "sliding_door"]


def test_a_coarse_skin_is_cut_at_its_creases() -> None:
    corners = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    faces = [face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))]
    assert find_segments(Mesh(corners, np.array(faces)), relief=True).count == 6


@needs_data
def test_both_doors_of_a_real_skin_are_found() -> None:
    folder = DATA / "bigym_wall_cabinet"
    mesh = read_source(folder / "fused.glb", Plugins()).mesh
    found = Geometric().segment(mesh)
    truth = np.load(folder / "fused.npz")["face_part"]
    assert [guess.label for guess in found.parts] == ["body", "door", "door"]
    for door in (1, 2):
        own = found.face_part == door
        owner = np.bincount(truth[own], mesh.face_areas[own]).argmax()
        shared = mesh.face_areas[own & (truth == owner)].sum() / mesh.face_areas[own | (truth == owner)].sum()
        assert owner > 0
        assert shared > 0.8


@needs_data
def test_the_leaf_of_a_real_skin_with_speckled_colours_is_one_piece_and_opens() -> None:
    """Between its surfaces, which nearly coincide, the baked colours change from vertex to vertex."""
    mesh = read_source(DATA / "gz_hinged_door" / "fused.glb", Plugins()).mesh
    found = Geometric(seed=0).segment(mesh)
    assert [part.label for part in found.parts] == ["body", "door"]
    truth = np.load(DATA / "gz_hinged_door" / "fused.npz")["face_part"] > 0
    own, areas = found.face_part == 1, mesh.face_areas
    assert areas[own & truth].sum() > 0.9 * areas[own | truth].sum()
