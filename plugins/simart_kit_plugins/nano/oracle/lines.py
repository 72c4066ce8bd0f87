"""The best of nano's joint candidates for a part whose true joint is known."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import IntArray, vec3
from simart_kit.bench.articulation import Link, LinkJoint

from ..candidates import SLIDE, Candidates, candidates
from ..cloud import Cloud
from ..evidence import TOUCHING
from .judging import off


def part_candidates(cloud: Cloud, pieces: IntArray) -> Candidates:
    """The candidates of a part.

    Args:
        cloud: of the object.
        pieces: (K,) the pieces that the part consists of, at least one.
    """
    from scipy.spatial import cKDTree

    inside = np.isin(cloud.piece, pieces)
    own, rest = cloud.points[inside], cloud.points[~inside]
    gap = np.asarray(cKDTree(rest).query(own)[0])
    return candidates(own, cloud.normals[inside], own[gap < TOUCHING])


def best_joint(found: Candidates, link: Link) -> LinkJoint:
    """The candidate that comes nearest to one of a link's true joints, with that one's kind.

    A joint without an axis needs no candidate and is returned as it is.
    """
    tries = [
        (off(true, said), number, said)
        for number, true in enumerate((link.joint, *link.also))
        for said in _as_joints(found, true)
    ]
    return min(tries, key=lambda one: one[:2])[2] if tries else link.joint


def _as_joints(found: Candidates, true: LinkJoint) -> list[LinkJoint]:
    """The candidates that may be meant by a true joint: slides, or lines to turn about."""
    if true.axis is None:
        return [true]
    rows = np.flatnonzero((found.source == SLIDE) == (true.kind == "prismatic"))
    return [LinkJoint(true.kind, vec3(found.axis[k]), vec3(found.origin[k])) for k in rows]
