"""Plücker coordinates of a line, in the convention of Particulate's files."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, units


def lines(plucker: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Directions and points of lines.

    A line along l through a point p is stored as (l, m) with the moment m = l x p. Of all points of the line,
    m x l / |l|^2 is the one nearest to the frame's origin. The usual moment is p x l, and so says a text
    that comes with Particulate; its program writes and reads l x p, and that is what its files hold.

    Args:
        plucker: (N, 6); zeros where there is no line.

    Returns:
        (N, 3) unit directions and (N, 3) points; zeros where there is no line.
    """
    direction, moment = plucker[:, :3], plucker[:, 3:]
    squared = np.sum(direction**2, axis=1, keepdims=True)
    points = np.cross(moment, direction) / np.where(squared > 0, squared, 1.0)
    return units(direction), points
