"""Parts that two propose, made one set in which no face is claimed twice."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.sweeping import Sweep, free_range

from .proposals import SAME, Proposal, along, only, overlap

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh
    from simart_kit.arrays import BoolArray, FloatArray

_LOST = 0.3  # a proposal that loses more than this share is dropped
# Of drawers lumped together each has this share of the lump at least, and this share of it lies there.
_SHARE, _WITHIN = 0.1, 0.75
# Joints of one kind whose axes are closer than this are not compared [cosine].
_ALIKE = np.cos(np.deg2rad(15.0))
# How much surer of its joint the second has to be; and how sure that a part turns, which the first has
# slide or turn otherwise: drawers and bins that tip, or doors and wheels, look the same to rules.
_SURER, _TURNS = 0.25, 0.7
# A joint that can go less than this share of its way is stuck.
_FREE, _STEPS = 0.25, 8


def pooled(
    mesh: Mesh, first: Sequence[Proposal], second: Sequence[Proposal], *, known: bool = False
) -> list[Proposal]:
    """All that the first proposes, and what the second adds to it.

    What both find is there once, as the first says, but with the second's joint if that is much surer, or
    the first's is stuck and the second's is not. What the first takes for one, and the second for several
    that slide, is several. What only the second finds must be free to move, and must not be claimed already;
    what slides may wait behind others that move, as drawers and racks behind doors do.

    Args:
        mesh: of the faces.
        first: proposals, none of which share a face.
        second: proposals, the surest first.
        known: whether the first, if it says anything, knows the object: then all that the second has a say in
            is what the first takes for one.
    """
    areas = mesh.face_areas
    single = [k for k, proposal in enumerate(first) if not _lumped(areas, proposal, second)]
    if known and first:
        lumps = [proposal for k, proposal in enumerate(first) if k not in single]
        inside = [any(_lies_in(areas, other, lump) for lump in lumps) for other in second]
        first = [_exact(mesh, proposal, second) for proposal in first]
        second = only(second, np.flatnonzero(inside).tolist())
    kept = [first[k] for k in single]
    place = {("first", k): row for row, k in enumerate(single)}
    taken = np.zeros(len(areas), dtype=np.bool_)
    for proposal in kept:
        taken |= proposal.faces
    for k, proposal in enumerate(second):
        twin = next((r for r, p in enumerate(kept) if overlap(mesh, p.faces, proposal.faces) >= SAME), None)
        if twin is not None:
            place["second", k] = twin
            kept[twin] = _better(mesh, kept[twin], proposal)
            continue
        free = proposal.faces & ~taken
        if areas[free].sum() < (1 - _LOST) * areas[proposal.faces].sum() or not free.any():
            continue
        if _held(mesh, proposal.joint, free, taken):
            continue
        place["second", k] = len(kept)
        kept.append(replace(proposal, faces=free))
        taken |= free
    return _carried(kept, place, {"first": first, "second": second})


def stuck(joint: Joint, sweep: Sweep) -> bool:
    """Whether a joint with limits is blocked both ways almost at once."""
    if joint.limits is None:
        return False
    lower, upper = free_range(joint, sweep, _STEPS)
    return upper - lower < _FREE * (joint.limits.upper - joint.limits.lower)


def _held(mesh: Mesh, joint: Joint, faces: BoolArray, moving: BoolArray) -> bool:
    """Whether a part cannot move. One that slides may wait behind what moves, but not where all does."""
    others = ~faces & ~moving if joint.kind == "prismatic" else ~faces
    return joint.limits is not None and (not others.any() or stuck(joint, _sweep(mesh, faces, others)))


def _lumped(areas: FloatArray, one: Proposal, others: Sequence[Proposal]) -> bool:
    """Whether a proposal is several parts that slide, such as the drawers of a stack, taken for one.

    What slides otherwise is none: a garage's door goes up, whatever its sections look like.
    """
    shares = [
        float(areas[other.faces & one.faces].sum() / areas[one.faces].sum())
        for other in others
        if other.joint.kind == "prismatic" and _lies_in(areas, other, one)
        if one.joint.kind != "prismatic" or along(one.joint, other.joint)
    ]
    return sum(share >= _SHARE for share in shares) > 1 and sum(shares) >= SAME


def _lies_in(areas: FloatArray, one: Proposal, other: Proposal) -> bool:
    """Whether most of a proposal is part of another."""
    return bool(areas[one.faces & other.faces].sum() >= _WITHIN * areas[one.faces].sum())


def _better(mesh: Mesh, one: Proposal, other: Proposal) -> Proposal:
    """The first proposal, with the other's joint where that is much surer, or its own is stuck alone."""
    surer = other.joint.confidence > one.joint.confidence + _SURER
    if surer or _turns(one, other):
        return replace(one, joint=other.joint)
    alike = one.joint.kind == other.joint.kind and np.dot(one.joint.axis, other.joint.axis) > _ALIKE
    if alike or one.joint.limits is None:
        return one
    sweep = _sweep(mesh, one.faces, ~one.faces)
    if stuck(one.joint, sweep) and not stuck(other.joint, sweep):
        return replace(one, joint=other.joint)
    return one


def _turns(one: Proposal, other: Proposal) -> bool:
    """Whether the second is rather sure that something turns which the first has turn otherwise, or slide.

    What slides on rails that the first has looked for, as a sliding door, is none such; a drawer is.
    """
    if one.joint.kind == "prismatic" and one.guess.label != "drawer":
        return False
    return other.joint.turns and other.joint.kind != one.joint.kind and other.joint.confidence >= _TURNS


def _exact(mesh: Mesh, one: Proposal, others: Sequence[Proposal]) -> Proposal:
    """The first proposal, with the joint of the other that has the same part move much alike."""
    for other in others:
        if along(one.joint, other.joint) and overlap(mesh, one.faces, other.faces) >= SAME:
            return replace(one, joint=other.joint)
    return one


def _sweep(mesh: Mesh, faces: BoolArray, against: BoolArray) -> Sweep:
    return Sweep(mesh.vertices, mesh.faces[faces], mesh.faces[against], holes=True)


def _carried(
    kept: Sequence[Proposal], place: dict[tuple[str, int], int], sources: dict[str, Sequence[Proposal]]
) -> list[Proposal]:
    """Each with the place of its carrier among those kept; the body where that was dropped."""
    whose = {row: key for key, row in reversed(place.items())}
    result = []
    for row, proposal in enumerate(kept):
        source, k = whose[row]
        parent = sources[source][k].parent
        found = None if parent is None else place.get((source, parent))
        result.append(replace(proposal, parent=None if found == row else found))
    return result
