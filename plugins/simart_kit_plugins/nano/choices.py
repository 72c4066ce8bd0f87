"""What the network says of all joints that a part may have, not only of the likeliest."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import JointKind

from .candidates import SLIDE, Candidates, alike
from .truth import KINDS


@dataclass(frozen=True, eq=False)
class Motion:
    """One way that a part may move, in the frame of the cloud.

    Attributes:
        kind: of the joint.
        axis: (3,) unit; positive opens.
        origin: (3,) a point on it.
        lower, upper: limits [rad | sides of the object]; 0 where the kind has none.
        confidence: chance of kind and line together; 0..1.
    """

    kind: JointKind
    axis: FloatArray
    origin: FloatArray
    lower: float
    upper: float
    confidence: float


@dataclass(frozen=True, eq=False)
class Choices:
    """Of one part.

    Attributes:
        kinds: (K,) chances, by `KINDS`.
        right: (C,) chance of each candidate.
        travel: (C, 2) limits about each: turns [rad], slides [sides of the object].
        found: the candidates.
    """

    kinds: FloatArray
    right: FloatArray
    travel: FloatArray
    found: Candidates

    def best(self) -> Motion:
        """The likeliest kind, and about what it goes."""
        return next(self.ranked(KINDS[int(self.kinds.argmax())]))

    def ranked(self, kind: JointKind) -> Iterator[Motion]:
        """All candidates of a kind, the likeliest first."""
        chance = self.right * ((self.found.source == SLIDE) == (kind == "prismatic"))
        # Several candidates may say the same: their chances add up.
        together = chance @ alike(self.found) / max(chance.sum(), 1e-9)
        order = np.argsort(-(chance * together), kind="stable")
        for row in order[chance[order] > 0].tolist() or order[:1].tolist():
            yield self._motion(kind, row, float(together[row]))

    def _motion(self, kind: JointKind, row: int, together: float) -> Motion:
        lower, upper = self.travel[row].tolist()
        axis = self.found.axis[row]
        if -lower > upper:  # positive opens
            axis, lower, upper = -axis, 0.0 - upper, 0.0 - lower
        limited = kind in ("revolute", "prismatic")
        sure = float(self.kinds[KINDS.index(kind)]) * (together if kind not in ("ball", "free") else 1.0)
        return Motion(
            kind,
            axis,
            self.found.origin[row],
            min(lower, 0.0) if limited else 0.0,
            max(upper, 0.0) if limited else 0.0,
            sure,
        )
