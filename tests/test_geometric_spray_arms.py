"""`geometric` on bars in a cavity: one that is held at its middle and free all around is a spray arm."""

import numpy as np
import pytest
import trimesh
from trimesh.transformations import rotation_matrix

from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh

from .furniture import Box, box, joined, turned
from .test_geometric import found
from .test_geometric_racks import DOOR, case, grid

ARM = box((-0.15, 0.15), (-0.01, 0.01), (0.29, 0.3))
POST = box((-0.008, 0.008), (-0.008, 0.008), (0.3, 0.47))


def washer(*inside: Box) -> Mesh:
    """A case of half a metre with a door, and things in it."""
    return joined(case(), boxes_mesh([*DOOR, *inside]))


@pytest.mark.parametrize("quarter", range(4))
def test_a_bar_that_hangs_by_its_middle_turns_all_around(quarter: int) -> None:
    result = found(turned(washer(ARM, POST), 90.0 * quarter))
    assert result.kinds == {"door": "revolute", "spray_arm": "continuous"}
    np.testing.assert_allclose(np.abs(result.joint("spray_arm").axis), (0, 0, 1), atol=1e-9)
    np.testing.assert_allclose(result.joint("spray_arm").origin[:2], (0, 0), atol=1e-6)
    assert len(result.faces("spray_arm")) == 12


def test_one_below_a_rack_goes_with_it() -> None:
    arm, post = (
        box((-0.15, 0.15), (-0.01, 0.01), (0.18, 0.19)),
        box((-0.006, 0.006), (-0.006, 0.006), (0.19, 0.206)),
    )
    result = found(washer(*grid(0.2), arm, post))
    assert result.kinds == {"door": "revolute", "rack": "prismatic", "spray_arm": "continuous"}
    assert result.joint("spray_arm").parent == "rack"


@pytest.mark.parametrize(
    "inside",
    [
        (ARM, box((-0.15, -0.134), (-0.008, 0.008), (0.3, 0.47))),  # held at one end
        (ARM, *(box((x, x + 0.016), (-0.008, 0.008), (0.3, 0.47)) for x in (-0.15, 0.134))),  # at both
        (ARM, POST, box((-0.05, 0.05), (0.12, 0.14), (0.03, 0.4))),  # something in its way
        (box((-0.22, 0.22), (-0.01, 0.01), (0.29, 0.3)), POST),  # a rail from wall to wall
        (box((-0.15, 0.15), (-0.1, 0.1), (0.29, 0.3)), POST),  # a board
    ],
)
def test_other_bars_stay(inside: tuple[Box, ...]) -> None:
    assert found(washer(*inside)).kinds == {"door": "revolute"}


def test_the_ribs_of_a_drum_stay() -> None:
    drum = trimesh.creation.annulus(0.115, 0.12, 0.3, transform=rotation_matrix(np.pi / 2, (1, 0, 0)))
    drum.apply_translation((0, 0, 0.25))
    shell = Mesh(np.array(drum.vertices), np.array(drum.faces, dtype=np.int32))
    assert (
        "spray_arm"
        not in found(joined(washer(box((0.1, 0.1145), (-0.05, 0.05), (0.245, 0.255))), shell)).kinds
    )


def test_a_bar_on_a_post_without_walls_around_stays() -> None:
    foot = box((-0.2, 0.2), (-0.2, 0.2), (0.0, 0.3))
    assert not found(
        [
            foot,
            box((-0.008, 0.008), (-0.008, 0.008), (0.3, 0.5)),
            box((-0.15, 0.15), (-0.01, 0.01), (0.5, 0.51)),
        ]
    ).joints
