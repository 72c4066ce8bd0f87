"""Parts that two propose, made one set in which no face is claimed twice."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.sweeping import Sweep, free_range

from .proposals import Proposal, overlap

if TYPE_CHECKING:
    from simart_kit import Joint, Mesh
    from simart_kit.arrays import BoolArray

# Two proposals are of one part from this overlap on; one that loses more than this share is dropped.
_SAME, _LOST = 0.5, 0.3
# Joints of one kind whose axes are closer than this are not compared [cosine].
_ALIKE = np.cos(np.deg2rad(15.0))
# A joint that can go less than this share of its way is stuck.
_FREE, _STEPS = 0.25, 8


def pooled(mesh: Mesh, first: Sequence[Proposal], second: Sequence[Proposal]) -> list[Proposal]:
    """All that the first proposes, and what the second adds to it.

    What both find is there once, as the first says, but with the second's joint if the first's is stuck and
    the second's is not. What only the second finds must be free to move, and must not be claimed already.

    Args:
        mesh: of the faces.
        first: proposals, none of which share a face.
        second: proposals, the surest first.
    """
    areas = mesh.face_areas
    kept = list(first)
    place = {("first", k): k for k in range(len(first))}
    taken = np.zeros(len(areas), dtype=np.bool_)
    for proposal in kept:
        taken |= proposal.faces
    for k, proposal in enumerate(second):
        twin = next((r for r, p in enumerate(kept) if overlap(mesh, p.faces, proposal.faces) >= _SAME), None)
        if twin is not None:
            place["second", k] = twin
            kept[twin] = _freer(mesh, kept[twin], proposal)
            continue
        free = proposal.faces & ~taken
        if areas[free].sum() < (1 - _LOST) * areas[proposal.faces].sum() or not free.any():
            continue
        if proposal.joint.limits and _stuck(proposal.joint, _sweep(mesh, free)):
            continue
        place["second", k] = len(kept)
        kept.append(replace(proposal, faces=free))
        taken |= free
    return _carried(kept, place, {"first": first, "second": second})


def _freer(mesh: Mesh, one: Proposal, other: Proposal) -> Proposal:
    """The first proposal, with the other's joint where its own is stuck and the other's is not."""
    alike = one.joint.kind == other.joint.kind and np.dot(one.joint.axis, other.joint.axis) > _ALIKE
    if alike or one.joint.limits is None:
        return one
    sweep = _sweep(mesh, one.faces)
    if _stuck(one.joint, sweep) and not _stuck(other.joint, sweep):
        return replace(one, joint=other.joint)
    return one


def _sweep(mesh: Mesh, faces: BoolArray) -> Sweep:
    return Sweep(mesh.vertices, mesh.faces[faces], mesh.faces[~faces])


def _stuck(joint: Joint, sweep: Sweep) -> bool:
    """Whether a joint with limits is blocked both ways almost at once."""
    if joint.limits is None:
        return False
    lower, upper = free_range(joint, sweep, _STEPS)
    return upper - lower < _FREE * (joint.limits.upper - joint.limits.lower)


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
