"""Chat completions, as OpenAI's API has them: messages to a server, and its reply as a text."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Mapping
from typing import Any

from simart_kit.arrays import ByteArray
from simart_kit.mesh import Image

from .endpoint import Endpoint, EndpointError
from .http import post, quoted
from .values import Completion

Message = dict[str, Any]
_MOST_TOKENS = 1 << 40  # what a server tells beyond is no count


def chat(endpoint: Endpoint, table: Mapping[str, Any], turn: Callable[[], None] = lambda: None) -> Completion:
    """The server's reply to a request for a chat completion.

    Args:
        endpoint: the server; its model is added to the table.
        table: messages and settings.
        turn: see `http.post`.

    Raises:
        EndpointError: as `http.post`, or the reply is none of a chat: one line with what the server said.
    """
    return _completion(endpoint, post(endpoint, {"model": endpoint.model, **table}, turn))


def text_message(role: str, text: str) -> Message:
    """A message that is nothing but a text."""
    return {"role": role, "content": text}


def picture_piece(picture: ByteArray) -> Message:
    """An (H, W, 3) picture as a piece of a message: a PNG in a data URI."""
    data = base64.b64encode(Image.from_pixels(picture).png).decode()
    return {"type": "image_url", "image_url": {"url": f"data:image/png;base64,{data}"}}


def _completion(endpoint: Endpoint, body: bytes) -> Completion:
    where = f"endpoint {endpoint.url}: the reply is no chat completion"
    text = body.decode("utf-8", "replace")
    try:
        table = json.loads(text)
        shown = quoted(endpoint.hidden(json.dumps(table, ensure_ascii=False)))
        choice = table["choices"][0]
        content, reason = choice["message"]["content"], choice.get("finish_reason")
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        raise EndpointError(f"{where}: {quoted(endpoint.hidden(text)) or 'it is empty'}") from error
    if content is None and reason == "length":
        content = ""  # of a model that was still thinking
    if not isinstance(content, str):
        raise EndpointError(f"{where} with a text in it: {shown}")
    used = table.get("usage")
    return Completion(
        endpoint.hidden(_writable(content)),
        reason != "length",
        _count(used, "prompt_tokens"),
        _count(used, "completion_tokens"),
    )


def _writable(text: str) -> str:
    """The text without halves of surrogate pairs, which no file can hold."""
    return text.encode("utf-8", "replace").decode()


def _count(used: object, name: str) -> int:
    """A number of tokens; 0 where the server does not tell it."""
    found = used.get(name) if isinstance(used, dict) else None
    return found if isinstance(found, int) and not isinstance(found, bool) and 0 < found < _MOST_TOKENS else 0
