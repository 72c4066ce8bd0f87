"""Spray arms: level bars within a cavity, held at their middles alone, as dishwashers wash with."""

from __future__ import annotations

from collections.abc import Sequence, Set

import numpy as np

from simart_kit.arrays import FloatArray, IntArray

from .candidates import Choice, spin
from .casting import first_met
from .contact import Contacts, smallest_distance
from .movers import Mover
from .scene import FACINGS, Box, Scene
from .views import View

SPRAY_ARMS = ("spray", "sprayer", "sprinkler")
_BAR = 0.25  # of its length, most of an arm's width
_HELD = 0.12  # of its length, how far from its middle what holds it may be
_TOUCH = 0.003  # of the object's diagonal: what is nearer touches
_SHORTEST = 0.2  # of the cavity's lesser width: what is shorter there is a knob or a hook
_DIRECTIONS = 32  # in which the way around is felt
_SKIMS = 0.98  # of half its length, how near to its axis other things may come


def spray_arms(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Level bars that may turn all around on what they are held by, with walls around and above them."""
    body = int(scene.areas.argmax())
    movers = []
    for piece, box in enumerate(scene.boxes):
        if piece in taken or piece == body or not _is_bar(box):
            continue
        holders = contacts.touching(piece, _TOUCH)
        held = bool(holders) and _held_at_middle(scene, box, holders)
        if held and _in_cavity(scene, box, body) and _free(scene, box, piece):
            movers.append(Mover((piece,), "spray_arm", 0.5, ("a level bar in a cavity, held at its middle",)))
    return movers


def whirling(scene: Scene, view: View) -> Choice | None:
    """About the vertical through the middle of a level bar."""
    box = scene.boxes[view.part]
    if not _is_bar(box):
        return None
    turning = spin(view.axes @ FACINGS["top"][2], view.axes @ box.center)
    return turning, 0.7, ("held at its middle, and free all around",)


def _is_bar(box: Box) -> bool:
    """Whether a box is long and narrow, lies level, and is no thicker than it is wide."""
    narrow, long = np.sort(box.size[:2])
    return bool(narrow < _BAR * long and box.size[2] <= narrow)


def _held_at_middle(scene: Scene, bar: Box, holders: Sequence[int]) -> bool:
    """Whether none of the pieces that a bar touches comes near it but at its middle."""
    long = int(bar.size[:2].argmax())
    outer = np.concatenate([np.linspace(-0.5, -_HELD, 12), np.linspace(_HELD, 0.5, 12)])
    points = np.tile(bar.center, (len(outer), 1))
    points[:, long] += outer * bar.size[long]
    above, below = points.copy(), points.copy()
    above[:, 2], below[:, 2] = bar.upper[2], bar.lower[2]
    triangles = scene.triangles[np.isin(scene.labels, holders)]
    return smallest_distance(np.concatenate([above, below]), triangles, 2 * _TOUCH) > _TOUCH


def _in_cavity(scene: Scene, bar: Box, body: int) -> bool:
    """Whether the body has walls on three sides at least and something above, and the bar spans it."""
    passing = np.delete(np.arange(scene.count), body)
    sides = (FACINGS[name][2] for name in ("left", "right", "front", "back", "top"))
    ways = np.array([_nearest(scene, bar.center[None], way, passing) for way in sides])
    walled = np.isfinite(ways[:4]).sum() >= 3 and np.isfinite(ways[4])
    return bool(walled and bar.size.max() > _SHORTEST * min(ways[:2].sum(), ways[2:4].sum()))


def _free(scene: Scene, box: Box, piece: int) -> bool:
    """Whether nothing stands where a bar comes by as it turns all around: a rib of a drum meets its wall."""
    heights = np.linspace(box.lower[2], box.upper[2], 5)[1:-1]
    middle = np.column_stack([np.tile(box.center[:2], (len(heights), 1)), heights])
    angles = 2 * np.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
    ways = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(_DIRECTIONS)])
    held = _HELD * box.size.max()  # nearer to its axis is what holds it
    met = [held + _nearest(scene, middle + held * way, way, [piece]) for way in ways]
    return bool(min(met) > _SKIMS * box.size.max() / 2)


def _nearest(
    scene: Scene, origins: FloatArray, direction: FloatArray, passing: Sequence[int] | IntArray
) -> float:
    return float(first_met(scene, origins, direction, passing)[1].min())
