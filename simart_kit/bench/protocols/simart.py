"""The SIMART protocol: the paper's five numbers and what has to be said besides."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from ..cases import Prediction, Truth
from ..execution import execute
from ..metrics.parts import detection
from ..metrics.penetration import penetration
from . import Metric, Protocol, Scores
from .simart_metrics import METRICS, PART_METRICS, WORST
from .simart_pairing import Pairing

_CUBE = float(np.sqrt(3.0))  # diagonal of an object of which nothing is known but its longest side


class Simart(Protocol):
    """Type, Axis, Origin, IoU and CD as the paper names them, with the matching that it leaves open.

    Frame: the true object's longest side is 1, the prediction moved alike. Links fixed to each other are one
    part; links without a surface are none. Moving parts are matched one to one (Hungarian, 1 - IoU), pairs
    below IoU 0.05 are dropped. Every number comes twice: over matched parts only, and penalised, where the
    mean over true parts and the mean over predicted parts are averaged and a part without partner counts
    with type 0, axis pi/2, direction pi, IoU 0, gIoU -1, and half the object's diagonal for lengths.
    A static object for which nothing is predicted has type, IoU, precision, recall and F1 of 1.
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
        if truth is None or prediction is None:
            return Scores(_failed(_CUBE if truth is None else _relative_diagonal(truth)))
        pairing = Pairing.of(truth.articulation, prediction.articulation)
        values: dict[str, float | None] = {}
        for metric in PART_METRICS:
            values[metric.key] = pairing.penalised(metric)
            values[f"{metric.key}_matched"] = pairing.matched(metric.key)
        if not pairing.true_parts and not pairing.predicted_parts:
            values |= _RIGHTLY_STATIC
        found = detection(pairing.iou, pairing.pairs)
        values |= {
            "range_turn_matched": pairing.matched("range_turn"),
            "range_slide_matched": pairing.matched("range_slide"),
            "body_iou": pairing.body_iou,
            "precision": found.precision,
            "recall": found.recall,
            "f1": found.f1,
            "penetration": penetration(pairing.prediction),
            **_simulated(prediction),
        }
        return Scores({m.key: values[m.key] for m in METRICS}, pairing.rows)


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


def _simulated(prediction: Prediction) -> dict[str, float | None]:
    """Executability; not defined for a prediction that is no simulator's file."""
    if prediction.simulator_file is None:
        return dict.fromkeys(("loads", "settles", "travels", "executable"))
    run = execute(prediction.simulator_file)
    return {
        "loads": float(run.loads),
        "settles": float(run.settles),
        "travels": float(run.travels),
        "executable": float(run.executable),
    }


def _failed(diagonal: float) -> dict[str, float | None]:
    """The worst of everything; what is asked of matched parts only is not defined."""
    lengths = {m.key for m in PART_METRICS if m.is_length}
    return {
        m.key: WORST[m.key] * (diagonal if m.key in lengths else 1.0) if m.key in WORST else None
        for m in METRICS
    }


def _relative_diagonal(truth: Truth) -> float:
    """Diagonal of the object when its longest side is 1."""
    bounds = truth.articulation.bounds
    return truth.articulation.diagonal / max(float(np.ptp(bounds, axis=0).max()), 1e-12)
