"""Talking to the model: every question goes one way, and is kept for the recording with its pictures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeVar

from pydantic import BaseModel

from simart_kit import Note
from simart_kit.evidence import Evidence, PictureEvidence, TextEvidence

from ..vlm import Ledger, Question

if TYPE_CHECKING:
    from simart_kit.arrays import ByteArray
    from simart_kit.usage import ModelUsage

    from ..vlm import Reply, Vlm, VlmOptions

T = TypeVar("T", bound=BaseModel)
Shown = tuple[str, "ByteArray"]
"""What a picture shows, and its (H, W, 3) pixels."""


class Talk:
    """Questions to one model about one object.

    Args:
        vlm: that is asked.
        system: what it is told before each question.
        options: with the prices of tokens.
    """

    def __init__(self, vlm: Vlm, system: str, options: VlmOptions) -> None:
        self._vlm = vlm
        self._system = system
        self._options = options
        self._evidence: list[Evidence] = []
        self._ledger = Ledger()

    def ask(self, topic: str, text: str, pictures: Sequence[Shown], answer: type[T]) -> T:
        """The model's answer.

        Args:
            topic: names the views of this question in the recording.
            text: the question.
            pictures: that it speaks of, in order.
            answer: what is wanted.

        Raises:
            BadInputError: there is no usable answer.
        """
        listed = "\n".join(f"Picture {i}: {what}." for i, (what, _) in enumerate(pictures, start=1))
        question = Question(
            self._system, f"{listed}\n\n{text}", tuple(pixels for _, pixels in pictures), answer
        )
        reply = self._vlm.ask(question)
        self._ledger = self._ledger.plus(reply)
        topic = f"{self._ledger.answers} {topic}"
        numbered = enumerate(pictures, start=1)
        self._evidence += [PictureEvidence(f"{topic}, picture {i}", pixels) for i, (_, pixels) in numbered]
        self._evidence.append(TextEvidence(f"{topic}, asked and said", _told(question, reply)))
        value = reply.value
        assert isinstance(value, answer)
        return value

    @property
    def evidence(self) -> tuple[Evidence, ...]:
        """Pictures, questions and answers so far."""
        return tuple(self._evidence)

    def notes(self, stage: str = "segment") -> tuple[Note, ...]:
        """Who was asked by a stage, and what that took."""
        return self._ledger.notes(stage, self._options)

    def usage(self) -> tuple[ModelUsage, ...]:
        """The same, for provenance."""
        return self._ledger.usage(self._options)


def _told(question: Question, reply: Reply) -> str:
    asked, said = (text.replace("```", "'''") for text in (question.text, reply.raw))
    return f"### Asked\n\n```text\n{asked}\n```\n\n### {reply.model} said\n\n```json\n{said}\n```"
