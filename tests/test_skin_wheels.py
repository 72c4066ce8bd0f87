"""Wheels of rough skins: discs that are no exact circles, of several pieces, alike and on the ground."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.geometric.contact import Contacts
from simart_kit_plugins.geometric.predictor import GeometricJoints
from simart_kit_plugins.geometric.rough_discs import rough_disc
from simart_kit_plugins.geometric.scene import Scene, make_scene
from simart_kit_plugins.geometric.skin_wheels import skin_wheels

from simart_kit import PartGuess, Segmentation
from simart_kit.arrays import FloatArray, IntArray, frozen_ints
from simart_kit.mesh import Mesh

RADIUS, WIDE = 0.15, 0.08


def wheel(
    at: tuple[float, float, float], radius: float = RADIUS, axis: int = 0, wide: float = WIDE
) -> tuple[FloatArray, IntArray]:
    """(F, 3, 3) triangles of a disc as rough as a voxel in ten of its radius, and 1 for those of its rim."""
    disc = trimesh.creation.cylinder(radius, wide, sections=48)
    rough = np.random.default_rng(0).normal(1.0, 0.03, len(disc.vertices))[:, None]
    points = disc.vertices * np.hstack([rough, rough, np.ones_like(rough)])
    rim = np.abs(disc.face_normals[:, 2]) < 0.5
    return np.roll(points, axis + 1, axis=1)[disc.faces] + at, rim.astype(np.int64)


def scene_of(wheels: list[tuple[FloatArray, IntArray]]) -> tuple[Scene, Mesh]:
    """A body of piece 0 that hangs above the ground, and the wheels, each of two pieces."""
    body = trimesh.creation.box(bounds=[[-0.3, -0.6, 0.2], [0.3, 0.6, 0.6]]).triangles
    triangles = np.concatenate([body, *(faces for faces, _ in wheels)])
    labels = [np.zeros(len(body)), *(1 + 2 * k + rim for k, (_, rim) in enumerate(wheels))]
    mesh = Mesh(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
    return make_scene(mesh, np.concatenate(labels).astype(np.int64)), mesh


PLACES = [(x, y, RADIUS) for x in (-0.35, 0.35) for y in (-0.4, 0.4)]


def found(wheels: list[tuple[FloatArray, IntArray]]) -> list[set[int]]:
    scene, _ = scene_of(wheels)
    return sorted((set(mover.pieces) for mover in skin_wheels(scene, Contacts(scene), {0})), key=min)


def test_wheels_alike_on_the_ground_move_each_with_its_faces_and_rim() -> None:
    assert found([wheel(place) for place in PLACES]) == [{1, 2}, {3, 4}, {5, 6}, {7, 8}]


@pytest.mark.parametrize("count", [2, 4])
def test_rolls_as_wide_as_high_are_wheels_where_they_are_more_than_two(count: int) -> None:
    assert len(found([wheel(place, wide=2 * RADIUS) for place in PLACES[:count]])) == (4 if count == 4 else 0)


def test_the_other_one_of_a_wheel_may_be_of_pieces_none_of_which_is_round() -> None:
    whole, (faces, _) = wheel((0.0, -0.5, RADIUS)), wheel((0.0, 0.5, RADIUS))
    halves = (faces[:, :, 2].mean(axis=1) > 1.2 * RADIUS).astype(np.int64)
    assert found([whole, (faces, halves)]) == [{1, 2}, {3, 4}]
    assert found([whole, (faces[halves == 1], 0 * halves[halves == 1])]) == []


def test_one_disc_alone_or_with_one_of_another_size_is_no_wheel() -> None:
    assert found([wheel(PLACES[0])]) == []
    assert found([wheel(PLACES[0]), wheel((0.35, 0.4, 0.1), 0.1)]) == []


def test_discs_in_the_air_or_with_an_upright_axle_are_no_wheels() -> None:
    high = [wheel((x, y, z + 0.3)) for x, y, z in PLACES]
    assert found([wheel((0.0, 0.0, 0.05), 0.05), *high]) == []
    assert found([wheel((x, y, WIDE / 2), axis=2) for x, y, _ in PLACES]) == []


def test_a_rough_disc_has_the_axis_the_middle_and_the_radius_of_the_exact_one() -> None:
    faces, _ = wheel((1.0, 2.0, 3.0), axis=1)
    disc = rough_disc(faces.reshape(-1, 3))
    assert disc is not None
    assert disc.axis == 1
    assert disc.center == pytest.approx((1, 2, 3), abs=0.02)
    assert disc.radius == pytest.approx(RADIUS, rel=0.1)
    assert disc.ends == pytest.approx((2 - WIDE / 2, 2 + WIDE / 2))


@pytest.mark.parametrize("size", [(0.1, 0.3, 0.3), (0.1, 0.3, 0.2)], ids=["a square", "an oblong"])
def test_what_has_corners_is_no_disc(size: tuple[float, float, float]) -> None:
    box = trimesh.creation.box(size).subdivide().subdivide()
    assert rough_disc(np.asarray(box.triangles).reshape(-1, 3)) is None


def test_a_rough_wheel_turns_about_its_axle() -> None:
    scene, mesh = scene_of([wheel(place) for place in PLACES])
    part = frozen_ints(((scene.labels + 1) // 2).astype(np.int32))
    guesses = (PartGuess("body", label="body"), *(PartGuess(f"wheel_{k}", label="wheel") for k in range(4)))
    joints = GeometricJoints().predict(mesh, Segmentation(part, guesses))
    assert [joint.kind for joint in joints] == ["continuous"] * 4
    assert np.abs([joint.axis[0] for joint in joints]) == pytest.approx(1, abs=1e-6)
