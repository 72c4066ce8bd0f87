"""How an object is turned about the vertical, by its faces."""

import numpy as np
import pytest
import trimesh

from simart_kit.alignment import yaw
from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh

from .furniture import box, joined, turned


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
