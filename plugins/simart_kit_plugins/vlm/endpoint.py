"""A server that is asked over HTTP: where it is, and its key, which is shown nowhere."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field
from urllib.parse import urlsplit

from simart_kit.errors import BadInputError

KEY_VARIABLE = "SIMART_VLM_API_KEY"
_PATH = "/chat/completions"
_ESCAPE = re.compile(r"\\u([0-9a-fA-F]{4})|\\(.)")
# Shorter ones, such as "EMPTY", are no secret, and stand in answers by chance.
_SHORTEST_KEY = 8


class EndpointError(BadInputError):
    """A server cannot be reached, refuses, or answers with what is no answer."""


class RefusedError(EndpointError):
    """The server understood the request, and will not do as it says.

    Attributes:
        code: HTTP status.
        said: what the server said of it, in one line.
    """

    def __init__(self, message: str, code: int, said: str) -> None:
        super().__init__(message)
        self.code, self.said = code, said


@dataclass(frozen=True, slots=True)
class Endpoint:
    """A server and how long it is waited for.

    Attributes:
        url: of its API, such as "http://localhost:8000/v1".
        model: name that it serves the model under.
        timeout: longest wait for one reply [s].
        pause: before the first retry [s]; each further one takes twice as long.
        retries: after a refused or broken connection, 429 and 5xx; one of them at most after silence.
        key: sent as a bearer token where it is not ""; shown nowhere.
        key_variable: environment variable of the key, for messages.
        timeout_option: what sets `timeout`, for messages.
    """

    url: str
    model: str
    timeout: float = 300.0
    pause: float = 1.0
    retries: int = 4
    key: str = field(default="", repr=False)
    key_variable: str = KEY_VARIABLE
    timeout_option: str = "timeout"

    @property
    def address(self) -> str:
        """URL that questions are posted to."""
        base = self.url.rstrip("/")
        if base.endswith(_PATH):
            return base
        return base + _PATH if re.search(r"/v\d+$", base) else f"{base}/v1{_PATH}"

    def hidden(self, text: str) -> str:
        """The text without the key, which some servers repeat."""
        if len(self.key) < _SHORTEST_KEY:
            return text
        mark = f"[{self.key_variable}]"
        shown = text.replace(self.key, mark)
        return f"[a text with {mark} in it]" if self.key in _unescaped(shown) else shown


def require_url(url: str, key_variable: str = KEY_VARIABLE) -> None:
    """Raise EndpointError unless this is the URL of a server, and nothing but that; shows no password."""
    if "@" in url or "?" in url or "#" in url:
        raise EndpointError(
            "the endpoint's URL holds more than an address: give the URL alone; a key belongs in the "
            f"environment variable {key_variable}"
        )
    try:
        parts = urlsplit(url)
        valid = parts.scheme in ("http", "https") and bool(parts.hostname) and (parts.port or 1) > 0
    except ValueError:
        valid = False
    if not valid or not url.isascii() or any(ord(c) < 33 for c in url):
        raise EndpointError(f"endpoint {url!r}: give a URL such as http://localhost:8000/v1")


def optional_url(url: str, key_variable: str = KEY_VARIABLE) -> str:
    """The URL of an option, which may be empty: refused with a ValueError, as validators want it.

    So a password in it is refused before it stands in a report or a recording.
    """
    try:
        if url:
            require_url(url, key_variable)
    except EndpointError as error:
        raise ValueError(str(error)) from error
    return url


def key_of(variable: str) -> str:
    """The key that an environment variable holds, "" where it is not set.

    Raises:
        EndpointError: it holds characters that no key has.
    """
    key = os.environ.get(variable, "").strip()
    if not key.isascii() or any(ord(c) < 33 for c in key):
        raise EndpointError(f"{variable} holds characters that no key has: set it again")
    return key


def _unescaped(text: str) -> str:
    """The text as a reader of JSON would see it."""
    return _ESCAPE.sub(lambda found: chr(int(found[1], 16)) if found[1] else found[2], text)
