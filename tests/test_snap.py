"""Modifier `snap`: axes near a main direction of the surface take it; others stay."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from simart_kit_plugins.modifiers.snap import Snap, main_directions

import simart_kit as sk
from simart_kit.arrays import FloatArray, vec3
from simart_kit.kinematics import rotation
from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset

from .furniture import joined


def tilted(axis: tuple[float, float, float], degrees: float, about: str = "x") -> tuple[float, float, float]:
    return vec3(rotation(np.eye(3)["xyz".index(about)] * np.radians(degrees)) @ axis)


def cabinet(door_axis: tuple[float, float, float], turn: float = 0.0) -> sk.Asset:
    """The cabinet, turned about the vertical [degrees], its door with this axis."""
    asset = cabinet_asset(physics=False)
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(np.array([0, 0, np.radians(turn)]))
    door = replace(asset.joint("door_hinge"), axis=door_axis)
    return replace(asset.with_joints({"door_hinge": door}), mesh=asset.mesh.transformed(matrix))


def snapped(asset: sk.Asset, **options: Any) -> tuple[float, float, float]:
    return Snap(Snap.Options(**options)).modify(asset).joint("door_hinge").axis


@pytest.mark.parametrize("about", ["x", "y"])
@pytest.mark.parametrize("degrees", [0.5, 3.0, -3.0, 7.9])
def test_a_few_degrees_are_turned_away(degrees: float, about: str) -> None:
    assert snapped(cabinet(tilted((0, 0, 1), degrees, about))) == (0.0, 0.0, 1.0)


@pytest.mark.parametrize("degrees", [8.1, 20.0, 45.0])
def test_more_is_taken_for_meant(degrees: float) -> None:
    axis = tilted((0, 0, 1), degrees)
    assert snapped(cabinet(axis)) == axis


def test_the_largest_turn_can_be_set() -> None:
    axis = tilted((0, 0, 1), 20.0)
    assert snapped(cabinet(axis), angle=21.0) == (0.0, 0.0, 1.0)
    assert snapped(cabinet(tilted((0, 0, 1), 3.0)), angle=2.0) == tilted((0, 0, 1), 3.0)


def test_the_sense_of_turning_stays() -> None:
    assert snapped(cabinet(tilted((0, 0, -1), 3.0))) == (0.0, 0.0, -1.0)
    assert snapped(cabinet(tilted((0, 1, 0), 3.0))) == (0.0, 1.0, 0.0)
    assert snapped(cabinet(tilted((-1, 0, 0), 3.0, "z"))) == (-1.0, 0.0, 0.0)


@pytest.mark.parametrize("axis", [(0.0, 0.0, -1.0), (0.0, -1.0, 0.0), tilted((-1, 0, 0), 20.0, "z")])
def test_what_turns_without_end_turns_about_the_positive_axis(axis: tuple[float, float, float]) -> None:
    asset = cabinet(axis)
    spin = replace(asset.joint("door_hinge"), kind="continuous", limits=None)
    after = Snap().modify(asset.with_joints({"door_hinge": spin})).joint("door_hinge")
    assert after == replace(spin, axis=vec3(-np.array(axis)))


def test_directions_are_those_of_the_object_not_of_the_axes() -> None:
    """The cabinet stands turned by 30 degrees: what is 3 degrees off its own front takes that direction."""
    front = (np.sin(np.pi / 6), -np.cos(np.pi / 6), 0.0)
    np.testing.assert_allclose(snapped(cabinet(tilted(front, 3.0, "z"), turn=30.0)), front, atol=1e-9)
    along_y = (0.0, -1.0, 0.0)
    assert snapped(cabinet(along_y, turn=30.0)) == along_y


def test_each_change_is_told() -> None:
    result = Snap().modify(cabinet(tilted((0, 0, 1), 3.0)))
    assert [(n.stage, n.level, n.text) for n in result.notes] == [
        ("snap", "info", "door_hinge: axis turned by 3.00 degrees onto the geometry")
    ]


def test_what_is_right_stays_without_a_word() -> None:
    asset = cabinet_asset()
    result = Snap().modify(asset)
    assert result.joints == asset.joints
    assert result.notes == ()


def test_nothing_but_the_axis_changes() -> None:
    asset = cabinet(tilted((0, 0, 1), 3.0))
    result = Snap().modify(asset)
    assert replace(result.joint("door_hinge"), axis=asset.joint("door_hinge").axis) == asset.joint(
        "door_hinge"
    )
    assert result.joint("drawer_slide") == asset.joint("drawer_slide")
    assert result.mesh is asset.mesh


@pytest.mark.parametrize("kind", ["fixed", "ball", "free"])
def test_joints_without_one_axis_are_left_alone(kind: Any) -> None:
    joint = sk.Joint("door_hinge", kind, "body", "door", axis=tilted((0, 0, 1), 3.0))
    asset = cabinet_asset().with_joints({"door_hinge": joint})
    assert Snap().modify(asset).joint("door_hinge") == joint


def test_a_door_that_stands_ajar_does_not_pull() -> None:
    """It is turned by 5 degrees, and so are a fifth of the faces: the case's own direction still counts."""
    case, door = boxes_mesh([((0, 0, 0), (1, 1, 1))]), boxes_mesh([((0, 0, 0), (0.8, 0.02, 0.8))])
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(np.array([0, 0, np.radians(-5)]))
    mesh = joined(case, door.transformed(matrix))
    slide = sk.Joint(
        "slide", "prismatic", "case", "door", axis=tilted((0, -1, 0), -1.0, "z"), limits=sk.Limits(0, 1)
    )
    asset = sk.Asset("box", mesh, np.repeat([0, 1], 12), (sk.Part("case"), sk.Part("door")), (slide,))
    assert Snap().modify(asset).joint("slide").axis == (0.0, -1.0, 0.0)


class TestMainDirections:
    def found(self, mesh: Mesh, share: float = 0.05) -> FloatArray:
        return main_directions(mesh.face_normals, mesh.face_areas, share)

    def test_a_box_has_three(self) -> None:
        found = self.found(boxes_mesh([((0, 0, 0), (1, 2, 3))]))
        assert set(map(tuple, found.tolist())) == {(0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)}

    def test_each_needs_its_share(self) -> None:
        """A plate of 2 x 2 x 0.1: each pair of edges has 0.2 of its 8.8, the two sides have 8."""
        plate = boxes_mesh([((0, 0, 0), (2, 0.1, 2))])
        assert {tuple(d) for d in self.found(plate).tolist()} == {(0.0, 0.0, 1.0), (0.0, 1.0, 0.0)}
        assert len({tuple(d) for d in self.found(plate, share=0.04).tolist()}) == 3

    def test_up_is_always_one(self) -> None:
        matrix = np.eye(4)
        matrix[:3, :3] = rotation(np.array([0.4, 0.5, 0.6]))
        found = self.found(boxes_mesh([((0, 0, 0), (1, 1, 1))]).transformed(matrix))
        assert found[0].tolist() == [0.0, 0.0, 1.0]
        assert len(found) == 4
        np.testing.assert_allclose(np.abs(found[1:] @ matrix[:3, :3]).max(axis=1), 1.0)

    def test_a_hair_off_an_axis_is_the_axis(self) -> None:
        matrix = np.eye(4)
        matrix[:3, :3] = rotation(np.array([0, 0, np.radians(0.2)]))
        found = self.found(boxes_mesh([((0, 0, 0), (1, 1, 1))]).transformed(matrix))
        assert {tuple(d) for d in found.tolist()} == {(0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)}
