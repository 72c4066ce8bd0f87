"""Travel for joints of which the network says none, or both ways: of small parts, its numbers are noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit import Limits
from simart_kit.rays import Rays

from .proposals import Proposal

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh
    from simart_kit.arrays import FloatArray

_LEAST = {"revolute": np.deg2rad(1.0), "prismatic": 0.05}  # [rad], and of the part's extent along the axis
_OPEN, _PRESSED = np.pi / 2, 0.5  # [rad], and of that extent
_BUTTONS = ("button", "key")
_SMALL = 0.1  # of the object's diagonal: smaller things are pressed in, larger ones pulled out
_BEYOND = 0.002  # of it, from where on it is looked for what is before and behind a small thing
_MIDDLE = np.array([(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)]) / 4  # of how wide it is


def with_travel(mesh: Mesh, proposals: Sequence[Proposal]) -> list[Proposal]:
    """The proposals, with usual limits where theirs are next to nothing, and buttons that only go in.

    A quarter turn; half of its length for what slides, small things into what is behind them, others away
    from the middle of the object. What is called a button goes that way alone, as far as it would either way.

    Args:
        mesh: of the faces.
        proposals: the network's.
    """
    rays = Rays(mesh.vertices, mesh.faces) if any(p.joint.kind == "prismatic" for p in proposals) else None
    return [
        replace(p, joint=_moving(mesh, rays, p.joint, mesh.triangles[p.faces].reshape(-1, 3), p.guess.label))
        for p in proposals
    ]


def _moving(mesh: Mesh, rays: Rays | None, joint: Joint, points: FloatArray, label: str) -> Joint:
    """A joint of a part with these (N, 3) points and this label; without rays, nothing slides."""
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
    away = float((middle - mesh.bounds.mean(axis=0)) @ np.array(joint.axis))
    if small and rays is not None:
        away = _room(rays, points, np.array(joint.axis), mesh.diagonal) or away
    outward = away > 0
    travel = _PRESSED * extent if little else max(joint.limits.upper, -joint.limits.lower)
    return replace(joint, limits=Limits(-travel, 0.0) if small == outward else Limits(0.0, travel))


def _room(rays: Rays, points: FloatArray, axis: FloatArray, diagonal: float) -> float:
    """How much more room a part of (N, 3) points has before it, along a (3,) axis, than behind it [m]."""
    across = np.linalg.svd(axis[None])[2][1:]
    local = points @ np.vstack([axis, across]).T
    low, high = local.min(axis=0), local.max(axis=0)
    seen = (low + high)[1:] / 2 + _MIDDLE * (high - low)[1:]
    free = []
    for way, end in ((1.0, high[0]), (-1.0, low[0])):
        start = (end + way * _BEYOND * diagonal) * axis + seen @ across
        free.append(min(float(np.median(rays.first(start, way * axis)[1])), diagonal))
    return free[0] - free[1]
