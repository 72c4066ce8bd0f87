"""Leaves that lean and slide: found by the room beside them, and by how they are held."""

import numpy as np
import pytest
from simart_kit_plugins.geometric.leaning import sliding_across

from simart_kit import Joint
from simart_kit.kinematics import rotation
from simart_kit.testing.meshes import boxes_mesh

from .furniture import Box, bar, box, joined

BASE = [box((-0.6, 0.6), (-0.3, 0.3), (0.0, 0.4))]
# Upright, and turned back about the x axis: a face 1.2 m wide, and on one half of it a leaf.
FACE = box((-0.6, 0.6), (0.0, 0.02), (0.0, 0.5))
LEFT, RIGHT = (-0.58, -0.02), (0.02, 0.58)
MIDDLE = {LEFT: -0.3, RIGHT: 0.3}
LEAN = -30.0


def leaf(across: tuple[float, float]) -> Box:
    return box(across, (-0.025, -0.002), (0.02, 0.48))


def slide(
    leaf: Box, handle: Box | None, face: Box = FACE, lean: float = LEAN, turned: float = 0.0
) -> Joint | None:
    """What is said of a leaf, with its handle, that leans with the face behind it, and may stand ajar."""
    back, swing = np.eye(4), np.eye(4)
    back[:3, :3] = rotation(np.radians([lean, 0.0, 0.0]))
    back[:3, 3] = (0.0, -0.2, 0.4)
    swing[:3, :3] = rotation(np.radians([0.0, 0.0, turned]))
    part = boxes_mesh([leaf] if handle is None else [leaf, handle]).transformed(back @ swing)
    mesh = joined(boxes_mesh(BASE), boxes_mesh([face]).transformed(back), part)
    return sliding_across(mesh, np.arange(len(mesh.faces)) >= len(mesh.faces) - len(part.faces))


@pytest.mark.parametrize("lean", [0.0, -17.0, LEAN, -60.0])
@pytest.mark.parametrize(("across", "way"), [(LEFT, 1.0), (RIGHT, -1.0)])
def test_over_one_half_of_a_face_it_slides_over_the_other_by_its_width(across, way, lean):
    joint = slide(leaf(across), bar(MIDDLE[across], 0.25, -0.025), lean=lean)
    assert joint is not None
    assert joint.kind == "prismatic"
    np.testing.assert_allclose(joint.axis, (way, 0.0, 0.0), atol=1e-9)
    assert joint.limits is not None
    assert joint.limits.lower == 0
    assert joint.limits.upper == pytest.approx(0.56, abs=0.03)


@pytest.mark.parametrize(
    ("across", "handle"),
    [
        (LEFT, None),
        (LEFT, bar(-0.08, 0.25, -0.025)),  # on the side of the room: hinged on the other
        (LEFT, bar(-0.3, 0.4, -0.025, upright=False)),  # level: a flap's
        ((-0.28, 0.28), bar(0.0, 0.25, -0.025)),  # room for no whole leaf on either side
        ((-0.2, 0.2), bar(0.0, 0.25, -0.025)),  # room on both
    ],
)
def test_what_may_be_hinged_or_goes_either_way_is_not_said_to_slide(across, handle):
    assert slide(leaf(across), handle) is None


def test_beside_its_body_there_is_no_room():
    narrow = box((-0.6, 0.0), (0.0, 0.02), (0.0, 0.5))
    assert slide(leaf(LEFT), bar(-0.3, 0.25, -0.025), face=narrow) is None


def test_what_stands_ajar_or_lies_is_not_said_to_slide():
    handle = bar(-0.3, 0.25, -0.025)
    assert slide(leaf(LEFT), handle, turned=-10.0) is None
    assert slide(leaf(LEFT), handle, lean=-85.0) is None


def test_what_is_no_leaf_is_not_said_to_slide():
    thick = box(LEFT, (-0.4, -0.002), (0.02, 0.48))
    assert slide(thick, bar(-0.3, 0.25, -0.4)) is None
