"""Seats under lids, as on a toilet: a flat ring on a bowl, and a plate of its outline on that."""

from __future__ import annotations

from collections.abc import Set

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

from .candidates import Choice, hinges
from .casting import first_met, grid
from .contact import TOUCH, Contacts
from .fronts import thin
from .movers import Mover
from .scene import Box, Scene
from .views import View

# Lengths are shares of the object's diagonal.
_SMALLEST = 0.1  # a seat is at least this wide and long
_FLAT = 0.25  # thickness of a seat or lid, as a share of its width
_LONG = 1.08  # times as long as wide, a seat is at least: rims of glasses and plates are round
_SAME = 0.06  # of its width by which a lid's outline may differ from the seat's
_APART = 0.02  # so far a lid may stand above its seat, and a seat above what it lies on
_HOLE = 0.4  # middle of a ring, as a share of its width, in which nothing of it is
_BOWL = 0.25  # depth of the bowl below it, as a share of its width
_CARRIED = 0.03  # share of its rectangle below which the rim of the bowl is
_SMALL = 0.25  # of the surface of a seat or lid, what hangs on it: hinges and buffers
_DOWN = np.array([0.0, 0.0, -1.0])


def seats(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Flat rings that lie on something, each with the plate of its outline that covers it."""
    flat = [
        piece
        for piece, box in enumerate(scene.boxes)
        if box.size[:2].min() > max(_SMALLEST, box.size[2] / _FLAT)
    ]
    found: list[Mover] = []
    for ring in (piece for piece in flat if piece not in taken):
        lid = next((piece for piece in flat if piece != ring and _covers(scene, piece, ring)), None)
        if lid is None or not _is_ring(scene, ring) or _is_ring(scene, lid):
            continue
        if _on_a_bowl(scene, ring, lid):
            pieces = _with_hinges(scene, contacts, ring, {ring, lid})
            found.append(Mover(pieces, "seat", 0.6, ("a ring under a lid",)))
            if lid not in taken:  # a front may have it
                found.append(Mover((lid,), "lid", 0.6, ("covers a ring of its outline",)))
    return found


def turned_up(scene: Scene, view: View) -> Choice | None:
    """A hinge at the back of a part that is a flat ring, or None."""
    if view.facing != "top" or not thin(view.box) or not _is_ring(scene, view.part):
        return None
    back = next(hinge for hinge in hinges(view) if hinge.edge == "top")
    return back, 0.7, ("seats turn up at their back",)


def _covers(scene: Scene, lid: int, ring: int) -> bool:
    """Whether a flat piece lies over another one of the same outline."""
    above, below = scene.boxes[lid], scene.boxes[ring]
    width = below.size[:2].min()
    same = np.abs(np.concatenate([above.lower - below.lower, above.upper - below.upper])[[0, 1, 3, 4]])
    apart = above.lower[2] - below.upper[2]
    long = below.size[:2].max() > _LONG * width
    return bool(long and same.max() < _SAME * width and -above.size[2] < apart < _APART)


def _is_ring(scene: Scene, piece: int) -> bool:
    """Whether rays pass down through the middle of a piece."""
    others = [i for i in range(scene.count) if i != piece]
    labels, _ = _from_above(scene, scene.boxes[piece], _HOLE, others)
    return bool((labels < 0).all())


def _on_a_bowl(scene: Scene, ring: int, lid: int) -> bool:
    """Whether a ring lies on something, which is deep and closed below its hole."""
    box = scene.boxes[ring]
    labels, way = _from_above(scene, box, 0.95, [ring, lid])
    lies = ((labels >= 0) & (way < box.size[2] + 2 * _APART)).mean() > _CARRIED
    labels, way = _from_above(scene, box, _HOLE, [ring, lid])
    deep = (way > box.size[2] + _APART + _BOWL * box.size[:2].min()).mean() > 0.5
    return bool(lies and deep and (labels >= 0).mean() > 0.5)


def _from_above(scene: Scene, box: Box, shrink: float, passing: list[int]) -> tuple[IntArray, FloatArray]:
    """What rays down over a box meet first, and how far below a little above it."""
    points = grid(box, 10, shrink)
    starts = np.column_stack([points, np.full(len(points), box.upper[2] + _APART)])
    return first_met(scene, starts, _DOWN, passing)


def _with_hinges(scene: Scene, contacts: Contacts, piece: int, own: Set[int]) -> tuple[int, ...]:
    """A piece with the small ones that touch it and lie in its outline."""
    box = scene.boxes[piece]
    small = [
        i
        for i in range(scene.count)
        if i not in own
        and scene.areas[i] < _SMALL * scene.areas[piece]
        and scene.boxes[i].lies_in(box, TOUCH)
        and contacts.within(piece, i, TOUCH)
    ]
    return (piece, *small)
