"""Round things that spin: wheels that stand on the ground, and rows of knobs."""

from __future__ import annotations

from collections.abc import Set
from itertools import pairwise

import numpy as np

from simart_kit.arrays import FloatArray

from .contact import Contacts
from .movers import Mover
from .scene import Scene

_ROUND = 0.03  # how far within the radius a corner still lies on the rim, as a share of it
_LARGEST_GAP = np.deg2rad(50.0)  # between corners of the rim: an octagon is a coarse wheel, a hexagon a nut


def round_axis(points: FloatArray) -> int | None:
    """Axis (0, 1, 2) about which (N, 3) points are a disc: a rim all around, and not a rod."""
    size = np.ptp(points, axis=0)
    center = (points.max(axis=0) + points.min(axis=0)) / 2
    for axis in np.argsort(size):
        across = np.delete(np.arange(3), axis)
        offset = (points - center)[:, across]
        radius = np.hypot(*offset.T)
        rim = offset[radius > (1 - _ROUND) * radius.max()]
        angles = np.sort(np.arctan2(rim[:, 1], rim[:, 0]))
        gaps = np.diff(angles, append=angles[0] + 2 * np.pi)
        if gaps.max() < _LARGEST_GAP and size[axis] < 1.2 * size[across].max():
            return int(axis)
    return None


def is_rod(points: FloatArray, axis: int) -> bool:
    """Whether (N, 3) points are of something round along an axis, however long: a disc when pressed flat."""
    size = np.ptp(points, axis=0)
    scale = np.ones(3)
    scale[axis] = 0.5 * np.delete(size, axis).min() / max(size[axis], 1e-30)
    return round_axis(points * scale) == axis


def wheels(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Discs with a level axis that stand on the ground, at least two of a size, and all within them."""
    ground = scene.box.lower[2]
    found: list[tuple[int, float]] = []
    for piece, box in enumerate(scene.boxes):
        diameter = box.size[2]
        if piece in taken or not 0.02 < diameter < 0.6 or box.lower[2] > ground + 0.02:
            continue
        axis = round_axis(scene.triangles[scene.labels == piece].reshape(-1, 3))
        if axis in (0, 1) and box.size[axis] < 0.8 * diameter:
            found.append((piece, float(diameter)))
    movers: list[Mover] = []
    used: set[int] = set()
    for piece, diameter in found:
        alike = [p for p, d in found if abs(d - diameter) < 0.1 * diameter]
        if len(alike) >= 2 and piece not in used:
            pieces = (piece, *_inside(scene, contacts, piece))
            used.update(pieces)
            movers.append(Mover(pieces, "wheel", 0.7, (f"one of {len(alike)} discs alike on the ground",)))
    return movers


def knobs(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Rows of three or more small discs alike that stick out of a front and are nobody's handle."""
    rounds = []
    for piece, box in enumerate(scene.boxes):
        if piece in taken or not 0.008 < box.size.max() < 0.08:
            continue
        axis = round_axis(scene.triangles[scene.labels == piece].reshape(-1, 3))
        if axis == 1:
            rounds.append(
                (round(float(box.center[2]), 2), round(float(box.size[2]), 3), float(box.center[0]), piece)
            )
    rows: dict[tuple[float, float], list[tuple[float, int]]] = {}
    for height, diameter, place, piece in rounds:
        rows.setdefault((height, diameter), []).append((place, piece))
    movers = []
    for row in rows.values():
        apart = all(b[0] - a[0] > 0.01 for a, b in pairwise(sorted(row)))
        if len(row) >= 3 and apart:
            movers += [Mover((p,), "knob", 0.5, (f"one of {len(row)} discs alike in a row",)) for _, p in row]
    return movers


def _inside(scene: Scene, contacts: Contacts, wheel: int) -> list[int]:
    """Pieces within a wheel's own box: hub, spokes, bolts."""
    outer = scene.boxes[wheel]
    return [
        i
        for i in contacts.touching(wheel, 0.01)
        if (scene.boxes[i].lower >= outer.lower - 0.01).all()
        and (scene.boxes[i].upper <= outer.upper + 0.01).all()
    ]
