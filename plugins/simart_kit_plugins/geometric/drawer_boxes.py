"""What hangs behind a front: whether it is the box of a drawer."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

from .casting import cast, grid
from .contact import HOLDS, TOUCH, Contacts, hanging_on
from .scene import Box, Scene

# Lengths are shares of the object's diagonal.
_HANGS = 0.012  # closer than this, a box behind a front hangs on it
_LEAST = (0.6, 0.25)  # share of the front's width and height that a drawer's box takes
_CLOSED = 0.85  # share of rays that meet what is closed
_NEAR = 1e-4  # a ray starts so far off what it is to meet
_BOARD, _FLAT = 0.5, 0.2  # share of the panel that a board on its back takes, and how thick it is
_LID = 0.15  # of a lining's height and depth, how far within rays still meet its outside


def reaches_back(reach: float, front: Box, whole: Box) -> bool:
    """Whether a front with this reach behind it [w] is a drawer's."""
    return bool(reach > 0.3 * whole.size[2] and reach > 0.3 * front.size[:2].min())


def bare(scene: Scene, axes: FloatArray, box: Box, own: tuple[int, ...]) -> bool:
    """Whether a solid top lies open to the sky, as that of a mattress or a seat does, and of no drawer."""
    highest = scene.box.turned(axes).upper[1]
    labels, distance = _from_above(scene, axes, box, highest)
    near_top = distance < highest + 0.01 - box.upper[1] + 0.5 * box.size[1]
    return float((np.isin(labels, own) & near_top).mean()) > 0.5


def hollow(scene: Scene, axes: FloatArray, box: Box, piece: int) -> bool:
    """Whether most rays from above go well into a piece before they meet it."""
    others = tuple(i for i in range(scene.count) if i != piece)
    labels, distance = _from_above(scene, axes, box, box.upper[1], others)
    return float(((labels >= 0) & (distance > 0.3 * box.size[1])).mean()) > 0.5


def _from_above(
    scene: Scene, axes: FloatArray, box: Box, height: float, passing: tuple[int, ...] = ()
) -> tuple[IntArray, FloatArray]:
    """What rays straight down over a box meet first, and how far below a little above `height` [v]."""
    above = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])  # (u, v, w) -> across, depth, upward
    points = grid(box.turned(above), 8, 0.8)
    origins = np.column_stack([points[:, 0], np.full(len(points), height + 0.01), -points[:, 1]])
    return cast(scene, axes, origins, np.array([0.0, -1.0, 0.0]), passing)


def hanging_behind(
    contacts: Contacts, boxes: list[Box], piece: int, front: tuple[int, ...]
) -> tuple[int, ...]:
    """A drawer's box behind its front: it hangs on the front, and no wall beside it holds it."""
    panel = boxes[piece]
    inside = [
        i
        for i, box in enumerate(boxes)
        if i not in (piece, *front) and box.lies_in(panel, 0.0) and box.upper[2] <= panel.upper[2] + TOUCH
    ]
    own = {piece, *front, *inside}

    def joined(i: int, j: int) -> bool:
        return contacts.within(i, j, _HANGS) and not _held(contacts, boxes, i, own)

    hanging = hanging_on({piece}, inside, joined)
    return tuple(i for i in inside if i in hanging)


def _held(contacts: Contacts, boxes: list[Box], piece: int, own: set[int]) -> bool:
    """Whether something beside a piece holds it at both ends, as walls hold a shelf."""
    box = boxes[piece]
    holders = [
        i
        for i, other in enumerate(boxes)
        if i not in own
        and other.lower[1] < box.center[1] < other.upper[1]
        and contacts.within(piece, i, HOLDS)
    ]
    left = any(boxes[i].lower[0] <= box.lower[0] + TOUCH for i in holders)
    right = any(boxes[i].upper[0] >= box.upper[0] - TOUCH for i in holders)
    return left and right


def is_drawer_box(
    scene: Scene, axes: FloatArray, boxes: list[Box], piece: int, behind: tuple[int, ...]
) -> bool:
    """Whether what hangs behind fills the front's rectangle fairly, and is closed when seen from below.

    What is closed above and open towards the front is the lining of an oven, and stays when its door opens.
    """
    inner = Box.around([boxes[i] for i in behind])
    if (inner.size[:2] < _LEAST * boxes[piece].size[:2]).any():
        return False
    below = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # (u, v, w) -> across, depth, downward
    points = grid(inner.turned(below), 8, 0.9)
    origins = np.column_stack([points[:, 0], np.full(len(points), inner.lower[1] - 0.01), points[:, 1]])
    others = tuple(i for i in range(scene.count) if i not in behind)
    labels, _ = cast(scene, axes, origins, np.array([0.0, 1.0, 0.0]), others)
    return float((labels >= 0).mean()) >= _CLOSED and not _lining(scene, axes, boxes, behind)


def backing(boxes: list[Box], piece: int, behind: Sequence[int]) -> tuple[int, ...]:
    """Of what hangs behind a panel, the boards on its back, which are of it."""
    panel = boxes[piece]
    return tuple(
        i
        for i in behind
        if np.prod(boxes[i].size[:2]) > _BOARD * np.prod(panel.size[:2])
        and boxes[i].upper[2] > panel.lower[2] - TOUCH
        and boxes[i].size[2] < _FLAT * boxes[i].size[:2].min()
    )


def _lining(scene: Scene, axes: FloatArray, boxes: list[Box], behind: Sequence[int]) -> bool:
    """Whether the deep pieces behind a front are closed above, and open where the front is."""
    whole = Box.around([boxes[i] for i in behind])
    deep = [i for i in behind if boxes[i].size[2] > 0.5 * whole.size[2]]
    if not deep:
        return False
    inner = Box.around([boxes[i] for i in deep])
    if inner.size[1] < 0.5 * whole.size[1]:
        return False
    others = tuple(i for i in range(scene.count) if i not in deep)
    labels, distance = _from_above(scene, axes, inner, inner.upper[1], others)
    covered = (labels >= 0) & (distance < 0.01 + _LID * inner.size[1])
    origins = np.column_stack([grid(inner, 8, 0.8), np.full(64, inner.upper[2] + _NEAR)])
    labels, distance = cast(scene, axes, origins, np.array([0.0, 0.0, -1.0]), others)
    met = (labels >= 0) & (distance < _LID * inner.size[2])
    return float(covered.mean()) >= _CLOSED and float(met.mean()) < 1 - _CLOSED
