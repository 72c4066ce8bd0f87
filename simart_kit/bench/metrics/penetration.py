"""Penetration: how much of an object passes through itself while its joints travel."""

from __future__ import annotations

import numpy as np

from ...arrays import FloatArray
from ...sweeping import Sweep
from ..articulation import Articulation
from ..states import motion, way

STOPS = 12
"""Steps on the way from rest to an end."""


def penetration(articulation: Articulation, seed: int = 0) -> float | None:
    """Share of surface that passes through other surface on the way of a joint, mean over joints.

    Formula: mean over links l with travel of max over ends e of s(l, e). For s, the link and all that it
    carries go from rest to the end, the rest of the object at rest; it is the number of sampled points, of
    either surface, that have gone through the other one and deeper than 0.3 % of the moving surface's size,
    per point sampled on the moving surface, at most 1. Points that lie inside of the other surface at rest
    are not sampled: what is let into something, as a hinge is, may move there. Faces without a link belong
    to the rest of the object.

    Unit: share, 0..1; 0 is best.
    Source: what AOR, the overlap ratio of sibling boxes of CAGE and SINGAPO, is a proxy of, on surfaces.

    Args:
        articulation: in any frame and unit.
        seed: of the sampling.

    Returns:
        None where nothing with a surface moves, and for a point cloud, which has no surface.
    """
    if articulation.is_cloud:
        return None
    shares = [_share(articulation, link, seed) for link in articulation.moving]
    known = [share for share in shares if share is not None]
    return float(np.mean(known)) if known else None


def _share(articulation: Articulation, link: int, seed: int) -> float | None:
    """Of one link, s at its worse end; None where it has no travel or no face."""
    joint = articulation.links[link].joint
    moving = np.isin(articulation.labels, articulation.carried(link))
    ends = [end for end in way(joint) if end != 0.0]
    if not ends or not moving.any():
        return None
    sweep = Sweep(articulation.vertices, articulation.faces[moving], articulation.faces[~moving], seed)

    def posed(position: float) -> FloatArray:
        return motion(joint, position)

    shares = [sweep.blocked(posed, end * np.arange(1, STOPS + 1) / STOPS).max() for end in ends]
    return min(float(max(shares)), 1.0)
