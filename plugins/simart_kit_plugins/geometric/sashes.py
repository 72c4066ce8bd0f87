"""What slides along its own front: leaves that pass by each other, and panels that pass before a body."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.sweeping import Motion, Sweep

from .candidates import Candidate, Choice
from .casting import cast
from .fronts import Front
from .scene import FACINGS, Box, Scene
from .siblings import alike, same_plane_axes
from .views import View

SASHES = ("sliding", "sash")
_APART = 0.25  # share of their thickness that leaves in two tracks may share
_NEAR = 0.02  # diagonals between two tracks at most
_CLOSES = -0.005  # diagonals by which the edges of two leaves may miss each other where they should meet
_ROOM = 0.9  # share of its width that a panel needs beside itself
_INNER = 0.3  # from the middle to the edge, where a handle is on the side of the room
_STOPS = 20
_UP = 2  # axis of the aligned frame


def passing(scene: Scene, fronts: Sequence[Front]) -> set[int]:
    """Panels of leaves alike, side by side in two tracks: where they meet, one overlaps the other.

    Of one above the other only the lower one: the upper sash of most windows is fixed, or kept shut.
    """
    found: set[int] = set()
    for one, other in combinations(fronts, 2):
        along = _two_tracks(scene, one, other) if alike(scene, one, other) else None
        pair = sorted((one.piece, other.piece), key=lambda piece: float(scene.boxes[piece].center[2]))
        if along is not None:
            found.update(pair[:1] if along == _UP else pair)
    return found


def slides_over(scene: Scene, front: Front) -> bool:
    """Whether a panel lies on one end of a body, which goes on for its width, and is not hinged on that end.

    A leaf that is hinged there has its handle on the side of that room, and a flap one along its edge.
    """
    if front.facing == "top" or front.boxed or not front.handles or front.held is None:
        return False
    axes = FACINGS[front.facing]
    size = Box.around([scene.boxes[i].turned(axes) for i in front.handles]).size
    side = room_beside(scene, axes, front.box, front.pieces)
    return bool(side and crosses(size, 2 * front.held[0] * side))


def crosses(handle: FloatArray, place: float) -> bool:
    """Whether a handle is that of what slides: across its way, and not on the side of its room.

    Args:
        handle: (3,) extents along the way, up, and out.
        place: of its middle, from -1 to 1 on the side of the room.
    """
    return bool(handle[1] > handle[0] and place < _INNER)


def room_beside(scene: Scene, axes: FloatArray, box: Box, own: tuple[int, ...]) -> int:
    """The side, -1 or 1 along u, on which alone a panel has room to slide into; 0 for none or both.

    Args:
        scene: it is in.
        axes: (3, 3) rows u, v, w.
        box: of the panel, in (u, v, w).
        own: pieces that move with it.
    """
    left, right = (_room(scene, axes, box, own, sign) for sign in (-1.0, 1.0))
    return int(right) - int(left)


def sliding(scene: Scene, view: View) -> Choice:
    """Along the front to where it goes farthest, or to where the body goes on."""
    return with_room(scene, view) or _towards_the_middle(view)


def with_room(scene: Scene, view: View) -> Choice | None:
    """Along the front to where it goes farthest; the longer way where both are free, None where none is."""
    mine = scene.labels == view.part
    sweep = Sweep(scene.vertices @ view.axes.T, scene.faces[mine], scene.faces[~mine])
    best: tuple[float, float, FloatArray] | None = None
    for axis, sign in ((0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)):
        direction = np.zeros(3)
        direction[axis] = sign
        # Beyond the body nothing stops a leaf, and nothing holds it.
        end = (
            view.body.upper[axis] - view.box.upper[axis]
            if sign > 0
            else view.box.lower[axis] - view.body.lower[axis]
        )
        limit = min(float(end), float(view.box.size[axis]))
        travel = sweep.free(_along(direction), limit, _STOPS) if limit > 0 else 0.0
        share = travel / view.box.size[axis]
        if share >= 0.4 and (best is None or share > best[0] + 0.1):
            best = share, travel, direction
    if best is None:
        return None
    candidate = Candidate("prismatic", best[2], view.box.center, best[1])
    return candidate, 0.8, ("has room beside itself to slide into",)


def _towards_the_middle(view: View) -> Choice:
    """Along the front to where the body goes on: something in the model is in the way of everything."""
    off = (view.body.center - view.box.center)[:2]
    along = int(np.argmax(np.abs(off) / view.box.size[:2]))
    direction = np.zeros(3)
    direction[along] = 1.0 if off[along] >= 0 else -1.0
    travel = min(2 * abs(float(off[along])), float(view.box.size[along]))
    candidate = Candidate("prismatic", direction, view.box.center, max(travel, 0.05))
    return candidate, 0.4, ("slides to where the body goes on",)


def _two_tracks(scene: Scene, one: Front, other: Front) -> int | None:
    """The axis along which two leaves follow each other in two tracks; None where they do not."""
    a, b = scene.boxes[one.piece], scene.boxes[other.piece]
    normal, *within = same_plane_axes(one)
    thickness = min(a.size[normal], b.size[normal])
    apart = -_shared(a, b, normal)
    if not -_APART * thickness <= apart <= thickness + _NEAR:
        return None
    for along, across in (within, within[::-1]):
        level = _shared(a, b, across) > 0.95 * a.size[across]
        if level and _CLOSES <= _shared(a, b, along) < 0.5 * a.size[along]:
            return along
    return None


def _shared(a: Box, b: Box, axis: int) -> float:
    """Length along an axis that two boxes share; negative where they are apart."""
    return float(min(a.upper[axis], b.upper[axis]) - max(a.lower[axis], b.lower[axis]))


def _room(scene: Scene, axes: FloatArray, box: Box, own: tuple[int, ...], sign: float) -> bool:
    """Whether nothing stands beside a panel for its width, and the body is behind all of that room."""
    heights, whole = np.linspace(-0.35, 0.35, 5), scene.box.turned(axes)
    end = box.center[0] + sign * (0.5 + _ROOM) * box.size[0]
    if not whole.lower[0] <= end <= whole.upper[0]:
        return False
    points = np.tile(box.center, (5, 1))
    points[:, 1] += heights * box.size[1]
    labels, distance = cast(scene, axes, points, np.array([sign, 0.0, 0.0]), own)
    if ((labels >= 0) & (distance < (0.5 + _ROOM) * box.size[0])).any():
        return False
    steps = (0.6, 0.8, 1.0, 1.2, 1.35)
    beside = np.concatenate([points + [sign * step * box.size[0], 0.0, 0.0] for step in steps])
    behind, _ = cast(scene, axes, beside, np.array([0.0, 0.0, -1.0]), own)
    before, _ = cast(scene, axes, beside, np.array([0.0, 0.0, 1.0]), own)
    return bool((behind >= 0).mean() > _ROOM and (before < 0).mean() > _ROOM)


def _along(direction: FloatArray) -> Motion:
    def motion(travel: float) -> FloatArray:
        matrix = np.eye(4)
        matrix[:3, 3] = travel * direction
        return matrix

    return motion
