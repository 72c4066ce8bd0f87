"""Moving parts of truth and prediction side by side: matched, missed and invented, with their numbers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ...arrays import FloatArray
from ...sweeping import move
from ..articulation import Articulation, Link, LinkJoint
from ..frame import unit_from_object
from ..metrics import joints
from ..metrics.parts import FOUND_IOU, hierarchy, iou_matrix, match
from ..metrics.shape import box_giou, chamfer, chamfer_moved
from ..metrics.voxel_shape import part_grids, voxel_iou
from ..overlay import Overlay, overlay
from ..sampling import Cloud
from ..states import states, way, ways
from .simart_metrics import PartMetric

_THICK = 0.005  # of the object's size


@dataclass(frozen=True, eq=False)
class Pairing:
    """Two objects in the frame in which the true one's longest side is 1, and which parts are the same.

    Attributes:
        truth: rigid bodies; where a part has several right joints, the one that the prediction is nearest to.
        prediction: rigid bodies.
        overlay: samples of both surfaces.
        true_parts: links of the truth that move and have a surface.
        predicted_parts: the same of the prediction.
        link_iou: overlap of every true and every predicted link.
        pairs: indices into `true_parts` and `predicted_parts` that belong together.
    """

    truth: Articulation
    prediction: Articulation
    overlay: Overlay
    true_parts: tuple[int, ...]
    predicted_parts: tuple[int, ...]
    link_iou: FloatArray
    pairs: tuple[tuple[int, int], ...]

    @classmethod
    def of(cls, truth: Articulation, prediction: Articulation) -> Pairing:
        """Bring both to the common frame and match their moving parts."""
        frame = unit_from_object(truth.bounds)
        truth, prediction = truth.rigid().transformed(frame), prediction.rigid().transformed(frame)
        laid = overlay(truth, prediction)
        true_parts, predicted_parts = moving_surfaces(truth), moving_surfaces(prediction)
        shape = (len(truth.links), len(prediction.links))
        iou = iou_matrix(laid.true_labels, laid.predicted_labels, laid.weights, shape)
        pairs = match(iou[np.ix_(true_parts, predicted_parts)])
        links = list(truth.links)
        for a, b in pairs:
            index = true_parts[a]
            links[index] = _nearest_joint(links[index], prediction.links[predicted_parts[b]].joint)
        truth = replace(truth, links=tuple(links))
        return cls(truth, prediction, laid, true_parts, predicted_parts, iou, pairs)

    @property
    def iou(self) -> FloatArray:
        """(T, P) overlap of the moving parts."""
        return self.link_iou[np.ix_(self.true_parts, self.predicted_parts)]

    @property
    def body_iou(self) -> float | None:
        """Overlap of what does not move; None when truth has no such thing."""
        bodies = [
            [i for i, link in enumerate(side.links) if not link.joint.moves]
            for side in (self.truth, self.prediction)
        ]
        if not bodies[0]:
            return None
        return float(self.link_iou[bodies[0][0], bodies[1][0]]) if bodies[1] else 0.0

    @property
    def missed(self) -> tuple[int, ...]:
        """Indices into `true_parts` of those without partner."""
        return tuple(sorted(set(range(len(self.true_parts))) - {a for a, _ in self.pairs}))

    @property
    def invented(self) -> tuple[int, ...]:
        """Indices into `predicted_parts` of those without partner."""
        return tuple(sorted(set(range(len(self.predicted_parts))) - {b for _, b in self.pairs}))

    @cached_property
    def rows(self) -> tuple[dict[str, Any], ...]:
        """A row a part: matched pairs, then missed true parts, then invented ones."""
        matched = [self._pair_row(a, b, same) for (a, b), same in zip(self.pairs, self._parents, strict=True)]
        missed = missed_rows(self._true(a) for a in self.missed)
        invented = [
            {"outcome": "invented", "found": False, **_told("predicted", self._predicted(b))}
            for b in self.invented
        ]
        return (*matched, *missed, *invented)

    def penalised(self, metric: PartMetric) -> float | None:
        """Mean over pairs, missed and invented parts, the latter two with the worst.

        None where truth has no such number, whatever was predicted: two systems that are compared then have
        numbers for the same objects.
        """
        if metric.of_surface and self._sparse:
            return None
        worst = metric.worst * (self.truth.diagonal if metric.is_length else 1.0)

        def entry(value: float | None) -> float:
            if value is None:
                return worst
            return min(value, worst) if metric.is_length else value  # a match is no worse than a miss

        # Rows begin with those of the pairs.
        entries = [
            entry(row[metric.key])
            for (a, _), row in zip(self.pairs, self.rows, strict=False)
            if metric.defined(self._true(a).joint)
        ]
        entries += [worst for a in self.missed if metric.defined(self._true(a).joint)]
        if metric.of_joint is None or entries:
            entries += [worst] * len(self.invented)
        return float(np.mean(entries)) if entries else None

    def matched(self, key: str) -> float | None:
        """Mean over the matched pairs for which a number is defined; None without any."""
        values = [row[key] for row in self.rows if row.get(key) is not None]
        return float(np.mean(values)) if values else None

    def _true(self, a: int) -> Link:
        return self.truth.links[self.true_parts[a]]

    def _predicted(self, b: int) -> Link:
        return self.prediction.links[self.predicted_parts[b]]

    def _pair_row(self, a: int, b: int, same_parent: float) -> dict[str, Any]:
        true, predicted = self._true(a), self._predicted(b)
        i, j = self.true_parts[a], self.predicted_parts[b]
        one, two = self.overlay.truth.of(i), self.overlay.prediction.of(j)
        return {
            "outcome": "matched",
            "found": float(self.link_iou[i, j]) >= FOUND_IOU,
            **_told("true", true),
            **_told("predicted", predicted),
            **_joint_numbers(true.joint, predicted.joint),
            "iou": float(self.link_iou[i, j]),
            "iou_voxel": None if self._sparse else voxel_iou(self._grids[0][i], self._grids[1][j]),
            "cd": chamfer(one, two),
            **_moved_numbers(one, two, [(t[i], p[j]) for t, p in self._states]),
            "hierarchy": same_parent,
        }

    @property
    def _sparse(self) -> bool:
        """Whether one is a cloud, whose points leave cells of its surface empty."""
        return self.truth.is_cloud or self.prediction.is_cloud

    @cached_property
    def _grids(self) -> tuple[Any, Any]:
        return part_grids(self.truth), part_grids(self.prediction)

    @cached_property
    def _states(self) -> list[tuple[FloatArray, FloatArray]]:
        going = [[way(link.joint) for link in side.links] for side in (self.truth, self.prediction)]
        for a, b in self.pairs:
            i, j = self.true_parts[a], self.predicted_parts[b]
            going[0][i], going[1][j] = ways(self._true(a).joint, self._predicted(b).joint)
        return list(zip(states(self.truth, going[0]), states(self.prediction, going[1]), strict=True))

    @cached_property
    def _parents(self) -> list[float]:
        true = _moving_parents(self.truth, self.true_parts)
        predicted = _moving_parents(self.prediction, self.predicted_parts)
        return hierarchy(true, predicted, self.pairs)


def missed_rows(links: Iterable[Link]) -> list[dict[str, Any]]:
    """The rows of true parts without partner."""
    return [{"outcome": "missed", "found": False, **_told("true", link)} for link in links]


def moving_surfaces(articulation: Articulation) -> tuple[int, ...]:
    """Links that move and have a surface; others, as abstract links of a chain are, cannot be seen."""
    size = np.bincount(articulation.labels + 1, articulation.weights, len(articulation.links) + 1)[1:]
    return tuple(i for i in articulation.moving if size[i] > 0)


def _joint_numbers(true: LinkJoint, predicted: LinkJoint) -> dict[str, float | None]:
    error = joints.range_error(true, predicted)
    return {
        "type": joints.same_type(true, predicted),
        "type_coarse": joints.same_coarse_type(true, predicted),
        "axis": joints.axis_error(true, predicted),
        "direction": joints.direction_error(true, predicted),
        "origin": joints.origin_error(true, predicted),
        "origin_line": joints.line_error(true, predicted),
        "limits_iou": joints.limits_iou(true, predicted),
        "range_turn": error if true.turns else None,
        "range_slide": None if true.turns else error,
    }


def _moved_numbers(
    one: Cloud, two: Cloud, poses: Sequence[tuple[FloatArray, FloatArray]]
) -> dict[str, float]:
    overlaps = [
        box_giou(_bounds(move(posed_T_true, one.points)), _bounds(move(posed_T_predicted, two.points)))
        for posed_T_true, posed_T_predicted in poses
    ]
    distance = float(np.mean(chamfer_moved(one, two, poses)))
    return {"articulated_cd": distance, "articulated_giou": float(np.mean(overlaps))}


def _bounds(points: FloatArray) -> FloatArray:
    """Their box, grown a little, so that that of a flat part has a volume."""
    return np.stack([points.min(axis=0) - _THICK, points.max(axis=0) + _THICK])


def _moving_parents(articulation: Articulation, parts: Sequence[int]) -> list[int]:
    """For each of `parts`, the index in `parts` of the next one that carries it; -1 for the body."""
    place = {link: index for index, link in enumerate(parts)}
    parents = []
    for link in parts:
        above = articulation.links[link].parent
        while above >= 0 and above not in place:
            above = articulation.links[above].parent
        parents.append(place.get(above, -1))
    return parents


def _nearest_joint(link: Link, predicted: LinkJoint) -> Link:
    """The link with the one of its joints that the prediction comes nearest to."""

    def distance(joint: LinkJoint) -> tuple[float, float, float]:
        axis, line = joints.axis_error(joint, predicted), joints.line_error(joint, predicted)
        return (
            -joints.same_type(joint, predicted),
            np.pi if axis is None else axis,
            np.inf if line is None else line,
        )

    return replace(link, joint=min((link.joint, *link.also), key=distance))


def _told(side: str, link: Link) -> dict[str, str]:
    return {side: link.name, f"{side}_kind": link.joint.kind}
