"""The best of nano's joint candidates for a part whose true joint is known."""

from __future__ import annotations

import numpy as np

from simart_kit.arrays import IntArray, vec3
from simart_kit.bench.articulation import Link, LinkJoint

from ..candidates import SLIDE, Candidates
from ..cloud import Cloud
from ..part_lines import part_lines
from .judging import off


def part_candidates(cloud: Cloud, pieces: IntArray) -> Candidates:
    """The candidates of the part that (K,) pieces are; at least one is, and one is not."""
    return part_lines(cloud, np.isin(cloud.piece, pieces)).found


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
