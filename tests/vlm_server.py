"""A vision-language model that a test plays: a real server on loopback, and a client with short pauses."""

from __future__ import annotations

import base64
import io
import json
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image
from simart_kit_plugins.vlm.opening import endpoint_of, vlm_of
from simart_kit_plugins.vlm.options import VlmOptions
from simart_kit_plugins.vlm.served import Served

from .endpoint_cases import serving, status

KEY = "sk-vlm-secret-0123456789"


@dataclass(frozen=True, eq=False)
class Asked:
    """A request, as a model would see it.

    Attributes:
        system: text before the question, the answer's schema in it.
        text: of the question.
        pictures: (H, W, 3) each.
        turns: roles of all messages; five of them where an answer is corrected, else two.
        table: the request as it was sent.
    """

    system: str
    text: str
    pictures: tuple[np.ndarray, ...]
    turns: tuple[str, ...]
    table: dict


def asked(table):
    """What a request's table says."""
    system, user = table["messages"][:2]
    pieces = user["content"]
    uris = [piece["image_url"]["url"] for piece in pieces if piece["type"] == "image_url"]
    return Asked(
        system["content"],
        next(piece["text"] for piece in pieces if piece["type"] == "text"),
        tuple(picture_of(uri) for uri in uris),
        tuple(message["role"] for message in table["messages"]),
        table,
    )


def picture_of(uri):
    """(H, W, 3) pixels of a data URI."""
    data = base64.b64decode(uri.removeprefix("data:image/png;base64,"))
    return np.asarray(Image.open(io.BytesIO(data)))


def said(content, tokens=(100, 20), finish="stop"):
    """A chat completion with its count of tokens; tables become JSON."""
    text = content if isinstance(content, str) else json.dumps(content)
    message = {"role": "assistant", "content": text}
    table = {"choices": [{"index": 0, "message": message, "finish_reason": finish}]}
    if tokens:
        table["usage"] = {"prompt_tokens": tokens[0], "completion_tokens": tokens[1]}
    return json.dumps(table).encode()


@contextmanager
def played(answer):
    """Serve what `answer(Asked)` returns, a table or a text, to one client at a time; yields `Served`."""

    def reply(handler):
        status(200, said(answer(asked(served.asked[-1][2]))))(handler)

    with serving(reply) as served:
        yield served


def options_for(served, **changes):
    """Options of a client of this server; nothing is kept unless a cache is named."""
    named = {"url": served.url, "model": "Qwen3-VL", "cache": "off", "timeout": 5.0, "retries": 2} | changes
    return VlmOptions(**named)


def client(served, **changes):
    """A `Vlm` of this server that waits a hundredth of a second where others wait one."""
    options = options_for(served, **changes)
    return vlm_of(Served(replace(endpoint_of(options), pause=0.01), options), options)
