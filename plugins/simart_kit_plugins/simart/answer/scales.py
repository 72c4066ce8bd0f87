"""Metres and radians to the whole numbers of an answer, and back.

Rounding moves a center by at most 0.0025 of the cube's edge along each axis and a limit by half a unit, 0.9
degrees or 0.005 of the edge; it turns a direction by at most 0.41 degrees.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray, Vec3, unit, vec3
from simart_kit.voxels import GridFrame

from .values import AXIS_MAX, CENTER_MAX, SLIDE_MAX, TURN_MAX

_HALF_TURN = 100
"""Whole number that stands for 180 degrees."""
FULL_TURN = 2 * _HALF_TURN
"""A turn whose limits are so far apart has no ends."""

Whole3 = tuple[int, int, int]
Whole2 = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Direction:
    """An axis as whole numbers.

    Attributes:
        axis: (3,) the largest component is 100 in size; the first that is not 0 is positive.
        flipped: whether it points against the direction that was given, so that limits change sign.
    """

    axis: Whole3
    flipped: bool


def edge(frame: GridFrame) -> float:
    """Length of the cube's edge [m]."""
    return frame.voxel_size * frame.resolution


def grid_point(point: Vec3, axis: Vec3 | None, frame: GridFrame) -> Whole3:
    """The grid point of a point, or of its axis where that passes the cube.

    Args:
        point: (3,) [m].
        axis: (3,) unit direction of a line through the point, any point of which would do; None for none.
        frame: the object's cube.
    """
    place = frame.to_grid(np.array(point)) / frame.resolution
    if axis is not None and ((place < 0) | (place > 1)).any():
        place = _nearest_inside(place, np.array(axis))
    return _whole3(np.clip(np.rint(place * CENTER_MAX), 0, CENTER_MAX))


def point_of(center: Whole3, frame: GridFrame) -> Vec3:
    """(3,) the point that a grid point stands for [m]."""
    return vec3(frame.to_world(np.array(center) * (frame.resolution / CENTER_MAX)))


def direction(axis: Vec3) -> Direction:
    """A unit direction as whole numbers, its sign folded into `flipped`."""
    values = np.array(axis)
    rounded = np.rint(values * (AXIS_MAX / np.abs(values).max()))
    flipped = bool(rounded[np.flatnonzero(rounded)[0]] < 0)
    return Direction(_whole3(-rounded if flipped else rounded), flipped)


def unit_of(axis: Whole3) -> Vec3:
    """(3,) unit direction of whole numbers."""
    return vec3(unit(np.array(axis, dtype=np.float64)))


def turn(lower: float, upper: float, flipped: bool) -> Whole2:
    """Limits of a turn [rad] as whole numbers; what no number stands for is cut off."""
    return _limits(lower / math.pi * _HALF_TURN, upper / math.pi * _HALF_TURN, TURN_MAX, flipped)


def slide(lower: float, upper: float, flipped: bool, frame: GridFrame) -> Whole2:
    """Limits of a slide [m] as whole numbers; what no number stands for is cut off."""
    scale = SLIDE_MAX / edge(frame)
    return _limits(lower * scale, upper * scale, SLIDE_MAX, flipped)


def radians(limit: int) -> float:
    """A limit of a turn [rad]."""
    return limit * math.pi / _HALF_TURN


def metres(limit: int, frame: GridFrame) -> float:
    """A limit of a slide [m]."""
    return limit * edge(frame) / SLIDE_MAX


def _limits(lower: float, upper: float, largest: int, flipped: bool) -> Whole2:
    if flipped:
        lower, upper = -upper, -lower
    whole = [int(min(max(round(value), -largest), largest)) for value in (lower, upper)]
    # What moves little has to move all the same: a key of a keyboard.
    if whole == [0, 0] and upper > lower:
        whole = [0, 1] if upper >= -lower else [-1, 0]
    return whole[0], whole[1]


def _nearest_inside(place: FloatArray, axis: FloatArray) -> FloatArray:
    """The point of a line inside the unit cube that is nearest to `place`; where none is, to the middle.

    Args:
        place: (3,) a point of the line.
        axis: (3,) its unit direction.
    """
    along = np.abs(axis) > 1e-9
    ends = np.sort(np.stack([-place[along], 1 - place[along]]) / axis[along], axis=0)
    first, last = float(ends[0].max()), float(ends[1].min())
    outside = ((place < 0) | (place > 1))[~along].any()
    step = float((0.5 - place) @ axis) if outside or first > last else min(max(0.0, first), last)
    return np.asarray(place + step * axis)


def _whole3(values: FloatArray) -> Whole3:
    x, y, z = (int(value) for value in values)
    return (x, y, z)
