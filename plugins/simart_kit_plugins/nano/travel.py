"""Travel for joints of which the network says none, or both ways: of small parts, its numbers are noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit import Limits

from .proposals import Proposal

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh
    from simart_kit.arrays import FloatArray

_LEAST = {"revolute": np.deg2rad(1.0), "prismatic": 0.05}  # [rad], and of the part's extent along the axis
_OPEN, _PRESSED = np.pi / 2, 0.5  # [rad], and of that extent
_BUTTONS = ("button", "key")
_SMALL = 0.1  # of the object's diagonal: smaller things are pressed in, larger ones pulled out


def with_travel(mesh: Mesh, proposals: Sequence[Proposal]) -> list[Proposal]:
    """The proposals, with usual limits where theirs are next to nothing, and buttons that only go in.

    A quarter turn; half of its length for what slides, small things towards the middle of the object and
    others away from it. What is called a button goes that way alone, as far as it would go either way.

    Args:
        mesh: of the faces.
        proposals: the network's.
    """
    return [
        replace(p, joint=_moving(mesh, p.joint, mesh.triangles[p.faces].reshape(-1, 3), p.guess.label))
        for p in proposals
    ]


def _moving(mesh: Mesh, joint: Joint, points: FloatArray, label: str) -> Joint:
    """A joint of a part with these (N, 3) points and this label."""
    if joint.limits is None:
        return joint
    extent = float(np.ptp(points @ np.array(joint.axis)))
    little = joint.limits.upper - joint.limits.lower <= _LEAST[joint.kind] * (1.0 if joint.turns else extent)
    small = float(np.linalg.norm(np.ptp(points, axis=0))) < _SMALL * mesh.diagonal
    button = small and not joint.turns and label in _BUTTONS
    if not little and not button:
        return joint
    if joint.turns:
        return replace(joint, limits=Limits(0.0, _OPEN))
    middle = (points.max(axis=0) + points.min(axis=0)) / 2
    outward = float((middle - mesh.bounds.mean(axis=0)) @ np.array(joint.axis)) > 0
    travel = _PRESSED * extent if little else max(joint.limits.upper, -joint.limits.lower)
    return replace(joint, limits=Limits(-travel, 0.0) if small == outward else Limits(0.0, travel))
