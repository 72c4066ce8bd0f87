"""Blades alike, evenly around a hub, as of fans and propellers: they turn together about its axis."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from simart_kit.arrays import FloatArray

from .candidates import Choice, spin
from .contact import Contacts
from .movers import Mover
from .scene import Scene
from .views import View

ROTORS = ("rotor", "blades", "propeller", "impeller")
_ALIKE = 0.02  # how much blades differ, as a share of what is measured
_MOST = 12  # blades
_EVEN = 0.1  # how much angles between them differ, as a share of the mean
_ROOT = 0.45  # share of its reach from the axis at which a blade begins, at most: it comes from the hub
_FLAT = 0.5  # a blade's smallest extent, as a share of its middle one
_WIDE = 0.25  # least of its middle extent, as a share of its largest: spokes and arms are narrower
_NARROW, _THIN = 0.06, 0.2  # the same of one that is no thicker than this share of its middle extent
_FULL = 0.4  # least of a blade's area, as a share of both sides of its outline's box: bent wires have less
_WIRE = 0.25  # of a blade's area, at most, that a guard's wires have: they may touch where they should not
_TOUCH = 0.003  # of the object's diagonal: what is nearer touches
_CLEAR = 0.02  # of the object's diagonal, how far from the ground what lies level is: it has no feet
_HUB = 0.5  # share of the blades' reach that the hub has, at most
_OFF = 0.05  # share of their reach that the hub's middle is beside the axis, at most


Line = tuple[FloatArray, FloatArray]
"""A point on it and its unit direction, (3,) each."""


@dataclass(frozen=True, eq=False)
class _Blade:
    """A piece's measures: what all blades of a rotor share, and where it is."""

    piece: int
    points: FloatArray
    center: FloatArray
    measures: FloatArray  # area and three extents


def rotors(scene: Scene, contacts: Contacts, taken: Set[int]) -> list[Mover]:
    """Three or more flat pieces alike, evenly around an axis that runs through a hub, clear of the ground."""
    movers = []
    for group in _alike(scene, taken):
        line = _axis(scene, group)
        if line is None or not _clear(scene, contacts, group, line):
            continue
        hub = _hub(scene, group, line)
        if hub is not None:
            pieces = (hub, *(blade.piece for blade in group))
            movers.append(Mover(pieces, "rotor", 0.8, (f"{len(group)} blades alike, evenly around a hub",)))
    return movers


def _alike(scene: Scene, taken: Set[int]) -> list[list[_Blade]]:
    """Three or more pieces of one area and extents each, but for the largest."""
    body = int(scene.areas.argmax())
    free = [int(piece) for piece in np.argsort(scene.areas) if piece not in taken and piece != body]
    sides = np.sqrt(scene.areas[free])
    begins = np.append(np.flatnonzero(np.diff(sides, prepend=-1.0) > _ALIKE * sides), len(free))
    groups: list[list[_Blade]] = []
    for start, end in pairwise(begins):
        blades = [_blade(scene, piece) for piece in free[start:end]] if end - start >= 3 else []
        left, measures = np.arange(len(blades)), np.array([blade.measures for blade in blades])
        while len(left):
            alike = np.isclose(measures[left], measures[left[0]], rtol=_ALIKE, atol=1e-6).all(axis=1)
            groups += [[blades[i] for i in left[alike]]] if 3 <= alike.sum() <= _MOST else []
            left = left[~alike]
    return groups


def _blade(scene: Scene, piece: int) -> _Blade:
    points = scene.points_of(piece)
    middle = points.mean(axis=0)
    turned = (points - middle) @ np.linalg.svd(points - middle, full_matrices=False)[2].T
    measures = np.array([np.sqrt(scene.areas[piece]), *np.sort(np.ptp(turned, axis=0))])
    return _Blade(piece, points, middle, measures)


def _axis(scene: Scene, group: Sequence[_Blade]) -> Line | None:
    """Point and direction of the axis around which blades stand evenly, and from which they come."""
    centers = np.array([blade.center for blade in group])
    middle = centers.mean(axis=0)
    _, sizes, rows = np.linalg.svd(centers - middle)
    radius = np.linalg.norm(centers - middle, axis=1)
    if sizes[2] > _OFF * sizes[0] or np.ptp(radius) > _EVEN * radius.max():
        return None
    angles = np.sort(np.arctan2((centers - middle) @ rows[1], (centers - middle) @ rows[0]))
    gaps = np.diff(angles, append=angles[0] + 2 * np.pi)
    if np.ptp(gaps) > _EVEN * gaps.mean():
        return None
    for blade in group:
        reach = _reach(blade.points, (middle, rows[2]))
        side, thick, wide, long = blade.measures
        shaped = thick < _FLAT * wide and wide > (_NARROW if thick < _THIN * wide else _WIDE) * long
        if (
            not shaped
            or side**2 < _FULL * 2 * wide * long
            or reach.min() > _ROOT * reach.max()
            or blade.points[:, 2].min() < scene.box.lower[2] + max(_CLEAR * abs(rows[2][2]), _TOUCH)
        ):
            return None
    return middle, rows[2]


def _hub(scene: Scene, group: Sequence[_Blade], line: Line) -> int | None:
    """The piece, around the axis and at the blades' roots, that holds them."""
    axis = line[1]
    reach = max(_reach(blade.points, line).max() for blade in group)
    along = np.concatenate([blade.points @ axis for blade in group])
    found = []
    for piece in set(range(scene.count)) - {blade.piece for blade in group}:
        points = scene.points_of(piece)
        center = (points.max(axis=0) + points.min(axis=0)) / 2
        wide, off = float(_reach(points, line).max()), _reach(center[None], line)[0]
        level = along.min() < center @ axis < along.max()
        if off < _OFF * reach and wide < _HUB * reach and level:
            found.append((wide, piece))
    return max(found)[1] if found else None


def _clear(scene: Scene, contacts: Contacts, group: Sequence[_Blade], line: Line) -> bool:
    """Whether blades touch nothing but each other, wires, and what lies around their axis."""
    own = {blade.piece for blade in group}
    touched = {other for blade in group for other in contacts.touching(blade.piece, _TOUCH)} - own
    held = [piece for piece in touched if scene.areas[piece] > _WIRE * scene.areas[group[0].piece]]
    reach = max(_reach(blade.points, line).max() for blade in group)
    return all(_reach(scene.points_of(piece), line).max() < _HUB * reach for piece in held)


def _reach(points: FloatArray, line: Line) -> FloatArray:
    """(N,) distance of points from a line."""
    return np.asarray(np.linalg.norm(np.cross(points - line[0], line[1]), axis=1))


def about_symmetry(scene: Scene, view: View) -> Choice | None:
    """About the axis of a part that looks alike whichever way it is turned about it, by its spread."""
    of_part = scene.labels == view.part
    areas, centers = scene.face_areas[of_part], scene.triangles[of_part].mean(axis=1)
    middle = np.average(centers, axis=0, weights=areas)
    spread, rows = np.linalg.eigh(np.cov((centers - middle).T, aweights=areas))
    apart = np.diff(spread)
    odd = 0 if apart[1] < _EVEN * apart[0] else 2 if apart[0] < _EVEN * apart[1] else None
    if odd is None:
        return None
    turning = spin(view.axes @ rows[:, odd], view.axes @ middle)
    return turning, 0.8, ("its blades stand evenly around this axis",)
