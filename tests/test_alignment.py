"""How an object is turned about the vertical, by its faces."""

import numpy as np
import pytest
import trimesh

from simart_kit.alignment import straight_from_asset, yaw
from simart_kit.arrays import FloatArray
from simart_kit.kinematics import rotation
from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh

from .furniture import box, joined, turned, turning


def block(noise: float = 0.0) -> Mesh:
    """A finely meshed block; each vertex is moved by so much [m]."""
    made = trimesh.creation.box((0.6, 0.5, 0.9))
    for _ in range(5):
        made = made.subdivide()
    return Mesh(
        made.vertices + np.random.default_rng(0).normal(scale=noise, size=made.vertices.shape), made.faces
    )


def round_thing() -> Mesh:
    made = trimesh.creation.cylinder(radius=0.3, height=0.9, sections=720)
    return Mesh(np.asarray(made.vertices), np.asarray(made.faces))


@pytest.mark.parametrize("degrees", [-40.0, -3.0, 0.0, 20.0, 44.0])
@pytest.mark.parametrize(("noise", "off"), [(0.0, 1e-6), (0.0005, 0.3), (0.001, 0.5)])
def test_a_block_is_turned_as_its_sides_are(degrees: float, noise: float, off: float) -> None:
    assert np.degrees(yaw(turned(block(noise), degrees))) == pytest.approx(degrees, abs=off)


def test_a_quarter_turn_is_none() -> None:
    """Which of its sides is the front is not asked; the two ends of the range are one direction."""
    assert np.degrees(yaw(turned(block(), 100.0))) == pytest.approx(10.0, abs=1e-6)
    assert abs(np.degrees(yaw(turned(block(0.0005), 45.0)))) == pytest.approx(45.0, abs=0.3)


@pytest.mark.parametrize("mesh", [round_thing(), turned(block(0.01), 20.0)], ids=["round", "too rough"])
def test_what_has_no_direction_is_not_turned(mesh: Mesh) -> None:
    assert yaw(mesh) == 0.0


def test_a_little_of_a_turn_is_none() -> None:
    assert yaw(turned(block(), 0.4)) == 0.0
    assert yaw(turned(block(0.0005), 0.8)) == 0.0


def test_what_stands_along_the_axes_and_is_ajar_is_not_turned() -> None:
    """More of the surface is that of the leaves; alone, these would tell a direction."""
    frame, leaf = box((0.0, 0.3), (0.0, 0.3), (0.0, 1.0)), box((0.3, 1.0), (0.0, 0.02), (0.0, 1.0))
    leaf_ajar = turned(boxes_mesh([leaf]), 20.0)
    assert np.degrees(yaw(leaf_ajar)) == pytest.approx(20.0, abs=1e-6)
    assert yaw(joined(boxes_mesh([frame]), leaf_ajar)) == 0.0


def leaning(mesh: Mesh, degrees: float) -> tuple[Mesh, FloatArray]:
    """A mesh turned about a level axis between x and y, and its turn."""
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(np.radians(degrees) * np.array([0.8, 0.6, 0.0]))
    return mesh.transformed(matrix), matrix[:3, :3]


def off(turn: FloatArray) -> float:
    """Angle of a rotation [degrees]."""
    return float(np.degrees(np.arccos(np.clip((np.trace(turn) - 1) / 2, -1.0, 1.0))))


@pytest.mark.parametrize("degrees", [1.2, 2.5, 4.5])
@pytest.mark.parametrize("about_vertical", [0.0, 30.0])
@pytest.mark.parametrize(("noise", "most"), [(0.0, 1e-4), (0.0005, 0.3)])
def test_a_slight_lean_is_told_with_the_turn(
    degrees: float, about_vertical: float, noise: float, most: float
) -> None:
    mesh, turn = leaning(turned(block(noise), about_vertical), degrees)
    assert off(straight_from_asset(mesh) @ turn @ turning(about_vertical)[:3, :3]) < most


@pytest.mark.parametrize("degrees", [0.1, 8.0])
def test_next_to_no_lean_and_much_of_it_are_how_it_is_made(degrees: float) -> None:
    assert off(straight_from_asset(leaning(block(), degrees)[0])) < 1e-6


def test_a_sloping_top_on_upright_sides_is_no_lean() -> None:
    """Whatever share of the surface it is: all of what is upright stands straight."""
    top, _ = leaning(boxes_mesh([box((-1.0, 1.0), (-1.0, 1.0), (0.5, 0.52))]), 3.0)
    post = boxes_mesh([box((-0.1, 0.1), (-0.1, 0.1), (0.0, 0.5))])
    assert off(straight_from_asset(joined(post, top))) < 1e-6


def test_a_tower_leans_and_a_ball_does_not() -> None:
    tower, turn = leaning(round_thing(), 3.0)
    assert off(straight_from_asset(tower) @ turn) < 0.01
    ball = trimesh.creation.icosphere(subdivisions=4)
    ball_turned, _ = leaning(Mesh(np.asarray(ball.vertices), np.asarray(ball.faces)), 3.0)
    assert off(straight_from_asset(ball_turned)) < 1e-6
