"""Wheels on a fused skin, which is rough: rims are not quite circles, and a wheel is of several pieces."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import replace

import numpy as np

from .contact import Contacts
from .movers import Mover
from .rough_discs import Disc, rim_share, rough_disc
from .scene import Box, Scene

_LEAST, _MOST = 0.03, 0.6  # diagonals across a wheel
_GROUND = 0.03  # diagonals above the ground up to which it stands there
_SAME = 0.15  # share of their diameter by which wheels may differ
THICK, _THIN = 1.1, 0.8  # of its diameter that a wheel is thick at most, and one of two
_ROLLS = 3  # so many thick ones there are at least
_LARGE = 0.08  # diagonals, the radius of a wheel whose other one is looked for
_RIM = 0.65  # share of a rim of several pieces that is found: a fork or a fender hides some
_ASIDE = 0.3  # of its diameter that what is within the rim of a wheel may be beside it along the axle
_WITHIN = 1.05  # radii within which all of that lies


def skin_wheels(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Two or more discs alike with a level axle that stand on the ground, each with all that is within it."""
    found = _standing(scene, taken)
    found += _in_pieces(scene, [disc for _, disc in found], taken)
    movers: list[Mover] = []
    used = set(taken)
    for piece, disc in found:
        alike = [other for _, other in found if _alike(disc, other)]
        if piece in used or len(_places(alike)) < (_ROLLS if _is_thick(disc) else 2):
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
        disc = rough_disc(scene.points_of(piece), THICK) if able else None
        if disc is not None and disc.axis != 2:
            found.append((piece, disc))
    return sorted(found, key=lambda item: -item[1].radius)


def _in_pieces(scene: Scene, known: Sequence[Disc], taken: Set[int]) -> list[tuple[int, Disc]]:
    """The other one of a large wheel, as high, where it is of several pieces none of which is round."""
    alone = [
        disc
        for disc in known
        if disc.radius > _LARGE and all(not _alike(disc, other) for other in known if _apart(disc, other))
    ]
    for disc in alone:
        along = 1 - disc.axis
        for piece, box in enumerate(scene.boxes):
            for middle in (box.lower[along] + disc.radius, box.upper[along] - disc.radius):
                place = _at(disc, along, float(middle), box)
                if piece not in taken and _apart(disc, place) and _is_round(scene, place, taken):
                    return [(piece, place)]
    return []


def _at(disc: Disc, along: int, middle: float, box: Box) -> Disc:
    """A disc like another, elsewhere along the ground, and as thick as a box."""
    center = disc.center.copy()
    center[along], center[disc.axis] = middle, box.center[disc.axis]
    return replace(disc, center=center, ends=np.array([box.lower[disc.axis], box.upper[disc.axis]]))


def _is_round(scene: Scene, disc: Disc, taken: Set[int]) -> bool:
    """Whether the pieces within a disc are its rim."""
    faces = scene.faces_of(tuple(_within(scene, disc, taken)))
    offset = scene.triangles[faces].reshape(-1, 3) - disc.center
    return rim_share(np.delete(offset, disc.axis, axis=1), disc.radius) > _RIM


def _is_thick(disc: Disc) -> bool:
    return bool(np.ptp(disc.ends) > _THIN * 2 * disc.radius)


def _alike(one: Disc, other: Disc) -> bool:
    return one.axis == other.axis and abs(one.radius - other.radius) < _SAME * one.radius


def _places(discs: Sequence[Disc]) -> list[Disc]:
    """Those that are not about the middle of one before them: the faces of one wheel."""
    kept: list[Disc] = []
    for disc in discs:
        if all(_apart(disc, other) for other in kept):
            kept.append(disc)
    return kept


def _apart(one: Disc, other: Disc) -> bool:
    return bool(np.linalg.norm(one.center - other.center) > one.radius)


def _within(scene: Scene, disc: Disc, used: Set[int]) -> list[int]:
    """Pieces that lie within the rim, and nearly so along the axle: faces, tread, hub and spokes."""
    across = [other for other in range(3) if other != disc.axis]
    aside = _ASIDE * 2 * disc.radius
    low, high = scene.bounds[:, 0] - disc.center, scene.bounds[:, 1] - disc.center
    reach = np.maximum(-low, high)[:, across]
    able = (reach < _WITHIN * disc.radius).all(axis=1)
    able &= scene.bounds[:, 0, disc.axis] >= disc.ends[0] - aside
    able &= scene.bounds[:, 1, disc.axis] <= disc.ends[1] + aside
    found = []
    for piece in np.flatnonzero(able).tolist():
        off = scene.points_of(piece)[:, across] - disc.center[across]
        if piece not in used and np.hypot(*off.T).max() < _WITHIN * disc.radius:
            found.append(piece)
    return found
