"""When each joint moves, and where it then is: the one animation that AR Quick Look plays, over and over."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.asset import Asset, Joint

from ..sweeps import SECONDS, shown_joints, stop_times, stops

FRAMES_A_SECOND = 24
_LONGEST = 10.0  # [s], what Apple advises
_APART = 2.0  # [s] between the starts of two joints: one opens when the other begins to close


def frames(asset: Asset) -> tuple[tuple[Joint, tuple[int, int]], ...]:
    """Every joint that is shown, with the frames at which it leaves and comes back to rest.

    One starts after the other, carriers first, so that each can be watched; where there are many the starts
    are as close as it takes to be done in ten seconds.
    """
    joints = shown_joints(asset)
    apart = min(_APART, (_LONGEST - SECONDS) / max(len(joints) - 1, 1))
    starts = [round(index * apart * FRAMES_A_SECOND) for index in range(len(joints))]
    length = round(SECONDS * FRAMES_A_SECOND)
    return tuple((joint, (start, start + length)) for joint, start in zip(joints, starts, strict=True))


def last_frame(asset: Asset) -> int:
    """Frame at which the last joint is back at rest."""
    return max((end for _, (_, end) in frames(asset)), default=0)


def positions(joint: Joint, count: int) -> FloatArray:
    """(count,) positions [rad | m] at even times, gently started and stopped at every stop."""
    ends = stops(joint)
    times = stop_times(ends)
    now = np.linspace(0.0, SECONDS, count)
    leg = np.clip(np.searchsorted(times, now, side="right") - 1, 0, len(ends) - 2)
    share = (now - times[leg]) / (times[leg + 1] - times[leg])
    eased = share * share * (3.0 - 2.0 * share)
    return np.asarray(ends[leg] + eased * (ends[leg + 1] - ends[leg]))
