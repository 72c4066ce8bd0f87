"""Shapes that give way at their own hinge to what is beside it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import simart_kit as sk
from simart_kit import Subject
from simart_kit.fitting import aligned_box
from simart_kit.hinge_relief import relieved
from simart_kit.separation import overlaps
from simart_kit.testing.meshes import boxes_mesh

from .checks_cases import judged

GAP, THICK, WIDE = 0.004, 0.03, 0.5
BACK = ((-1.0, 0.05, 0.0), (1.0, 0.1, 1.0))
LEFT = ((-WIDE, -THICK, 0.0), (-GAP / 2, 0.0, 1.0))
RIGHT = ((GAP / 2, -THICK, 0.0), (WIDE, 0.0, 1.0))


def leaves(y: float = 0.0, neighbour: tuple[float, ...] | None = None) -> sk.Asset:
    """Two leaves side by side; the right one turns about its back edge, or y [m] off; the left one slides."""
    boxes = [BACK, LEFT, RIGHT]
    if neighbour is not None:
        boxes[1] = (neighbour[:3], neighbour[3:])  # type: ignore[assignment]
    shapes = [(aligned_box(*np.array(box)),) for box in boxes]
    parts = [sk.Part(n, collision=s) for n, s in zip(("body", "left", "right"), shapes, strict=True)]
    origin, limits = (GAP / 2, y, 0.5), sk.Limits(0.0, np.radians(90))
    hinge = sk.Joint(
        "hinge", "revolute", "body", "right", origin=origin, axis=(0.0, 0.0, -1.0), limits=limits
    )
    slide = sk.Joint("slide", "prismatic", "body", "left", axis=(0.0, -1.0, 0.0), limits=sk.Limits(0.0, 0.2))
    return sk.Asset("leaves", boxes_mesh(boxes), np.repeat([0, 1, 2], 12), tuple(parts), (hinge, slide))


def begins(asset: sk.Asset) -> float:
    """How far from its hinge the right leaf's shape begins [m]."""
    (shape,) = asset.part("right").collision
    return float(shape.vertices[:, 0].min()) - GAP / 2


def deepest(asset: sk.Asset) -> float:
    """Of the leaves' overlap on the hinge's way [m]."""
    stops = np.linspace(0, np.radians(90), 91)
    return max((o.depth for s in stops for o in overlaps(asset, {"hinge": float(s)})), default=0.0)


def test_a_leaf_hung_at_its_back_edge_would_turn_into_its_neighbour_and_does_not() -> None:
    """Its front edge goes round at THICK from the axis, GAP from the neighbour."""
    asset = leaves()
    assert deepest(asset) > 0.015
    result, names = relieved(asset)
    assert names == ("right",)
    assert deepest(result) < 1e-3
    # What is nearer to the axis than the gap never touches; nothing that is farther than the corner does.
    assert GAP < begins(result) <= np.hypot(THICK, THICK)
    assert begins(result) <= 0.1 * np.hypot(WIDE, THICK)
    assert result.part("left") is asset.part("left")
    assert result.part("right").collision[0].primitive is not None  # still a box


def test_driven_in_simulation_it_gets_there() -> None:
    assert not judged("travel", Subject({}, weighed(leaves()))).passed
    assert judged("travel", Subject({}, weighed(relieved(leaves())[0]))).passed


def test_a_leaf_hung_at_its_front_edge_is_left_alone() -> None:
    asset = leaves(-THICK)
    result, names = relieved(asset)
    assert result is asset
    assert names == ()


@pytest.mark.parametrize("x", [-0.02, 0.1])
def test_what_is_in_the_way_farther_off_stays_so(x: float) -> None:
    """A block before the neighbour, that no tenth of the leaf would free."""
    asset = leaves(neighbour=(x - 0.1, -0.5, 0.0, x + 0.1, -0.2, 1.0))
    assert deepest(asset) > 0.01
    result, names = relieved(asset)
    assert result is asset
    assert names == ()


def test_twice_changes_nothing_more() -> None:
    once, _ = relieved(leaves())
    assert relieved(once)[0] is once


def weighed(asset: sk.Asset) -> sk.Asset:
    """With a mass and inertia that the check can move."""
    mass = sk.MassProperties(5.0, (0.2, 0.0, 0.5), ((0.5, 0, 0), (0, 0.5, 0), (0, 0, 0.5)))
    return asset.with_parts({part.name: replace(part, mass=mass) for part in asset.parts})
