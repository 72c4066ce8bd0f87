"""Wheels on a fused skin, which is rough: rims are not quite circles, and a wheel is of several pieces."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray

from .contact import Contacts
from .movers import Mover
from .scene import Scene

_LEAST, _MOST = 0.03, 0.6  # diagonals across a wheel
_GROUND = 0.03  # diagonals above the ground up to which it stands there
_ROUND = 0.12  # by which its width and height may differ, and its rim be off, as a share of its radius
_RIM, _BINS = 0.75, 24  # share of the ways from its middle in which the rim is found
_WIDE = 0.8  # diameters along the axle
_SAME = 0.15  # share of their diameter by which wheels may differ
_ASIDE = 0.3  # of its diameter that what is within the rim of a wheel may be beside it along the axle
_WITHIN = 1.05  # radii within which all of that lies


@dataclass(frozen=True, eq=False)
class Disc:
    """Something about as high as long, with a rim nearly all around.

    Attributes:
        axis: 0, 1 or 2, of the aligned frame.
        center: (3,) its middle.
        radius: of the rim [diagonals].
        ends: (2,) where it begins and ends along the axis.
    """

    axis: int
    center: FloatArray
    radius: float
    ends: FloatArray


def rough_disc(points: FloatArray) -> Disc | None:
    """The disc that (N, 3) points are of, roughly; None where they are of none."""
    low, high = points.min(axis=0), points.max(axis=0)
    size, center = high - low, (low + high) / 2
    for axis in np.argsort(size).tolist():
        across = [other for other in range(3) if other != axis]
        wide = size[across]
        if wide.max() - wide.min() > _ROUND * wide.max() or size[axis] > _WIDE * wide.max():
            continue
        radius = float(wide.mean()) / 2
        offset = points[:, across] - center[across]
        way = ((np.arctan2(offset[:, 1], offset[:, 0]) / (2 * np.pi) + 0.5) * _BINS).astype(np.int64) % _BINS
        reach = np.zeros(_BINS)
        np.maximum.at(reach, way, np.hypot(*offset.T))
        if (np.abs(reach - radius) < _ROUND * radius).mean() >= _RIM:
            return Disc(int(axis), center, radius, np.array([low[axis], high[axis]]))
    return None


def skin_wheels(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Two or more discs alike with a level axle that stand on the ground, each with all that is within it."""
    found = _standing(scene, taken)
    movers: list[Mover] = []
    used = set(taken)
    for piece, disc in found:
        alike = [other for _, other in found if _alike(disc, other)]
        if piece in used or len(_places(alike)) < 2:
            continue
        pieces = (piece, *_within(scene, disc, used | {piece}))
        used.update(pieces)
        reason = f"one of {len(_places(alike))} discs alike on the ground"
        movers.append(Mover(pieces, "wheel", 0.6, (reason,)))
    return movers


def _standing(scene: Scene, taken: Set[int]) -> list[tuple[int, Disc]]:
    """Discs on the ground, the largest first."""
    ground, found = scene.box.lower[2], []
    for piece, box in enumerate(scene.boxes):
        able = _LEAST < box.size[2] < _MOST and box.lower[2] < ground + _GROUND and piece not in taken
        disc = rough_disc(scene.points_of(piece)) if able else None
        if disc is not None and disc.axis != 2:
            found.append((piece, disc))
    return sorted(found, key=lambda item: -item[1].radius)


def _alike(one: Disc, other: Disc) -> bool:
    return one.axis == other.axis and abs(one.radius - other.radius) < _SAME * one.radius


def _places(discs: Sequence[Disc]) -> list[Disc]:
    """Those that are not about the middle of one before them: the faces of one wheel."""
    kept: list[Disc] = []
    for disc in discs:
        if all(np.linalg.norm(disc.center - other.center) > disc.radius for other in kept):
            kept.append(disc)
    return kept


def _within(scene: Scene, disc: Disc, used: Set[int]) -> list[int]:
    """Pieces that lie within the rim, and nearly so along the axle: faces, tread, hub and spokes."""
    across = [other for other in range(3) if other != disc.axis]
    aside = _ASIDE * 2 * disc.radius
    found = []
    for piece, box in enumerate(scene.boxes):
        low, high = box.lower[disc.axis], box.upper[disc.axis]
        if piece in used or low < disc.ends[0] - aside or high > disc.ends[1] + aside:
            continue
        off = scene.points_of(piece)[:, across] - disc.center[across]
        if np.hypot(*off.T).max() < _WITHIN * disc.radius:
            found.append(piece)
    return found
