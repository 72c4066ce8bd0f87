"""Furniture made of boards, front -y, standing on z = 0 [m]: things that open, and things that do not."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh

from simart_kit.arrays import FloatArray
from simart_kit.kinematics import rotation
from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh

Box = tuple[tuple[float, float, float], tuple[float, float, float]]
BOARD = 0.018
GAP = 0.003


def box(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> Box:
    return (x[0], y[0], z[0]), (x[1], y[1], z[1])


def carcass(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> list[Box]:
    """A box of five boards, open at the front; the sides stand between floor and top."""
    inner = (z[0] + BOARD, z[1] - BOARD)
    return [
        box(x, y, (z[0], inner[0])),
        box(x, y, (inner[1], z[1])),
        box((x[0], x[0] + BOARD), y, inner),
        box((x[1] - BOARD, x[1]), y, inner),
        box((x[0] + BOARD, x[1] - BOARD), (y[1] - 0.006, y[1]), inner),
    ]


def panel(x: tuple[float, float], front: float, z: tuple[float, float]) -> Box:
    """A door or a drawer's front."""
    return box(x, (front, front + BOARD), z)


def bar(x: float, z: float, front: float, half: float = 0.06, upright: bool = True) -> Box:
    """A handle on a panel."""
    across, up = (0.008, half) if upright else (half, 0.008)
    return box((x - across, x + across), (front - 0.03, front), (z - up, z + up))


def drawer(x: tuple[float, float], front: float, back: float, z: tuple[float, float]) -> list[Box]:
    """A front, a box of five boards behind it, and a handle in its middle."""
    inner = (x[0] + 0.02, x[1] - 0.02)
    behind, low, high = front + BOARD, z[0] + 0.015, z[1] - 0.03
    return [
        panel(x, front, z),
        box(inner, (behind, back), (low, low + 0.008)),
        box((inner[0], inner[0] + 0.012), (behind, back), (low + 0.008, high)),
        box((inner[1] - 0.012, inner[1]), (behind, back), (low + 0.008, high)),
        box((inner[0] + 0.012, inner[1] - 0.012), (back - 0.012, back), (low + 0.008, high)),
        box((inner[0] + 0.012, inner[1] - 0.012), (behind, behind + 0.012), (low + 0.008, high)),
        bar(sum(x) / 2, sum(z) / 2, front, upright=False),
    ]


def legs(width: float, depth: float, height: float, thick: float = 0.05) -> list[Box]:
    x, y = (width - thick) / 2, (depth - thick) / 2
    return [
        box((a - thick / 2, a + thick / 2), (b - thick / 2, b + thick / 2), (0, height))
        for a in (-x, x)
        for b in (-y, y)
    ]


# A wall cabinet 0.5 x 0.4 x 0.7 with a door set into its frame.
CABINET = carcass((-0.25, 0.25), (-0.2, 0.2), (0.0, 0.7))
INSET = (-0.25 + BOARD + GAP, 0.25 - BOARD - GAP)
HIGH = (BOARD + GAP, 0.7 - BOARD - GAP)


def cabinet_with_door(handle: str | None) -> list[Box]:
    """A door with a handle near its "left" or "right" edge, or none."""
    place = {"left": [INSET[0] + 0.04], "right": [INSET[1] - 0.04], None: []}[handle]
    return [*CABINET, panel(INSET, -0.2, HIGH), *[bar(x, 0.35, -0.2) for x in place]]


def cabinet_with_two_doors(handles: bool) -> list[Box]:
    """A cabinet 0.9 wide with two doors in front of its boards; handles meet in the middle."""
    fronts = [panel((-0.448, -0.0015), -0.22, (0.002, 0.698)), panel((0.0015, 0.448), -0.22, (0.002, 0.698))]
    bars = [bar(-0.04, 0.35, -0.22), bar(0.04, 0.35, -0.22)] if handles else []
    return [*carcass((-0.45, 0.45), (-0.2, 0.2), (0.0, 0.7)), *fronts, *bars]


def sideboard() -> list[Box]:
    """A drawer above a door that has its handle on the left."""
    shelf = box((-0.25 + BOARD, 0.25 - BOARD), (-0.18, 0.19), (0.45, 0.45 + BOARD))
    door = panel(INSET, -0.2, (BOARD + GAP, 0.455))
    return [
        *CABINET,
        shelf,
        door,
        bar(INSET[0] + 0.04, 0.25, -0.2),
        *drawer(INSET, -0.2, 0.15, (0.475, HIGH[1])),
    ]


def dresser() -> list[Box]:
    """A solid block with three plain fronts on it, a knob in the middle of each: as games draw it."""
    body = box((-0.5, 0.5), (-0.22, 0.22), (0.0, 0.84))
    rows = [(0.03 + 0.27 * i, 0.27 + 0.27 * i) for i in range(3)]
    fronts = [box((-0.48, 0.48), (-0.24, -0.22), z) for z in rows]
    return [
        body,
        *fronts,
        *[box((-0.015, 0.015), (-0.27, -0.24), (sum(z) / 2 - 0.015, sum(z) / 2 + 0.015)) for z in rows],
    ]


def oven() -> list[Box]:
    """A flap over a cavity, with a handle along its upper edge."""
    return [
        *carcass((-0.3, 0.3), (-0.28, 0.28), (0.0, 0.6)),
        box((-0.3, 0.3), (-0.28, 0.28), (0.602, 0.75)),
        panel((-0.298, 0.298), -0.30, (0.002, 0.598)),
        box((-0.24, 0.24), (-0.345, -0.33), (0.54, 0.555)),
        box((-0.24, -0.225), (-0.33, -0.30), (0.54, 0.555)),
        box((0.225, 0.24), (-0.33, -0.30), (0.54, 0.555)),
    ]


def microwave() -> list[Box]:
    """A door on the left three quarters, its handle near the controls, which stay."""
    return [
        *carcass((-0.25, 0.12), (-0.18, 0.18), (0.0, 0.3)),
        box((0.122, 0.25), (-0.2, 0.18), (0.0, 0.3)),
        panel((-0.248, 0.118), -0.2, (0.002, 0.298)),
        bar(0.095, 0.15, -0.2, half=0.1),
    ]


def chest() -> list[Box]:
    """An open box of boards under a lid that overhangs it."""
    return [
        box((-0.4, 0.4), (-0.25, 0.25), (0.0, 0.02)),
        *[box((x, x + 0.02), (-0.25, 0.25), (0.02, 0.4)) for x in (-0.4, 0.38)],
        *[box((-0.38, 0.38), (y, y + 0.02), (0.02, 0.4)) for y in (-0.25, 0.23)],
        box((-0.41, 0.41), (-0.26, 0.26), (0.402, 0.43)),
    ]


def cart(axis: int) -> Mesh:
    """A board on four wheels of 0.1 across, which roll about x (0) or y (1)."""
    deck = [box((-0.4, 0.4), (-0.25, 0.25), (0.12, 0.15))]
    return with_discs(deck, [(x, y, 0.05) for x in (-0.35, 0.35) for y in (-0.2, 0.2)], 0.05, 0.03, axis)


def stove() -> Mesh:
    """A block with four knobs in a row on its front."""
    block = [box((-0.3, 0.3), (-0.3, 0.3), (0.0, 0.85))]
    return with_discs(block, [(x, -0.31, 0.8) for x in (-0.2, -0.1, 0.1, 0.2)], 0.02, 0.02, 1)


OPENING = {
    "cabinet": cabinet_with_door("right"),
    "two_doors": cabinet_with_two_doors(handles=True),
    "sideboard": sideboard(),
    "dresser": dresser(),
    "oven": oven(),
    "microwave": microwave(),
    "chest": chest(),
}

STATIC = {
    "table": [box((-0.6, 0.6), (-0.4, 0.4), (0.70, 0.73)), *legs(1.2, 0.8, 0.7)],
    "table with aprons": [
        box((-0.6, 0.6), (-0.4, 0.4), (0.70, 0.73)),
        *legs(1.2, 0.8, 0.7),
        *[box((-0.55, 0.55), (y, y + 0.02), (0.6, 0.7)) for y in (-0.385, 0.365)],
        *[box((x, x + 0.02), (-0.35, 0.35), (0.6, 0.7)) for x in (-0.585, 0.565)],
    ],
    "bookcase": [
        *carcass((-0.4, 0.4), (-0.15, 0.15), (0.0, 1.8)),
        *[box((-0.4 + BOARD, 0.4 - BOARD), (-0.15, 0.144), (z, z + BOARD)) for z in (0.4, 0.8, 1.2)],
    ],
    "shelf of books": [
        *carcass((-0.4, 0.4), (-0.15, 0.15), (0.0, 0.45)),
        *[
            box((-0.36 + 0.05 * i, -0.32 + 0.05 * i), (-0.12, 0.1), (BOARD, 0.3 + 0.02 * (i % 4)))
            for i in range(14)
        ],
    ],
    "chair": [
        box((-0.22, 0.22), (-0.22, 0.22), (0.43, 0.46)),
        *legs(0.44, 0.44, 0.43, 0.04),
        box((-0.22, -0.18), (0.18, 0.22), (0.46, 0.92)),
        box((0.18, 0.22), (0.18, 0.22), (0.46, 0.92)),
        *[box((-0.18, 0.18), (0.19, 0.21), (z, z + 0.1)) for z in (0.55, 0.75)],
    ],
    "sofa": [
        box((-0.9, 0.9), (-0.4, 0.4), (0.1, 0.3)),
        box((-0.9, 0.9), (0.25, 0.4), (0.3, 0.8)),
        box((-0.9, -0.75), (-0.4, 0.25), (0.3, 0.55)),
        box((0.75, 0.9), (-0.4, 0.25), (0.3, 0.55)),
        *[box(x, (-0.4, 0.25), (0.3, 0.42)) for x in ((-0.74, -0.01), (0.01, 0.74))],
        *[box(x, (0.1, 0.25), (0.42, 0.8)) for x in ((-0.74, -0.01), (0.01, 0.74))],
    ],
    "bed": [
        box((-0.8, 0.8), (-1.0, 1.0), (0.2, 0.3)),
        box((-0.78, 0.78), (-0.98, 0.98), (0.3, 0.5)),
        box((-0.8, 0.8), (1.0, 1.05), (0.0, 1.0)),
        *[box(x, (0.6, 0.92), (0.5, 0.6)) for x in ((-0.7, -0.1), (0.1, 0.7))],
        *legs(1.6, 2.0, 0.2),
    ],
    "bed between boards": [
        box((-0.46, 0.44), (-0.95, 0.95), (0.29, 0.48)),
        *[box(x, (-1.0, 1.0), (0.18, 0.42)) for x in ((-0.515, -0.465), (0.445, 0.495))],
        *[box((-0.52, 0.5), y, (0.18, 0.63)) for y in ((-1.005, -0.955), (0.955, 1.005))],
        *[box((x, x + 0.12), (y, y + 0.12), (0.0, 0.7)) for x in (-0.54, 0.42) for y in (-1.04, 0.92)],
    ],
    "open crate": [
        box((-0.3, 0.3), (-0.2, 0.2), (0.0, 0.02)),
        *[box((x, x + 0.02), (-0.2, 0.2), (0.02, 0.3)) for x in (-0.3, 0.28)],
        *[box((-0.28, 0.28), (y, y + 0.02), (0.02, 0.3)) for y in (-0.2, 0.18)],
    ],
    "television": [
        box((-0.6, 0.6), (-0.02, 0.03), (0.1, 0.8)),
        box((-0.2, 0.2), (-0.1, 0.12), (0.0, 0.02)),
        box((-0.05, 0.05), (0.0, 0.02), (0.02, 0.1)),
        box((-0.58, 0.58), (-0.025, -0.02), (0.12, 0.78)),
    ],
    "picture": [
        box((-0.5, 0.5), (0.0, 0.03), (0.0, 0.05)),
        box((-0.5, 0.5), (0.0, 0.03), (0.75, 0.8)),
        box((-0.5, -0.45), (0.0, 0.03), (0.05, 0.75)),
        box((0.45, 0.5), (0.0, 0.03), (0.05, 0.75)),
        box((-0.45, 0.45), (0.01, 0.02), (0.05, 0.75)),
    ],
    "block": [box((-0.3, 0.3), (-0.2, 0.2), (0.0, 0.5))],
}


def with_discs(
    boxes: Sequence[Box], centers: Sequence[Sequence[float]], radius: float, thick: float, axis: int
) -> Mesh:
    """The boxes and after them discs of 128 faces each about an axis (0, 1, 2)."""
    disc = trimesh.creation.cylinder(radius=radius, height=thick, sections=32)
    turn = rotation(np.array([[0, np.pi / 2, 0], [np.pi / 2, 0, 0], [0, 0, 0]])[axis])
    return joined(boxes_mesh(boxes), *[Mesh(disc.vertices @ turn.T + c, disc.faces) for c in centers])


def joined(*meshes: Mesh) -> Mesh:
    """Several meshes as one, face after face."""
    offsets = np.cumsum([0, *[len(m.vertices) for m in meshes[:-1]]])
    faces = [m.faces + offset for m, offset in zip(meshes, offsets, strict=True)]
    return Mesh(np.concatenate([m.vertices for m in meshes]), np.concatenate(faces))


def turned(mesh: Mesh, degrees: float, factor: float = 1.0) -> Mesh:
    """The mesh turned about the vertical, and scaled."""
    return mesh.transformed(turning(degrees, factor))


def turning(degrees: float, factor: float = 1.0) -> FloatArray:
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(np.array([0.0, 0.0, np.radians(degrees)])) * factor
    return matrix
