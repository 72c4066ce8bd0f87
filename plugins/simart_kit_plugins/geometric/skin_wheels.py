"""Wheels on a fused skin, which is rough: rims are not quite circles, and a wheel is of several pieces."""

from __future__ import annotations

from collections.abc import Sequence, Set

import numpy as np

from .contact import Contacts
from .movers import Mover
from .rough_discs import Disc, rough_disc
from .scene import Scene

_LEAST, _MOST = 0.03, 0.6  # diagonals across a wheel
_GROUND = 0.03  # diagonals above the ground up to which it stands there
_SAME = 0.15  # share of their diameter by which wheels may differ
_ASIDE = 0.3  # of its diameter that what is within the rim of a wheel may be beside it along the axle
_WITHIN = 1.05  # radii within which all of that lies


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
