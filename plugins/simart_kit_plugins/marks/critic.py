"""The critic: the model looks at the object closed and open, says what is wrong, and that is chosen anew."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from simart_kit import Note, Segmentation
from simart_kit.arrays import ByteArray
from simart_kit.assemble import assemble
from simart_kit.drawing.preview import preview_png

from .answers import CriticAnswer, Fault, critic_answer
from .linking import Link, face_links, guesses, moved
from .moving import Choice, chosen, joints, reversed_choice
from .prompts import PICTURES, critic_text
from .talk import Shown, Talk
from .views import Seen


@dataclass(frozen=True)
class Articulated:
    """Links and how they move.

    Attributes:
        links: the body first.
        choices: by the name of a link, the line that it moves about or along.
        notes: what the critic found.
    """

    links: tuple[Link, ...]
    choices: dict[str, Choice]
    notes: tuple[Note, ...] = ()


def criticised(talk: Talk, seen: Seen, marks: ByteArray, state: Articulated, rounds: int) -> Articulated:
    """Let the model find faults and mend them, until it finds none, or so many rounds are over.

    Args:
        talk: with the model.
        seen: the object.
        marks: (H, W, 3) sheet of numbered pieces.
        state: to look at.
        rounds: at most.
    """
    for number in range(1, rounds + 1):
        if len(state.links) == 1:
            return state
        answer = _asked(talk, seen, marks, state, number)
        if not answer.faults:
            return replace(state, notes=(*state.notes, _note(f"round {number}: nothing is wrong")))
        for fault in answer.faults:
            state = _mended(talk, seen, state, fault, number)
    return state


def motion_picture(seen: Seen, links: Sequence[Link], choices: dict[str, Choice]) -> ByteArray:
    """(H, W, 3) the object closed, half open and open, a colour a link, with axes and names."""
    from PIL import Image

    segmentation = Segmentation(face_links(seen.piece, links), guesses(links))
    made = joints(seen, links, choices)
    asset = assemble("object", seen.mesh, segmentation, made, np.eye(4))
    with Image.open(io.BytesIO(preview_png(asset))) as picture:
        return np.array(picture.convert("RGB"))


def _asked(talk: Talk, seen: Seen, marks: ByteArray, state: Articulated, number: int) -> CriticAnswer:
    pictures: list[Shown] = [
        ("the object closed, half open and open", motion_picture(seen, state.links, state.choices)),
        (PICTURES[1], marks),
    ]
    names = tuple(link.name for link in state.links if link.parent)
    wanted = critic_answer(names, seen.count)
    return talk.ask(f"critic, round {number}", critic_text(state.links), pictures, wanted)


def _mended(talk: Talk, seen: Seen, state: Articulated, fault: Fault, number: int) -> Articulated:
    link = next(link for link in state.links if link.name == fault.link)
    before = state.choices.get(link.name)
    told = f"round {number}: {link.name}, {fault.wrong}" + (f": {fault.reason}" if fault.reason else "")
    notes = (*state.notes, _note(told))
    if fault.wrong == "pieces":
        links = moved(state.links, link.name, fault.add)
        return Articulated(links, state.choices, notes)
    if before is None:
        return replace(state, notes=notes)
    if fault.wrong == "direction":
        return Articulated(state.links, {**state.choices, link.name: reversed_choice(before)}, notes)
    anew = chosen(talk, seen, state.links, link, before=before, reason=fault.reason)
    return Articulated(state.links, {**state.choices, link.name: anew or before}, notes)


def _note(text: str) -> Note:
    return Note("segment", "info", f"critic, {text}")
