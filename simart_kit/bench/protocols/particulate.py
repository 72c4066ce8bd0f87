"""Particulate's protocol: distances and boxes of all parts, at rest and over five states of the joints."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np

from ..articulation import Link
from ..cases import Prediction, Truth
from . import Metric, Protocol, Scores
from .particulate_clouds import part_clouds
from .particulate_pairs import Pairs

_HALF_CUBE = float(np.sqrt(3.0)) / 2
_WORST = {"chamfer": _HALF_CUBE, "giou": -1.0, "mIoU": 0.0}
_TOLD = {
    "chamfer": ("CD", "Mean squared nearest distance of part to part, both ways added [square units]"),
    "giou": ("gIoU", "Generalised IoU of the parts' axis-aligned boxes"),
    "mIoU": ("Box IoU", "IoU of the parts' axis-aligned boxes, not of segments"),
}
_REST, _MOVED = "rest_per_part_avg", "fully_per_part_articulated_avg"
_REST_WHOLE, _MOVED_WHOLE = "rest_overall_chamfer", "fully_articulated_overall_chamfer_distances"


def _part_metrics() -> tuple[Metric, ...]:
    return tuple(
        _part_metric(prefix, key, suffix)
        for suffix in ("", "_nopunish")
        for prefix in (_REST, _MOVED)
        for key in _WORST
    )


def _part_metric(prefix: str, key: str, suffix: str) -> Metric:
    title, text = _TOLD[key]
    when = "at rest" if prefix == _REST else "mean over five states"
    who = "matched parts only" if suffix else "parts without partner punished"
    return Metric(
        key=f"{prefix}_{key}{suffix}",
        title=f"{title} {'rest' if prefix == _REST else 'moved'}{' matched' if suffix else ''}",
        better="lower" if key == "chamfer" else "higher",
        text=f"{text}; {when}; {who}.",
        headline=not suffix,
    )


class Particulate(Protocol):
    """What `evaluate.py` of Particulate measures, under its keys.

    Frame: each object is scaled and moved into [-0.5, 0.5] by its own box; for equal meshes that is one
    transform. 100,000 points each, spread by area. Parts are the rigid links, the body among them; a part too
    small to get a point is none. Parts are matched one to one by the distance of the means of their points.
    A mean is taken over true parts and one over predicted parts, and then the mean of both. A part without
    partner counts with half the diagonal of the predicted cloud, gIoU -1 and box IoU 0; `_nopunish` leaves it
    out. Five states go from the lower to the upper limits of all joints at once, a continuous joint without
    limits from 0 to 2 pi; the truth moves by its own joints and the prediction by those predicted.
    An object that failed, or one side without any part, gets gIoU -1, box IoU 0 and as distance half the
    diagonal of the cube, which no penalty exceeds; `_nopunish` is not defined then.
    """

    name: ClassVar[str] = "particulate"
    version: ClassVar[str] = "1"
    source: ClassVar[str] = "github.com/RuiningLi/particulate, evaluate.py; arXiv 2512.11798"
    flaws: ClassVar[tuple[str, ...]] = (
        "The penalty of a distance is a length, while the distances are squared lengths.",
        "The penalty comes from the predicted cloud: the shape of a prediction changes what its misses cost.",
        "`mIoU` is the IoU of axis-aligned boxes, so that wrong segments with the right extent score 1.",
        "The static body is a part like any other and enters every mean.",
        "`fully_...` are means over the five states, in spite of the name.",
        "gIoU of a moved pair takes the box that encloses the boxes at rest, not the moved ones: "
        "boxes that are equal at rest and move away from each other can keep a gIoU of 1.",
        "Each object is scaled by its own box, so that a wrong size or place of the whole goes unseen.",
        "A pair of boxes that lie flat in one plane has no gIoU and counts with -1, equal or not.",
        "The same movement written with axis and limits turned around is run through backwards, and costs.",
        "Parts without surface are not seen: neither missed nor counted as invented.",
        "Joint type, axis, origin and limits are not measured as such.",
        "Departures: the public script counts the states after the first twice in its mean of gIoU, swaps "
        "the two motions in one of its two directions and boxes the moved clouds in the first state; here "
        "all five count once, and each box moves with its own joints.",
    )
    metrics: ClassVar[tuple[Metric, ...]] = (
        *_part_metrics(),
        Metric(
            _REST_WHOLE,
            "Whole CD rest",
            "lower",
            "Mean squared nearest distance of the whole clouds, both ways added; at rest [square units].",
        ),
        Metric(
            _MOVED_WHOLE,
            "Whole CD moved",
            "lower",
            "Mean squared nearest distance of the whole clouds, both ways added; mean over five states.",
        ),
    )

    def score(self, truth: Truth | None, prediction: Prediction | None) -> Scores:
        if truth is None or prediction is None:
            return Scores(_failed())
        one, two = part_clouds(truth.articulation, prediction.articulation)
        pairs = Pairs.of(one, two)
        values = _failed()
        if pairs.pairs:
            values |= _values(pairs)
        values[_REST_WHOLE] = pairs.whole[0]
        values[_MOVED_WHOLE] = float(np.mean(pairs.whole[1:]))
        links = truth.articulation.rigid().links, prediction.articulation.rigid().links
        return Scores(values, _rows(pairs, *links))


def _values(pairs: Pairs) -> dict[str, float | None]:
    worst = _WORST | {"chamfer": pairs.predicted.diagonal / 2}
    found: dict[str, float | None] = {}
    for key, table in pairs.tables.items():
        for prefix, states in ((_REST, table[:, :1]), (_MOVED, table[:, 1:])):
            punished = float(np.mean([pairs.punished(column, worst[key]) for column in states.T]))
            matched = float(states.mean())
            found[f"{prefix}_{key}"] = punished
            found[f"{prefix}_{key}_nopunish"] = matched
    return found


def _failed() -> dict[str, float | None]:
    """The worst of everything; what is asked of matched parts only is not defined."""
    parts: dict[str, float | None] = {}
    for prefix in (_REST, _MOVED):
        for key, worst in _WORST.items():
            parts |= {f"{prefix}_{key}": worst, f"{prefix}_{key}_nopunish": None}
    return parts | {_REST_WHOLE: _HALF_CUBE, _MOVED_WHOLE: _HALF_CUBE}


def _rows(pairs: Pairs, true: Sequence[Link], predicted: Sequence[Link]) -> tuple[dict[str, Any], ...]:
    """A row a pair, then missed true parts, then invented ones."""
    one = [_told("true", true[i]) for i in pairs.true.parts]
    two = [_told("predicted", predicted[j]) for j in pairs.predicted.parts]
    matched = [
        {"outcome": "matched", **one[a], **two[b], **_numbers(pairs, row)}
        for row, (a, b) in enumerate(pairs.pairs)
    ]
    missed = set(range(len(one))) - {a for a, _ in pairs.pairs}
    invented = set(range(len(two))) - {b for _, b in pairs.pairs}
    return (
        *matched,
        *({"outcome": "missed", **one[a]} for a in sorted(missed)),
        *({"outcome": "invented", **two[b]} for b in sorted(invented)),
    )


def _numbers(pairs: Pairs, row: int) -> dict[str, float | None]:
    found: dict[str, float] = {}
    for key, table in pairs.tables.items():
        found |= {f"{_REST}_{key}": table[row, 0], f"{_MOVED}_{key}": table[row, 1:].mean()}
    return {key: None if np.isnan(value) else float(value) for key, value in found.items()}


def _told(side: str, link: Link) -> dict[str, str]:
    return {side: link.name, f"{side}_kind": link.joint.kind}
