"""What holds a part down and turns about the same pin goes along with it: a stapler's cover, its magazine."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from .asset import Asset, Joint
from .waiting import faces_of, stops, swept

_SAME_WAY = np.cos(np.deg2rad(10.0))
_SAME_PLACE = 0.05  # of the moving part's size


def riding(asset: Asset, stuck: Iterable[str], least: float, steps: int, seed: int) -> dict[str, Joint]:
    """Joints by name of what holds a stuck part down, with that as their parent.

    It turns about the same line, hangs on the same part, moves by itself, and alone is in the way.

    Args:
        asset: at rest.
        stuck: names of joints with limits that are blocked at once.
        least: share of the wanted travel that is enough to be free.
        steps: stops on the way to each limit.
        seed: of the sampling.
    """
    held, found = set(stuck), dict[str, Joint]()
    for joint in map(asset.joint, sorted(held)):
        for other in asset.joints:
            if other.name in held or other.name in found or not _on_one_pin(asset, joint, other):
                continue
            free = swept(asset, joint, {}, faces_of(asset, other.child), steps, seed)
            if not stops(joint, free, least):
                found[other.name] = replace(other, parent=joint.child)
    return found


def _on_one_pin(asset: Asset, joint: Joint, other: Joint) -> bool:
    """Whether two joints of the same parent turn about the same line."""
    if not (joint.turns and other.turns and joint.parent == other.parent and joint.child != other.child):
        return False
    axis, between = np.array(joint.axis), np.subtract(other.origin, joint.origin)
    size = np.linalg.norm(np.ptp(asset.mesh.points_of(faces_of(asset, joint.child)), axis=0))
    same_way = abs(float(axis @ np.array(other.axis))) >= _SAME_WAY
    return bool(same_way and np.linalg.norm(np.cross(between, axis)) <= _SAME_PLACE * size)
