"""`geometric` on what stands open: it moves about the edge that it shares with what it closes."""

import numpy as np
import pytest

from .furniture import CABINET, Box, box, turned
from .test_geometric import assert_hinge, boxes_mesh, found

BASE = box((-0.16, 0.16), (-0.22, 0.0), (0.0, 0.02))
SCREEN = box((-0.16, 0.16), (0.0, 0.01), (0.02, 0.24))
KEYS = [box((x, x + 0.015), (-0.1, -0.085), (0.02, 0.024)) for x in (-0.1, -0.05, 0.0, 0.05)]
FRAME = [
    box((-0.45, -0.4), (-0.05, 0.05), (0.0, 2.05)),
    box((0.4, 0.45), (-0.05, 0.05), (0.0, 2.05)),
    box((-0.4, 0.4), (-0.05, 0.05), (2.0, 2.05)),
]
BESIDE = box((0.25, 0.268), (-0.7, -0.2), (0.0, 0.7))  # as wide as the cabinet's opening, before its side


def test_the_screen_of_a_laptop_turns_about_the_edge_of_its_base() -> None:
    result = found([BASE, SCREEN, *KEYS])
    assert result.kinds["lid"] == "revolute"
    assert_hinge(result.joint("lid"), (0.0, 0.0, 0.02), "x")
    np.testing.assert_array_equal(result.faces("lid"), np.arange(12, 24))
    limits = result.joint("lid").limits
    assert limits is not None
    assert limits.lower == pytest.approx(-np.pi / 2, abs=1e-6)
    assert (result.travel("lid", fraction=limits.lower / limits.upper) @ [0, 1, 0]).min() < -0.2  # it closes


def test_a_thick_lid_that_lies_open_turns_about_its_inner_face_as_else_it_would_not_close() -> None:
    walls = [
        box((-0.3, 0.3), (0.18, 0.2), (0.0, 0.56)),
        *(box((x, x + 0.02), (-0.2, 0.18), (0.0, 0.56)) for x in (-0.3, 0.28)),
        *(box((-0.28, 0.28), (-0.2, 0.18), (z, z + 0.02)) for z in (0.0, 0.54)),
    ]
    lid = box((-0.3, 0.3), (-0.702, -0.202), (0.0, 0.06))
    result = found([*walls, lid])
    assert result.kinds == {"lid": "revolute"}
    hinge = result.joint("lid")
    assert_hinge(hinge, (0.0, -0.202, 0.06), "x")
    assert hinge.limits is not None
    assert hinge.limits.lower == pytest.approx(-np.pi / 2, abs=1e-6)


def test_a_door_that_stands_open_turns_about_the_edge_in_its_frame() -> None:
    leaf = box((-0.4, -0.36), (-0.85, -0.05), (0.01, 1.99))
    result = found([*FRAME, leaf])
    assert result.kinds == {"door": "revolute"}
    assert_hinge(result.joint("door"), (-0.38, -0.05, 0.0), "z")


def test_a_door_that_stands_open_before_a_cabinet_closes_it() -> None:
    result = found(turned(boxes_mesh([*CABINET, BESIDE]), 90.0))
    assert result.kinds == {"door": "revolute"}
    limits = result.joint("door").limits
    assert limits is not None
    assert limits.lower < -1.5


@pytest.mark.parametrize(
    "boards",
    [
        # A bench: its back is lower than its seat is deep, and the seat has legs.
        [
            box((-0.6, 0.6), (-0.25, 0.25), (0.42, 0.45)),
            box((-0.6, 0.6), (0.22, 0.25), (0.45, 0.9)),
            *(box((x, x + 0.05), (-0.25, 0.25), (0.0, 0.42)) for x in (-0.6, 0.55)),
        ],
        # A cube open at the front: its side is as wide as the opening, but is its wall.
        [
            box((-0.2, 0.2), (-0.2, 0.2), (0.0, 0.02)),
            box((-0.2, 0.2), (-0.2, 0.2), (0.38, 0.4)),
            box((-0.2, -0.18), (-0.2, 0.2), (0.02, 0.38)),
            box((0.18, 0.2), (-0.2, 0.2), (0.02, 0.38)),
            box((-0.18, 0.18), (0.18, 0.2), (0.02, 0.38)),
        ],
        # A screen of another size than the plate it stands on.
        [box((-0.1, 0.1), (-0.1, 0.1), (0.0, 0.02)), box((-0.3, 0.3), (0.07, 0.1), (0.02, 0.4))],
    ],
)
def test_what_fits_nothing_stays(boards: list[Box]) -> None:
    assert found(boards).kinds == {}
