"""A joint from two poses: what turns or slides a body from the one to the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from simart_kit.arrays import FloatArray, vec3
from simart_kit.bench.articulation import LinkJoint

_STILL = 1e-3  # of the size of the object: a movement that nobody sees
_LEAST_TURN = np.radians(0.5)
# Of the mean way: where the ways of points differ by more, the body turns.
_APART = 0.25


@dataclass(frozen=True, eq=False)
class Sweep:
    """A movement of a body.

    Attributes:
        name: of the joint.
        points: (N, 3) of the body at rest.
        low_T_rest: (4, 4) that brings them to the lower end.
        high_T_rest: (4, 4) that brings them to the upper end.
        rest: where it rests, 0..1 of the way.
    """

    name: str
    points: FloatArray
    low_T_rest: FloatArray
    high_T_rest: FloatArray
    rest: float


def joint_of(sweep: Sweep, size: float) -> LinkJoint | None:
    """The joint of a movement; None where it is less than a thousandth of the size of the object."""
    ways = _moved(sweep.points, sweep.high_T_rest) - _moved(sweep.points, sweep.low_T_rest)
    if np.linalg.norm(ways, axis=1).max() < _STILL * size:
        return None
    mean = ways.mean(axis=0)
    high_T_low = sweep.high_T_rest @ np.linalg.inv(sweep.low_T_rest)
    turn = _turn(high_T_low)
    apart = np.linalg.norm(ways - mean, axis=1).max()
    if apart > _APART * np.linalg.norm(mean) and np.linalg.norm(turn) > _LEAST_TURN:
        return _hinge(sweep, high_T_low, turn)
    return _slide(sweep, mean)


def _slide(sweep: Sweep, mean: FloatArray) -> LinkJoint:
    length = float(np.linalg.norm(mean))
    lower, upper = -length * sweep.rest, length * (1 - sweep.rest)
    middle = vec3(sweep.points.mean(axis=0))
    return LinkJoint("prismatic", vec3(mean / length), middle, lower, upper, sweep.name)


def _hinge(sweep: Sweep, high_T_low: FloatArray, turn: FloatArray) -> LinkJoint:
    """The hinge, its point beside the middle of the body."""
    angle = float(np.linalg.norm(turn))
    axis, shift = turn / angle, high_T_low[:3, 3]
    across = shift - axis * (shift @ axis)
    # Along the axis every point will do: what rounding leaves there must not count as an answer.
    point = np.linalg.lstsq(np.eye(3) - high_T_low[:3, :3], across, rcond=1e-6)[0]
    point = point + axis * ((sweep.points.mean(axis=0) - point) @ axis)
    lower, upper = -angle * sweep.rest, angle * (1 - sweep.rest)
    return LinkJoint("revolute", vec3(axis), vec3(point), lower, upper, sweep.name)


def _turn(new_T_old: FloatArray) -> FloatArray:
    """(3,) rotation vector of a similarity."""
    matrix = new_T_old[:3, :3]
    return np.asarray(Rotation.from_matrix(matrix / np.cbrt(np.linalg.det(matrix))).as_rotvec())


def _moved(points: FloatArray, matrix: FloatArray) -> FloatArray:
    return np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3])
