"""From pieces to links and joints: what is asked, one question after the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simart_kit import Note, PartGuess, Segmentation
from simart_kit.arrays import ByteArray

from .answers import ObjectAnswer, object_answer
from .critic import Articulated, criticised
from .linking import Link, face_links, guesses, links_of, unnamed
from .moving import chosen, joints
from .prompts import PICTURES, RED, grouping_text
from .proposing import Proposed
from .sheets import marks_sheet, plain_sheet, red_sheets
from .talk import Talk
from .views import Seen

_FAR_OFF = 3.0  # factor between what is said and the mesh, beyond which the unit is in doubt


@dataclass(frozen=True, eq=False)
class _Grouped:
    """The answer to the first question.

    Attributes:
        links: the body first.
        marks: (H, W, 3) sheet of numbered pieces that was shown.
        notes: on the answer.
    """

    links: tuple[Link, ...]
    marks: ByteArray
    notes: tuple[Note, ...]


def articulated(talk: Talk, found: Proposed, rounds: int, wishes: str = "") -> Segmentation:
    """Ask for links, then for the line of each that moves, then for faults; joints are hints.

    Args:
        talk: with the model.
        found: the pieces.
        rounds: of the critic, at most.
        wishes: what a person states, as `wishes_text` puts it.

    Raises:
        BadInputError: there is no usable answer.
    """
    seen = Seen.of(found.mesh, found.piece)
    if seen.count == 1:
        return _whole(found)
    grouped = _grouped(talk, seen, wishes)
    choices = {
        link.name: choice
        for link in grouped.links
        if link.parent and (choice := chosen(talk, seen, grouped.links, link, wishes))
    }
    state = criticised(talk, seen, grouped.marks, Articulated(grouped.links, choices), rounds)
    return Segmentation(
        face_links(found.piece, state.links),
        guesses(state.links),
        joints=joints(seen, state.links, state.choices),
        face_segment=found.piece,
        notes=(*found.notes, *grouped.notes, *state.notes, *talk.notes()),
        evidence=talk.evidence,
        usage=talk.usage(),
        mesh=found.mesh if found.cut else None,
    )


def _whole(found: Proposed) -> Segmentation:
    """An object of one piece, about which there is nothing to ask."""
    told = "the proposer has one piece, so nothing can be told apart: the object is taken as static"
    return Segmentation(
        found.piece,
        (PartGuess("body", label="body"),),
        joints=(),
        face_segment=found.piece,
        notes=(*found.notes, Note("segment", "warning", told)),
        mesh=found.mesh if found.cut else None,
    )


def _grouped(talk: Talk, seen: Seen, wishes: str) -> _Grouped:
    """Ask which pieces are one link."""
    marks = marks_sheet(seen)
    views = red_sheets(seen, [(str(piece), (piece,)) for piece in range(seen.count)])
    pictures = [(PICTURES[0], plain_sheet(seen)), (PICTURES[1], marks), *((RED, view) for view in views)]
    answer = talk.ask("links", grouping_text(seen) + wishes, pictures, object_answer(seen.count))
    notes = [_size_note(answer, float(np.ptp(seen.mesh.bounds, axis=0).max()))]
    left = unnamed(answer, seen.count)
    if left:
        told = ", ".join(map(str, left))
        notes.append(Note("segment", "warning", f"pieces {told} were not named and stay with the body"))
    return _Grouped(links_of(answer, seen.count), marks, tuple(notes))


def _size_note(answer: ObjectAnswer, size: float) -> Note:
    """What the object is and how large it should be, against the mesh's longest side [m]."""
    factor = answer.longest_side_m / size
    told = (
        f"category: {answer.category}; the longest side should be about {answer.longest_side_m:.3g} m, "
        f"that of the mesh is {size:.3g} m"
    )
    if 1 / _FAR_OFF < factor < _FAR_OFF:
        return Note("segment", "info", told)
    return Note(
        "segment", "warning", f"{told}: if the mesh's unit is wrong, convert with --scale {factor:.3g}"
    )
