"""How good answers are, against those of held-out records; the metrics are the benchmark's.

Parts are compared by their cells, in the object's cube with edge 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.bench.articulation import LinkJoint
from simart_kit.bench.metrics.joints import axis_error, line_error, same_coarse_type
from simart_kit.bench.metrics.parts import match
from simart_kit.voxels import GridFrame

from ..answer.units import joints_of
from ..answer.values import ObjectAnswer

_CUBE = GridFrame((0.0, 0.0, 0.0), 1.0, 1)


@dataclass(frozen=True)
class Score:
    """Means over records; parts that were missed count as 0 in IoU and type.

    Attributes:
        objects: records that were answered whole.
        complete: share of the answers that came to their end; all of these parse.
        count: share of the objects whose number of parts is right.
        iou: of all parts.
        moving_iou: of parts that move.
        type: share of parts that move whose type is right.
        spurious: parts that move in the answer, but match none, for each object.
        axis: angle between the lines of axes [rad], of parts whose type is right.
        line: distance of the origin from the true axis, of turns [cube edges].
        grounded: answers to questions for one part.
        grounding_iou: of these; None where there are none.
    """

    objects: int
    complete: float
    count: float
    iou: float
    moving_iou: float
    type: float
    spurious: float
    axis: float | None
    line: float | None
    grounded: int = 0
    grounding_iou: float | None = None


@dataclass(frozen=True)
class _Compared:
    """One object."""

    count: bool
    iou: tuple[float, ...]
    moving: tuple[float, ...]
    types: tuple[float, ...]
    spurious: int
    axes: tuple[float, ...]
    lines: tuple[float, ...]


def score(
    true: Sequence[ObjectAnswer],
    predicted: Sequence[ObjectAnswer | None],
    grounding: Sequence[float] = (),
) -> Score:
    """Compare answers; None stands for one that was not completed, and the object counts as one part.

    Args:
        true: of the held-out records.
        predicted: of as many.
        grounding: IoU of parts that were asked for one by one.
    """
    rows = [_compared(t, p) for t, p in zip(true, predicted, strict=True)]
    return Score(
        objects=len(rows),
        complete=_mean([p is not None for p in predicted]) or 0.0,
        count=_mean([row.count for row in rows]) or 0.0,
        iou=_mean([v for row in rows for v in row.iou]) or 0.0,
        moving_iou=_mean([v for row in rows for v in row.moving]) or 0.0,
        type=_mean([v for row in rows for v in row.types]) or 0.0,
        spurious=_mean([row.spurious for row in rows]) or 0.0,
        axis=_mean([v for row in rows for v in row.axes]),
        line=_mean([v for row in rows for v in row.lines]),
        grounded=len(grounding),
        grounding_iou=_mean(grounding),
    )


def cell_iou(one: IntArray, other: IntArray) -> float:
    """Intersection over union of two sets of cells; 0 where both are empty."""
    either = len(np.union1d(one, other))
    return len(np.intersect1d(one, other)) / either if either else 0.0


def _compared(true: ObjectAnswer, predicted: ObjectAnswer | None) -> _Compared:
    if predicted is None:
        missed = (0.0,) * sum(part.type != "fixed" for part in true.parts)
        return _Compared(False, (0.0,) * len(true.parts), missed, missed, 0, (), ())
    overlap = _overlap(true, predicted)
    pairs = dict(match(overlap))
    ours, theirs = _joints(true), _joints(predicted)
    best = [float(overlap[t, pairs[t]]) if t in pairs else 0.0 for t in range(len(true.parts))]
    movers = [t for t, joint in enumerate(ours) if joint.moves]
    right = [t for t in movers if t in pairs and same_coarse_type(ours[t], theirs[pairs[t]])]
    met = {pairs[t] for t in movers if t in pairs}
    spurious = [p for p, joint in enumerate(theirs) if joint.moves and p not in met]
    axes = [axis_error(ours[t], theirs[pairs[t]]) for t in right]
    lines = [line_error(ours[t], theirs[pairs[t]]) for t in right]
    return _Compared(
        count=len(true.parts) == len(predicted.parts),
        iou=tuple(best),
        moving=tuple(best[t] for t in movers),
        types=tuple(float(t in right) for t in movers),
        spurious=len(spurious),
        axes=tuple(v for v in axes if v is not None),
        lines=tuple(v for v in lines if v is not None),
    )


def _overlap(true: ObjectAnswer, predicted: ObjectAnswer) -> FloatArray:
    """(T, P) IoU of cells."""
    rows = [[cell_iou(t.voxels.index, p.voxels.index) for p in predicted.parts] for t in true.parts]
    return np.array(rows)


def _joints(answer: ObjectAnswer) -> list[LinkJoint]:
    """The joint that moves each part, in the cube with edge 1; the root's is fixed."""
    names = [f"part_{number}" for number in range(len(answer.parts))]
    made, _ = joints_of(answer, names, _CUBE)
    by_child = {joint.child: joint for joint in made}
    found = [by_child.get(name) for name in names]
    return [
        LinkJoint("fixed") if joint is None else LinkJoint(joint.kind, joint.axis, joint.origin)
        for joint in found
    ]


def _mean(values: Sequence[float]) -> float | None:
    return float(np.mean(values)) if len(values) else None
