"""Makes cabinet.glb, a textured cabinet as one welded mesh, and its ground truth beside it.

    python examples/make_cabinet.py [FOLDER]

The same bytes come out every time. Frame: glTF's, +Y up, front +Z, metres.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from glb import glb
from mapping import texture_coordinates
from numpy.typing import NDArray
from solids import Solid, X, Y, Z, board, framed_front, turned
from wood import paint

SEED = 7
GAP = 0.0025
# Inner faces of the carcass, and the plane of its front edges [m].
SIDE, FLOOR, SHELF_LOW, SHELF_HIGH, CEILING, FRONT, BACK = 0.46, 0.12, 0.62, 0.638, 0.87, 0.195, -0.205
DIVIDER = 0.009
SWING, TRAVEL = 1.92, 0.3


@dataclass(frozen=True, eq=False)
class PartPlan:
    """A part of the cabinet: its solids, and the joint that moves it (None: the body)."""

    name: str
    solids: tuple[Solid, ...]
    joint: dict[str, Any] | None = None


def cabinet() -> tuple[PartPlan, ...]:
    """The parts; the first one carries the others."""
    return (
        PartPlan("body", (*carcass(), *plinth())),
        door("door_left", -1),
        door("door_right", 1),
        drawer("drawer_left", -1),
        drawer("drawer_right", 1),
    )


def carcass() -> list[Solid]:
    """Sides, top, bottom, back boards, the floor and divider of the drawers, and a shelf behind the doors.

    Neighbours differ by a millimetre where they would have an edge in common: once coincident vertices are
    merged, an edge with four faces is no closed surface.
    """
    inside = "inside"
    rear = BACK - 0.010
    solids = [
        board((-0.48, 0.10, rear), (-SIDE, CEILING, FRONT), "walnut", Y, faces={"+x": inside}),
        board((SIDE, 0.10, rear), (0.48, CEILING, FRONT), "walnut", Y, faces={"-x": inside}),
        board((-0.5, CEILING, rear - 0.004), (0.5, 0.90, FRONT + 0.02), "walnut", X, 0.005, {"-y": inside}),
        board((-SIDE, 0.10, rear + 0.001), (SIDE, FLOOR, FRONT - 0.001), "walnut", X, faces={"+y": inside}),
        board((-SIDE, SHELF_LOW, BACK), (SIDE, SHELF_HIGH, FRONT), inside, X, faces={"+z": "walnut"}),
        board((-DIVIDER, SHELF_HIGH, BACK), (DIVIDER, CEILING, FRONT), inside, Y, faces={"+z": "walnut"}),
        board((-SIDE, 0.36, BACK), (SIDE, 0.376, 0.14), inside, X),
    ]
    edges = np.linspace(-SIDE, SIDE, 5)
    for number, (left, right) in enumerate(pairwise(edges)):
        thin = 0.001 * (number % 2)
        lower, upper = (left, FLOOR, rear + thin), (right, CEILING, BACK - thin)
        solids.append(board(lower, upper, "walnut", Y, faces={"+z": inside}))
    return solids


def plinth() -> list[Solid]:
    """Four turned feet and the aprons between them."""
    profile = [
        (0.013, 0.0),
        (0.016, 0.003),
        (0.0215, 0.060),
        (0.028, 0.068),
        (0.030, 0.076),
        (0.028, 0.084),
        (0.024, 0.088),
    ]
    x, front, rear = 0.425, 0.150, -0.170
    solids = [
        turned((side * x, 0.0, z), Y, [*profile, (0.024, 0.10)], 12, "walnut")
        for side in (-1, 1)
        for z in (front, rear)
    ]
    for z in (front, rear):
        solids.append(board((-x + 0.015, 0.055, z - 0.008), (x - 0.015, 0.10, z + 0.008), "walnut", X))
    for side in (-x, x):
        solids.append(
            board((side - 0.008, 0.055, rear + 0.015), (side + 0.008, 0.10, front - 0.015), "walnut", Z)
        )
    return solids


def door(name: str, side: int) -> PartPlan:
    """A framed door with a bar handle; `side` is -1 for the left one, hinged at the outer edge."""
    stile = 0.065
    low, high = FLOOR + GAP, SHELF_LOW - GAP
    left, right = sorted((side * GAP / 2, side * (SIDE - GAP)))
    panel = framed_front((left, low, FRONT - 0.022), (right, high, FRONT), "oak", Y, stile)
    handle = bar_handle((side * (GAP + stile) / 2, 0.44, FRONT), Y, 0.17)
    # The pin stands in the gap, in the plane of the front, so that no edge swings into the carcass.
    joint = {
        "name": f"{name}_hinge",
        "type": "revolute",
        "axis": [0.0, 1.0, 0.0],
        "origin": [round(side * (SIDE - GAP / 2), 6), round((low + high) / 2, 6), FRONT],
        "lower": -SWING if side < 0 else 0.0,
        "upper": 0.0 if side < 0 else SWING,
    }
    return PartPlan(name, (panel, *handle), joint)


def drawer(name: str, side: int) -> PartPlan:
    """A drawer: framed front with a handle, and a box of two sides, bottom and back."""
    low, high, rear = SHELF_HIGH + GAP, CEILING - GAP, FRONT - 0.020
    left, right = sorted((side * (DIVIDER + GAP), side * (SIDE - GAP)))
    inner, outer = left + 0.010, right - 0.010
    floor, rim, end = low + 0.004, high - 0.045, -0.185
    middle = ((left + right) / 2, (low + high) / 2, FRONT)
    solids = (
        framed_front((left, low, rear), (right, high, FRONT), "oak", X, 0.042),
        board((inner, floor, end), (inner + 0.012, rim, rear), "oak", Z),
        board((outer - 0.012, floor, end), (outer, rim, rear), "oak", Z),
        board((inner + 0.012, floor + 0.002, end), (outer - 0.012, rim - 0.004, end + 0.012), "oak", X),
        board((inner + 0.012, floor + 0.006, end + 0.012), (outer - 0.012, floor + 0.014, rear), "inside", X),
        *bar_handle(middle, X, 0.20),
    )
    joint = {
        "name": f"{name}_slide",
        "type": "prismatic",
        "axis": [0.0, 0.0, 1.0],
        "origin": [round(v, 6) for v in middle],
        "lower": 0.0,
        "upper": TRAVEL,
    }
    return PartPlan(name, solids, joint)


def bar_handle(middle: Sequence[float], axis: int, length: float) -> list[Solid]:
    """A round bar on two posts that stand on the plane z = middle[2]."""
    radius, reach = 0.006, 0.030
    along = np.eye(3)[axis]
    start = np.array(middle) + (0.0, 0.0, reach) - along * length / 2
    ends = [(0.004, 0.0), (radius, 0.002), (radius, length - 0.002), (0.004, length)]
    post = [(0.009, 0.0), (0.009, 0.003), (0.0045, 0.006), (0.0045, reach - 0.001)]
    feet = [np.array(middle) + along * place * length * 0.36 for place in (-1, 1)]
    return [turned(start, axis, ends, 12, "brass")] + [turned(foot, Z, post, 8, "brass") for foot in feet]


def triangles(parts: Sequence[PartPlan]) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """(F, 3, 8) position, normal and texture coordinate of every corner, and the (F,) part of every face."""
    rng = np.random.default_rng(SEED)
    corners, face_part = [], []
    for index, part in enumerate(parts):
        for solid in part.solids:
            for polygon, uv in zip(solid, texture_coordinates(solid, rng), strict=True):
                rows = np.concatenate([polygon.corners, polygon.normals, uv], axis=1)
                fan = [rows[[0, i, i + 1]] for i in range(1, len(rows) - 1)]
                corners += fan
                face_part += [index] * len(fan)
    return np.array(corners, dtype=np.float32), np.array(face_part, dtype=np.int32)


def ground_truth(parts: Sequence[PartPlan], face_part: NDArray[np.int32]) -> dict[str, Any]:
    """What is where and how it moves, in the mesh's frame; position 0 is the pose of the mesh."""
    rows = [
        {
            "id": index,
            "name": part.name,
            "parent": 0 if part.joint else -1,
            "faces": int((face_part == index).sum()),
            "joint": part.joint or {"type": "fixed"},
        }
        for index, part in enumerate(parts)
    ]
    return {
        "case": "cabinet",
        "category": "cabinet",
        "source": "examples/make_cabinet.py",
        "licence": "Apache-2.0",
        "frame": {"up": "+Y", "units": "metres"},
        "textured": True,
        "parts": rows,
    }


def write(folder: Path) -> None:
    """Write cabinet.glb, cabinet.gt.json and cabinet.gt.npz."""
    parts = cabinet()
    corners, face_part = triangles(parts)
    welded, faces = np.unique(corners.reshape(-1, 8), axis=0, return_inverse=True)
    vertices, normals, uv = (np.ascontiguousarray(welded[:, a:b]) for a, b in ((0, 3), (3, 6), (6, 8)))
    document = glb("cabinet", vertices, normals, uv, faces.reshape(-1, 3).astype(np.uint16), paint(SEED))
    (folder / "cabinet.glb").write_bytes(document)
    truth = json.dumps(ground_truth(parts, face_part), indent=1)
    (folder / "cabinet.gt.json").write_text(truth + "\n", encoding="utf-8", newline="\n")
    np.savez(folder / "cabinet.gt.npz", face_part=face_part)


if __name__ == "__main__":
    write(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
