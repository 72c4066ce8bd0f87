"""Skins as generators of shapes deliver them: decimated, with two sides to each wall, and with strays."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.geometric.segmenter import Geometric
from simart_kit_plugins.nano.segmenter import Nano

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.loading import read_source
from simart_kit.mesh import Mesh
from simart_kit.plugins import Plugins
from simart_kit.segments import find_segments
from simart_kit.skins.refining import longest_side, refined
from simart_kit.topology import half_edges, shared_by_two

from .delivered_skins import among_strays, decimated, double_walled, main
from .real_objects import DATA, needs_data
from .test_skins import SLAB, Box, at, skin

SLABS: list[Box] = [((0, 0, 0), (104, 40, 88)), *(((3, -3, low), (101, 0, low + 39)) for low in (3, 46))]
DRAWERS = ["body", "drawer", "drawer"]


def labels(mesh: Mesh) -> list[str]:
    return [guess.label for guess in Geometric().segment(mesh).parts]


def rough(mesh: Mesh, by: float = 0.0004) -> Mesh:
    noise = np.random.default_rng(0).normal(0, by, mesh.vertices.shape)
    return Mesh(mesh.vertices + noise, mesh.faces)


def made(how: Callable[..., tuple[trimesh.Trimesh, IntArray]], mesh: Mesh, much: float) -> Mesh:
    """A skin as one of `delivered_skins` makes it."""
    skin = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    other, _ = how(skin, np.zeros(len(mesh.faces), dtype=np.int64), much)
    return Mesh(np.array(other.vertices), np.array(other.faces))


def with_more(mesh: Mesh, *others: tuple[FloatArray, FloatArray]) -> Mesh:
    """One mesh of a mesh and the vertices and faces of others."""
    vertices, faces = [mesh.vertices], [mesh.faces]
    for places, corners in others:
        faces.append(corners + sum(map(len, vertices)))
        vertices.append(places)
    return Mesh(np.concatenate(vertices), np.concatenate(faces))


class TestRefined:
    """A flat tetrahedron, and small triangles beside it."""

    places = np.array([[0, 0, 0], [1.0, 0, 0], [0, 1.0, 0], [0, 0, 0.1], [2, 0, 0], [2.1, 0, 0], [2, 0.1, 0]])
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3], *[[4, 5, 6]] * 6])

    def test_no_side_is_longer_than_asked_for(self) -> None:
        fine = refined(self.places, self.faces, 0.15)
        corners = fine.places[fine.faces]
        assert np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max() <= 0.15

    def test_parts_lie_in_their_sources_and_cover_them(self) -> None:
        fine = refined(self.places, self.faces, 0.15)
        lie = np.einsum("nij,njk->nik", fine.weights, self.places[self.faces[fine.source]])
        np.testing.assert_allclose(lie, fine.places[fine.faces], atol=1e-12)
        np.testing.assert_allclose(np.bincount(fine.source, fine.shares), np.ones(len(self.faces)))

    def test_a_closed_surface_stays_closed(self) -> None:
        fine = refined(self.places, self.faces, 0.15)
        edge = half_edges(fine.faces[fine.source < 4])[1]
        assert 2 * len(shared_by_two(edge)) == len(edge)

    def test_triangles_of_a_size_are_left_as_they_are(self) -> None:
        mesh = skin(SLAB)
        assert len(refined(mesh.vertices, mesh.faces, 0.001).faces) == len(mesh.faces)

    def test_what_would_be_too_many_is_left_as_it_is(self) -> None:
        assert len(refined(self.places, self.faces, 1e-5).faces) == len(self.faces)

    def test_sides_are_left_half_as_long_where_triangles_are_large(self) -> None:
        assert longest_side(self.places, self.faces, 1.0) == 1.0
        assert longest_side(self.places, self.faces, 0.15) == 0.075

    def test_a_source_has_the_label_of_most_of_it(self) -> None:
        fine = refined(self.places, self.faces, 0.15)
        corners = fine.places[fine.faces]
        area = np.linalg.norm(np.cross(*np.diff(corners, axis=1).swapaxes(0, 1)), axis=1) / 2
        label = np.where((fine.source == 0) & (corners[..., 0].mean(axis=1) > 0.45), 1, 0)
        assert fine.on_sources(label, area).tolist() == [0] * 10
        label[fine.source == 2] = 2
        assert fine.on_sources(label, area).tolist() == [0, 0, 2, *[0] * 7]


class TestDecimated:
    @pytest.mark.parametrize("faces", [16_000, 6000, 3000])
    def test_drawers_are_found(self, faces: int) -> None:
        mesh = made(decimated, rough(skin(SLABS)), faces)
        found = Geometric().segment(mesh)
        assert [guess.label for guess in found.parts] == DRAWERS
        heights = []
        for part in (1, 2):
            front = (found.face_part == part) & (mesh.face_normals[:, 1] < -0.9)
            sums = mesh.face_areas[front] @ mesh.triangles[front].mean(axis=1)
            heights.append(sums[2] / mesh.face_areas[front].sum() * 100 - 5)
        assert sorted(heights) == pytest.approx([22.5, 65.5], abs=2)

    def test_it_is_cut_in_grooves_as_it_was_before(self) -> None:
        mesh = made(decimated, rough(skin(SLAB)), 5000)
        segments = find_segments(mesh, relief=True)
        above, slab, below = (at(mesh, segments, (30, y, z)) for y, z in ((10, 92), (4, 50), (10, 8)))
        assert len({above, slab, below}) == 3
        area = mesh.face_areas[segments.face_segment == slab].sum()
        assert area == pytest.approx(0.60 * 0.60, rel=0.25)

    @needs_data
    def test_drawers_of_a_real_one_are_found(self) -> None:
        mesh = read_source(DATA / "bigym_base_small_drawers" / "fused.glb", Plugins()).mesh
        found = labels(made(decimated, mesh, 40_000))
        assert found.count("drawer") >= 3


class TestTwoSidedWalls:
    outer = skin(SLABS)
    mesh = made(double_walled, outer, 0.012)

    def test_drawers_are_found_with_both_sides_of_their_fronts(self) -> None:
        found = Geometric().segment(self.mesh)
        assert [guess.label for guess in found.parts] == DRAWERS
        alone = Geometric().segment(self.outer).face_part
        before, behind = np.split(found.face_part, 2)
        np.testing.assert_array_equal(before, alone)
        both = (before > 0) & (np.abs(self.outer.face_normals[:, 1]) > 0.9)
        assert (behind[both] == before[both]).mean() > 0.9

    def test_inner_sides_are_told(self) -> None:
        outer, inner = np.split(find_segments(self.mesh).aside, 2)
        assert not outer.any()
        assert inner.all()

    def test_inner_faces_that_stand_twice_are_told_too(self) -> None:
        inner = len(self.mesh.faces) // 2
        twice = Mesh(self.mesh.vertices, np.concatenate([self.mesh.faces, self.mesh.faces[inner:, ::-1]]))
        assert find_segments(twice).aside[inner:].all()

    def test_what_is_far_from_all_walls_goes_with_none(self) -> None:
        core = skin([((0, 0, 0), (12, 2, 12))])
        block = skin([((0, 0, 0), (60, 60, 60))])
        mesh = with_more(block, (core.vertices + (0.24, 0.3, 0.24), core.faces))
        segments = find_segments(made(among_strays, mesh, 1), relief=True)
        inside = segments.face_segment[len(block.faces) : len(mesh.faces)]
        assert not set(inside.tolist()) & set(segments.face_segment[: len(block.faces)].tolist())

    def test_a_solid_within_a_plain_box_is_a_solid(self) -> None:
        corners = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
        quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
        faces = np.array([face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))])
        segments = find_segments(with_more(Mesh(corners, faces), (corners * 0.9 + 0.05, faces)), relief=True)
        assert segments.count == 2
        assert not segments.aside.any()


class TestStrays:
    def test_drawers_are_found_among_them(self) -> None:
        mesh = skin(SLABS)
        assert labels(made(among_strays, mesh, 40)) == labels(mesh) == DRAWERS

    def test_they_are_told(self) -> None:
        mesh = skin(SLABS)
        aside = find_segments(made(among_strays, mesh, 40)).aside
        assert aside[len(mesh.faces) :].all()
        assert not aside[: len(mesh.faces)].any()

    def test_the_report_says_so(self) -> None:
        told = "3200 faces of inner sides of walls and of strays go with what is next to them"
        for segmenter in (Geometric(), Nano()):
            notes = segmenter.segment(made(among_strays, skin(SLABS), 40)).notes
            assert any(note.text.endswith(told) for note in notes), notes


@pytest.mark.parametrize("asked", [("--faces", "2000"), ("--wall", "0.02"), ("--strays", "3")])
def test_parts_stay_with_their_places(tmp_path: Path, asked: tuple[str, str]) -> None:
    """Of a ball whose upper half is another part."""
    folder = tmp_path / "objects" / "ball"
    folder.mkdir(parents=True)
    ball = trimesh.creation.icosphere(subdivisions=4)
    ball.visual.vertex_colors = np.full((len(ball.vertices), 4), 200)
    ball.export(folder / "fused.glb")
    np.savez(folder / "fused.npz", face_part=(ball.triangles_center[:, 2] > 0).astype(np.int64))
    main([str(tmp_path / "objects"), str(tmp_path / "out"), *asked])
    mesh = trimesh.load(tmp_path / "out" / "ball" / "fused.glb", process=False, force="mesh")
    part = np.load(tmp_path / "out" / "ball" / "fused.npz")["face_part"]
    assert len(part) == len(mesh.faces) != len(ball.faces)
    height = mesh.triangles_center[: len(ball.faces), 2]  # strays come last, and inner sides
    away = np.abs(height) > 0.1
    np.testing.assert_array_equal(part[: len(ball.faces)][away] == 1, height[away] > 0)
