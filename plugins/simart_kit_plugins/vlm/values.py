"""What a vision-language model is asked, and what it answered."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from pydantic import BaseModel

from simart_kit.arrays import ByteArray


@dataclass(frozen=True, eq=False, slots=True)
class Question:
    """A question about pictures, whose answer is a table.

    Attributes:
        system: what the model is told before; "" for nothing.
        text: the question.
        pictures: (H, W, 3) sRGB, 0..255, in the order that the text speaks of them.
        answer: what the answer must be: a pydantic model that forbids unknown keys. Its JSON schema is sent.

    Raises:
        ValueError: a picture has another shape or type, or the model lets unknown keys through.
    """

    system: str
    text: str
    pictures: tuple[ByteArray, ...]
    answer: type[BaseModel]

    def __post_init__(self) -> None:
        """Tell the author's mistakes, which a server would tell less clearly."""
        for picture in self.pictures:
            if picture.dtype != np.uint8 or picture.ndim != 3 or picture.shape[2] != 3 or not picture.size:
                raise ValueError(f"a picture is (H, W, 3) uint8, not {picture.shape} {picture.dtype}")
        if self.answer.model_config.get("extra") != "forbid":
            raise ValueError(f"{self.answer.__name__} must have extra='forbid'")

    def schema(self) -> dict[str, Any]:
        """JSON schema of the answer."""
        return self.answer.model_json_schema()


@dataclass(frozen=True, slots=True)
class Correction:
    """Why a question is asked once more.

    Attributes:
        said: the answer that could not be used.
        mistake: what is wrong with it, in one line.
    """

    said: str
    mistake: str


@dataclass(frozen=True, slots=True)
class Completion:
    """What a model said, not yet read.

    Attributes:
        text: of the answer.
        complete: whether the model ended by itself, and not at the limit of tokens.
        input_tokens: that it read; 0 where the server does not tell.
        output_tokens: that it wrote; 0 where the server does not tell.
        remarks: on how it was asked, a sentence each.
    """

    text: str
    complete: bool
    input_tokens: int = 0
    output_tokens: int = 0
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Usage:
    """What an answer took.

    Attributes:
        calls: completions: 1, or 2 where it was asked for again.
        input_tokens: read by the model, as the server counts them; 0 where it does not.
        output_tokens: written by it.
        cached: whether the answer was kept from an earlier run: then nothing of this was spent now.
    """

    calls: int = 0
    input_tokens: int = 0
    output_tokens: int = 0
    cached: bool = False

    def plus(self, completion: Completion) -> Usage:
        """With one more completion."""
        return Usage(
            self.calls + 1,
            self.input_tokens + completion.input_tokens,
            self.output_tokens + completion.output_tokens,
            self.cached,
        )


@dataclass(frozen=True, slots=True)
class Reply:
    """An answer that fits its question.

    Attributes:
        value: an instance of the question's `answer`.
        usage: what it took.
        model: that gave it.
        raw: its text as the model gave it, without the key where a server repeats that.
        remarks: on how it came about, a sentence each.
    """

    value: BaseModel
    usage: Usage
    model: str
    raw: str
    remarks: tuple[str, ...] = ()


class Speaker(Protocol):
    """Who says something to a question, before it is read.

    Attributes:
        who: it is, for messages.
    """

    @property
    def who(self) -> str: ...

    def say(self, question: Question, correction: Correction | None) -> Completion:
        """What the model says, to the question or to the correction of its first answer.

        Raises:
            BadInputError: nothing; one line.
        """
        ...


class Vlm(Protocol):
    """A vision-language model that can be asked; `open_vlm` gives one."""

    def ask(self, question: Question) -> Reply:
        """The answer, from the cache where it is there.

        Raises:
            BadInputError: there is no usable answer; one line with who was asked, why, and what to do.
        """
        ...
