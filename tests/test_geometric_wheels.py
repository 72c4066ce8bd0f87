"""`geometric` on a single wheel: it turns where a fork holds its axle and nothing its rim."""

import numpy as np
import pytest
import trimesh
from trimesh.transformations import rotation_matrix

from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh

from .furniture import Box, box, joined, turned
from .test_geometric import found

TRAY = (box((-0.3, 0.3), (-0.3, 0.4), (0.4, 0.7)), box((-0.25, 0.25), (0.3, 0.35), (0.0, 0.4)))
ABOVE = (box((-0.07, -0.04), (-0.62, -0.28), (0.5, 0.52)), box((0.04, 0.07), (-0.62, -0.28), (0.5, 0.52)))
# Each from the tray forward, beside the wheel.
LEFT = box((-0.07, -0.04), (-0.62, -0.28), (0.19, 0.21))
RIGHT = box((0.04, 0.07), (-0.62, -0.28), (0.19, 0.21))
STAYS = tuple(box((x, x + 0.03), (-0.3, -0.27), (0.19, 0.45)) for x in (-0.07, 0.04))


def wheel(z: float) -> Mesh:
    """A disc of 0.4 m, its axle along x, before the tray."""
    made = trimesh.creation.cylinder(0.2, 0.08, sections=48)
    made.apply_transform(rotation_matrix(np.pi / 2, (0, 1, 0)))
    made.apply_translation((0, -0.6, z))
    return Mesh(np.array(made.vertices), np.array(made.faces, dtype=np.int32))


def barrow(*more: Box, z: float = 0.2) -> Mesh:
    return joined(boxes_mesh([*TRAY, *more]), wheel(z))


@pytest.mark.parametrize("quarter", range(4))
def test_a_wheel_in_a_fork_turns_about_its_axle(quarter: int) -> None:
    result = found(turned(barrow(LEFT, RIGHT, *STAYS), 90.0 * quarter))
    assert result.kinds == {"wheel": "continuous"}
    joint = result.joint("wheel")
    along = (1.0, 0.0, 0.0) if quarter % 2 == 0 else (0.0, 1.0, 0.0)
    np.testing.assert_allclose(np.abs(joint.axis), along, atol=1e-6)
    assert joint.origin[2] == pytest.approx(0.2, abs=1e-3)


@pytest.mark.parametrize(
    ("more", "z"),
    [
        ((LEFT, *STAYS), 0.2),  # held from one side
        ((LEFT, RIGHT, *STAYS, box((-0.03, 0.03), (-0.402, -0.3), (0.15, 0.25))), 0.2),  # stopped at its rim
        (
            (
                box((-0.07, -0.04), (-0.62, -0.28), (0.5, 0.52)),
                box((0.04, 0.07), (-0.62, -0.28), (0.5, 0.52)),
            ),
            0.51,
        ),
        ((box((-0.3, 0.3), (-0.62, -0.58), (0.18, 0.22)),), 0.2),  # on a shaft that leads nowhere
        ((), 0.2),  # beside the tray, held by nothing
    ],
    ids=["one side", "blocked", "in the air", "shaft", "loose"],
)
def test_other_discs_stay(more: tuple[Box, ...], z: float) -> None:
    assert "wheel" not in found(barrow(*more, z=z)).kinds


def test_the_spokes_go_with_the_tyre_and_the_fork_holds_the_hub() -> None:
    tyre = trimesh.creation.annulus(0.16, 0.2, 0.08)
    tyre.apply_transform(rotation_matrix(np.pi / 2, (0, 1, 0)))
    tyre.apply_translation((0, -0.6, 0.2))
    rim = Mesh(np.array(tyre.vertices), np.array(tyre.faces, dtype=np.int32))
    disc = trimesh.creation.cylinder(0.158, 0.02, sections=48)
    disc.apply_transform(rotation_matrix(np.pi / 2, (0, 1, 0)))
    disc.apply_translation((0, -0.6, 0.2))
    spokes = Mesh(np.array(disc.vertices), np.array(disc.faces, dtype=np.int32))
    near = tuple(box((x, x + 0.03), (-0.62, -0.28), (0.19, 0.21)) for x in (-0.045, 0.015))
    mesh = joined(joined(boxes_mesh([*TRAY, *near, *STAYS]), rim), spokes)
    result = found(mesh)
    assert result.kinds == {"wheel": "continuous"}
    assert len(result.faces("wheel")) == len(rim.faces) + len(spokes.faces)
