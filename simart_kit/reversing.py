"""Joints that open to the other side than was said: blocked the one way, and free the other."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from .asset import Asset, Joint
from .waiting import SMALL, faces_of, free_ranges, stops

# Of the longer way from rest: what goes farther than this to the other side, too, has no side to open to.
_BOTH_WAYS = 0.5


def opening_otherwise(
    asset: Asset, stuck: Iterable[str], least: float, steps: int, seed: int
) -> dict[str, Joint]:
    """Joints by name that are free once they turn, or slide, the other way round.

    What is small is not asked to slide so: a button that does not go in must not come out.

    Args:
        asset: at rest.
        stuck: names of joints with limits that are blocked at once.
        least: share of the wanted travel that is enough to be free.
        steps: stops on the way to each limit.
        seed: of the sampling.
    """
    joints = [joint for joint in map(asset.joint, stuck) if _one_sided(joint)]
    turned = {joint.name: _turned(joint) for joint in joints if joint.turns or _large(asset, joint)}
    if not turned:
        return {}
    free = free_ranges(asset.with_joints(turned), steps, seed)
    return {name: joint for name, joint in turned.items() if not stops(joint, free[name], least)}


def _turned(joint: Joint) -> Joint:
    x, y, z = joint.axis
    return replace(joint, axis=(0.0 - x, 0.0 - y, 0.0 - z))


def _one_sided(joint: Joint) -> bool:
    assert joint.limits is not None
    shorter, longer = sorted((-joint.limits.lower, joint.limits.upper))
    return shorter <= _BOTH_WAYS * longer


def _large(asset: Asset, joint: Joint) -> bool:
    size = np.linalg.norm(np.ptp(asset.mesh.points_of(faces_of(asset, joint.child)), axis=0))
    return bool(size > SMALL * asset.mesh.diagonal)
