"""Pieces of one thing that slides, taken for several: one stands in another's way at once, and lies on it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.sweeping import Sweep, free_range, sample_faces

from .hardware import distances
from .proposals import Proposal, only

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.arrays import FloatArray

_ALONG = 0.985  # cosine between their axes
_BEHIND = 0.5  # share of the smaller one's outline, seen along the axis, that lies within the other's
_BESIDE = 0.008  # of the object's diagonal: how far apart they lie at most
_AT_ONCE, _STEPS = 0.1, 15  # of its way that one comes at most, and stops on it
_POINTS = 300


def joined(mesh: Mesh, proposals: Sequence[Proposal]) -> list[Proposal]:
    """The proposals, of those that slide alike and stop each other at once the largest with all their faces.

    A drawer's front and its box are one so. Drawers of a stack and keys of a row pass by each other.

    Args:
        mesh: of the faces.
        proposals: parts that share no face.
    """
    whole = list(range(len(proposals)))  # by each, one that it is part of
    areas = [float(mesh.face_areas[proposal.faces].sum()) for proposal in proposals]
    for one, other in _pairs(mesh, proposals):
        first, second = sorted((_end(whole, one), _end(whole, other)), key=lambda k: areas[k])
        whole[first] = second
    kept = [k for k in range(len(proposals)) if whole[k] == k]
    grown = list(proposals)
    for k in range(len(proposals)):
        if (end := _end(whole, k)) != k:
            grown[end] = replace(grown[end], faces=grown[end].faces | proposals[k].faces)
    carried = [replace(one, parent=_carrier(proposals, whole, k)) for k, one in enumerate(grown)]
    return only(carried, kept)


def _carrier(proposals: Sequence[Proposal], whole: Sequence[int], k: int) -> int | None:
    """What carries a proposal and all that is one with it; None for the body."""
    above = proposals[k].parent
    while above is not None and _end(whole, above) == _end(whole, k):
        above = proposals[above].parent
    return None if above is None else _end(whole, above)


def _end(whole: Sequence[int], k: int) -> int:
    while whole[k] != k:
        k = whole[k]
    return k


def _pairs(mesh: Mesh, proposals: Sequence[Proposal]) -> Iterator[tuple[int, int]]:
    """Proposals that are pieces of one."""
    for label in dict.fromkeys(proposal.guess.label for proposal in proposals):
        slides = [
            k for k, p in enumerate(proposals) if p.joint.kind == "prismatic" and p.guess.label == label
        ]
        for one, other in _behind(mesh, proposals, slides):
            a, b = proposals[one], proposals[other]
            related = a.parent in (b.parent, other) or b.parent == one
            if related and _touch(mesh, a, b) and (_stops(mesh, a, b) or _stops(mesh, b, a)):
                yield one, other


def _behind(mesh: Mesh, proposals: Sequence[Proposal], slides: Sequence[int]) -> Iterator[tuple[int, int]]:
    """Those that slide along one axis, and seen along it lie behind each other."""
    left = list(slides)
    while len(left) > 1:
        axis = np.array(proposals[left[0]].joint.axis)
        along = [k for k in left if abs(np.dot(proposals[k].joint.axis, axis)) > _ALONG]
        left = [k for k in left if k not in along]
        across = np.linalg.svd(axis[None])[2][1:]
        corners = [mesh.triangles[proposals[k].faces].reshape(-1, 3) @ across.T for k in along]
        lower, upper = (np.array([end(points, axis=0) for points in corners]) for end in (np.min, np.max))
        shared = np.minimum(upper[:, None], upper) - np.maximum(lower[:, None], lower)
        size = np.prod(upper - lower, axis=1)
        share = np.prod(np.maximum(shared, 0.0), axis=2) / np.maximum(np.minimum(size[:, None], size), 1e-30)
        yield from ((along[i], along[j]) for i, j in np.argwhere(np.triu(share > _BEHIND, 1)))


def _touch(mesh: Mesh, one: Proposal, other: Proposal) -> bool:
    apart = distances(_points(mesh, one), _points(mesh, other))
    return bool(apart.min(initial=np.inf) < _BESIDE * mesh.diagonal)


def _points(mesh: Mesh, proposal: Proposal) -> FloatArray:
    return sample_faces(mesh.triangles[proposal.faces], _POINTS, np.random.default_rng(0))[1]


def _stops(mesh: Mesh, one: Proposal, other: Proposal) -> bool:
    """Whether the second is in the first one's way at once."""
    limits = one.joint.limits
    if limits is None:
        return False
    sweep = Sweep(mesh.vertices, mesh.faces[one.faces], mesh.faces[other.faces], holes=True)
    lower, upper = free_range(one.joint, sweep, _STEPS)
    return upper - lower < _AT_ONCE * (limits.upper - limits.lower)
