"""Parts of two objects matched by their means, and what Particulate's evaluation measures of each pair."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import FloatArray
from ...sweeping import move
from ..metrics.shape import box_giou, box_iou, chamfer_squared
from .particulate_clouds import PartClouds

BOX_POINTS = 2048
_SAME_MOTION = 1e-12


@dataclass(frozen=True, eq=False)
class Pairs:
    """Which parts belong together, and their numbers by state.

    Attributes:
        true: the true object.
        predicted: the predicted one.
        pairs: indices into the parts of each.
    """

    true: PartClouds
    predicted: PartClouds
    pairs: tuple[tuple[int, int], ...]

    @classmethod
    def of(cls, true: PartClouds, predicted: PartClouds) -> Pairs:
        """Match parts one to one, so that the distances of the means of their points have the least sum.

        Matching the other way round gives the same pairs, and other parts without partner.
        """
        from scipy.optimize import linear_sum_assignment
        from scipy.spatial.distance import cdist

        rows, columns = linear_sum_assignment(cdist(true.means, predicted.means))
        return cls(true, predicted, tuple((int(a), int(b)) for a, b in zip(rows, columns, strict=True)))

    @cached_property
    def tables(self) -> dict[str, FloatArray]:
        """(K, 1 + S) chamfer, giou and mIoU of each pair, at rest and in every state."""
        return {
            "chamfer": self._table(self._chamfer),
            "giou": self._table(self._giou),
            "mIoU": np.array([self._box_ious(a, b) for a, b in self.pairs]),
        }

    @cached_property
    def whole(self) -> list[float]:
        """(1 + S) squared chamfer distance of all points, at rest and in every state."""
        motions = np.concatenate([self.true.poses, self.predicted.poses], axis=1)
        return _measured(
            motions, lambda state: chamfer_squared(self.true.posed(state), self.predicted.posed(state))
        )

    def punished(self, values: Sequence[float] | FloatArray, worst: float) -> float:
        """Mean over true and mean over predicted parts, averaged; `worst` for each part without partner.

        Args:
            values: (K,) of the pairs.
            worst: of a part without partner.
        """
        counts = (len(self.true.parts), len(self.predicted.parts))
        sides = [(float(np.sum(values)) + worst * (count - len(values))) / count for count in counts]
        return sum(sides) / 2

    def _table(self, measure: Callable[[int, int, FloatArray], float]) -> FloatArray:
        return np.array([self._over_states(a, b, measure) for a, b in self.pairs])

    def _over_states(self, a: int, b: int, measure: Callable[[int, int, FloatArray], float]) -> list[float]:
        """(1 + S) of what depends only on how the predicted part has moved against the true one."""
        i, j = self.true.parts[a], self.predicted.parts[b]
        motions = np.linalg.inv(self.true.poses[:, i]) @ self.predicted.poses[:, j]
        return _measured(motions, lambda state: measure(a, b, motions[state]))

    def _chamfer(self, a: int, b: int, true_T_predicted: FloatArray) -> float:
        return chamfer_squared(self.true.part_points[a], self.predicted.part_points[b], true_T_predicted)

    def _giou(self, a: int, b: int, true_T_predicted: FloatArray) -> float:
        one, two = bounds(self.true.part_points[a]), bounds(self.predicted.part_points[b])
        return moved_giou(one, two, true_T_predicted)

    def _box_ious(self, a: int, b: int) -> list[float]:
        one, two = self.true.part_points[a], self.predicted.part_points[b]
        i, j = self.true.parts[a], self.predicted.parts[b]
        return [
            box_iou(bounds(move(posed_T_true, one)), bounds(move(posed_T_predicted, two)))
            for posed_T_true, posed_T_predicted in zip(
                self.true.poses[:, i], self.predicted.poses[:, j], strict=True
            )
        ]


def moved_giou(true_box: FloatArray, predicted_box: FloatArray, true_T_predicted: FloatArray) -> float:
    """Generalised IoU of two boxes, IoU - (enclosing - union) / enclosing, of which one has moved.

    The overlap is estimated from `BOX_POINTS` points in each box; the enclosing volume is that of the boxes
    at rest, as Particulate's evaluation has it. Exact where neither moves against the other.

    Args:
        true_box: (2, 3) lower and upper corner at rest.
        predicted_box: (2, 3) the same.
        true_T_predicted: (4, 4) motion of the predicted box, seen from the true one.

    Returns:
        -1 for boxes that both lie flat in one plane, of which there is none: Particulate's for what is NaN.
    """
    enclosing = float(
        np.prod(np.maximum(true_box[1], predicted_box[1]) - np.minimum(true_box[0], predicted_box[0]))
    )
    if not enclosing > 0:
        return -1.0
    if _alike(true_T_predicted, np.eye(4)):
        return box_giou(true_box, predicted_box)
    one, two = (float(np.prod(box[1] - box[0])) for box in (true_box, predicted_box))
    spread = np.random.default_rng(0).random((BOX_POINTS, 3))
    there = move(np.asarray(np.linalg.inv(true_T_predicted)), _fill(true_box, spread))
    here = move(true_T_predicted, _fill(predicted_box, spread))
    both = (one * _share_within(predicted_box, there) + two * _share_within(true_box, here)) / 2
    union = one + two - both
    return (both / union if union > 0 else 0.0) - (enclosing - union) / enclosing


def bounds(points: FloatArray) -> FloatArray:
    """(2, 3) lower and upper corner of (N, 3) points."""
    return np.stack([points.min(axis=0), points.max(axis=0)])


def _fill(box: FloatArray, spread: FloatArray) -> FloatArray:
    return np.asarray(box[0] + spread * (box[1] - box[0]))


def _share_within(box: FloatArray, points: FloatArray) -> float:
    return float(((points >= box[0]) & (points <= box[1])).all(axis=1).mean())


def _measured(motions: FloatArray, measure: Callable[[int], float]) -> list[float]:
    """The measure by index of each motion; motions that are alike are measured once."""
    result: list[float] = []
    for index, motion in enumerate(motions):
        before = next((k for k in range(index) if _alike(motion, motions[k])), None)
        result.append(measure(index) if before is None else result[before])
    return result


def _alike(one: FloatArray, two: FloatArray) -> bool:
    return bool(np.abs(one - two).max() <= _SAME_MOTION)
