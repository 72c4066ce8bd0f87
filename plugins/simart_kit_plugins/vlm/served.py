"""A model on a server: questions as chat messages, settings that the server does not take left out."""

from __future__ import annotations

import re
from typing import Any

from .chat import Message, chat, picture_piece, text_message
from .endpoint import Endpoint, RefusedError
from .options import VlmOptions
from .pacing import Pace
from .values import Completion, Correction, Question
from .wording import correction_text, said_before, system_text

# What servers say of a setting that they do not take.
_NOT_TAKEN = {
    "response_format": re.compile(r"response_format|json_schema|structured|guided|grammar", re.IGNORECASE),
    "max_tokens": re.compile(r"max_completion_tokens"),
    "temperature": re.compile(r"temperature"),
    "seed": re.compile(r"\bseed\b"),
}
_REMARKS = {
    "response_format": "the server takes no response_format: the schema was told in the prompt alone",
    "temperature": "the server takes no temperature: its answers may differ from run to run",
}
_WRONG_REQUEST = (400, 422)


class Served:
    """A model that a server runs; remembers what that server does not take."""

    def __init__(self, endpoint: Endpoint, options: VlmOptions) -> None:
        """A server, and how its model is asked."""
        self._endpoint = endpoint
        self._settings = {name: getattr(options, name) for name in ("temperature", "seed", "max_tokens")}
        self._pace = Pace(options.rate_limit)
        self._left_out: tuple[str, ...] = ()

    @property
    def who(self) -> str:
        return f"model {self._endpoint.model} at {self._endpoint.url}"

    def say(self, question: Question, correction: Correction | None) -> Completion:
        """The server's reply.

        Raises:
            EndpointError: see `chat.chat`.
        """
        table = self._settings | {
            "messages": _messages(question, correction),
            "response_format": _form(question),
        }
        while True:
            try:
                completion = chat(self._endpoint, self._taken(table), self._pace.wait)
            except RefusedError as error:
                culprit = self._culprit(error)
                if culprit is None:
                    raise
                self._left_out += (culprit,)
            else:
                return self._remarked(completion)

    def _taken(self, table: dict[str, Any]) -> dict[str, Any]:
        """The request without what the server does not take; newer ones know max_tokens by another name."""
        taken = {name: value for name, value in table.items() if name not in self._left_out}
        if "max_tokens" in self._left_out:
            taken["max_completion_tokens"] = table["max_tokens"]
        return taken

    def _culprit(self, error: RefusedError) -> str | None:
        """The setting that a refusal speaks of, where it can be left out and was not yet."""
        if error.code not in _WRONG_REQUEST:
            return None
        named = (name for name, pattern in _NOT_TAKEN.items() if pattern.search(error.said))
        return next((name for name in named if name not in self._left_out), None)

    def _remarked(self, completion: Completion) -> Completion:
        remarks = tuple(_REMARKS[name] for name in self._left_out if name in _REMARKS)
        return Completion(
            completion.text, completion.complete, completion.input_tokens, completion.output_tokens, remarks
        )


def _messages(question: Question, correction: Correction | None) -> list[Message]:
    """Pictures first, then the text, as vision-language models are trained."""
    pieces = [picture_piece(picture) for picture in question.pictures]
    pieces.append({"type": "text", "text": question.text})
    messages = [text_message("system", system_text(question)), {"role": "user", "content": pieces}]
    if correction is None:
        return messages
    said = text_message("assistant", said_before(correction))
    return [*messages, said, text_message("user", correction_text(correction))]


def _form(question: Question) -> dict[str, Any]:
    name = re.sub(r"\W", "_", question.answer.__name__, flags=re.ASCII)[:64]
    schema = {"name": name, "schema": question.schema(), "strict": True}
    return {"type": "json_schema", "json_schema": schema}
