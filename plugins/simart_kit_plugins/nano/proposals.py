"""Parts that may move, whoever says so: by the network, or by geometry alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from simart_kit import Joint, Limits, PartGuess, Segmentation
from simart_kit.arrays import BoolArray, FloatArray, vec3
from simart_kit.assemble import checked
from simart_kit.asset import clean_name, unique_names
from simart_kit.spec.protocols import predict_by, segment_by

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.arrays import IntArray
    from simart_kit.spec.values import Spec

    from .choices import Choices, Motion
    from .meshes import MeshCloud
    from .predicting import PredictedPart, Prediction

SAME = 0.5  # overlap from which on two proposals are of one part
_ALONG = np.cos(np.deg2rad(15.0))  # of axes that are much the same
_BODY = 0.02  # share of the surface that what stands still has at least
SUFFIX = {"revolute": "hinge", "prismatic": "slide", "continuous": "spin"}


@dataclass(frozen=True, eq=False)
class Proposal:
    """A part with its joint.

    Attributes:
        faces: (F,) bool of the mesh.
        guess: what it is taken for.
        joint: how it moves; its parent and child are named when all parts are known.
        parent: place of the part that carries it among those proposed with it; None for the body.
        choices: what the network says of all its joints; None where geometry proposes it.
    """

    faces: BoolArray
    guess: PartGuess
    joint: Joint
    parent: int | None
    choices: Choices | None = None


def of_network(said: Prediction, face_part: IntArray, seen: MeshCloud) -> list[Proposal]:
    """The network's parts that have faces; (F,) face_part numbers them from 1."""
    kept = [number for number in range(1, len(said.parts) + 1) if (face_part == number).any()]
    place = {number: k for k, number in enumerate(kept)}
    proposals = []
    for number in kept:
        part = said.parts[number - 1]
        joint = joint_of(part, seen)
        joint = replace(joint, evidence=part.reasons or joint.evidence)
        guess = PartGuess(clean_name(part.label or "part"), label=part.label, score=part.certainty)
        parent = place.get(part.parent)
        proposals.append(Proposal(face_part == number, guess, joint, parent, part.choices))
    return proposals


def joint_of(motion: PredictedPart | Motion, seen: MeshCloud) -> Joint:
    """A joint of the asset by one of the cloud; its parent and child are named later."""
    scale = seen.size if motion.kind == "prismatic" else 1.0
    limited = motion.kind in ("revolute", "prismatic")
    return Joint(
        "joint",
        motion.kind,
        "body",
        "part",
        vec3(motion.origin * seen.size + seen.center),
        vec3(motion.axis),
        Limits(motion.lower * scale, motion.upper * scale) if limited else None,
        confidence=motion.confidence,
        evidence=(f"simart-nano: {motion.confidence:.2f} sure of kind and axis",),
    )


def of_geometry(mesh: Mesh, seed: int, spec: Spec | None = None) -> list[Proposal]:
    """What the segmenter and the joint predictor `geometric` find, in their order; a spec is heeded."""
    from ..geometric.predictor import GeometricJoints
    from ..geometric.segmenter import Geometric

    found = checked(segment_by(Geometric(seed=seed), mesh, spec), mesh)
    names = [guess.name for guess in found.parts]
    joints = predict_by(GeometricJoints(seed=seed), mesh, found, spec)
    place = {joint.child: k for k, joint in enumerate(joints)}
    return [
        Proposal(
            np.asarray(found.face_part == names.index(joint.child)),
            found.parts[names.index(joint.child)],
            joint,
            place.get(joint.parent),
        )
        for joint in joints
    ]


def with_body(mesh: Mesh, proposals: Sequence[Proposal]) -> list[Proposal]:
    """The proposals, but for one if they leave next to nothing of the mesh: something has to stand still.

    That is the largest of those that nothing else carries: a screen's hinges and feet carry no leaves.
    """
    kept = list(proposals)
    claimed = np.zeros(len(mesh.faces), dtype=np.bool_)
    for proposal in kept:
        claimed |= proposal.faces
    areas = mesh.face_areas
    if not kept or areas[~claimed].sum() >= _BODY * areas.sum():
        return kept
    on_body = [k for k, proposal in enumerate(kept) if proposal.parent is None] or range(len(kept))
    largest = max(on_body, key=lambda k: float(areas[kept[k].faces].sum()))
    return only(kept, [k for k in range(len(kept)) if k != largest])


def only(proposals: Sequence[Proposal], kept: Sequence[int]) -> list[Proposal]:
    """Some of the proposals; what one that is left out carries hangs on the body."""
    place = {old: new for new, old in enumerate(kept)}
    carriers = [proposals[k].parent for k in kept]
    return [
        replace(proposals[k], parent=None if carrier is None else place.get(carrier))
        for k, carrier in zip(kept, carriers, strict=True)
    ]


def segmentation_of(
    proposals: Sequence[Proposal], count: int, material: Callable[[str], str]
) -> Segmentation:
    """The body as part 0 and each proposal, with its joint.

    Args:
        proposals: where two share a face the later one has it; each must keep one.
        count: faces of the mesh.
        material: of a part by its label; that of the body by "".
    """
    names = unique_names(["body", *(clean_name(p.guess.name) for p in proposals)])
    face_part = np.zeros(count, dtype=np.int32)
    joints = []
    for number, proposal in enumerate(proposals, start=1):
        face_part[proposal.faces] = number
        suffix = SUFFIX.get(proposal.joint.kind, "joint")
        parent = names[0 if proposal.parent is None else proposal.parent + 1]
        joints.append(
            replace(proposal.joint, name=f"{names[number]}_{suffix}", parent=parent, child=names[number])
        )
    guesses = [
        replace(p.guess, name=name, material=material(p.guess.label))
        for p, name in zip(proposals, names[1:], strict=True)
    ]
    body = PartGuess(names[0], label="body", material=material(""))
    return Segmentation(face_part, (body, *guesses), joints=tuple(joints))


def along(one: Joint, other: Joint) -> bool:
    """Whether two joints are of one kind, and along much the same axis, whichever way."""
    return one.kind == other.kind and bool(abs(np.dot(one.axis, other.axis)) > _ALONG)


def overlap(mesh: Mesh, one: BoolArray, other: BoolArray) -> float:
    """Area that two sets of faces share, as a share of what they cover together."""
    areas: FloatArray = mesh.face_areas
    both = areas[one | other].sum()
    return float(areas[one & other].sum() / both) if both > 0 else 0.0
