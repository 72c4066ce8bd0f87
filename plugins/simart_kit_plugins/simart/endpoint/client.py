"""One question to a server that runs a SIMART model."""

from __future__ import annotations

from collections.abc import Sequence

from ...vlm import chat as general
from ...vlm.chat import Message
from ...vlm.http import quoted
from ...vlm.values import Completion
from .values import Endpoint

__all__ = ["Message", "chat", "quoted"]


def chat(
    endpoint: Endpoint, messages: Sequence[Message], *, temperature: float, seed: int, max_tokens: int
) -> Completion:
    """The server's reply to messages.

    Raises:
        EndpointError: no reply came in time or after all retries, the server refuses, or its reply is none of
            a chat: one line with the server and what it said.
    """
    table = {"messages": list(messages), "temperature": temperature, "seed": seed, "max_tokens": max_tokens}
    return general.chat(endpoint, table)
