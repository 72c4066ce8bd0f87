"""`geometric` on wire in a cavity: a rack slides out of the front; what is narrow, or solid, stays."""

import numpy as np
import pytest

from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import box as corners
from simart_kit.testing.meshes import boxes_mesh

from .furniture import Box, box, joined, turned
from .test_geometric import found


def case() -> Mesh:
    """A case in one piece, half a metre wide, deep and high, with walls of 3 cm; open at the front."""
    outer, faces = corners((-0.25, -0.25, 0.0), (0.25, 0.25, 0.5))
    inner, _ = corners((-0.22, -0.25, 0.03), (0.22, 0.22, 0.47))
    open_faces = faces[(outer[faces][:, :, 1] > -0.25).any(axis=1)]
    front = [i for i in range(8) if outer[i, 1] == -0.25]
    front.sort(key=lambda i: np.arctan2(outer[i, 2] - 0.25, outer[i, 0]))
    pairs = zip(front, [*front[1:], front[0]], strict=True)
    rim = [t for a, b in pairs for t in ([a, b, b + 8], [a, b + 8, a + 8])]
    return Mesh(np.concatenate([outer, inner]), np.concatenate([open_faces, open_faces[:, ::-1] + 8, rim]))


def grid(half: float) -> list[Box]:
    """Wires in both directions, of half a width."""
    along = [box((x - 0.003, x + 0.003), (-0.22, 0.2), (0.2, 0.206)) for x in np.linspace(-half, half, 10)]
    across = [box((-half, half), (y - 0.003, y + 0.003), (0.206, 0.212)) for y in (-0.15, 0.0, 0.15)]
    return [*along, *across]


DOOR = [box((-0.24, 0.24), (-0.272, -0.252), (0.01, 0.49)), box((-0.2, 0.2), (-0.3, -0.272), (0.44, 0.46))]


@pytest.mark.parametrize("quarter", range(4))
def test_a_rack_as_wide_as_its_cavity_slides_out_of_the_front(quarter: int) -> None:
    result = found(turned(joined(case(), boxes_mesh([*DOOR, *grid(0.2)])), 90.0 * quarter))
    assert result.kinds == {"door": "revolute", "rack": "prismatic"}
    outward = np.array([(0, -1, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0)][quarter])
    np.testing.assert_allclose(result.joint("rack").axis, outward, atol=1e-9)
    assert len(result.faces("rack")) == 13 * 12


@pytest.mark.parametrize(
    "inside",
    [
        grid(0.1),  # room for another beside it
        [box((-0.21, 0.21), (-0.22, 0.2), (0.2, 0.21)), *grid(0.2)],  # a shelf with things on it
    ],
)
def test_other_things_in_a_cavity_stay(inside: list[Box]) -> None:
    assert found(joined(case(), boxes_mesh([*DOOR, *inside]))).kinds == {"door": "revolute"}
