"""Answers against the truth, in the columns of the paper's ablation; parts are compared as decoded voxels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.arrays import BoolArray
from simart_kit.bench.metrics.parts import match
from simart_kit.bench.metrics.voxel_shape import voxel_iou
from simart_kit.bench.reconstruction import score_reconstruction

from ..answer.values import CENTER_MAX, ObjectAnswer, PartAnswer
from ..codec import TokenModel, decode_tokens
from ..tokens import TokenGrid

_TURNS = ("revolute", "hinge")


@dataclass(frozen=True)
class Truth:
    """A held-out object.

    Attributes:
        answer: its parts.
        voxels: (P, 64, 64, 64) bool, of each part.
    """

    answer: ObjectAnswer
    voxels: BoolArray


@dataclass(frozen=True)
class RowScore:
    """Means over all true parts of all objects; a part that was missed counts.

    Parts are matched by their cells, which every row can learn before its codes.

    Attributes:
        objects: answered.
        complete: share of the answers that ended within the limit; all parts of the others are missed.
        type: share of the parts that move whose type is right; a missed part's is not.
        center: distance of the two centres, of parts that turn and are said to [edge of the cube]; None where
            there are none.
        centers: their number.
        iou: of voxels, 0 for a missed part.
        cell_iou: of cells that hold a voxel, 0 for a missed part.
        cd: chamfer distance of the voxels' middles, not squared; that of an empty grid for a missed part,
            half the cube's diagonal [edge of the cube].
    """

    objects: int
    complete: float
    type: float
    center: float | None
    centers: int
    iou: float
    cell_iou: float
    cd: float


@dataclass(frozen=True)
class _Part:
    """A true part, compared with what it was matched with."""

    right: float | None
    center: float | None
    iou: float
    cell_iou: float
    cd: float


def scored(
    truths: Sequence[Truth], given: Sequence[ObjectAnswer | None], codec: TokenModel, grid: TokenGrid
) -> RowScore:
    """Score answers.

    Args:
        truths: of the objects, at least one.
        given: as many; None for one that did not end.
        codec: decodes their codes.
        grid: whose cells parts are matched by.
    """
    parts = [
        part
        for truth, answer in zip(truths, given, strict=True)
        for part in _compared(truth, answer, codec, grid)
    ]
    centers = [part.center for part in parts if part.center is not None]
    right = [part.right for part in parts if part.right is not None]
    return RowScore(
        objects=len(truths),
        complete=float(np.mean([answer is not None for answer in given])),
        type=float(np.mean(right)) if right else 0.0,
        center=float(np.mean(centers)) if centers else None,
        centers=len(centers),
        iou=float(np.mean([part.iou for part in parts])),
        cell_iou=float(np.mean([part.cell_iou for part in parts])),
        cd=float(np.mean([part.cd for part in parts])),
    )


def _compared(truth: Truth, answer: ObjectAnswer | None, codec: TokenModel, grid: TokenGrid) -> list[_Part]:
    found = answer.parts if answer else ()
    voxels = decode_tokens(codec, [part.voxels for part in found])
    ours = [grid.occupied_cells(part) for part in truth.voxels]
    theirs = [grid.occupied_cells(part) for part in voxels]
    overlap = np.array([[voxel_iou(a, b) for b in theirs] for a in ours]).reshape(len(ours), len(theirs))
    pairs = dict(match(overlap)) if found else {}
    nothing = np.zeros_like(truth.voxels[0])
    compared = []
    for number, part in enumerate(truth.answer.parts):
        place = pairs.get(number)
        other, decoded = (None, nothing) if place is None else (found[place], voxels[place])
        shape = score_reconstruction(truth.voxels[number], decoded)
        cells = 0.0 if place is None else float(overlap[number, place])
        compared.append(_Part(_right(part, other), _center(part, other), shape.iou, cells, shape.cd))
    return compared


def _right(part: PartAnswer, other: PartAnswer | None) -> float | None:
    """Whether the type is right; None for a part that does not move."""
    if part.type == "fixed":
        return None
    return float(other is not None and other.type == part.type)


def _center(part: PartAnswer, other: PartAnswer | None) -> float | None:
    """Distance of the centres [edge of the cube]; None unless both turn."""
    if other is None or part.type not in _TURNS or other.type not in _TURNS:
        return None
    if part.motion is None or other.motion is None:
        return None
    return float(np.linalg.norm(np.subtract(part.motion.center, other.motion.center)) / CENTER_MAX)
