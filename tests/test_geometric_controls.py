"""`geometric` on small controls: what fingers press, tilt, pull and turn, and what only looks like it."""

import numpy as np
import pytest
import trimesh

from simart_kit.arrays import FloatArray
from simart_kit.kinematics import rotation
from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh

from .furniture import box, joined, with_discs
from .test_geometric import found

BODY = [box((-0.025, 0.025), (-0.08, 0.08), (0.0, 0.04))]
BLOCK = [box((-0.3, 0.3), (-0.3, 0.3), (0.0, 0.85))]
TRIGGER = box((-0.01, 0.01), (0.04, 0.065), (-0.018, 0.01))
GRIP = box((0.02, 0.029), (-0.01, 0.012), (0.012, 0.03))


def stick(x: float, y: float) -> Mesh:
    """A cap of 16 mm on a thin stem, as one surface of revolution, in the top of the body."""
    profile = [(0.0, 0.035), (0.004, 0.035), (0.004, 0.046), (0.008, 0.046), (0.008, 0.049), (0.0, 0.049)]
    made = trimesh.creation.revolve(profile, sections=24)
    return Mesh(np.asarray(made.vertices) + [x, y, 0.0], np.asarray(made.faces))


def controller() -> Mesh:
    """A stick, two buttons, a trigger in front below and a grip at the side, on a block 16 cm long."""
    buttons = with_discs([*BODY, TRIGGER, GRIP], [(0.014, y, 0.04) for y in (0.02, 0.036)], 0.005, 0.005, 2)
    return joined(buttons, stick(-0.01, 0.05))


def pitched(mesh: Mesh, degrees: float) -> tuple[Mesh, FloatArray]:
    """A mesh turned about x, and its turn."""
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(np.array([np.deg2rad(degrees), 0.0, 0.0]))
    return mesh.transformed(matrix), matrix[:3, :3]


class TestHandHeld:
    def test_a_controller_has_what_fingers_reach(self) -> None:
        result = found(controller())
        assert {p.label for p in result.segmentation.parts} == {
            "body", "button", "thumbstick", "trigger", "squeeze",
        }  # fmt: skip
        kinds = {p.name: p.label for p in result.segmentation.parts}
        for joint in result.joints:
            turns = kinds[joint.child] in ("thumbstick", "trigger")
            assert joint.kind == ("revolute" if turns else "prismatic")
        np.testing.assert_allclose(result.joint("squeeze").axis, (-1, 0, 0), atol=0.02)
        np.testing.assert_allclose(result.joint("thumbstick").axis, (0, 1, 0), atol=0.02)

    def test_a_trigger_tells_by_itself_that_a_thing_is_held_and_a_grip_at_its_side_does_not(self) -> None:
        long = box((-0.01, 0.01), (0.035, 0.065), (-0.018, 0.01))
        assert found(boxes_mesh([*BODY, long])).kinds == {"trigger": "revolute"}
        other = box((-0.01, 0.01), (-0.065, -0.035), (-0.018, 0.01))
        assert not found(boxes_mesh([*BODY, long, other])).joints  # feet
        assert not found(boxes_mesh([*BODY, GRIP])).joints

    def test_a_trigger_hangs_at_its_front_and_is_pulled_back(self) -> None:
        result = found(controller())
        joint = result.joint("trigger")
        np.testing.assert_allclose(np.abs(joint.axis), (1, 0, 0), atol=1e-9)
        assert joint.origin[1] > 0.05
        assert joint.origin[2] > -0.01
        points = result.mesh.triangles[result.faces("trigger")].reshape(-1, 3)
        lowest = points[:, 2] < -0.017
        assert (result.travel("trigger")[lowest, 1] < 0).all()

    @pytest.mark.parametrize("degrees", [20.0, 50.0])
    def test_buttons_go_in_along_where_they_face(self, degrees: float) -> None:
        mesh, turn = pitched(
            with_discs(BODY, [(0.0, y, 0.04) for y in (0.0, 0.03)], 0.005, 0.005, 2), degrees
        )
        result = found(mesh)
        assert list(result.kinds.values()) == ["prismatic", "prismatic"]
        for joint in result.joints:
            assert np.array(joint.axis) @ turn @ [0, 0, -1] > np.cos(np.deg2rad(3.0))
            assert joint.limits is not None
            assert joint.limits.upper < 0.004

    def test_what_is_larger_than_a_hand_has_none(self) -> None:
        big = np.diag([4.0, 4.0, 4.0, 1.0])
        assert not found(controller().transformed(big)).joints

    def test_screws_in_corners_are_no_sticks(self) -> None:
        corners = [(x, y, 0.045) for x in (-0.017, 0.017) for y in (-0.07, 0.07)]
        assert not found(with_discs(BODY, corners, 0.0065, 0.02, 2)).joints

    def test_a_knob_on_a_box_is_no_stick(self) -> None:
        assert "thumbstick" not in found(joined(boxes_mesh(BODY), stick(0.0, 0.0))).kinds

    def test_keys_of_many_widths_in_rows_are_a_keyboards(self) -> None:
        keys = [
            box((x, x + 0.005), (y, y + wide), (0.039, 0.042))
            for x in (-0.024, -0.011, 0.002, 0.015)
            for y, wide in zip(np.arange(11) * 0.0145 - 0.078, np.linspace(0.006, 0.008, 11), strict=True)
        ]
        assert set(found([*BODY, *keys[:26:6]]).kinds.values()) == {"prismatic"}
        assert not found([*BODY, *keys]).joints

    def test_flush_discs_are_no_buttons(self) -> None:
        flush = with_discs(BODY, [(0.0, y, 0.0379) for y in (0.0, 0.03)], 0.005, 0.005, 2)
        assert not found(flush).joints


class TestFronts:
    def test_knobs_two_by_two_turn(self) -> None:
        places = [(x, -0.31, z) for x in (-0.05, 0.05) for z in (0.6, 0.7)]
        result = found(with_discs(BLOCK, places, 0.02, 0.02, 1))
        assert result.kinds == {f"knob_{n}": "revolute" for n in (1, 2, 3, 4)}

    def test_knobs_far_apart_are_not_of_one_panel(self) -> None:
        places = [(x, -0.31, z) for x in (-0.2, 0.2) for z in (0.2, 0.7)]
        assert not found(with_discs(BLOCK, places, 0.02, 0.02, 1)).joints

    def test_a_cap_in_a_collar_is_pressed(self) -> None:
        collar = with_discs(BLOCK, [(0.0, -0.3, 0.6)], 0.03, 0.02, 1)
        cap = with_discs([box((0.1, 0.2), (-0.3, -0.29), (0.1, 0.2))], [(0.0, -0.31, 0.6)], 0.025, 0.05, 1)
        result = found(joined(collar, cap))
        assert result.kinds == {"button": "prismatic"}
        np.testing.assert_allclose(result.joint("button").axis, (0, 1, 0), atol=1e-6)

    def test_a_disc_without_a_collar_stays(self) -> None:
        assert not found(with_discs(BLOCK, [(0.0, -0.31, 0.6)], 0.025, 0.05, 1)).joints


def over_ring(cap: float, hole: float, deep: float) -> Mesh:
    """A round table, a metre wide, with a raised ring around a hole, and a disc of a radius on the ring."""
    top = 0.4 + 0.025
    wall = max(hole, cap) + 0.01
    outside = [(0, 0), (0.5, 0), (0.5, 0.4), (wall, 0.4), (wall, top)]
    profile = [*outside, (hole, top), (hole, top - deep), (0, top - deep)]
    table = trimesh.creation.revolve(profile, sections=32)
    disc = trimesh.creation.cylinder(cap, 0.03, sections=32)
    disc.apply_translation((0.0, 0.0, top + 0.015))
    return joined(*(Mesh(np.asarray(one.vertices), np.asarray(one.faces)) for one in (table, disc)))


class TestOverHoles:
    @pytest.mark.parametrize("hole", [0.037, 0.043])
    def test_a_small_cap_over_a_hole_in_the_body_is_pressed(self, hole: float) -> None:
        result = found(over_ring(0.04, hole, 0.025))
        assert result.kinds == {"button": "prismatic"}
        np.testing.assert_allclose(result.joint("button").axis, (0, 0, -1), atol=1e-6)

    @pytest.mark.parametrize(
        ("cap", "hole", "deep"),
        [
            (0.04, 0.037, 0.2),  # the stopper of a vessel
            (0.09, 0.085, 0.05),  # too wide for a hand
            (0.04, 0.02, 0.025),  # a disc on a ring
        ],
    )
    def test_other_discs_over_holes_stay(self, cap: float, hole: float, deep: float) -> None:
        assert not found(over_ring(cap, hole, deep)).joints
