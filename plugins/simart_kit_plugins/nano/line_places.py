"""Where each line runs: on which side of its part, across from what grip, along which hinges, held by what.

Without this the two upright edges of a door would read alike.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray, units

from .candidates import SLIDE, Candidates

PLACE_NUMBERS = 3 + 2 + 1 + 1 + 1 + 2
# Of these numbers, the place beside the part along x, y and z: it turns with the object.
SIDE = slice(0, 3)
# Shares of the part's size: around it, what may hold it; as near to a line, what lies on that.
_AROUND, _ON = 0.1, 0.06
# Sections of a line, each of which is held or not.
_SECTIONS = 8


@dataclass(frozen=True, eq=False)
class Details:
    """The small pieces around a part.

    Attributes:
        grip: (3,) middle of the part's own small pieces, such as a handle; of the part without any.
        hardware: (K, 3) points of small pieces of the rest, such as hinges.
    """

    grip: FloatArray
    hardware: FloatArray


def line_places(found: Candidates, part: FloatArray, rest: FloatArray, details: Details) -> FloatArray:
    """(C, PLACE_NUMBERS) of each candidate, all about -1..1, and 0 where a slide has no such place.

    From the line to the middle of the part (3); how far the grip is on that side, and how far along the line
    (2; of a slide, how far the grip is off it); how far the part's bulk is on that side; how far the rest
    goes on beyond the line; how much of the line the rest lies along; how near small pieces of the rest are,
    and how far apart along it (2). Lengths are shares of the part's size.

    Args:
        found: candidates of the part.
        part: (N, 3) points of the part; the object's longest side is 1.
        rest: (M, 3) points of all else; may be none.
        details: of both.
    """
    low, high = part.min(axis=0), part.max(axis=0)
    middle, size = (low + high) / 2, max(float((high - low).max()), 1e-6)
    slide = found.source == SLIDE
    off = np.where(slide[:, None], 0, from_lines(found, middle)) / size
    away = units(off)
    reach = (details.grip - middle) / size
    along = found.axis @ reach
    beside = np.linalg.norm(reach - along[:, None] * found.axis, axis=1)
    beyond = ((middle - rest) / size @ away.T).max(axis=0, initial=0.0) - np.linalg.norm(off, axis=1)
    held, _, _ = _on_lines(found, part, around(rest, low, high, _AROUND * size), size)
    _, near, apart = _on_lines(found, part, around(details.hardware, low, high, _AROUND * size), size)
    numbers = [
        np.clip(off, -2, 2),
        np.where(slide, beside, away @ reach)[:, None],
        np.abs(along)[:, None],
        (away @ ((part.mean(axis=0) - middle) / size))[:, None],
        np.clip(np.where(away.any(axis=1), beyond, 0), 0, 2)[:, None],
        np.where(slide, 0, held)[:, None],
        np.where(slide, 0, near)[:, None],
        np.where(slide, 0, apart)[:, None],
    ]
    return np.concatenate(numbers, axis=1)


def from_lines(found: Candidates, point: FloatArray) -> FloatArray:
    """(C, 3) from the nearest point of each line to a point."""
    reach = point - found.origin
    axis = units(found.axis)
    return np.asarray(reach - (reach * axis).sum(axis=1, keepdims=True) * axis)


def around(points: FloatArray, low: FloatArray, high: FloatArray, margin: float) -> FloatArray:
    """The (K, 3) points that are in a box or this near it."""
    return points[((points > low - margin) & (points < high + margin)).all(axis=1)]


def _on_lines(
    found: Candidates, part: FloatArray, points: FloatArray, size: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """(C,) each: share of a line's sections that points lie on, how near the nearest is, how far they reach.

    A line is as long as the part along it; nearness is 1 on it and goes to 0; reach is a share of the length.
    """
    none = np.zeros(len(found))
    if not len(points):
        return none, none, none
    own = part @ found.axis.T
    low, extent = own.min(axis=0), np.maximum(np.ptp(own, axis=0), 1e-6)
    place = ((points @ found.axis.T - low) / extent).T
    radial = points[None] - found.origin[:, None]
    straight = np.einsum("cmk,ck->cm", radial, found.axis)
    distance = np.sqrt(np.maximum((radial**2).sum(axis=2) - straight**2, 0)) / size
    distance = np.where((place > -_AROUND) & (place < 1 + _AROUND), distance, np.inf)
    on = distance < _ON
    sections = np.clip((place * _SECTIONS).astype(np.int64), 0, _SECTIONS - 1)
    held = np.mean([(on & (sections == k)).any(axis=1) for k in range(_SECTIONS)], axis=0)
    reach = np.where(on, place, -np.inf).max(axis=1) - np.where(on, place, np.inf).min(axis=1)
    return held, np.exp(-distance.min(axis=1) / _ON), np.clip(reach, 0, 1)
