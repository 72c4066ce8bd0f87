"""Grounding: does what is red in each view belong to what is described?"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from simart_kit.grounding import Candidate, Grounded

from .answers import GroundingAnswer, Match, grounding_answer
from .prompts import PICTURES, RED, grounding_text
from .sheets import plain_sheet, red_sheets
from .talk import Talk
from .views import Seen

if TYPE_CHECKING:
    from .proposing import Proposed


def grounded(talk: Talk, found: Proposed, description: str) -> Grounded:
    """The pieces that belong to a description; where there is none, the surest of those that partly do.

    Args:
        talk: with the model.
        found: the pieces.
        description: such as "the upper left door".
    """
    seen = Seen.of(found.mesh, found.piece)
    views = red_sheets(seen, [(str(piece), (piece,)) for piece in range(seen.count)])
    pictures = [(PICTURES[0], plain_sheet(seen)), *((RED, view) for view in views)]
    text = grounding_text(description, seen.count)
    answer = talk.ask("grounding", text, pictures, grounding_answer(seen.count))
    matches = sorted(answer.matches, key=lambda match: match.piece)
    meant = _meant(answer)
    sure = [match.confidence / 100.0 for match in matches if match.piece in meant]
    return Grounded(
        faces=np.isin(seen.piece, meant),
        score=float(np.mean(sure)) if sure else 0.0,
        reason=_reason(meant, seen.count),
        candidates=tuple(
            Candidate(f"piece {m.piece}", _score(m), m.piece in meant, m.belongs) for m in matches
        ),
        face_candidate=seen.piece,
        mesh=found.mesh if found.cut else None,
        notes=(*found.notes, *talk.notes()),
        usage=talk.usage(),
    )


def _meant(answer: GroundingAnswer) -> tuple[int, ...]:
    yes = tuple(match.piece for match in answer.matches if match.belongs == "yes")
    partly = [match for match in answer.matches if match.belongs == "partly"]
    if yes or not partly:
        return yes
    return (max(partly, key=lambda match: match.confidence).piece,)


def _score(match: Match) -> float:
    """How well a piece fits, 0..1."""
    sure = match.confidence / 100.0
    return round({"yes": 0.5 + sure / 2, "partly": 0.5, "no": 0.5 - sure / 2}[match.belongs], 4)


def _reason(meant: tuple[int, ...], count: int) -> str:
    if not meant:
        return f"the model says of none of {count} pieces that it belongs to it"
    return f"the model says so of {len(meant)} of {count} pieces: {', '.join(map(str, sorted(meant)))}"
