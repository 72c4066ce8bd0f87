"""Levers and knobs on a spindle that goes through a leaf: they turn about it, and the leaf carries them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.bounds import triangle_bounds

from .candidates import Candidate, Choice
from .contact import Contacts, hanging_on
from .fronts import meet
from .lever_pairs import held_at, lever_pair
from .movers import Mover
from .rounds import is_rod
from .scene import Box, Scene
from .views import View, cut

LEVERS = ("lever",)
_OUT = 0.01  # diagonals that a spindle stands out on both sides at least
_NARROW = 0.25  # of a leaf's shorter side that a spindle is wide at most
_TURN = np.pi / 4  # how far a lever goes [rad]


def with_levers(scene: Scene, contacts: Contacts, movers: Sequence[Mover]) -> list[Mover]:
    """The movers, and the lever of each door through which a spindle goes, or that has two, as its own."""
    result: list[Mover] = []
    for mover in movers:
        lever, reason = _lever_of(scene, contacts, mover) if mover.label == "door" else ((), "")
        result.append(replace(mover, pieces=tuple(i for i in mover.pieces if i not in lever)))
        if lever:
            result.append(Mover(lever, "lever", 0.9 * mover.score, (reason,)))
    return result


def _lever_of(scene: Scene, contacts: Contacts, door: Mover) -> tuple[tuple[int, ...], str]:
    panel = max(door.pieces, key=lambda piece: float(np.prod(np.sort(scene.boxes[piece].size)[1:])))
    pierced_by = _on_spindle(scene, contacts, door.pieces, panel)
    if pierced_by:
        return pierced_by, "its spindle goes through a door"
    pair = lever_pair(scene, contacts, panel, door.pieces)
    return pair, "alike before and behind a door, held at one end"


def pierced(scene: Scene, part: int, others: Sequence[int]) -> int | None:
    """The part that one goes right through, across the least of its extents; no frame around that."""
    leaves = {other: _beneath(scene, part, other) for other in others}
    return next((i for i, leaf in leaves.items() if leaf and _through(scene.boxes[part], leaf)), None)


def levering(scene: Scene, view: View) -> Choice | None:
    """About the middle of what goes through another part, so that its far end goes down."""
    leaf = pierced(scene, view.part, [i for i in range(scene.count) if i != view.part])
    if leaf is None:
        return None
    axis, origin = np.zeros(3), _pierced_at(scene, view.part, leaf)
    axis[int(scene.boxes[leaf].size.argmin())] = 1.0
    rises = np.cross(axis, scene.boxes[view.part].center - origin)[2] > 0
    candidate = Candidate("revolute", view.axes @ (-axis if rises else axis), view.axes @ origin, _TURN)
    return candidate, 0.7, ("turns where its leaf holds it",)


def with_handle(scene: Scene, view: View, levers: Sequence[int]) -> View:
    """The view, with the lever that goes through the part as its handle; as it is without one."""
    for lever in levers:
        if pierced(scene, lever, [view.part]) is not None:
            foot = (view.axes @ _pierced_at(scene, lever, view.part))[:2]
            return replace(view, handle=scene.boxes[lever].turned(view.axes), foot=foot)
    return view


def _pierced_at(scene: Scene, part: int, leaf: int) -> FloatArray:
    """(3,) middle of where one part goes through the middle of another, or holds on to it on both sides."""
    box = _beneath(scene, part, leaf) or scene.boxes[leaf]
    normal = int(box.size.argmin())
    turn = np.roll(np.eye(3), 2 - normal, axis=0)  # rows: two in the leaf's plane, then its normal
    middle = cut(scene.triangles[scene.labels == part] @ turn.T, float(box.center[normal]))
    if middle is not None:
        return np.array([*middle, box.center[normal]]) @ turn
    return held_at(scene.points_of(part), box)


def _beneath(scene: Scene, part: int, leaf: int) -> Box | None:
    """The box of a leaf, as thick as under a lever: its hinges may stand out farther; None beside it."""
    box, lever = scene.boxes[leaf], scene.boxes[part]
    normal = int(box.size.argmin())
    within = np.delete(np.arange(3), normal)
    lower, upper = triangle_bounds(scene.triangles[scene.faces_of((leaf,))])
    under = ((lower <= lever.upper) & (upper >= lever.lower))[:, within].all(axis=1)
    if not under.any():
        return None
    thick = np.arange(3) == normal
    low, high = lower[under].min(axis=0), upper[under].max(axis=0)
    return Box(np.where(thick, low, box.lower), np.where(thick, high, box.upper))


def _on_spindle(scene: Scene, contacts: Contacts, door: Sequence[int], panel: int) -> tuple[int, ...]:
    """The spindle through a door's leaf, with all that it holds before and behind the leaf; or nothing."""
    leaf = scene.boxes[panel]
    spindles = [piece for piece in door if piece != panel and _spindle(scene, piece, leaf)]
    if len(spindles) != 1:
        return ()
    normal = int(leaf.size.argmin())
    outside = [
        i
        for i, box in enumerate(scene.boxes)
        if (box.lower[normal] > leaf.upper[normal] or box.upper[normal] < leaf.lower[normal])
        and box.size.max() < 0.5 * leaf.size.max()
    ]
    lever = hanging_on(set(spindles), outside, lambda i, j: meet(contacts, scene.boxes, i, j))
    return tuple(sorted(lever))


def _spindle(scene: Scene, piece: int, leaf: Box) -> bool:
    """Whether a piece is a rod that goes through a leaf."""
    box, normal = scene.boxes[piece], int(leaf.size.argmin())
    within = np.delete(np.arange(3), normal)
    if not _through(box, leaf) or box.size.argmax() != normal:
        return False
    narrow = box.size[within].max() < _NARROW * leaf.size[within].min()
    return bool(narrow) and is_rod(scene.points_of(piece), normal)


def _through(box: Box, leaf: Box) -> bool:
    normal = int(leaf.size.argmin())
    within = np.delete(np.arange(3), normal)
    inside = (box.center[within] > leaf.lower[within]) & (box.center[within] < leaf.upper[within])
    return bool(
        inside.all()
        and box.lower[normal] < leaf.lower[normal] - _OUT
        and box.upper[normal] > leaf.upper[normal] + _OUT
    )
