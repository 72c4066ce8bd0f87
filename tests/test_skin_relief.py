"""Closed skins of all kinds: sides that rounded edges join, what stands out, buttons, and stray shells."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from simart_kit_plugins.shapes.surface_nets import surface_nets

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.mesh import Mesh
from simart_kit.segments import find_segments
from simart_kit.skins.graph import SkinGraph, skin_graph
from simart_kit.skins.lobes import with_lobes_whole
from simart_kit.skins.sides import ways, with_sides_parted

Distance = Callable[[FloatArray], FloatArray]


def skin(distance: Distance, size: tuple[float, float, float], cell: float) -> Mesh:
    """The closed skin of a signed distance [m] within a box of a size about the origin."""
    steps = [np.arange(-side / 2, side / 2, cell) for side in size]
    places = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1)
    vertices, faces = surface_nets(distance(places))
    return Mesh(vertices * cell + [step[0] for step in steps], faces)


def graph_of(mesh: Mesh) -> SkinGraph:
    return skin_graph(mesh.vertices, mesh.faces, mesh.face_normals, mesh.face_areas)


def rounded_box(size: tuple[float, float, float], radius: float) -> Distance:
    def distance(places: FloatArray) -> FloatArray:
        off = np.abs(places) - (np.array(size) / 2 - radius)
        outside = np.linalg.norm(np.maximum(off, 0), axis=-1)
        return np.asarray(outside + np.minimum(off.max(axis=-1), 0) - radius)

    return distance


def ball(radius: float, at: tuple[float, float, float] = (0, 0, 0)) -> Distance:
    return lambda places: np.asarray(np.linalg.norm(places - at, axis=-1) - radius)


def capsule(radius: float, half: float) -> Distance:
    """About the y axis."""

    def distance(places: FloatArray) -> FloatArray:
        along = np.clip(places[..., 1], -half, half)
        off = places - np.stack([0 * along, along, 0 * along], axis=-1)
        return np.asarray(np.linalg.norm(off, axis=-1) - radius)

    return distance


def union(*several: Distance) -> Distance:
    return lambda places: np.asarray(np.min([one(places) for one in several], axis=0))


class TestSides:
    def parted(self, distance: Distance) -> tuple[SkinGraph, IntArray]:
        graph = graph_of(skin(distance, (1.2, 1.2, 1.2), 0.03))
        whole = np.zeros(len(graph.places), dtype=np.int64)
        return graph, with_sides_parted(graph, whole, ways(graph.normals), 0.01)

    def test_a_box_with_rounded_edges_has_six(self) -> None:
        graph, label = self.parted(rounded_box((0.8, 0.6, 0.7), 0.03))
        assert np.unique(label).tolist() == list(range(6))
        for side in range(6):
            own = graph.normals[label == side]
            assert np.abs(own.mean(axis=0)).max() > 0.85

    def test_a_ball_has_none(self) -> None:
        assert np.unique(self.parted(ball(0.4))[1]).tolist() == [0]

    def test_a_board_stays_in_one_piece(self) -> None:
        assert np.unique(self.parted(rounded_box((0.9, 0.08, 0.9), 0.03))[1]).tolist() == [0]


class TestLobes:
    """A ball half in a larger one, of whose own surface only what looks down is a piece at first."""

    radius, middle = 0.15, (0.0, 0.33, 0.0)

    def whole(self, height_of_rest: float) -> tuple[SkinGraph, IntArray, IntArray]:
        graph = graph_of(skin(union(ball(0.4), ball(self.radius, self.middle)), (1.1, 1.1, 1.1), 0.02))
        lobe = np.linalg.norm(graph.places - self.middle, axis=1) < self.radius + 0.01
        lower = lobe & (graph.places[:, 2] < 0.0)
        height = np.where(np.abs(np.linalg.norm(graph.places, axis=1) - 0.4) < 0.02, 0.03, height_of_rest)
        label = with_lobes_whole(graph, lower.astype(np.int64), height)
        return graph, label, lobe.astype(np.int64)

    def test_what_is_beyond_the_hollow_where_it_begins_is_of_it(self) -> None:
        graph, label, lobe = self.whole(-0.03)
        both, either = ((label == 1) & (lobe == 1)), ((label == 1) | (lobe == 1))
        assert graph.areas[both].sum() / graph.areas[either].sum() > 0.85

    def test_a_piece_that_no_sharp_edge_ends_stays_as_it_is(self) -> None:
        graph, label, lobe = self.whole(0.0)
        assert graph.areas[label == 1].sum() == pytest.approx(graph.areas[lobe == 1].sum() / 2, rel=0.2)

    def test_shells_and_pieces_of_few_places_stay_as_they_are(self) -> None:
        """A small shell has no border at all, and a piece of one vertex a hollow one of a place or two."""
        large, small = skin(ball(0.4), (1.0, 1.0, 1.0), 0.03), skin(ball(0.06), (0.3, 0.3, 0.3), 0.03)
        count = len(large.vertices)
        both = Mesh(
            np.concatenate([large.vertices, small.vertices]),
            np.concatenate([large.faces, small.faces + count]),
        )
        label = np.concatenate([np.zeros(count), np.ones(len(small.vertices))]).astype(np.int64)
        label[0] = 2
        for height in (0.03, -0.03):
            found = with_lobes_whole(graph_of(both), label, np.full(len(label), height))
            np.testing.assert_array_equal(found, label)


class TestFaintGrooves:
    def test_low_buttons_of_a_handle_are_pieces(self) -> None:
        buttons = [ball(0.012, (0.0, y, 0.024)) for y in (0.0, 0.045)]
        mesh = skin(union(capsule(0.03, 0.06), *buttons), (0.08, 0.2, 0.08), 0.0014)
        segments = find_segments(mesh, relief=True)
        middles = mesh.triangles.mean(axis=1)
        on = [int(np.linalg.norm(middles - (0, y, 0.036), axis=1).argmin()) for y in (0.0, 0.045)]
        found = segments.face_segment[on]
        assert segments.patches
        assert len({0, *found.tolist()}) == 3
        for piece in found:
            assert np.ptp(middles[segments.face_segment == piece][:, 1]) < 0.035


class TestStrayShells:
    box = skin(rounded_box((0.5, 0.4, 0.6), 0.03), (0.7, 0.6, 0.8), 0.012)

    def beside(self, other: Mesh) -> Mesh:
        return Mesh(
            np.concatenate([self.box.vertices, other.vertices + (0.4, 0.0, 0.0)]),
            np.concatenate([self.box.faces, other.faces + len(self.box.vertices)]),
        )

    def test_a_small_one_as_finely_meshed_beside_a_skin_leaves_it_one(self) -> None:
        crumb = skin(ball(0.05), (0.2, 0.2, 0.2), 0.012)
        segments = find_segments(self.beside(crumb), relief=True)
        assert segments.patches
        assert len(np.unique(segments.face_segment[len(self.box.faces) :])) == 1

    def test_a_solid_that_is_meshed_otherwise_is_a_solid_and_so_is_the_other(self) -> None:
        finer = skin(ball(0.05), (0.2, 0.2, 0.2), 0.006)
        segments = find_segments(self.beside(finer), relief=True)
        assert not segments.patches
        assert segments.count == 2

    def test_two_of_a_size_are_two_solids(self) -> None:
        twin = Mesh(self.box.vertices + (0.3, 0.0, 0.0), self.box.faces)
        assert not find_segments(self.beside(twin), relief=True).patches
