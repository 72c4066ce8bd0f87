"""An answer and the mesh it is about, to a Segmentation: decoded, laid onto the faces, joints as hints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from simart_kit import Mesh, Note, Segmentation

from .answer.units import guesses_of, joints_of, material_notes
from .answer.values import ObjectAnswer
from .answer_evidence import Drawn, evidence
from .asking import Said
from .certainty import caption_certainty
from .codec import part_seeds
from .labelling import TransferOptions, labelled
from .looking import Asked
from .seeding import Decoder
from .surviving import surviving

# Sizes within this factor of each other agree.
_SAME_SIZE = 1.25
_EMPTY = (
    "none of the parts decodes to a voxel, so that all is one part: "
    "the codes are of another voxel model, or the language model was not trained"
)


def segmentation_of(
    mesh: Mesh, asked: Asked, said: Said[ObjectAnswer], decoder: Decoder, options: TransferOptions
) -> Segmentation:
    """Parts on the mesh's faces, with the joints that the answer gives them.

    A part that decodes to no voxel, or gets no face, is told and left out; what it carried hangs on what
    carried it. Where no part decodes to a voxel, the whole object is the first.
    """
    answer, frame = said.value, asked.seen.frame
    grids = decoder.voxels([part.voxels for part in answer.parts], asked.seen)
    empty = not grids.any()
    if empty:
        grids[0] = asked.seen.occupancy
    solid: list[int] = np.flatnonzero(grids.any(axis=(1, 2, 3))).tolist()
    guesses = guesses_of(answer)
    names = tuple(guesses[part].name for part in solid)
    labels = labelled(mesh, part_seeds(grids[solid], frame, names), names, options)
    kept = [solid[place] for place in labels.kept]
    sure = caption_certainty(said.words, len(answer.parts)) or [1.0] * len(answer.parts)
    parts = tuple(replace(guesses[part], score=sure[part]) for part in kept)
    rest = surviving(answer, kept)
    joints, doubts = joints_of(rest, [part.name for part in parts], frame, [sure[part] for part in kept])
    lost = [guess.name for number, guess in enumerate(guesses) if number not in kept]
    return Segmentation(
        labels.face_part,
        parts,
        joints=tuple(replace(joint, evidence=(f"said by {said.source}",)) for joint in joints),
        face_segment=labels.segments.face_segment,
        notes=(
            *asked.notes,
            *_said_notes(mesh, said),
            *([Note("segment", "warning", _EMPTY)] if empty else []),
            *_lost_notes(lost),
            *labels.notes,
            *material_notes(rest),
            *doubts,
        ),
        evidence=evidence(mesh, asked, said, Drawn(names, grids[solid], labels.moved)),
    )


def _said_notes(mesh: Mesh, said: Said[ObjectAnswer]) -> list[Note]:
    answer = said.value
    moving = sum(part.type != "fixed" for part in answer.parts)
    told = f"{said.source}: '{answer.name or 'object'}', parts: {len(answer.parts)}, {moving} of them moving"
    if said.words:
        forced = sum(word.forced for word in said.words)
        told += f"; {len(said.words)} tokens, {forced} of them forced"
    remarks = [Note("segment", "warning", remark) for remark in said.remarks]
    return [Note("segment", "info", told), *remarks, _size_note(mesh, answer)]


def _size_note(mesh: Mesh, answer: ObjectAnswer) -> Note:
    """What the model takes the object's size for; the asset keeps the file's."""
    extent = mesh.bounds[1] - mesh.bounds[0]
    here, there = float(extent.max()), answer.scale / 100
    told = f"the model takes the longest side for {there:.3g} m, the file says {here:.3g} m"
    if max(here, there) <= _SAME_SIZE * min(here, there):
        return Note("segment", "info", told)
    return Note("segment", "info", f"{told}: --scale {there / here:.3g} takes the model's word")


def _lost_notes(names: Sequence[str]) -> list[Note]:
    said = "decodes to no voxel or gets no face: it is left out, and what it carried hangs on what carried it"
    return [Note("segment", "warning", f"part '{name}' {said}") for name in names]
