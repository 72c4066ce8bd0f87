"""URDF-Anything's protocol: joints compared by name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..articulation import Articulation, Link, LinkJoint
from ..cases import Prediction, Truth
from ..metrics.joints import axis_error
from . import Metric, Protocol, Scores
from .axis_lines import published_line_distance

LARGEST_ANGLE = 0.25
LARGEST_ORIGIN = 0.05
_LEAST_SIDE = 1e-12
_RATES = ("success", "type_correct", "axis_within", "origin_within")


class UrdfAnything(Protocol):
    """Type, axis, origin and success of joints that have the same name.

    The joints of truth are those that move. Each is compared with the predicted joint of its name; a joint
    without name goes by that of its link, and of predicted joints with one name the last counts. Success:
    type equal, axis within 0.25 rad, and the mean of origin and orientation error within 0.05. Our joints
    carry no orientation of their own, so that error is 0 for all. The unit of length is the true object's
    longest side. The origin error is the distance of the axis lines for a true revolute joint, and that of
    the origins for all others. Where several joints of a part are right, the best comparison counts. A
    missing joint fails everything; errors are means over the joints that were found. Rates are not defined
    for an object without joints, which adds nothing to the published means either.
    """

    name: ClassVar[str] = "urdf-anything"
    version: ClassVar[str] = "1"
    source: ClassVar[str] = "github.com/LZVSDY/URDF-Anything_CODE, scripts/eval_metric.py"
    flaws: ClassVar[tuple[str, ...]] = (
        "Joints are matched by name, so that names of one's own choice fail everything.",
        "Invented joints cost nothing.",
        "The distance of parallel axes is that of one component only: a hinge on the wrong side can have 0.",
        "A continuous joint is judged by the distance of its origin, wherever on the axis it sits.",
        "The origin of a slide counts, although it can be anywhere.",
        "An origin that nobody said is taken for (0, 0, 0).",
        "The sign of the axis and the limits are not measured.",
        "Departure: the published script skips replies that it cannot read, and failing raises its means; "
        "here an object that failed fails all its joints.",
    )
    metrics: ClassVar[tuple[Metric, ...]] = (
        Metric("success", "Success", "higher", "Share of true joints with all three right.", True),
        Metric("type_correct", "Type", "higher", "Share of true joints with the same type.", True),
        Metric(
            "axis_within", "Axis ok", "higher", "Share of true joints with an axis within 0.25 rad.", True
        ),
        Metric("origin_within", "Origin ok", "higher", "Share of true joints with origin within 0.05.", True),
        Metric("axis_angle_error_rad", "Axis error", "lower", "Mean arccos|dot| of found joints [rad]."),
        Metric("origin_xyz_error", "Origin error", "lower", "Mean origin error of found joints [sides]."),
        Metric(
            "origin_combined_error", "Combined", "lower", "Half of origin plus orientation error [sides]."
        ),
        Metric("num_gt_joints", "True", "", "Number of true joints."),
        Metric("num_pred_joints", "Predicted", "", "Number of predicted joints that move."),
        Metric("missing_joints", "Missing", "", "Number of true joints without predicted one."),
    )

    def score(self, truth: Truth | None, prediction: Prediction | None) -> Scores:
        true = () if truth is None else _moving(truth.articulation)
        if truth is None or prediction is None:
            return Scores(_values([None] * len(true), 0, dict.fromkeys(_RATES, 0.0)))
        by_name = {name: link.joint for link in prediction.articulation.links if (name := _name(link))}
        side = max(float(np.ptp(truth.articulation.bounds, axis=0).max()), _LEAST_SIDE)
        found = [_best(link, by_name, side) for link in true]
        predicted = len(_moving(prediction.articulation))
        rows = tuple(_row(link, match) for link, match in zip(true, found, strict=True))
        return Scores(_values(found, predicted, dict.fromkeys(_RATES)), rows)


@dataclass(frozen=True)
class _Comparison:
    """A true joint and the predicted one of its name; lengths in sides of the true object."""

    type_correct: bool
    axis_error: float
    origin_error: float

    @property
    def combined_error(self) -> float:
        """Mean of origin and orientation error; the latter is 0, as joints here have no orientation."""
        return 0.5 * self.origin_error

    @property
    def rates(self) -> dict[str, bool]:
        right = {
            "type_correct": self.type_correct,
            "axis_within": self.axis_error <= LARGEST_ANGLE,
            "origin_within": self.combined_error <= LARGEST_ORIGIN,
        }
        return {"success": all(right.values())} | right


def _moving(articulation: Articulation) -> tuple[Link, ...]:
    return tuple(articulation.links[i] for i in articulation.moving)


def _name(link: Link, joint: LinkJoint | None = None) -> str:
    return (link.joint if joint is None else joint).name or link.name


def _best(link: Link, by_name: dict[str, LinkJoint], side: float) -> _Comparison | None:
    """The comparison that comes nearest to success; None when no right joint has a predicted namesake."""
    found = [
        _compared(joint, by_name[name], side)
        for joint in (link.joint, *link.also)
        if (name := _name(link, joint)) in by_name
    ]
    return max(found, key=lambda c: (*c.rates.values(), -c.axis_error, -c.origin_error), default=None)


def _compared(true: LinkJoint, predicted: LinkJoint, side: float) -> _Comparison:
    if true.axis is None or predicted.axis is None:
        angle: float | None = 0.0 if true.axis == predicted.axis else np.pi / 2
    else:
        angle = axis_error(true, predicted)
    assert angle is not None
    return _Comparison(true.kind == predicted.kind, angle, _origin_error(true, predicted) / side)


def _origin_error(true: LinkJoint, predicted: LinkJoint) -> float:
    """Error of the origin [units]; an origin that nobody said is (0, 0, 0), as in the published script."""
    one, two = (np.array(joint.origin or (0.0, 0.0, 0.0)) for joint in (true, predicted))
    if true.kind == "revolute" and true.axis is not None and predicted.axis is not None:
        return published_line_distance(one, np.array(true.axis), two, np.array(predicted.axis))
    return float(np.linalg.norm(one - two))


def _row(link: Link, match: _Comparison | None) -> dict[str, Any]:
    if match is None:
        return {"outcome": "missed", "true": _name(link), **dict.fromkeys(_RATES, 0)}
    rates = {key: int(right) for key, right in match.rates.items()}
    errors = {"axis_angle_error_rad": match.axis_error, "origin_xyz_error": match.origin_error}
    return {"outcome": "matched", "true": _name(link), **rates, **errors}


def _values(
    found: Sequence[_Comparison | None], predicted: int, without_joints: dict[str, float | None]
) -> dict[str, float | None]:
    matched = [match for match in found if match is not None]
    rates = without_joints
    if found:
        rates = {key: sum(match.rates[key] for match in matched) / len(found) for key in _RATES}
    return {
        **rates,
        "axis_angle_error_rad": _mean([match.axis_error for match in matched]),
        "origin_xyz_error": _mean([match.origin_error for match in matched]),
        "origin_combined_error": _mean([match.combined_error for match in matched]),
        "num_gt_joints": float(len(found)),
        "num_pred_joints": float(predicted),
        "missing_joints": float(len(found) - len(matched)),
    }


def _mean(values: Sequence[float]) -> float | None:
    return float(np.mean(values)) if values else None
