"""Lines in space that show how joints move: an axis with an arc for a turn, an arrow for a slide."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, unit
from ..asset import Joint
from ..kinematics import rotation, span

_ARC_STEP = np.deg2rad(4.0)


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line in the asset frame at rest.

    Attributes:
        points: (N, 3) [m].
        head: whether an arrow head stands at its end.
        tail: whether one stands at its start.
    """

    points: FloatArray
    head: bool = False
    tail: bool = False

    def moved(self, posed_T_rest: FloatArray) -> Stroke:
        """The stroke where the joint's parent takes it."""
        return Stroke(self.points @ posed_T_rest[:3, :3].T + posed_T_rest[:3, 3], self.head, self.tail)


def joint_strokes(joint: Joint, points: FloatArray, size: float) -> tuple[Stroke, ...]:
    """Strokes of a joint; none for kinds without an axis.

    Args:
        joint: any kind.
        points: (N, 3) vertices of what it moves, at rest [m].
        size: of the whole object [m]; strokes are scaled by it.
    """
    if joint.kind == "prismatic":
        return (_slide(joint, points, size),)
    return _turn(joint, points, size) if joint.turns else ()


def _slide(joint: Joint, points: FloatArray, size: float) -> Stroke:
    """From where the part's leading side is at rest, over its travel, and a little on."""
    axis, (lower, upper) = np.array(joint.axis), span(joint)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    along = (points - middle) @ axis
    if upper >= -lower:
        start, end = along.max() + lower, along.max() + upper + 0.08 * size
    else:
        start, end = along.min() + upper, along.min() + lower - 0.08 * size
    return Stroke(middle + np.outer([start, end], axis), head=True, tail=_both_ways(lower, upper))


def _turn(joint: Joint, points: FloatArray, size: float) -> tuple[Stroke, Stroke]:
    """The axis, a little longer than the part, and the way of a point of the part about its middle."""
    axis, origin = np.array(joint.axis), np.array(joint.origin)
    along = (points - origin) @ axis
    low, high = along.min() - 0.06 * size, along.max() + 0.06 * size
    across = points - origin - np.outer(along, axis)
    center = origin + axis * (low + high) / 2
    radius = min(0.55 * float(np.linalg.norm(across, axis=1).max()), 0.3 * size)
    side = across.mean(axis=0)
    if np.linalg.norm(side) < 0.2 * radius:  # a part that turns about its middle: an arc around its end
        side = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
        center, radius = origin + axis * (high - 0.02 * size), max(radius, 0.05 * size)
    lower, upper = span(joint) if joint.limits else (0.0, 5 / 3 * np.pi)
    angles = np.linspace(lower, upper, max(2, int(np.ceil((upper - lower) / _ARC_STEP)) + 1))
    if upper < -lower:
        angles = angles[::-1]
    start = radius * unit(side)
    arc = center + np.stack([rotation(axis * angle) @ start for angle in angles])
    moves = upper - lower > 1e-3
    axis_line = Stroke(origin + np.outer([low, high], axis))
    return axis_line, Stroke(arc, head=moves, tail=moves and _both_ways(lower, upper))


def _both_ways(lower: float, upper: float) -> bool:
    """Whether the shorter way from rest is worth an arrow head: a third of the longer one."""
    return min(-lower, upper) > max(-lower, upper) / 3
