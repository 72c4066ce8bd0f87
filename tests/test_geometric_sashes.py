"""`geometric` on windows and doors in their frames: both leaves, what slides, and what turns."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from simart_kit_plugins.geometric.predictor import GeometricJoints
from simart_kit_plugins.nano.pooling import pooled
from simart_kit_plugins.nano.proposals import of_geometry

from simart_kit import PartGuess, Segmentation
from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh

from .furniture import BOARD, Box, bar, box, carcass, joined, panel
from .test_geometric import assert_hinge, found

DEEP = (-0.05, 0.05)
FRAME = [
    box((-0.65, -0.6), DEEP, (0.0, 2.0)),
    box((0.6, 0.65), DEEP, (0.0, 2.0)),
    box((-0.6, 0.6), DEEP, (0.0, 0.05)),
    box((-0.6, 0.6), DEEP, (1.95, 2.0)),
]
HANDLE = box((-0.06, -0.03), (-0.08, -0.02), (0.95, 1.1))
HALF = [
    *carcass((-0.6, 0.6), (-0.2, 0.2), (0.0, 0.8)),
    box((-BOARD / 2, BOARD / 2), (-0.2, 0.2), (BOARD, 0.8 - BOARD)),
]


def leaf(x: tuple[float, float], y: tuple[float, float] = (-0.02, 0.02)) -> Box:
    return box(x, y, (0.055, 1.945))


def feet(x: float) -> list[Box]:
    """What holds a handle at a height of 1 m, before and behind a leaf."""
    return [box((x - 0.01, x + 0.01), y, (0.99, 1.01)) for y in ((-0.05, -0.02), (0.02, 0.05))]


def arms(x: tuple[float, float]) -> list[Box]:
    """Level bars that stand off a leaf on both sides, at a height of 1 m."""
    return [box(x, y, (0.99, 1.01)) for y in ((-0.065, -0.05), (0.05, 0.065))]


def rod(radius: float, height: float, along: str, center: tuple[float, float, float]) -> Mesh:
    turn = np.eye(4)
    if along == "y":
        turn = trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0])
    turn[:3, 3] = center
    solid = trimesh.creation.cylinder(radius, height, sections=24, transform=turn)
    return Mesh(np.asarray(solid.vertices), np.asarray(solid.faces, dtype=np.int32))


class TestTwins:
    def test_a_leaf_without_a_handle_opens_as_its_twin_does(self) -> None:
        result = found([*FRAME, leaf((-0.595, -0.002)), leaf((0.002, 0.595)), HANDLE])
        assert result.kinds == {"left_door": "revolute", "right_door": "revolute"}
        assert_hinge(result.joint("left_door"), (-0.595, -0.02, 0), "z")
        assert_hinge(result.joint("right_door"), (0.595, -0.02, 0), "z")

    def test_a_narrower_pane_beside_a_leaf_is_no_twin(self) -> None:
        frame = [*FRAME, box((0.2, 0.25), DEEP, (0.05, 1.95))]
        handle = box((0.13, 0.16), (-0.08, -0.02), (0.95, 1.1))
        assert found([*frame, leaf((-0.595, 0.195)), leaf((0.255, 0.595)), handle]).kinds == {
            "door": "revolute"
        }


class TestSliding:
    def test_leaves_that_overlap_in_two_tracks_slide_by_each_other(self) -> None:
        result = found([*FRAME, leaf((-0.595, 0.02), (-0.03, -0.005)), leaf((-0.02, 0.595), (0.005, 0.03))])
        assert set(result.kinds.values()) == {"prismatic"}
        for name, way in (("left_sliding_door", 1), ("right_sliding_door", -1)):
            np.testing.assert_allclose(result.joint(name).axis, [way, 0, 0], atol=1e-9)

    def test_no_hinge_overrules_a_leaf_that_has_room_to_slide_into(self) -> None:
        """However sure the network is of one."""
        leaves = [leaf((-0.595, 0.02), (-0.03, -0.005)), leaf((-0.02, 0.595), (0.005, 0.03))]
        mesh = boxes_mesh([*FRAME, *leaves])
        first = of_geometry(mesh, seed=0)
        hinges = [replace(p, joint=replace(p.joint, kind="revolute", confidence=0.999)) for p in first]
        assert {p.joint.kind for p in pooled(mesh, first, hinges)} == {"prismatic"}

    def test_doors_of_a_wardrobe_do_before_its_body_without_a_frame(self) -> None:
        body = carcass((-0.6, 0.6), (-0.3, 0.3), (0.0, 2.0))
        doors = [
            box((-0.598, 0.03), (-0.36, -0.34), (0.02, 1.98)),
            box((-0.03, 0.598), (-0.33, -0.31), (0.02, 1.98)),
        ]
        result = found([*body, *doors])
        assert result.kinds == {"left_sliding_door": "prismatic", "right_sliding_door": "prismatic"}
        for name, way in (("left_sliding_door", 1), ("right_sliding_door", -1)):
            np.testing.assert_allclose(result.joint(name).axis, [way, 0, 0], atol=1e-9)

    def test_of_two_above_each_other_the_lower_one_slides_up(self) -> None:
        lower = box((-0.595, 0.595), (-0.03, -0.005), (0.055, 1.02))
        upper = box((-0.595, 0.595), (0.005, 0.03), (0.98, 1.945))
        result = found([*FRAME, lower, upper])
        assert result.kinds == {"sliding_door": "prismatic"}
        np.testing.assert_allclose(result.joint("sliding_door").axis, [0, 0, 1], atol=1e-9)
        assert result.mesh.triangles[result.faces("sliding_door")][..., 2].max() < 1.03

    def test_a_panel_over_one_half_of_a_body_slides_over_the_other(self) -> None:
        front = panel((-0.59, 0.0), -0.225, (0.01, 0.79))
        joint = found([*HALF, front, bar(-0.55, 0.4, -0.225)]).joint("sliding_door")
        assert joint.kind == "prismatic"
        np.testing.assert_allclose(joint.axis, [1, 0, 0], atol=1e-9)

    def test_with_its_handle_on_the_side_of_the_room_it_is_hinged(self) -> None:
        front = panel((-0.59, 0.0), -0.225, (0.01, 0.79))
        assert found([*HALF, front, bar(-0.05, 0.4, -0.225)]).kinds == {"door": "revolute"}


class TestLines:
    def test_a_window_with_a_pin_on_either_side_turns_about_them(self) -> None:
        pins = [box((x, x + 0.01), (-0.01, 0.01), (1.0, 1.02)) for x in (-0.605, 0.595)]
        pane = leaf((-0.594, 0.594))
        result = found([*FRAME, *pins, pane, box((-0.1, 0.1), (-0.06, -0.02), (1.8, 1.83))])
        assert_hinge(result.joint("door"), (0, 0, 1.01), "x")

    def test_a_leaf_between_round_posts_hangs_on_one_and_its_lever_turns(self) -> None:
        posts = [rod(0.05, 2.0, "z", (x, 0, 1)) for x in (-0.56, 0.56)]
        spindle = rod(0.02, 0.2, "y", (-0.42, 0, 1))
        arms = boxes_mesh([box((-0.44, -0.3), (y, y + 0.02), (0.98, 1.02)) for y in (-0.1, 0.08)])
        result = found(joined(boxes_mesh([leaf((-0.5, 0.5))]), *posts, spindle, arms))
        assert_hinge(result.joint("door"), (0.56, 0, 1), "z")
        assert_hinge(result.joint("lever"), (-0.42, 0, 1), "y")
        assert result.joint("lever").parent == "door"

    def test_a_handle_on_one_side_is_part_of_its_door(self) -> None:
        posts = [rod(0.05, 2.0, "z", (x, 0, 1)) for x in (-0.56, 0.56)]
        knob = rod(0.02, 0.08, "y", (-0.42, -0.06, 1))
        assert found(joined(boxes_mesh([leaf((-0.5, 0.5))]), *posts, knob)).kinds == {"door": "revolute"}

    def test_levers_before_and_behind_a_leaf_turn_together(self) -> None:
        result = found([*FRAME, leaf((-0.595, 0.595)), *feet(-0.54), *arms((-0.55, -0.43))])
        assert result.kinds == {"door": "revolute", "lever": "revolute"}
        assert_hinge(result.joint("door"), (0.595, -0.02, 0), "z")
        assert_hinge(result.joint("lever"), (-0.54, 0, 1), "y")
        assert result.joint("lever").parent == "door"
        assert len(result.faces("lever")) == 4 * 12

    def test_a_lever_turns_where_it_is_held_though_hinges_stand_out_of_its_leaf(self) -> None:
        knuckles = [box((0.57, 0.595), (-0.06, -0.02), (z, z + 0.1)) for z in (0.3, 1.6)]
        boxes = [*FRAME, leaf((-0.595, 0.595)), *knuckles, *feet(-0.54), *arms((-0.55, -0.43))]
        labels = np.repeat([0] * 4 + [1] * 3 + [2] * 4, 12).astype(np.int32)
        parts = (PartGuess("body"), PartGuess("door"), PartGuess("lever"))
        segmentation = Segmentation(labels, parts)
        joints = {joint.child: joint for joint in GeometricJoints().predict(boxes_mesh(boxes), segmentation)}
        assert joints["lever"].parent == "door"
        assert_hinge(joints["lever"], (-0.54, 0, 1), "y")

    @pytest.mark.parametrize("side", [-1, 1])
    def test_the_far_end_of_a_lever_goes_down(self, side: int) -> None:
        across = sorted((side * 0.55, side * 0.43))
        levers = [*feet(side * 0.54), *arms((across[0], across[1]))]
        lever = found([*FRAME, leaf((-0.595, 0.595)), *levers]).joint("lever")
        assert np.cross(lever.axis, [-side, 0, 0])[2] < -0.9

    def test_handles_that_are_held_at_both_ends_stay_with_their_leaf(self) -> None:
        handles = [*feet(-0.54), *feet(-0.44), *arms((-0.55, -0.43))]
        assert found([*FRAME, leaf((-0.595, 0.595)), *handles]).kinds == {"door": "revolute"}

    def test_a_lever_on_one_side_stays_with_its_leaf(self) -> None:
        handle = [one for one in (*feet(-0.54), *arms((-0.55, -0.43))) if one[1][1] < 0]
        assert found([*FRAME, leaf((-0.595, 0.595)), *handle]).kinds == {"door": "revolute"}
