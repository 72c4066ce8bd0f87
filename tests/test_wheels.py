"""Wheels get the cylinder that they roll on; what only looks or turns like one does not."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.modifiers.collision import Collision

import simart_kit as sk
from simart_kit.arrays import FloatArray
from simart_kit.wheels import wheels

RADIUS, WIDTH, HEIGHT = 0.3, 0.05, 0.3
TURN_Z_TO_Y = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])


def rim(sections: int = 48, inner: float = 0.25) -> trimesh.Trimesh:
    return trimesh.creation.annulus(inner, RADIUS, WIDTH, sections=sections)


def cart(wheel: trimesh.Trimesh, height: float = HEIGHT, **joint: Any) -> sk.Asset:
    """A board on the ground with a wheel beside it, whose axle is along y at a height."""
    board = trimesh.creation.box((1.0, 0.2, 0.1))
    board.apply_translation((0, 0.5, 0.05))
    points = wheel.vertices @ TURN_Z_TO_Y.T + (0, 0, height)
    mesh = sk.Mesh(
        np.concatenate([board.vertices, points]),
        np.concatenate([board.faces, wheel.faces + len(board.vertices)]),
    )
    spin = sk.Joint("spin", "continuous", "board", "wheel", origin=(0, 0, height), axis=(0, 1, 0))
    labels = np.repeat([0, 1], [len(board.faces), len(wheel.faces)])
    return sk.Asset("cart", mesh, labels, (sk.Part("board"), sk.Part("wheel")), (replace(spin, **joint),))


def corners(part: sk.Part) -> FloatArray:
    return np.concatenate([shape.vertices for shape in part.collision])


def test_a_hollow_rim_rolls_on_one_cylinder_about_its_axle() -> None:
    found = wheels(cart(rim()))
    assert list(found) == ["wheel"]
    primitive = found["wheel"].primitive
    assert primitive is not None
    assert (primitive.kind, primitive.size) == ("cylinder", pytest.approx((0.6, 0.6, WIDTH), rel=0.01))
    np.testing.assert_allclose(primitive.asset_T_shape[:3, 3], [0, 0, HEIGHT], atol=1e-6)
    np.testing.assert_allclose(np.abs(primitive.asset_T_shape[:3, 2]), [0, 1, 0], atol=1e-9)


def test_a_hub_that_stands_out_makes_no_wheel_as_wide_as_that() -> None:
    hub = trimesh.creation.cylinder(0.05, 0.15)
    (shape,) = wheels(cart(trimesh.util.concatenate([rim(), hub]))).values()
    assert shape.primitive is not None
    assert shape.primitive.size[:2] == pytest.approx((0.6, 0.6), rel=0.01)
    assert WIDTH < shape.primitive.size[2] < 0.1


@pytest.mark.parametrize(
    "asset",
    [
        pytest.param(cart(rim(), height=0.5), id="off the ground"),
        pytest.param(cart(rim(), axis=(0, 0, 1)), id="turns about the vertical"),
        pytest.param(cart(rim(), kind="revolute", limits=sk.Limits(-1, 1)), id="turns between limits"),
        pytest.param(cart(rim(), origin=(0.1, 0, HEIGHT)), id="turns about a line beside its middle"),
        pytest.param(cart(rim(sections=6, inner=0.2)), id="has six sides"),
    ],
)
def test_what_does_not_roll_is_no_wheel(asset: sk.Asset) -> None:
    assert wheels(asset) == {}


@pytest.mark.parametrize(("mode", "kinds"), [("auto", ["cylinder"]), ("hull", [None])])
def test_the_modifier_gives_wheels_their_cylinder_where_shapes_are_found_by_it(
    mode: Any, kinds: list[str | None]
) -> None:
    asset = Collision(Collision.Options(mode=mode)).modify(cart(rim()))
    wheel = asset.part("wheel")
    assert [shape.primitive and shape.primitive.kind for shape in wheel.collision] == kinds
    assert np.ptp(corners(wheel), axis=0) == pytest.approx([0.6, WIDTH, 0.6], rel=0.02)
