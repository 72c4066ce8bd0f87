"""What a spec states, honoured among what the network and geometry propose: which parts, and which joints."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit import Joint, Segmentation
from simart_kit.asset import clean_name
from simart_kit.spec.choosing import Option, choose
from simart_kit.spec.places import Place, part_places
from simart_kit.spec.values import Spec
from simart_kit.spec.wishes import Wish, kind_of, wishes_of

from .grouping import piece_parts
from .pooling import pooled
from .predicting import PredictedPart, Prediction
from .proposals import SUFFIX, Proposal, joint_of, of_network, only
from .truth import KINDS

if TYPE_CHECKING:
    from simart_kit import Mesh

    from .meshes import MeshCloud

# A line less likely than this is the network's guess no more.
_LEAST = 0.01


def chosen(
    mesh: Mesh,
    said: Prediction,
    seen: MeshCloud,
    sure: list[Proposal],
    spec: Spec,
    geometry: Callable[[], list[Proposal]],
) -> list[Proposal]:
    """As many proposals of each kind as are stated; those in doubt are looked at where there are too few.

    Args:
        mesh: of the faces.
        said: with parts in doubt.
        seen: what the network read.
        sure: proposals that move if no number is stated.
        spec: what is stated.
        geometry: what geometry proposes to a spec, asked only where there are too few.
    """
    moves = np.zeros(len(mesh.faces), dtype=np.bool_)
    for proposal in sure:
        moves |= proposal.faces

    def labels(of: Sequence[Proposal]) -> tuple[str | None, ...]:
        options = []
        for proposal in of:
            area = float(mesh.face_areas[proposal.faces].sum())
            # One of several that were lumped together is as sure as the lump.
            surely = float(mesh.face_areas[proposal.faces & moves].sum()) > area / 2
            options.append(Option(proposal.guess.label, proposal.guess.score, area, surely))
        return choose(spec, options)

    every, found = sure, labels(sure)
    if _short(spec, found):
        doubtful = _parts(said, [replace(part, parent=0) for part in said.doubtful])
        more = of_network(doubtful, doubtful.piece_part[seen.face_piece], seen)
        every = pooled(mesh, sure, [*more, *geometry()])
        found = labels(every)
    named = [p if label is None else _called(p, label) for p, label in zip(every, found, strict=True)]
    return only(named, [k for k, label in enumerate(found) if label is not None])


def chosen_said(said: Prediction, seen: MeshCloud, spec: Spec) -> Prediction:
    """The prediction with as many parts of each kind as are stated, of those in doubt too."""
    every = [*said.parts, *(replace(part, parent=0) for part in said.doubtful)]
    area = np.bincount(seen.cloud.piece, seen.cloud.area, seen.cloud.count)
    options = [
        Option(part.label, part.certainty, float(area[part.pieces].sum()), k < len(said.parts))
        for k, part in enumerate(every)
    ]
    found = choose(spec, options)
    kept = [k for k, label in enumerate(found) if label is not None]
    place = {old + 1: new + 1 for new, old in enumerate(kept)}
    parts = [replace(every[k], label=found[k] or "", parent=place.get(every[k].parent, 0)) for k in kept]
    return _parts(said, parts)


def rejoined(
    mesh: Mesh, found: Segmentation, proposals: Sequence[Proposal], seen: MeshCloud, spec: Spec
) -> Segmentation:
    """The segmentation with the network's likeliest joint that is as stated, where its own is not.

    Args:
        mesh: the one that `found.face_part` is of.
        found: of the proposals, in their order.
        proposals: with what the network says of their joints.
        seen: what it read.
        spec: what is stated.
    """
    wishes = wishes_of(spec, found.parts, mesh.bounds)
    labels = [guess.label or guess.name for guess in found.parts]
    places = part_places(mesh, found.face_part, labels)
    joints = tuple(
        _refitted(joint, proposal, wish, place, seen)
        for joint, proposal, wish, place in zip(
            found.joints or (), proposals, wishes[1:], places[1:], strict=True
        )
    )
    return replace(found, joints=joints)


def _refitted(joint: Joint, proposal: Proposal, wish: Wish, place: Place, seen: MeshCloud) -> Joint:
    choices = proposal.choices
    if choices is None or wish.granted(joint, place):
        return joint
    likely = sorted(KINDS, key=lambda kind: -choices.kinds[KINDS.index(kind)])
    for kind in likely:
        if wish.joint not in (None, kind):
            continue
        # However unlikely the kind: it is stated.
        of_kind = max(float(choices.kinds[KINDS.index(kind)]), 1e-9)
        for motion in choices.ranked(kind):
            other = joint_of(motion, seen)
            if motion.confidence / of_kind >= _LEAST and wish.granted(other, place):
                name = f"{joint.child}_{SUFFIX.get(kind, 'joint')}"
                told = (*other.evidence, "as the spec states")
                return replace(other, name=name, parent=joint.parent, child=joint.child, evidence=told)
    return joint


def _parts(said: Prediction, parts: Sequence[PredictedPart]) -> Prediction:
    pieces = piece_parts([part.pieces for part in parts], len(said.piece_part))
    return replace(said, parts=tuple(parts), doubtful=(), piece_part=pieces)


def _called(proposal: Proposal, label: str) -> Proposal:
    if label == proposal.guess.label:
        return proposal
    return replace(proposal, guess=replace(proposal.guess, label=label, name=clean_name(label)))


def _short(spec: Spec, labels: Sequence[str | None]) -> bool:
    """Whether there are fewer of a kind than stated."""
    kinds = [None if label is None else kind_of(spec, label) for label in labels]
    return any(kind.count is not None and kinds.count(word) < kind.count for word, kind in spec.kinds.items())
