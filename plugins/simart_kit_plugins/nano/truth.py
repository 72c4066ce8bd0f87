"""What the network should say of a made-up object."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import FloatArray, IntArray
from simart_kit.asset import JointKind

from .candidates import SLIDE, Candidates
from .generate.objects import Motion

KINDS: tuple[JointKind, ...] = ("revolute", "continuous", "prismatic", "ball", "free")
# Units of a candidate's error: of its axis [rad] and its line [sides of the object].
_ANGLE, _LINE = np.deg2rad(8.0), 0.03
# Below the first a candidate is right, beyond the last it is not; between, those nearly as good as the best.
_GOOD, _NEARLY, _FAR = 0.3, 1.3, 3.0


@dataclass(frozen=True, eq=False)
class PartTruth:
    """A moving part.

    Attributes:
        kind: index into `KINDS`.
        right: (C,) int8: 1 for candidates that say how it moves, -1 where their axis has the other sense;
            0 for all others. All 0 for ball and free.
        travel: (2,) lower and upper limit about the true axis [rad | sides of the object]; 0 where there are
            none.
        parent: number of the part that carries it, 0 for the body.
        label: what it is called.
    """

    kind: int
    right: IntArray
    travel: FloatArray
    parent: int
    label: str


def right_candidates(found: Candidates, motion: Motion) -> IntArray:
    """(C,) `PartTruth.right` of a motion in the same frame; none is right if even the best is far off."""
    if motion.kind in ("ball", "free"):
        return np.zeros(len(found), dtype=np.int8)
    along = found.axis @ motion.axis
    angle = np.arccos(np.clip(np.abs(along), 0, 1))
    if motion.kind == "prismatic":
        error = np.where(found.source == SLIDE, angle / _ANGLE, np.inf)
    else:
        off = np.linalg.norm(np.cross(motion.origin - found.origin, motion.axis), axis=1)
        error = np.where(found.source != SLIDE, np.maximum(angle / _ANGLE, off / _LINE), np.inf)
    right = (error <= max(_GOOD, _NEARLY * error.min())) & (error < _FAR)
    return np.where(right, np.where(along < 0, -1, 1), 0).astype(np.int8)


def majority(label: IntArray, piece: IntArray, area: FloatArray, count: int, pieces: int) -> IntArray:
    """(S,) the label that most of the area of each piece has.

    Args:
        label: (N,) of the points, 0..count-1.
        piece: (N,) of the points.
        area: (N,) that each stands for.
        count: number of labels.
        pieces: number of pieces.
    """
    table = np.bincount(piece * count + label, area, pieces * count).reshape(pieces, count)
    return np.asarray(table.argmax(axis=1))
