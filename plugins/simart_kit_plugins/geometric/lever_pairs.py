"""Levers in pairs: level bars before and behind a leaf, each held at one end, as handles to pull are not."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray

from .contact import Contacts, hanging_on
from .fronts import meet
from .scene import Box, Scene

_LONG = (0.06, 0.3)  # [m] length of a lever
_LEVEL = 1.5  # least of its length over its height
_NEAR = 0.4  # of how far it stands out of the leaf: what is nearer to the leaf holds it
_HELD = 0.6  # of its length, the most over which it is held
_END = 0.05  # of its length, how far from its end it is held at most
_ALIKE = 0.1  # of their length, how much two levers differ in size and place at most
_EDGE = 0.25  # of the leaf's width, how far from its edge a lever is held at most


def lever_pair(scene: Scene, contacts: Contacts, panel: int, door: Sequence[int]) -> tuple[int, ...]:
    """The pieces of a door's two levers, or nothing.

    Args:
        scene: the pieces.
        contacts: of these.
        panel: the piece that is the door's leaf.
        door: all pieces of the door.
    """
    leaf = scene.boxes[panel]
    normal = int(leaf.size.argmin())
    if normal == 2:
        return ()
    beside: list[list[tuple[int, ...]]] = []
    for side in (-1, 1):
        out = [i for i in door if i != panel and _stands_out(scene.boxes[i], leaf, side)]
        beside.append([one for one in _hanging_together(scene, contacts, out) if _is_lever(scene, one, leaf)])
    for one, other in product(*beside):
        if _mirrored(_box(scene, one), _box(scene, other), normal):
            return tuple(sorted((*one, *other)))
    return ()


def held_at(points: FloatArray, leaf: Box) -> FloatArray:
    """(3,) middle of where (N, 3) points before and behind a leaf hold on to it."""
    near = points[_near(points, leaf)]
    return np.asarray((near.min(axis=0) + near.max(axis=0)) / 2)


def _is_lever(scene: Scene, pieces: tuple[int, ...], leaf: Box) -> bool:
    """Whether pieces beside a leaf are a level bar that only one of its ends holds, near the leaf's edge."""
    box, normal = _box(scene, pieces), int(leaf.size.argmin())
    across = 1 - normal
    long = float(box.size[across])
    if not _LONG[0] < long * scene.size < _LONG[1] or long < _LEVEL * box.size[2]:
        return False
    points = scene.triangles[scene.faces_of(pieces)].reshape(-1, 3)
    held = points[_near(points, leaf), across]
    if np.ptp(held) > _HELD * long:
        return False
    at_end = min(held.min() - box.lower[across], box.upper[across] - held.max()) < _END * long
    middle = (held.min() + held.max()) / 2
    to_edge = min(middle - leaf.lower[across], leaf.upper[across] - middle)
    return bool(at_end and to_edge < _EDGE * leaf.size[across])


def _near(points: FloatArray, leaf: Box) -> BoolArray:
    """(N,) which points of what stands out of a leaf are near it."""
    normal = int(leaf.size.argmin())
    out = np.abs(points[:, normal] - leaf.center[normal]) - leaf.size[normal] / 2
    return np.asarray(out <= max(_NEAR * out.max(), out.min()))


def _stands_out(box: Box, leaf: Box, side: int) -> bool:
    normal = int(leaf.size.argmin())
    beyond = side * (box.center - leaf.center)[normal] > leaf.size[normal] / 2
    return bool(beyond and (box.size < 0.5 * leaf.size.max()).all())


def _hanging_together(scene: Scene, contacts: Contacts, pieces: Sequence[int]) -> list[tuple[int, ...]]:
    left, groups = set(pieces), []
    while left:
        start = min(left)
        group = hanging_on({start}, sorted(left), lambda i, j: meet(contacts, scene.boxes, i, j))
        groups.append(tuple(sorted(group)))
        left -= group
    return groups


def _mirrored(one: Box, other: Box, normal: int) -> bool:
    """Whether two boxes are alike, but for where they are along an axis."""
    off = np.delete(one.center - other.center, normal)
    apart = np.abs([*(one.size - other.size), *off])
    return bool(apart.max() < _ALIKE * one.size.max())


def _box(scene: Scene, pieces: Sequence[int]) -> Box:
    return Box.around([scene.boxes[i] for i in pieces])
