"""Rays of `geometric` that pass through pieces."""

import numpy as np
import pytest
from simart_kit_plugins.geometric.casting import first_met
from simart_kit_plugins.geometric.scene import make_scene

from simart_kit.testing.meshes import boxes_mesh

# A slab, a panel that lies on it face on face, and a wall behind them.
MESH = boxes_mesh([((0, 0, 0), (1, 0.1, 1)), ((0.2, -0.1, 0.2), (0.8, 0, 0.8)), ((0, 0.5, 0), (1, 0.6, 1))])
SLAB, PANEL, WALL = range(3)
SCENE = make_scene(MESH, np.repeat(np.arange(3), 12))


def met(start, way, passing):
    """The piece that a ray from a depth [m] through the middle of all three meets, and at which depth [m]."""
    low = SCENE.boxes[PANEL].lower[1]
    origin = (SCENE.boxes[PANEL].lower + SCENE.boxes[PANEL].upper) / 2
    origin[1] = low + (start + 0.1) / SCENE.size
    (piece,), (far,) = first_met(SCENE, origin[None], np.array([0.0, way, 0.0]), passing)
    return piece, start + way * far * SCENE.size


@pytest.mark.parametrize(
    ("start", "passing", "piece", "depth"),
    [
        (-0.5, (), PANEL, -0.1),
        (-0.5, (PANEL,), SLAB, 0.0),
        (-0.5, (PANEL, WALL), SLAB, 0.0),
        (-0.5, (PANEL, SLAB), WALL, 0.5),
        (0.9, (WALL,), SLAB, 0.1),
        (0.9, (WALL, SLAB), PANEL, 0.0),
    ],
)
def test_a_ray_does_not_pass_through_what_lies_on_what_it_passes(start, passing, piece, depth):
    found, there = met(start, 1.0 if start < 0 else -1.0, passing)
    assert found == piece
    assert there == pytest.approx(depth, abs=1e-3)


def test_nothing_is_met_behind_all_that_is_passed():
    assert met(-0.5, 1.0, (PANEL, SLAB, WALL)) == (-1, np.inf)
