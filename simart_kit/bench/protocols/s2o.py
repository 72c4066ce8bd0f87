"""S2O's protocol: openable parts found, and of those the motion type, axis and origin that are right."""

from __future__ import annotations

import re
from typing import Any, ClassVar, Literal

import numpy as np

from ...arrays import FloatArray
from ..articulation import Articulation, Link, LinkJoint
from ..cases import Prediction, Truth
from ..metrics.joints import axis_error, line_error, same_coarse_type
from ..metrics.parts import iou_matrix
from ..overlay import overlay
from . import Metric, Protocol, Scores

Openable = Literal["drawer", "door", "lid"]
LEAST_IOU = 0.5
LARGEST_ANGLE = np.deg2rad(5.0)
LARGEST_OFFSET = 0.1  # of the diagonal of the true part's box

_WORDS: dict[str, Openable] = {
    "drawer": "drawer",
    "drawers": "drawer",
    "door": "door",
    "doors": "door",
    "lid": "lid",
    "lids": "lid",
}
_BY_KIND: dict[str, Openable] = {"prismatic": "drawer", "revolute": "door", "continuous": "door"}
# Words of names of moving parts, as in PartNet-Mobility, that are none of the three.
_OTHERS = {"arm", "blade", "button", "caster", "fan", "handle", "handles", "key", "knob", "knobs", "lever"}
_OTHERS |= {
    "pedal",
    "rack",
    "seat",
    "shelf",
    "spout",
    "sprinkler",
    "stem",
    "switch",
    "tray",
    "wheel",
    "wheels",
}
_WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")
_LEVELS = {
    "pd": ("PD", "part detected: same class and IoU of at least 0.5"),
    "m": ("M", "part detected, motion type right"),
    "ma": ("MA", "motion type right, axis within 5 degrees"),
    "mao": ("MAO", "type and axis right, origin within 0.1 of the part's diagonal of the true axis"),
}


def _level_metrics(level: str) -> tuple[Metric, ...]:
    title, text = _LEVELS[level]
    return (
        Metric(f"{level}_f1", f"{title} F1", "higher", f"F1 of this: {text}.", headline=True),
        Metric(f"{level}_precision", f"{title} precision", "higher", f"Hits by predictions: {text}."),
        Metric(f"{level}_recall", f"{title} recall", "higher", f"Hits by truths: {text}."),
        Metric(f"{level}_hits", f"{title} hits", "", f"Number of hits, for micro means: {text}."),
    )


class S2O(Protocol):
    """M, MA and MAO of drawers, doors and lids; PD is the detection that all of them start from.

    Parts are rigid links that move, have a surface and are a drawer, a door or a lid. The class is the last
    of these words in the label, or without one in the name; where a name tells nothing, a slide is a drawer
    and a hinge a door.
    Predictions, the most confident first and then in their order, each take the free true part of their class
    with the largest overlap, if that is at least 0.5 of face area (points, where meshes differ). The sign of
    an axis is ignored, and so is the origin of a slide. Where a part has several true joints, any is right.
    Precision is hits by predictions, recall hits by true parts. A mean over objects is S2O's macro mean; sums
    of hits, predictions and truths give the micro one.
    An object without openable parts for which none is predicted scores 1, where their script has 0 / 0. One
    that failed scores 0.
    """

    name: ClassVar[str] = "s2o"
    version: ClassVar[str] = "1"
    source: ClassVar[str] = "github.com/3dlg-hcvc/s2o, motion_eval.py and opmotion/evaluation/evaluator.py"
    flaws: ClassVar[tuple[str, ...]] = (
        "Classes are told by words: a part that is right but for its word counts as missed and as invented.",
        "Parts that move but are no drawer, door or lid by their words and joints are not counted at all.",
        "Limits and the side to which a part opens are not measured.",
        "S2O knows turning and sliding only: continuous counts as revolute.",
        "A true joint of which nobody said the origin is judged without it.",
        "Matching is greedy, so that the order of predictions can change the score.",
    )
    metrics: ClassVar[tuple[Metric, ...]] = (
        *(metric for level in _LEVELS for metric in _level_metrics(level)),
        Metric("predictions", "Predicted", "", "Number of openable parts predicted."),
        Metric("truths", "True", "", "Number of openable parts in truth."),
    )

    def score(self, truth: Truth | None, prediction: Prediction | None) -> Scores:
        if truth is None or prediction is None:
            count = 0 if truth is None else len(_openables(truth.articulation.rigid()))
            return Scores(_values(dict.fromkeys(_LEVELS, 0), count, 0, failed=True))
        one, two = truth.articulation.rigid(), prediction.articulation.rigid()
        true, predicted = _openables(one), _openables(two)
        pairs = _matched(one, two, true, predicted)
        rows = [_row(one, two, a, b) for a, b in pairs.items()]
        hits = {level: sum(row[level] for row in rows) for level in _LEVELS}
        rows += [
            {"outcome": "missed", "true": one.links[a].name, "class": true[a]} for a in true if a not in pairs
        ]
        rows += [
            {"outcome": "invented", "predicted": two.links[b].name, "class": predicted[b]}
            for b in predicted
            if b not in pairs.values()
        ]
        return Scores(_values(hits, len(true), len(predicted)), tuple(rows))


def openable(link: Link) -> Openable | None:
    """What a link is: by its label, or without one by its name; by the kind of its joint if neither tells.

    The last of the words drawer, door and lid counts. Another label, or a name such as "left_knob", is of a
    part that S2O does not know; names such as "link_3" tell nothing.
    """
    if not link.joint.moves:
        return None
    words = [word.lower() for word in _WORD.findall(link.label or link.name)]
    known = [_WORDS[word] for word in words if word in _WORDS]
    if known:
        return known[-1]
    return None if link.label or _OTHERS & set(words) else _BY_KIND.get(link.joint.kind)


def _openables(articulation: Articulation) -> dict[int, Openable]:
    size = np.bincount(articulation.labels + 1, articulation.weights, len(articulation.links) + 1)[1:]
    found = {i: openable(link) for i, link in enumerate(articulation.links) if size[i] > 0}
    return {i: kind for i, kind in found.items() if kind is not None}


def _matched(
    one: Articulation, two: Articulation, true: dict[int, Openable], predicted: dict[int, Openable]
) -> dict[int, int]:
    """Predicted link by true link: greedy, the most confident prediction first."""
    if not true or not predicted:
        return {}
    laid = overlay(one, two)
    iou = iou_matrix(laid.true_labels, laid.predicted_labels, laid.weights, (len(one.links), len(two.links)))
    pairs: dict[int, int] = {}
    for b in sorted(predicted, key=lambda b: -two.links[b].confidence):
        free = [a for a in true if a not in pairs and true[a] == predicted[b] and iou[a, b] >= LEAST_IOU]
        if free:
            pairs[max(free, key=lambda a: iou[a, b])] = b
    return pairs


def _row(one: Articulation, two: Articulation, a: int, b: int) -> dict[str, Any]:
    true, predicted = one.links[a], two.links[b]
    diagonal = _diagonal(one, a)
    levels = max(_right(joint, predicted.joint, diagonal) for joint in (true.joint, *true.also))
    names = {"outcome": "matched", "true": true.name, "predicted": predicted.name, "class": openable(true)}
    return (
        names | {"pd": 1} | {key: int(right) for key, right in zip(("m", "ma", "mao"), levels, strict=True)}
    )


def _right(true: LinkJoint, predicted: LinkJoint, diagonal: float) -> tuple[bool, bool, bool]:
    """Whether M, MA and MAO hold; each needs the one before."""
    kind = same_coarse_type(true, predicted) == 1.0
    angle = axis_error(true, predicted)
    axis = kind and angle is not None and angle <= LARGEST_ANGLE
    return kind, axis, axis and (not true.turns or true.origin is None or _near(true, predicted, diagonal))


def _near(true: LinkJoint, predicted: LinkJoint, diagonal: float) -> bool:
    offset = line_error(true, predicted)
    return offset is not None and offset < LARGEST_OFFSET * diagonal


def _diagonal(articulation: Articulation, link: int) -> float:
    mine = articulation.labels == link
    points: FloatArray = articulation.vertices if articulation.is_cloud else articulation.triangles
    return float(np.linalg.norm(np.ptp(points[mine].reshape(-1, 3), axis=0)))


def _values(
    hits: dict[str, int], true: int, predicted: int, *, failed: bool = False
) -> dict[str, float | None]:
    nothing = 0.0 if failed or true or predicted else 1.0
    values: dict[str, float | None] = {}
    for level, count in hits.items():
        values |= {
            f"{level}_f1": 2 * count / (true + predicted) if true + predicted else nothing,
            f"{level}_precision": count / predicted if predicted else nothing,
            f"{level}_recall": count / true if true else nothing,
            f"{level}_hits": float(count),
        }
    return values | {"predictions": float(predicted), "truths": float(true)}
