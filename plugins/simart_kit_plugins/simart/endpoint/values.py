"""What is known of a server, and what it said."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field
from urllib.parse import urlsplit

from simart_kit.errors import BadInputError

KEY_VARIABLE = "SIMART_API_KEY"
_PATH = "/chat/completions"


class EndpointError(BadInputError):
    """A server cannot be reached, refuses, or answers with what is no answer."""


@dataclass(frozen=True, slots=True)
class Endpoint:
    """A server and how long it is waited for.

    Attributes:
        url: of its API, such as "http://localhost:8000/v1".
        model: name that it serves the model under.
        timeout: longest wait for one reply [s].
        pause: before the first retry [s]; each further one takes twice as long.
        retries: after a refused or broken connection, 429 and 5xx.
        key: sent as a bearer token where it is not ""; shown nowhere.
    """

    url: str
    model: str
    timeout: float = 300.0
    pause: float = 1.0
    retries: int = 4
    key: str = field(default="", repr=False)

    @property
    def address(self) -> str:
        """URL that questions are posted to."""
        base = self.url.rstrip("/")
        if base.endswith(_PATH):
            return base
        return base + _PATH if re.search(r"/v\d+$", base) else f"{base}/v1{_PATH}"


@dataclass(frozen=True, slots=True)
class Reply:
    """What a server said.

    Attributes:
        text: of the answer.
        complete: whether the model ended by itself, and not at the limit of tokens.
    """

    text: str
    complete: bool


def require_url(url: str) -> None:
    """Raise EndpointError unless this is the URL of a server, and nothing but that; shows no password."""
    if "@" in url or "?" in url or "#" in url:
        raise EndpointError(
            "the endpoint's URL holds more than an address: give the URL alone; a key belongs in the "
            f"environment variable {KEY_VARIABLE}"
        )
    try:
        parts = urlsplit(url)
        valid = parts.scheme in ("http", "https") and bool(parts.hostname) and (parts.port or 1) > 0
    except ValueError:
        valid = False
    if not valid or not url.isascii() or any(ord(c) < 33 for c in url):
        raise EndpointError(f"endpoint {url!r}: give a URL such as http://localhost:8000/v1")


def endpoint_at(url: str, model: str, timeout: float) -> Endpoint:
    """The server at a URL, with the key of the environment.

    Raises:
        EndpointError: no http(s) URL, more than that in it (see `require_url`), or no name of a model.
    """
    require_url(url)
    if not model:
        raise EndpointError(
            f"endpoint {url}: its model is not named: add --set segmenter.options.endpoint_model=NAME, "
            "the name that the server lists under /v1/models"
        )
    key = os.environ.get(KEY_VARIABLE, "").strip()
    if not key.isascii() or any(ord(c) < 33 for c in key):
        raise EndpointError(f"{KEY_VARIABLE} holds characters that no key has: set it again")
    return Endpoint(url, model, timeout, key=key)
