"""Metrics of one predicted joint against the true one. Both are in the same frame and unit.

"The paper" is SIMART (arXiv 2603.23386), section "Metrics". It names Type, Axis and Origin and gives neither
units nor what happens to signs; what is taken here is said at each.
"""

from __future__ import annotations

import numpy as np

from ...arrays import FloatArray, Vec3
from ..articulation import LinkJoint
from ..states import opening, travel

_COARSE = {"continuous": "revolute"}


def same_type(true: LinkJoint, predicted: LinkJoint) -> float:
    """1 when the kinds are equal, else 0 (the paper's Type accuracy, of one joint)."""
    return float(true.kind == predicted.kind)


def same_coarse_type(true: LinkJoint, predicted: LinkJoint) -> float:
    """1 when the kinds are equal with continuous counted as revolute, else 0."""
    return float(_COARSE.get(true.kind, true.kind) == _COARSE.get(predicted.kind, predicted.kind))


def axis_error(true: LinkJoint, predicted: LinkJoint) -> float | None:
    """arccos|u.v| [rad], 0..pi/2: the angle between the lines of two axes (the paper's Axis).

    None where either has no axis. An axis and its opposite are the same line: which way a joint opens is
    asked by `direction_error`.
    """
    if true.axis is None or predicted.axis is None:
        return None
    between = angle(true.axis, predicted.axis)
    return min(between, np.pi - between)


def direction_error(true: LinkJoint, predicted: LinkJoint) -> float | None:
    """Angle between the directions of opening [rad], 0..pi.

    The direction of opening is the axis, turned so that the longer way from rest is positive: axis u with
    limits [0, a] opens like -u with [-a, 0]. None where the true joint opens to no side, as a continuous one;
    nor is it defined where the prediction has no axis or no limits that say a side.
    """
    one, two = opening(true), opening(predicted)
    return None if one is None or two is None else angle(one, two)


def origin_error(true: LinkJoint, predicted: LinkJoint) -> float | None:
    """Distance of the two origins, |p - q| [units] (the paper's Origin: "L2 distance").

    Defined for joints that turn. A correct hinge whose origin sits elsewhere on the same line has an error:
    the annotator's choice enters the number. `line_error` does not have this flaw.
    """
    if not (true.turns and predicted.turns) or true.origin is None or predicted.origin is None:
        return None
    return float(np.linalg.norm(np.subtract(predicted.origin, true.origin)))


def line_error(true: LinkJoint, predicted: LinkJoint) -> float | None:
    """Distance of the predicted origin from the true axis line, |(q - p) x u| [units]; for joints that turn.

    Source: S2O's MAO, which divides it by the part's diagonal; here it stays in units.
    """
    if not (true.turns and predicted.turns) or true.origin is None or predicted.origin is None:
        return None
    assert true.axis is not None
    return float(np.linalg.norm(np.cross(np.subtract(predicted.origin, true.origin), true.axis)))


def range_error(true: LinkJoint, predicted: LinkJoint) -> float | None:
    """| (upper - lower) - (upper' - lower') | [rad | units]; None where the true joint is not `limited`.

    A prediction without travel, or of another kind of movement, has a range of 0.
    """
    if not limited(true):
        return None
    lower, upper = travel(true)
    low, high = travel(predicted) if same_coarse_type(true, predicted) else (0.0, 0.0)
    return abs((upper - lower) - (high - low))


def limits_iou(true: LinkJoint, predicted: LinkJoint) -> float | None:
    """Overlap of the two ranges of travel along the true axis: |A and B| / |A or B|, 0..1.

    The predicted range is turned around where its axis points against the true one. 0 for another kind of
    movement or a prediction without travel; None where the true joint is not `limited`. A continuous
    prediction counts as [-pi, pi].
    """
    if not limited(true):
        return None
    lower, upper = travel(true)
    low, high = travel(predicted)
    if not same_coarse_type(true, predicted) or high <= low:
        return 0.0
    assert true.axis is not None
    assert predicted.axis is not None
    if np.dot(true.axis, predicted.axis) < 0:
        low, high = -high, -low
    both = max(0.0, min(upper, high) - max(lower, low))
    return both / (upper - lower + high - low - both)


def limited(joint: LinkJoint) -> bool:
    """Whether it travels between two limits: a revolute or prismatic joint with a range that is not empty."""
    return joint.kind != "continuous" and travel(joint) != (0.0, 0.0)


def angle(one: Vec3 | FloatArray, two: Vec3 | FloatArray) -> float:
    """Angle between two (3,) unit vectors [rad], exact for small ones where arccos is not."""
    u, v = np.asarray(one), np.asarray(two)
    return float(2 * np.arctan2(np.linalg.norm(u - v), np.linalg.norm(u + v)))
