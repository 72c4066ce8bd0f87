"""Drawers within: tubs between two walls of a cavity, as in a wardrobe or a refrigerator."""

from __future__ import annotations

from collections.abc import Sequence, Set

import numpy as np

from simart_kit.arrays import FloatArray

from .candidates import Choice
from .casting import cast, first_met, grid
from .contact import TOUCH, Contacts, hanging_on
from .movers import Mover
from .racks import sliding_out
from .scene import FACINGS, Box, Scene
from .tubs import enclosing, is_tub
from .views import View, shown

# Lengths are shares of the object's diagonal.
_WIDE, _HIGH = 0.1, 0.03  # what is less wide, deep or high is a tray or a cup
_FRONT = 0.06  # so far before a drawer its front and its handle reach
_FRONT_SHARE = np.array([0.7, 0.4])  # of a front's width and height that its drawer takes
_FRONTS = ("door", "drawer", "sliding_door")
_REASON = ("a tub between the walls of a cavity",)
_COVERED = 0.5  # share of rays straight up that meet something, of what stands in a cavity
_UP = _OUTWARD = np.array([0.0, 0.0, 1.0])  # of the aligned frame, and of (u, v, w)
_SIDES = tuple(axes for facing, axes in FACINGS.items() if facing != "top")


def inner_drawers(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Tubs with a wall close on either side, something above and nothing before, with their fronts."""
    movers, used = list[Mover](), set(taken)
    for piece, box in enumerate(scene.boxes):
        if piece in used or box.size[:2].min() < _WIDE or box.size[2] < _HIGH or not is_tub(scene, piece):
            continue
        around = enclosing(scene, piece)
        if not _covered(scene, piece, taken):
            continue
        for axes in _SIDES:
            pieces = (piece, *_front(scene, contacts, axes, piece, used))
            walled = all(tuple(sign * axes[0]) in around for sign in (-1.0, 1.0))
            if walled and _comes_out(scene, axes, pieces, taken):
                used.update(pieces)
                movers.append(Mover(pieces, "drawer", 0.5, _REASON))
                break
    return movers


def with_fronts(scene: Scene, movers: Sequence[Mover]) -> list[Mover]:
    """Movers, of which drawers within and fronts of their size close before them are one."""
    result = list(movers)
    for drawer in [mover for mover in movers if mover.evidence == _REASON]:
        tub = scene.boxes[drawer.pieces[0]]
        fronts = (one for one in result if one.label in _FRONTS and one.evidence != _REASON)
        front = next((one for one in fronts if _before(scene, one, tub)), None)
        if front is not None:
            one = Mover((*front.pieces, *drawer.pieces), "drawer", front.score, front.evidence + _REASON)
            result = [one if mover is front else mover for mover in result if mover is not drawer]
    return result


def out_of_hiding(scene: Scene, view: View) -> Choice | None:
    """The slide of a drawer that a door hides, out of its cavity; None for one that is seen."""
    hidden = all(shown(scene, axes, view.part) == 0 for axes in _SIDES)
    return sliding_out(scene, view) if hidden else None


def _before(scene: Scene, front: Mover, whole: Box) -> bool:
    """Whether a front is about as large as a tub, and close before it."""
    for axes in _SIDES:
        panel, tub = scene.boxes[front.pieces[0]].turned(axes), whole.turned(axes)
        within = (panel.lower < tub.center)[:2].all() and (tub.center < panel.upper)[:2].all()
        large = (tub.size[:2] > _FRONT_SHARE * panel.size[:2]).all()
        if within and large and abs(panel.lower[2] - tub.upper[2]) < _FRONT:
            return True
    return False


def _comes_out(scene: Scene, axes: FloatArray, pieces: tuple[int, ...], taken: Set[int]) -> bool:
    """Whether nothing is before a drawer but what moves."""
    box = Box.around([scene.boxes[i] for i in pieces]).turned(axes)
    starts = np.tile(box.center, (9, 1))
    starts[:, 0] += np.linspace(-0.4, 0.4, 9) * box.size[0]
    starts[:, 2] = box.upper[2]
    labels, _ = cast(scene, axes, starts, _OUTWARD, (*pieces, *taken))
    return bool((labels >= 0).mean() < 0.5)


def _covered(scene: Scene, piece: int, taken: Set[int]) -> bool:
    """Whether something that does not move is above a tub."""
    box = scene.boxes[piece]
    points = grid(box, 6, 0.7)
    starts = np.column_stack([points, np.full(len(points), box.upper[2] + TOUCH)])
    return bool((first_met(scene, starts, _UP, [piece, *taken])[0] >= 0).mean() > _COVERED)


def _front(scene: Scene, contacts: Contacts, axes: FloatArray, piece: int, used: Set[int]) -> list[int]:
    """What is before a tub and touches it, or touches that: its front and its handle."""
    boxes = [box.turned(axes) for box in scene.boxes]
    tub = boxes[piece]
    before = [
        i
        for i, box in enumerate(boxes)
        if i != piece
        and i not in used
        and box.center[2] > tub.upper[2] - TOUCH
        and box.upper[2] < tub.upper[2] + _FRONT
        and box.lies_in(tub, _FRONT)
    ]
    on = hanging_on({piece}, before, lambda i, j: contacts.within(i, j, TOUCH))
    return [i for i in before if i in on]
