"""Hulls of points that are flat, or nearly so, as simulators take them."""

import mujoco
import numpy as np
import pytest

from simart_kit.arrays import FloatArray
from simart_kit.hulls import convex_hull, hull_of, volume

AWAY = np.array([0.1, -0.2, 0.1])


def slab(thickness: float, size: float = 0.04) -> FloatArray:
    """(8, 3) corners of a slanted slab, away from the origin."""
    corners = np.array([(x, y, z) for x in (0, size) for y in (0, size) for z in (0, thickness)])
    slanted, _ = np.linalg.qr(np.array([[1.0, 2.0, 0.5], [0.3, 1.0, 2.0], [2.0, 0.1, 1.0]]))
    return np.asarray(corners @ slanted.T + AWAY)


def mujoco_takes(points: FloatArray) -> bool:
    spec = mujoco.MjSpec()
    spec.add_mesh(name="hull", uservert=points.ravel())
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="hull")
    try:
        spec.compile()
    except ValueError:
        return False
    return True


@pytest.mark.parametrize("thickness", [0.0, 1e-12, 3e-9, 2e-8, 1e-6, 1e-4])
def test_what_has_a_hull_is_thick_enough_for_a_simulator(thickness: float) -> None:
    hull = hull_of(slab(thickness))
    assert (hull is not None) == (thickness >= 1e-6)
    assert hull is None or mujoco_takes(hull.vertices)


@pytest.mark.parametrize("size", [0.04, 40.0, 40_000.0])
def test_a_shape_around_flat_points_has_volume_whatever_their_size(size: float) -> None:
    hull = convex_hull(slab(0.0, size))
    assert volume(hull) > 0
    assert mujoco_takes(hull.vertices)
