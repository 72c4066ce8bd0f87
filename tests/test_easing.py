"""Parts whose shapes interlock begin to move: what gives way, how much, and what stays."""

import numpy as np
import pytest

from simart_kit.arrays import Vec3
from simart_kit.asset import Asset, ConvexMesh, Joint, Limits, Part
from simart_kit.easing import eased
from simart_kit.hulls import convex_hull
from simart_kit.mesh import Mesh
from simart_kit.separation import overlaps

BODY = (-0.2, 0.5, 0.0), (1.2, 0.6, 2.0)


def box(lower: Vec3, upper: Vec3) -> ConvexMesh:
    ends = np.array([lower, upper])
    return convex_hull(np.array([[ends[i, 0], ends[j, 1], ends[k, 2]] for i, j, k in np.ndindex(2, 2, 2)]))


def front(lower: float, upper: float, lean: float) -> ConvexMesh:
    """A panel whose upper and lower sides lean: further back they are higher by `lean` [m]."""
    shape = box((0.0, 0.0, lower), (1.0, 0.1, upper))
    return convex_hull(shape.vertices + [[0, 0, lean * (y > 0.05)] for y in shape.vertices[:, 1]])


def fronts(lean: float, gap: float = 0.001) -> Asset:
    """Two drawers' fronts, one above the other, that slide towards -y out of a body behind them."""
    shapes = {
        "body": box(*BODY),
        "low": front(0.0, 1.0, lean),
        "high": front(1.0 + gap, 2.0, lean),
    }
    mesh = Mesh(
        np.concatenate([shape.vertices for shape in shapes.values()]),
        np.concatenate([shape.faces + 8 * i for i, shape in enumerate(shapes.values())]),
    )
    count = [len(shape.faces) for shape in shapes.values()]
    joints = tuple(
        Joint(f"{name}_slide", "prismatic", "body", name, axis=(0.0, -1.0, 0.0), limits=Limits(0.0, 0.5))
        for name in ("low", "high")
    )
    parts = tuple(Part(name, collision=(shape,)) for name, shape in shapes.items())
    return Asset("chest", mesh, np.repeat(np.arange(3), count), parts, joints)


@pytest.mark.parametrize("lean", [0.006, -0.006, 0.03, -0.03])
def test_leaning_fronts_pass_each_other_and_lose_no_more_than_they_lean(lean: float) -> None:
    asset = fronts(lean)
    done = eased(asset)
    name = "low" if lean > 0 else "high"  # the one whose way the other is in
    assert overlaps(asset, {f"{name}_slide": 0.05})
    for step in (0.001, 0.02, 0.05, 0.3):
        assert not overlaps(done, {f"{name}_slide": step})
    for part in done.parts:
        ends, was = (np.ptp(a.part(part.name).collision[0].vertices, axis=0) for a in (done, asset))
        assert (was - ends <= abs(lean) + 1e-9).all()


def test_what_is_not_in_the_way_is_the_same_object() -> None:
    asset = fronts(0.0)
    assert eased(asset) is asset


def test_what_would_lose_much_is_really_in_the_way_and_stays() -> None:
    asset = fronts(0.08)
    done = eased(asset)
    assert done.part("low").collision == asset.part("low").collision


def test_joints_stay_as_they_are_once_the_work_is_done() -> None:
    asset = fronts(0.006)
    assert eased(asset, work=0) is asset


def test_what_overlaps_at_rest_already_stays_as_it_is() -> None:
    """Simulators exclude the pair: parted at its borders alone, it would stop a little later."""
    asset = fronts(0.006, gap=-0.004)
    assert overlaps(asset)
    assert eased(asset) is asset
