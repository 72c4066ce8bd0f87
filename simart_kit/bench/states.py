"""Poses of an Articulation: which way its joints open, and where that takes its parts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray
from ..kinematics import turned_about
from .articulation import Articulation, LinkJoint, ordered

STATES = 5
_EVEN = 0.1  # ways to both sides that differ by less of the range than this are no direction of opening


def way(joint: LinkJoint) -> tuple[float, float]:
    """Where a joint's travel starts, at the end nearer to rest, and where it ends [rad | units].

    From the lower to the upper end where it goes about as far to both sides; a continuous joint makes a full
    turn. (0, 0) for a joint without travel: limits not said or reversed, or a kind without an axis.
    """
    lower, upper = travel(joint)
    return (upper, lower) if opens_one_way(joint) and -lower > upper else (lower, upper)


def ways(true: LinkJoint, predicted: LinkJoint) -> tuple[tuple[float, float], tuple[float, float]]:
    """The ways of a true joint and of the predicted one, to be compared state by state.

    Each goes its own way where both open to one side. Where one does not, nobody can say at which end it
    starts: then the prediction goes in the direction in which the truth does.
    """
    one, two = way(true), way(predicted)
    if true.axis is None or predicted.axis is None or (opens_one_way(true) and opens_one_way(predicted)):
        return one, two
    alike = float(np.dot(true.axis, predicted.axis)) * (one[1] - one[0])
    lower, upper = travel(predicted)
    return one, (lower, upper) if alike >= 0 else (upper, lower)


def travel(joint: LinkJoint) -> tuple[float, float]:
    """Lowest and highest position [rad | units]; (0, 0) where there is no travel."""
    if joint.kind == "continuous":
        return (-np.pi, np.pi)
    if joint.axis is None or joint.lower is None or joint.upper is None or joint.lower >= joint.upper:
        return (0.0, 0.0)
    return (joint.lower, joint.upper)


def opens_one_way(joint: LinkJoint) -> bool:
    """Whether it travels clearly further to one side of rest than to the other."""
    lower, upper = travel(joint)
    return abs(upper + lower) > _EVEN * (upper - lower)


def opening(joint: LinkJoint) -> FloatArray | None:
    """(3,) unit axis, pointing so that opening is a positive movement; None where it opens to no side."""
    if joint.axis is None or not opens_one_way(joint):
        return None
    lower, upper = travel(joint)
    return np.array(joint.axis) * (1.0 if upper >= -lower else -1.0)


def states(
    articulation: Articulation, joint_ways: Sequence[tuple[float, float]] | None = None, count: int = STATES
) -> list[FloatArray]:
    """Poses evenly along the way of all joints at once: (L, 4, 4) `posed_T_rest` of the links, each.

    Args:
        articulation: what moves.
        joint_ways: (L,) where each joint starts and ends; the default is each joint's own `way`.
        count: how many, the first at the start and the last at the end.
    """
    going = joint_ways or [way(link.joint) for link in articulation.links]
    return [posed(articulation, [a + f * (b - a) for a, b in going]) for f in np.linspace(0.0, 1.0, count)]


def posed(articulation: Articulation, positions: Sequence[float]) -> FloatArray:
    """(L, 4, 4) `posed_T_rest`: moves each link's points to where positions (L,) [rad | units] take them."""
    result = np.tile(np.eye(4), (len(articulation.links), 1, 1))
    for index in ordered(articulation.links):
        link = articulation.links[index]
        own = motion(link.joint, positions[index])
        result[index] = own if link.parent < 0 else result[link.parent] @ own
    return result


def motion(joint: LinkJoint, position: float) -> FloatArray:
    """(4, 4) motion of the child in the object's frame, its parent at rest."""
    matrix = np.eye(4)
    if joint.axis is None or position == 0.0:
        return matrix
    axis = np.array(joint.axis)
    if joint.kind == "prismatic":
        matrix[:3, 3] = axis * position
        return matrix
    return turned_about(axis, np.array(joint.origin or (0.0, 0.0, 0.0)), position)
