"""`geometric` on things that face another way than most files have them: the same parts, turned with them."""

import numpy as np
import pytest
from simart_kit_plugins.geometric.segmenter import Geometric

from simart_kit.loading import read_source
from simart_kit.plugins import Plugins

from .furniture import box, cabinet_with_door, joined, turned, turning, with_discs
from .real_objects import DATA, needs_data
from .test_geometric import found
from .test_geometric_controls import BLOCK, controller, over_ring, pitched

QUARTERS = (90.0, 180.0, 270.0)
ROW = [(x, -0.31, 0.7) for x in (-0.12, -0.04, 0.04, 0.12)]


@pytest.mark.parametrize("degrees", QUARTERS)
class TestAnySide:
    def test_a_controller_has_the_same_controls(self, degrees: float) -> None:
        straight, across = found(controller()), found(turned(controller(), degrees))
        assert sorted(across.kinds.values()) == sorted(straight.kinds.values())
        turn = turning(degrees)[:3, :3]
        for name in ("squeeze", "trigger"):
            np.testing.assert_allclose(across.joint(name).axis, turn @ straight.joint(name).axis, atol=1e-6)

    def test_knobs_in_a_row_turn(self, degrees: float) -> None:
        result = found(turned(with_discs(BLOCK, ROW, 0.02, 0.02, 1), degrees))
        assert result.kinds == {f"knob_{n}": "revolute" for n in (1, 2, 3, 4)}
        along = turning(degrees)[:3, 1]
        assert all(abs(np.dot(joint.axis, along)) > 0.999 for joint in result.joints)

    def test_a_cap_in_a_collar_is_pressed(self, degrees: float) -> None:
        collar = with_discs(BLOCK, [(0.0, -0.3, 0.6)], 0.03, 0.02, 1)
        cap = with_discs([box((0.1, 0.2), (-0.3, -0.29), (0.1, 0.2))], [(0.0, -0.31, 0.6)], 0.025, 0.05, 1)
        result = found(turned(joined(collar, cap), degrees))
        assert result.kinds == {"button": "prismatic"}
        np.testing.assert_allclose(result.joint("button").axis, turning(degrees)[:3, 1], atol=1e-6)

    def test_a_cap_over_a_hole_is_pressed(self, degrees: float) -> None:
        before, _ = pitched(over_ring(0.04, 0.037, 0.025), 90.0)
        result = found(turned(before, degrees))
        assert result.kinds == {"button": "prismatic"}
        np.testing.assert_allclose(result.joint("button").axis, turning(degrees)[:3, 1], atol=1e-6)

    def test_discs_beside_a_door_are_no_knobs(self, degrees: float) -> None:
        """Such as the wheels of racks: what is turned is on the side that opens."""
        beside = [(-0.26, y, 0.35) for y in (-0.12, -0.04, 0.04, 0.12)]
        cabinet = with_discs(cabinet_with_door("left"), beside, 0.02, 0.02, 0)
        assert found(turned(cabinet, degrees)).kinds == {"door": "revolute"}


def test_discs_on_two_opposite_sides_are_no_knobs() -> None:
    """Such as the buttons of sleeves."""
    both = [(x, y, z) for x, y, z in [*ROW, *((x, -y, z) for x, y, z in ROW)]]
    assert not found(with_discs(BLOCK, both, 0.02, 0.02, 1)).joints


@needs_data
@pytest.mark.parametrize("degrees", [10.0, 45.0])
def test_a_real_skin_turned_by_any_angle_has_the_same_doors(degrees: float) -> None:
    mesh = read_source(DATA / "bigym_wall_cabinet" / "fused.glb", Plugins()).mesh
    across = Geometric().segment(turned(mesh, degrees))
    assert [guess.label for guess in across.parts] == ["body", "door", "door"]
    same = across.face_part == Geometric().segment(mesh).face_part
    assert mesh.face_areas[same].sum() > 0.95 * mesh.face_areas.sum()
