"""What speaks for each joint candidate: numbers that the network weighs."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import BoolArray, FloatArray

from .candidates import SLIDE, SOURCES, Candidates
from .line_places import PLACE_NUMBERS, SIDE, Details, from_lines, line_places
from .ways import WAY_NUMBERS, ways

# Points of a part that a sweep moves, and cells along an edge of the grid of what is in the way.
_SWEPT, _CELLS = 64, 40
# Trial positions: turns [rad], and slides as shares of the part's own extent.
_TURNS = np.deg2rad([-70.0, -15.0, 15.0, 70.0])
_SHIFTS = np.array([-0.8, -0.2, 0.2, 0.8])
# Points of the part this near to the rest touch it.
TOUCHING = 0.02
_PLACES = len(SOURCES) + 2 + 3 + 2 + 3 + 3 + 5
_MOVES = _PLACES + PLACE_NUMBERS
COUNT = _MOVES + 4 + WAY_NUMBERS
# Columns of evidence that tell lengths along x, y and z, places along them, extents in sides of the object,
# moves both ways, and where the sense of the axis leads: all that come before this are weighed together.
ALONG_AXES = (slice(8, 11), slice(13, 16), slice(16, 19))
PLACE = slice(_PLACES + SIDE.start, _PLACES + SIDE.stop)
EXTENTS, BOTH_WAYS, WAY = slice(11, 13), slice(_MOVES, _MOVES + 4), slice(_MOVES + 4, COUNT)


def evidence(
    found: Candidates, part: FloatArray, rest: FloatArray, gap: FloatArray, details: Details
) -> FloatArray:
    """(C, COUNT) of each candidate, all about -1..1.

    Args:
        found: candidates of the part.
        part: (N, 3) points of the part; the object is in the middle, its longest side is 1.
        rest: (M, 3) points of all else; may be none.
        gap: (N,) from each point of the part to the nearest of the rest, at most 1.
        details: the small pieces of both.
    """
    low, high = part.min(axis=0), part.max(axis=0)
    middle, size = (low + high) / 2, max(float((high - low).max()), 1e-6)
    near = part[gap <= max(TOUCHING, float(np.quantile(gap, 0.02)))]
    contact = near.mean(axis=0)
    slide = (found.source == SLIDE)[:, None]
    offset = np.where(slide, 0, from_lines(found, middle))
    to_contact = np.where(slide, 0, from_lines(found, contact))
    radial = part[None] - found.origin[:, None]
    along = np.einsum("cnk,ck->cn", radial, found.axis)
    radius = np.sqrt(np.maximum((radial**2).sum(axis=2) - along**2, 0))
    contact_along = (near - contact) @ found.axis.T
    numbers = [
        np.eye(len(SOURCES))[found.source],
        np.eye(2)[found.frame],
        np.abs(found.axis),
        np.column_stack([np.ptp(along, axis=1), radius.max(axis=1)]),
        np.clip(np.abs(offset) / size, 0, 2),
        np.clip(np.abs(to_contact) / size, 0, 2),
        np.column_stack(
            [
                np.clip(np.linalg.norm(to_contact, axis=1) / size, 0, 2),
                np.ptp(contact_along, axis=0) / size,
                found.misfit,
                radius.std(axis=1) / np.maximum(radius.mean(axis=1), 1e-6),
                offset @ [0, 0, 1] / size,
            ]
        ),
        line_places(found, part, rest, details),
        sweep(found, part, rest),
        ways(found, part, rest, details.grip),
    ]
    return np.concatenate(numbers, axis=1).astype(np.float32)


def sweep(found: Candidates, part: FloatArray, rest: FloatArray) -> FloatArray:
    """(C, 4) share of the part's points that a move drives into the rest, at `_TURNS` or `_SHIFTS`.

    What touches at rest does not count: cells with points of the part, and those beside them, are free.
    """
    chosen = part[np.linspace(0, len(part) - 1, min(_SWEPT, len(part))).astype(np.int64)]
    blocked = _blocked(part, rest)
    radial = chosen[None] - found.origin[:, None]
    along = np.einsum("cnk,ck->cn", radial, found.axis)
    axis = found.axis[:, None]
    straight = along[..., None] * axis
    across, turned = radial - straight, np.cross(axis, radial)
    extent = np.ptp(along, axis=1)[:, None, None]
    slide = (found.source == SLIDE)[:, None, None]
    shares = []
    for turn, shift in zip(_TURNS, _SHIFTS, strict=True):
        moved = straight + np.cos(turn) * across + np.sin(turn) * turned + found.origin[:, None]
        moved = np.where(slide, chosen[None] + shift * extent * axis, moved)
        cells = np.clip(np.floor((moved + 1) * (_CELLS / 2)).astype(np.int64), 0, _CELLS - 1)
        shares.append(blocked[cells[..., 0], cells[..., 1], cells[..., 2]].mean(axis=1))
    return np.stack(shares, axis=1)


def _blocked(part: FloatArray, rest: FloatArray) -> BoolArray:
    """(_CELLS,) * 3 cells of the cube -1..1 that the rest is in, none of them beside the part."""
    free = _cells(part)
    for axis in range(3):
        grid = np.moveaxis(free.copy(), axis, 0)
        along = np.moveaxis(free, axis, 0)
        along[1:] |= grid[:-1]
        along[:-1] |= grid[1:]
    return _cells(rest) & ~free


def _cells(points: FloatArray) -> BoolArray:
    """(_CELLS,) * 3 cells of the cube -1..1 that have a point."""
    grid = np.zeros((_CELLS,) * 3, dtype=np.bool_)
    cells = np.clip(np.floor((points + 1) * (_CELLS / 2)).astype(np.int64), 0, _CELLS - 1)
    grid[tuple(cells.T)] = True
    return grid
