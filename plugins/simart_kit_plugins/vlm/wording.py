"""The words around a question: that the answer is one JSON object, and what was wrong with the first one."""

from __future__ import annotations

import json

from .values import Correction, Question

# A model that got lost in the middle is shown the beginning of what it said.
_SHOWN = 2000


def system_text(question: Question) -> str:
    """What the model is told before; the schema too, since guided decoding does not show it to a model."""
    schema = json.dumps(question.schema(), ensure_ascii=False, separators=(",", ":"))
    form = f"Answer with one JSON object, and no other text. It must fit this JSON schema:\n{schema}"
    return f"{question.system}\n\n{form}" if question.system else form


def said_before(correction: Correction) -> str:
    """The answer that is corrected, as the model is shown it again."""
    return correction.said[:_SHOWN]


def correction_text(correction: Correction) -> str:
    """What the model is told of its first answer."""
    return (
        f"That answer cannot be used: {correction.mistake}. "
        "Answer again with one whole JSON object that fits the schema, and no other text."
    )
