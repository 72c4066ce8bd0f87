"""What the segmenter `simart` shows in a recording: what was asked and said, and what became of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from simart_kit.evidence import (
    Evidence,
    PictureEvidence,
    PointEvidence,
    TextEvidence,
    VertexEvidence,
    VoxelEvidence,
)

from .answer.values import ObjectAnswer, PartAnswer
from .answer.writing import answer_text
from .asking import Said, Word
from .codec import occupancy, seeds
from .tokens_evidence import token_cells

if TYPE_CHECKING:
    from simart_kit import Mesh
    from simart_kit.arrays import BoolArray, IntArray
    from simart_kit.transfer import Transfer
    from simart_kit.voxels import GridFrame

    from .looking import Asked
    from .prompt.values import Prompt

MEETINGS = ("same part", "other part", "decoded alone", "labelled alone")
# A viewer takes long tables ill.
_MOST_ROWS = 600
_MOST_TEXT = 20_000
_VOXEL = "<voxel>"


@dataclass(frozen=True, eq=False)
class Drawn:
    """What became of an answer.

    Attributes:
        names: of the parts that decode to voxels.
        grids: (P, 64, 64, 64) bool, those voxels.
        moved: the transfer of these parts.
    """

    names: tuple[str, ...]
    grids: BoolArray
    moved: Transfer


def evidence(mesh: Mesh, asked: Asked, said: Said[ObjectAnswer], drawn: Drawn) -> tuple[Evidence, ...]:
    """Prompt, picture, answer, its tokens and parts; voxel tokens, and decoded voxels against labels."""
    prompt, seen = asked.prompt, asked.seen
    owner = np.repeat(np.arange(len(drawn.names)), drawn.grids.reshape(len(drawn.names), -1).sum(axis=1))
    points = np.concatenate([seeds(grid, seen.frame) for grid in drawn.grids])
    picture = () if prompt.picture is None else (PictureEvidence("Picture shown", prompt.picture),)
    words = (TextEvidence("Tokens", stream_text(said.words)),) if said.words else ()
    return (
        *picture,
        token_cells(seen.tokens, seen.frame),
        PointEvidence("Part seeds", points, owner, drawn.names),
        meetings(mesh, seen.frame, drawn.grids, drawn.moved.face_part),
        VertexEvidence("Probability", np.clip(drawn.moved.probabilities, 0, 1), drawn.names),
        TextEvidence("Prompt", prompt_text(prompt)),
        TextEvidence("Answer", _fenced(answer_text(said.value, indent=2))),
        *words,
        TextEvidence("Parts said", parts_text(said)),
    )


def meetings(mesh: Mesh, frame: GridFrame, grids: BoolArray, face_part: IntArray) -> VoxelEvidence:
    """Decoded voxels of (P, 64, 64, 64) parts against the voxels of the faces that got their labels."""
    labels = np.zeros_like(grids)
    for part in np.unique(face_part).tolist():
        labels[part] = occupancy(mesh.triangles[face_part == part], frame)
    where = np.argwhere((grids | labels).any(axis=0))
    decoded, labelled = (both[:, *where.T] for both in (grids, labels))
    same, drawn, given = (on.any(axis=0) for on in (decoded & labelled, decoded, labelled))
    kind = np.select([same, drawn & given, drawn], [0, 1, 2], 3)
    return VoxelEvidence("Decoded voxels and labels", frame, where, kind, MEETINGS)


def prompt_text(prompt: Prompt) -> str:
    """A prompt for people, voxels as the paper prints them."""
    system = f"### System\n\n{_fenced(prompt.system)}\n\n" if prompt.system else ""
    shown = "" if prompt.picture is None else "*(the picture)*\n\n"
    voxels = _fenced(_cut(prompt.voxels.text()))
    count = len(prompt.voxels.index)
    return f"{system}### User\n\n{shown}{count} voxels:\n\n{voxels}\n\n{_fenced(prompt.question)}"


def parts_text(said: Said[ObjectAnswer]) -> str:
    """The parsed parts as a table."""
    answer = said.value
    lines = [
        f"**{answer.name or 'An object'}**, {answer.scale:g} cm on its longest side, by {said.source}.",
        "",
        _row("part", "name", "type", "parent", "center", "axis", "limits", "material", "g/cm^3", "cells"),
        _row(*["---"] * 10),
        *(_row(number, *_cells(part)) for number, part in enumerate(answer.parts)),
        *("", *(f"- {remark}" for remark in said.remarks)),
    ]
    return "\n".join(lines)


def stream_text(words: Sequence[Word]) -> str:
    """An answer's tokens with their probabilities: a row for each that was chosen, and for each voxel.

    Tokens between them that the grammar forced share a row, as do the tokens of a voxel.
    """
    rows = list(_stream(words))
    chosen = sum(not word.forced for word in words)
    lines = [
        f"{len(words)} tokens: {chosen} chosen by the model, {len(words) - chosen} forced by the grammar.",
        "",
        _row("text", "probability"),
        _row("---", "---"),
        *(_row(f"`{_code(text)}`", told) for text, told in rows[:_MOST_ROWS]),
    ]
    more = [f"\n... and {len(rows) - _MOST_ROWS} rows more"] if len(rows) > _MOST_ROWS else []
    return "\n".join([*lines, *more])


def _stream(words: Sequence[Word]) -> Iterator[tuple[str, str]]:
    """(text, what is told of it) of each row."""
    group: list[Word] = []
    for word in words:
        inside = group and group[0].text == _VOXEL and len(group) < 3
        if group and not inside and not (word.forced and group[0].forced and word.text != _VOXEL):
            yield _told(group)
            group = []
        group.append(word)
    if group:
        yield _told(group)


def _told(group: Sequence[Word]) -> tuple[str, str]:
    chances = [f"{word.probability:.3f}" for word in group if not word.forced]
    return "".join(word.text for word in group), " x ".join(chances) or "forced"


def _cells(part: PartAnswer) -> tuple[object, ...]:
    motion = part.motion
    return (
        part.name,
        part.type,
        "" if part.parent is None else part.parent,
        *((motion.center, motion.axis or "", motion.limits or "") if motion else ("", "", "")),
        part.material,
        "" if part.density is None else part.density,
        len(part.voxels.index),
    )


def _row(*cells: object) -> str:
    return "| " + " | ".join(str(cell).replace("|", "/") for cell in cells) + " |"


def _code(text: str) -> str:
    """A text that may stand in a line of code."""
    return text.replace("`", "'").replace("\n", "\\n") or " "


def _fenced(text: str) -> str:
    return f"```text\n{text.replace('```', chr(39) * 3)}\n```"


def _cut(text: str) -> str:
    return text if len(text) <= _MOST_TEXT else text[:_MOST_TEXT] + " ..."
