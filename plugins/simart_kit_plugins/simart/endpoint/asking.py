"""A prompt as chat messages, and its answer: asked again once, with the mistake, where it cannot be read."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from simart_kit.errors import BadInputError

from ...vlm.chat import picture_piece, text_message
from ..prompt.values import Prompt
from .client import Message, chat, quoted
from .values import Endpoint, EndpointError

T = TypeVar("T")

# A model that got lost in the middle is shown the beginning of what it said.
_SHOWN = 2000


@dataclass(frozen=True, slots=True)
class Told(Generic[T]):
    """A server's answer.

    Attributes:
        text: as the server gave it.
        value: what was read from it.
        mistake: of its first answer, where it had to be asked again; else "".
    """

    text: str
    value: T
    mistake: str = ""


def ask(
    endpoint: Endpoint,
    prompt: Prompt,
    read: Callable[[str], T],
    *,
    temperature: float,
    seed: int,
    max_tokens: int,
) -> Told[T]:
    """Ask a server; where `read` raises BadInputError, ask once more and say why.

    Raises:
        EndpointError: see `chat`; or neither answer ends within `max_tokens` and can be read.
    """
    messages = prompt_messages(prompt)
    mistake = ""
    for attempt in range(2):
        reply = chat(endpoint, messages, temperature=temperature, seed=seed + attempt, max_tokens=max_tokens)
        if not reply.complete:
            raise EndpointError(
                f"endpoint {endpoint.url}: the answer does not end within max_tokens, {max_tokens}: "
                "raise segmenter.options.max_tokens"
            )
        try:
            return Told(reply.text, read(reply.text), mistake)
        except BadInputError as error:
            mistake = str(error)
            messages = [*messages, *_again(reply.text, mistake)]
    raise EndpointError(
        f"endpoint {endpoint.url}: two answers could not be read: {quoted(mistake)}; "
        f"it said: {quoted(reply.text)}"
    )


def prompt_messages(prompt: Prompt) -> list[Message]:
    """A prompt in OpenAI's form: picture, then voxels and question, as the model was trained to read them."""
    content = [] if prompt.picture is None else [picture_piece(prompt.picture)]
    content.append({"type": "text", "text": prompt.voxels.atoms() + prompt.question})
    system = [text_message("system", prompt.system)] if prompt.system else []
    return [*system, {"role": "user", "content": content}]


def _again(said: str, mistake: str) -> Sequence[Message]:
    return (
        text_message("assistant", said[:_SHOWN]),
        text_message("user", f"That answer cannot be read: {mistake}. Give the whole answer, right."),
    )
