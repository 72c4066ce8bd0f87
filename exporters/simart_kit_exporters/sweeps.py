"""The way of a joint that animations show: from rest to its limits and back."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint
from simart_kit.kinematics import ordered_joints, span

SECONDS = 4.0
"""How long the way of a joint takes [s]."""


def shown_joints(asset: Asset) -> tuple[Joint, ...]:
    """The joints with a way to show, carriers first: those of one axis and some travel."""
    return tuple(joint for joint in ordered_joints(asset) if span(joint) != (0.0, 0.0))


def stops(joint: Joint) -> FloatArray:
    """(S,) positions [rad | m] where a joint turns back, from rest to rest; the upper limit comes first.

    A continuous joint makes one full turn, after which it is where it began.
    """
    lower, upper = span(joint)
    if joint.kind == "continuous":
        return np.array([lower, upper])
    return np.array([0.0, *(limit for limit in (upper, lower) if limit), 0.0])


def stop_times(positions: FloatArray) -> FloatArray:
    """(S,) times [s] at which the stops are reached at even speed; the whole way takes `SECONDS`."""
    way = np.concatenate([[0.0], np.abs(np.diff(positions)).cumsum()])
    return np.asarray(SECONDS * way / way[-1])


def quaternions(joint: Joint, angles: FloatArray) -> FloatArray:
    """(N, 4) unit quaternions x, y, z, w of turns about a joint's axis by (N,) angles [rad].

    They follow each other without a change of sign where angles are less than half a turn apart.
    """
    half = np.asarray(angles)[:, None] / 2
    return np.concatenate([np.sin(half) * np.array(joint.axis), np.cos(half)], axis=1)
