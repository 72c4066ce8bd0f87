"""The ladders of many objects as one, and what nano's candidates lack."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from simart_kit.errors import BadInputError

from .judging import Judged, PartResult
from .ladder import CANDIDATES, GROUPING, PIECES, WHOLE, Ladder

KINDS = ("revolute", "prismatic", "continuous")
"""Kinds of joints that need a candidate."""


@dataclass(frozen=True)
class Rung:
    """A step of many objects.

    Attributes:
        step: its name.
        iou: the bench's penalised part IoU, mean over objects.
        kept: share of all true parts with an IoU of at least 0.5; None without any.
        type: the bench's penalised Type, mean over objects; None where kinds are the true ones.
        joints: share of all true parts with the right joint, or a right candidate where that is asked: of
            those with an axis. None without any, or where joints are the true ones.
        invented: parts that are none.
    """

    step: str
    iou: float
    kept: float | None
    type: float | None
    joints: float | None
    invented: int


@dataclass(frozen=True)
class KindShare:
    """True parts of a kind of joint.

    Attributes:
        parts: how many.
        right: how many of them have a right candidate.
    """

    parts: int
    right: int


def rungs(found: Sequence[Ladder]) -> tuple[Rung, ...]:
    """The steps of several objects together.

    Raises:
        BadInputError: there is no object.
    """
    if not found:
        raise BadInputError("no object could be read: see the line of each")
    return tuple(_rung(step, [one.steps[step] for one in found]) for step in found[0].steps)


def kind_shares(found: Sequence[Ladder]) -> dict[str, KindShare]:
    """Parts with a right candidate, by the kinds of joints that need one."""
    parts = [part for one in found for part in one.steps[CANDIDATES].parts]
    of_kind = {kind: [part for part in parts if part.kind == kind] for kind in KINDS}
    return {kind: KindShare(len(own), sum(part.joint for part in own)) for kind, own in of_kind.items()}


def _rung(step: str, judged: Sequence[Judged]) -> Rung:
    parts = [part for one in judged for part in one.parts]
    asked = [part for part in parts if part.kind in KINDS] if step == CANDIDATES else parts
    said = step in (GROUPING, WHOLE)
    return Rung(
        step,
        float(np.mean([one.iou for one in judged])),
        _share(part.kept for part in parts),
        float(np.mean([one.type for one in judged])) if said else None,
        _share(part.joint for part in asked) if step != PIECES else None,
        sum(one.invented for one in judged),
    )


def _share(flags: Iterator[bool]) -> float | None:
    values = list(flags)
    return float(np.mean(values)) if values else None


def lacking(one: Ladder) -> tuple[PartResult, ...]:
    """The true parts of an object that need a candidate and have no right one."""
    return tuple(part for part in one.steps[CANDIDATES].parts if part.kind in KINDS and not part.joint)
