"""Lids of tubs: what covers the open top of a piece that has walls all around and a floor."""

from __future__ import annotations

from collections.abc import Set

import numpy as np

from .casting import first_met, grid
from .contact import TOUCH, Contacts, hanging_on
from .movers import Mover
from .scene import Box, Scene
from .tubs import enclosing, is_tub

# Lengths are shares of the object's diagonal.
_SMALLEST = 0.15  # a lid is at least this wide and long
_FLAT = 0.7  # thickness of a lid, as a share of its width: vaulted ones are thick
_SAME = 0.1  # share of its width by which a lid's outline may differ from the tub's
_APART = 0.02  # so far a lid may stand above its tub
_INSIDE = 0.25  # share of its depth by which a lid may reach into its tub
_SMALL = 0.25  # of a lid's surface, what hangs on it: handles and hinges
_TAKEN = 0.05  # of the whole surface: what has doors or drawers is no tub


def lids(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """The plate or vault that covers a tub, with what sits on it."""
    if scene.areas[list(taken)].sum() > _TAKEN * scene.areas.sum():
        return []
    able = [
        piece
        for piece, box in enumerate(scene.boxes)
        if piece not in taken and box.size[:2].min() > max(_SMALLEST, box.size[2] / _FLAT)
    ]
    for lid in sorted(able, key=lambda piece: -scene.boxes[piece].lower[2]):
        for tub in range(scene.count):
            on = tub != lid and tub not in taken and _on(scene.boxes[lid], scene.boxes[tub])
            if on and is_tub(scene, tub) and len(enclosing(scene, tub)) < 2 and _seen(scene, lid):
                pieces = (lid, *_mates(scene, contacts, lid, tub, taken))
                return [Mover(pieces, "lid", 0.6, ("covers a tub, open above",))]
    return []


def _on(lid: Box, tub: Box) -> bool:
    """Whether a piece lies on another of about the same outline."""
    off = np.abs(np.array([lid.lower - tub.lower, lid.upper - tub.upper])[:, :2])
    above = lid.lower[2] - tub.upper[2]
    return bool((off < _SAME * tub.size[:2]).all() and -_INSIDE * tub.size[2] < above < _APART)


def _seen(scene: Scene, lid: int) -> bool:
    """Whether most of a lid is seen from above."""
    points = grid(scene.boxes[lid], 8, 0.9)
    starts = np.column_stack([points, np.full(len(points), scene.box.upper[2] + _APART)])
    return bool((first_met(scene, starts, np.array([0, 0, -1.0]))[0] == lid).mean() > 0.5)


def _mates(scene: Scene, contacts: Contacts, lid: int, tub: int, taken: Set[int]) -> list[int]:
    """Small pieces that sit on a lid and not on its tub."""
    near = [
        i
        for i, box in enumerate(scene.boxes)
        if i not in (lid, tub)
        and i not in taken
        and scene.areas[i] < _SMALL * scene.areas[lid]
        and box.center[2] > scene.boxes[lid].lower[2]
        and box.lies_in(scene.boxes[lid], _APART)
    ]
    on = hanging_on({lid}, near, lambda i, j: contacts.within(i, j, TOUCH))
    return [i for i in near if i in on]
