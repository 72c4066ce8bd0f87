"""The SIMART protocol: the paper's five numbers and what has to be said besides."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from ..cases import Prediction, Truth
from ..execution import execute
from ..metrics.parts import detection
from ..metrics.penetration import penetration
from . import Metric, Protocol, Scores
from .simart_metrics import METRICS, PART_METRICS, WORST, PartMetric
from .simart_pairing import Pairing, missed_rows, moving_surfaces

_CUBE = float(np.sqrt(3.0))  # diagonal of an object of which nothing is known but its longest side


class Simart(Protocol):
    """Type, Axis, Origin, IoU and CD as the paper names them, with the matching that it leaves open.

    Frame: the true object's longest side is 1, the prediction moved alike. Links fixed to each other are one
    part; links without a surface are none. Moving parts are matched one to one (Hungarian, 1 - IoU), pairs
    below IoU 0.05 are dropped. Every number comes twice: over matched parts only, and penalised. The
    penalised mean has an entry for each pair, each missed part and each invented one; the latter two count
    with the worst: type 0, axis pi/2, direction pi, IoU 0, gIoU -1, hierarchy 0, and half the object's
    diagonal for lengths, beyond which no pair is counted either. Truth alone decides which numbers an object
    has: origins need a true joint that turns, and a static object has no axis. One for which nothing is
    predicted has type, IoU, precision, recall and F1 of 1.
    """

    name: ClassVar[str] = "simart"
    version: ClassVar[str] = "1"
    source: ClassVar[str] = "SIMART, arXiv 2603.23386, section Metrics"
    flaws: ClassVar[tuple[str, ...]] = (
        "The paper's Origin compares points: a right hinge whose origin lies elsewhere on its axis has an "
        "error. `origin_line` has none.",
        "The paper gives no unit, matching or penalty, so that its table can only be compared roughly.",
    )
    metrics: ClassVar[tuple[Metric, ...]] = METRICS

    def score(self, truth: Truth | None, prediction: Prediction | None) -> Scores:
        if truth is None:
            return Scores(_worst(_CUBE, PART_METRICS))
        if prediction is None:
            return _failed(truth)
        pairing = Pairing.of(truth.articulation, prediction.articulation)
        values: dict[str, float | None] = {}
        for metric in PART_METRICS:
            values[metric.key] = pairing.penalised(metric)
            values[f"{metric.key}_matched"] = pairing.matched(metric.key)
        if not pairing.true_parts and not pairing.predicted_parts:
            values |= _RIGHTLY_STATIC
        found = detection(pairing.iou, pairing.pairs)
        simulated, reason = _simulated(prediction, static=not pairing.true_parts)
        values |= {
            "range_turn_matched": pairing.matched("range_turn"),
            "range_slide_matched": pairing.matched("range_slide"),
            "body_iou": pairing.body_iou,
            "precision": found.precision,
            "recall": found.recall,
            "f1": found.f1,
            "penetration": penetration(pairing.prediction),
            **simulated,
        }
        return Scores({m.key: values[m.key] for m in METRICS}, pairing.rows, reason)


# What a static object gets for which nothing is predicted; what is asked of joints is not defined.
_RIGHTLY_STATIC = {
    "type": 1.0,
    "type_coarse": 1.0,
    "iou": 1.0,
    "iou_voxel": 1.0,
    "cd": 0.0,
    "articulated_cd": 0.0,
    "articulated_giou": 1.0,
    "hierarchy": 1.0,
}


def _simulated(prediction: Prediction, static: bool) -> tuple[dict[str, float | None], tuple[str, ...]]:
    """Executability, and why not; not defined for a prediction that is no simulator's file."""
    if prediction.simulator_file is None:
        return dict.fromkeys(("loads", "settles", "travels", "executable")), ()
    run = execute(prediction.simulator_file)
    idle = not static and not run.joints
    values: dict[str, float | None] = {
        "loads": float(run.loads),
        "settles": float(run.settles),
        "travels": 0.0 if idle else run.travels,
        "executable": float(run.executable and not idle),
    }
    return values, (f"not executable: {run.reason}",) if run.reason else ()


def _failed(truth: Truth) -> Scores:
    """The worst of every number that the object has; its parts are missed."""
    rigid = truth.articulation.rigid()
    parts = [rigid.links[i] for i in moving_surfaces(rigid)]
    defined = [
        m
        for m in PART_METRICS
        if (m.of_joint is None or any(m.defined(part.joint) for part in parts))
        and not (m.of_surface and rigid.is_cloud)
    ]
    return Scores(_worst(_relative_diagonal(truth), defined), tuple(missed_rows(parts)))


def _worst(diagonal: float, defined: Sequence[PartMetric]) -> dict[str, float | None]:
    """The worst of some numbers of parts and of all others; those of matched parts are not defined."""
    lengths = {m.key for m in PART_METRICS if m.is_length}
    left_out = {m.key for m in PART_METRICS} - {m.key for m in defined}
    return {
        m.key: WORST[m.key] * (diagonal if m.key in lengths else 1.0)
        if m.key in WORST and m.key not in left_out
        else None
        for m in METRICS
    }


def _relative_diagonal(truth: Truth) -> float:
    """Diagonal of the object when its longest side is 1."""
    side = float(np.ptp(truth.articulation.bounds, axis=0).max())
    return truth.articulation.diagonal / side if side > 0 else _CUBE
