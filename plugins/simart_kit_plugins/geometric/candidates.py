"""Joint candidates of a part: slides along its normal, hinges along its edges, spins of round things."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import JointKind

from .views import View

AS_FREE = 0.005  # share of points that may pass through more than about the freest line
_QUARTER = np.pi / 2


@dataclass(frozen=True, eq=False)
class Candidate:
    """A joint that the geometry allows, in (u, v, w) of the part's view.

    Attributes:
        kind: of the joint.
        axis: (3,) unit; positive opens.
        origin: (3,) point on the axis.
        upper: travel to open [rad | share of the diagonal].
        edge: for a hinge, which edge: "left", "right", "bottom" or "top" as seen from outside.
        closed: for a hinge, the angle at which what stands open is closed [rad], at most 0.
    """

    kind: JointKind
    axis: FloatArray
    origin: FloatArray
    upper: float
    edge: str = ""
    closed: float = 0.0


Choice = tuple[Candidate, float, tuple[str, ...]]
"""A joint, how sure it is (0..1), and why."""


def slide(view: View) -> Candidate:
    """Out of the front, by most of its own depth."""
    travel = max(0.8 * view.box.size[2], 0.05) if view.is_box else 0.5 * float(view.body.size[2])
    front = np.array([*view.box.center[:2], view.box.upper[2]])
    return Candidate("prismatic", np.array([0.0, 0.0, 1.0]), front, travel)


def hinges(view: View) -> tuple[Candidate, ...]:
    """About each of the four edges of the front, in the middle of its thickness."""
    box = view.box
    u, v, w = box.center
    if view.is_box:
        w = box.upper[2]
    # Opening moves the far edge outward, along +w: the axis is (far edge - hinge) x w, reversed.
    lines = {
        "left": (np.array([0.0, -1.0, 0.0]), np.array([box.lower[0], v, w])),
        "right": (np.array([0.0, 1.0, 0.0]), np.array([box.upper[0], v, w])),
        "bottom": (np.array([1.0, 0.0, 0.0]), np.array([u, box.lower[1], w])),
        "top": (np.array([-1.0, 0.0, 0.0]), np.array([u, box.upper[1], w])),
    }
    return tuple(
        Candidate("revolute", axis, origin, _QUARTER, edge) for edge, (axis, origin) in lines.items()
    )


def spin(axis: FloatArray, center: FloatArray) -> Candidate:
    """About the axis of something round, without end."""
    return Candidate("continuous", axis, center, 0.0)


def lift(view: View) -> Candidate:
    """Off what it lies on, any way."""
    return Candidate("free", np.array([0.0, 0.0, 1.0]), view.box.center, 0.0)


def at_depth(candidate: Candidate, w: float) -> Candidate:
    """The same hinge, farther out or in."""
    origin = np.array([*candidate.origin[:2], w])
    return Candidate(
        candidate.kind, candidate.axis, origin, candidate.upper, candidate.edge, candidate.closed
    )
