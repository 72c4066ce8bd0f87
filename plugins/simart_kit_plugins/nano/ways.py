"""Where each candidate takes its part: up, outward, away from what is beside it, to the side of its grip.

A candidate's axis has a sense by chance. Without this nothing tells that a door opens outward, and a button
goes in, and limits would come out the same on both sides of 0.
"""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray, units

from .candidates import SLIDE, Candidates
from .line_places import around, from_lines

WAY_NUMBERS = 5
# Shares of the part's size: around it, what is beside it; how far a grip stands out at most.
_BESIDE, _OUT = 0.2, 0.2


def ways(found: Candidates, part: FloatArray, rest: FloatArray, grip: FloatArray) -> FloatArray:
    """(C, WAY_NUMBERS) of each candidate, -1..1: all change sign with the sense of its axis.

    How far the middle of the part goes up; away from the middle of the object; away from the middle of all
    else, and of what is beside the part; and to the side on which the grip is. Of a slide these are
    directions; of a turn, shares of how far the middle goes beside a turn about the edge of the part.

    Args:
        found: candidates of the part.
        part: (N, 3) points of the part; the object is in the middle, its longest side is 1.
        rest: (M, 3) points of all else; may be none.
        grip: (3,) middle of the part's own small pieces; of the part without any.
    """
    low, high = part.min(axis=0), part.max(axis=0)
    middle, size = (low + high) / 2, max(float((high - low).max()), 1e-6)
    slide = (found.source == SLIDE)[:, None]
    turn = np.cross(units(found.axis), from_lines(found, middle)) / (size / 2)
    way = np.where(slide, units(found.axis), turn)
    beside = around(rest, low, high, _BESIDE * size)
    away = units(np.stack([middle, *(_from_middle(middle, points) for points in (rest, beside))]))
    out = (way @ (grip - middle))[:, None] / (_OUT * size)
    return np.asarray(np.clip(np.concatenate([way[:, 2:], way @ away.T, out], axis=1), -1, 1))


def _from_middle(place: FloatArray, points: FloatArray) -> FloatArray:
    """(3,) from the middle of (N, 3) points to a place; 0 where there are none."""
    return place - points.mean(axis=0) if len(points) else np.zeros(3)
