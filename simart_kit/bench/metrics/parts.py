"""Metrics of which parts were found: overlap, matching, precision and recall, hierarchy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import FloatArray, IntArray

LEAST_IOU = 0.05
"""Overlap below which two parts are not taken for each other."""
FOUND_IOU = 0.5
"""Overlap from which a part counts as found, for precision and recall."""


@dataclass(frozen=True)
class Detection:
    """How well moving parts were found.

    Attributes:
        precision: share of predicted parts that are found ones; 1 when nothing was predicted and nothing is.
        recall: share of true parts that were found.
        f1: harmonic mean of both.
    """

    precision: float
    recall: float
    f1: float


def iou_matrix(
    true_labels: IntArray, predicted_labels: IntArray, weights: FloatArray, shape: tuple[int, int]
) -> FloatArray:
    """(T, P) intersection over union of every true and every predicted link, |A and B| / |A or B|.

    Args:
        true_labels: (K,) link of each sample, -1 for none.
        predicted_labels: (K,) the same of the prediction.
        weights: (K,) what each sample counts for, such as the area of a face.
        shape: number of true and of predicted links. Links without a sample overlap nothing.
    """
    columns = shape[1] + 1  # one more of each, for label -1
    keys = (true_labels.astype(np.int64) + 1) * columns + predicted_labels + 1
    table = np.bincount(keys, weights, (shape[0] + 1) * columns).reshape(-1, columns)
    both = table[1:, 1:]
    either = table.sum(axis=1)[1:, None] + table.sum(axis=0)[None, 1:] - both
    return np.asarray(np.divide(both, either, out=np.zeros(shape), where=either > 0))


def match(iou: FloatArray, least: float = LEAST_IOU) -> tuple[tuple[int, int], ...]:
    """One-to-one pairs (true, predicted) with the largest sum of overlaps; those below `least` are none.

    Hungarian assignment on 1 - IoU.
    """
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(1.0 - iou)
    return tuple((int(a), int(b)) for a, b in zip(rows, columns, strict=True) if iou[a, b] >= least)


def detection(iou: FloatArray, pairs: Sequence[tuple[int, int]], threshold: float = FOUND_IOU) -> Detection:
    """Precision, recall and F1 of (T, P) parts: a pair is a hit from `threshold` on.

    Nothing to find and nothing predicted is right: all three are 1.
    """
    true, predicted = iou.shape
    hits = sum(float(iou[a, b]) >= threshold for a, b in pairs)
    precision = hits / predicted if predicted else float(not true)
    recall = hits / true if true else float(not predicted)
    return Detection(precision, recall, 2 * hits / (true + predicted) if true + predicted else 1.0)


def hierarchy(
    true_parents: Sequence[int], predicted_parents: Sequence[int], pairs: Sequence[tuple[int, int]]
) -> list[float]:
    """For each pair, 1 when the predicted parent is the match of the true parent, else 0.

    Args:
        true_parents: parent of each true moving part, as an index of moving parts; -1 for the body.
        predicted_parents: the same of the prediction.
        pairs: (true, predicted) indices of moving parts. The bodies are each other's match.
    """
    matched = dict(pairs) | {-1: -1}
    return [float(matched.get(true_parents[a]) == predicted_parents[b]) for a, b in pairs]
