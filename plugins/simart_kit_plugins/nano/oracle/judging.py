"""How much of an object's truth a step of the ladder keeps, by the bench's matching and numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.bench.articulation import Articulation, LinkJoint
from simart_kit.bench.metrics.joints import axis_error, line_error, same_type
from simart_kit.bench.metrics.parts import FOUND_IOU
from simart_kit.bench.protocols.simart_pairing import Pairing

MOST_ANGLE, MOST_DISTANCE = float(np.deg2rad(10.0)), 0.05
"""A joint is right whose axis [rad] and line [longest sides of the object] are no farther off."""


@dataclass(frozen=True)
class PartResult:
    """What became of a true moving part.

    Attributes:
        name: of the part.
        kind: of its true joint.
        iou: with the part that it was matched with; 0 where it was missed.
        type: whether the kind of joint is right.
        joint: whether the kind, the axis and, of a turn, the line are.
        axis: angle of the axes as lines [rad]; None where one has none.
        line: distance from the true line [longest sides]; None where one does not turn.
    """

    name: str
    kind: str
    iou: float = 0.0
    type: bool = False
    joint: bool = False
    axis: float | None = None
    line: float | None = None

    @property
    def kept(self) -> bool:
        """Whether the bench takes it for found."""
        return self.iou >= FOUND_IOU


@dataclass(frozen=True)
class Judged:
    """What became of an object.

    Attributes:
        parts: true moving parts, in their order.
        invented: predicted parts that were not.
    """

    parts: tuple[PartResult, ...]
    invented: int

    @property
    def iou(self) -> float:
        """The bench's penalised IoU: missed and invented parts count with 0."""
        return self._penalised(sum(part.iou for part in self.parts))

    @property
    def type(self) -> float:
        """The bench's penalised Type."""
        return self._penalised(sum(part.type for part in self.parts))

    def _penalised(self, total: float) -> float:
        """Mean of what sums to `total`; 1 where nothing moves and nothing is said to."""
        entries = len(self.parts) + self.invented
        return total / entries if entries else 1.0


def judge(truth: Articulation, said: Articulation) -> Judged:
    """Compare parts and joints; both in one frame."""
    pairing = Pairing.of(truth, said)
    partner = dict(pairing.pairs)
    parts = []
    for number, link in enumerate(pairing.true_parts):
        name, joint = pairing.truth.links[link].name, pairing.truth.links[link].joint
        if number not in partner:
            parts.append(PartResult(name, joint.kind))
            continue
        found = pairing.prediction.links[pairing.predicted_parts[partner[number]]].joint
        parts.append(
            PartResult(
                name,
                joint.kind,
                float(pairing.iou[number, partner[number]]),
                bool(same_type(joint, found)),
                right(joint, found),
                axis_error(joint, found),
                line_error(joint, found),
            )
        )
    return Judged(tuple(parts), len(pairing.invented))


def right(true: LinkJoint, found: LinkJoint) -> bool:
    """Whether a joint is the true one, but for its limits; the object's longest side is 1."""
    return bool(same_type(true, found)) and off(true, found) <= 1.0


def off(true: LinkJoint, found: LinkJoint) -> float:
    """How far off axis and line are, as shares of what is still right; the larger of the two."""
    axis, line = axis_error(true, found), line_error(true, found)
    return max((axis or 0.0) / MOST_ANGLE, (line or 0.0) / MOST_DISTANCE)
