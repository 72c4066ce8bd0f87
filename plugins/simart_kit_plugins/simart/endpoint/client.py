"""One question to a server: sent, waited for, sent again where that may help, and read."""

from __future__ import annotations

import http.client
import json
import socket
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any
from urllib.error import HTTPError, URLError
from urllib.request import HTTPRedirectHandler, Request, build_opener

from .values import KEY_VARIABLE, Endpoint, EndpointError, Reply

# An answer of 64 parts has some 100 kB.
_LARGEST = 8 << 20
_CHUNK = 1 << 16
_QUOTED = 200
_LONGEST_PAUSE = 30.0
# A time limit of the run also ends a wait, by a TimeoutError of its own, before the endpoint's is over.
_EARLY = 0.05
_BUSY = (408, 429, 500, 502, 503, 504)

Message = dict[str, Any]


@dataclass(frozen=True, slots=True)
class _Failure:
    """Why there is no reply, and whether to try again; after so many seconds where the server says so."""

    told: str
    again: bool
    after: float = 0.0


class _StayHere(HTTPRedirectHandler):
    """Follows no redirect: the key would go along to whoever the server names."""

    def redirect_request(self, *_: Any) -> None:
        return None


def chat(
    endpoint: Endpoint, messages: Sequence[Message], *, temperature: float, seed: int, max_tokens: int
) -> Reply:
    """The server's reply to messages.

    Raises:
        EndpointError: no reply came in time or after all retries, the server refuses, or its reply is none of
            a chat: one line with the server and what it said.
    """
    body = {
        "model": endpoint.model,
        "messages": list(messages),
        "temperature": temperature,
        "seed": seed,
        "max_tokens": max_tokens,
    }
    sent, tried = json.dumps(body).encode(), 1
    got = _posted(endpoint, sent)
    while isinstance(got, _Failure) and got.again and tried <= endpoint.retries:
        time.sleep(min(_LONGEST_PAUSE, max(endpoint.pause * 2 ** (tried - 1), got.after)))
        got, tried = _posted(endpoint, sent), tried + 1
    if isinstance(got, bytes):
        return _reply(endpoint, got)
    tries = f" ({tried} times)" if tried > 1 else ""
    raise EndpointError(f"endpoint {endpoint.url}: {got.told}{tries}")


def _posted(endpoint: Endpoint, body: bytes) -> bytes | _Failure:
    """The body of the server's reply, or why there is none."""
    head = {"Content-Type": "application/json", "Accept": "application/json"}
    if endpoint.key:
        head["Authorization"] = f"Bearer {endpoint.key}"
    request = Request(endpoint.address, body, head, method="POST")
    deadline = time.monotonic() + endpoint.timeout
    try:
        with build_opener(_StayHere).open(request, timeout=endpoint.timeout) as response:
            return _read(response, deadline)
    except HTTPError as error:
        with error:
            return _refused(endpoint, error, deadline)
    except (http.client.HTTPException, OSError) as error:
        return _broken(endpoint, error, deadline)


def _broken(endpoint: Endpoint, error: Exception, deadline: float) -> _Failure:
    """Why there is no reply at all; raises a TimeoutError that is not the endpoint's own."""
    unreached = isinstance(error, URLError)
    reason = error.reason if isinstance(error, URLError) else error
    if isinstance(reason, TimeoutError) and reason.errno is None:  # not one of the system's network
        if time.monotonic() < deadline - _EARLY:
            raise reason
        return _Failure(f"no reply within {endpoint.timeout:g} s: raise endpoint_timeout", again=False)
    if not unreached:
        return _Failure(f"the connection broke: {type(error).__name__}: {error}", again=True)
    told = getattr(reason, "strerror", None) or str(reason)
    unknown = isinstance(reason, socket.gaierror)
    return _Failure(f"cannot be reached: {told}: is the server running?", again=not unknown)


def _read(response: Any, deadline: float) -> bytes | _Failure:
    """The whole body. Raises TimeoutError when it is not there in time, and OSError where it is cut off."""
    chunks, size = [], 0
    while chunk := response.read1(_CHUNK):
        size += len(chunk)
        if size > _LARGEST:
            return _Failure(f"the reply is longer than {_LARGEST >> 20} MB: it is no answer", again=False)
        if time.monotonic() > deadline:
            raise TimeoutError
        chunks.append(chunk)
    if response.length:
        raise http.client.IncompleteRead(b"".join(chunks), response.length)
    return b"".join(chunks)


def _refused(endpoint: Endpoint, error: HTTPError, deadline: float) -> _Failure:
    """What a status other than 200 means."""
    try:
        body = _read(error, deadline)
    except (OSError, http.client.HTTPException) as broken:
        body = _broken(endpoint, broken, deadline)
    said = _said(endpoint, body) if isinstance(body, bytes) else body.told
    told = f"HTTP {error.code} {error.reason}" + (f": {said}" if said else "")
    if error.code in (401, 403):
        told += f"; the key is read from {KEY_VARIABLE}" + ("" if endpoint.key else ", which is not set")
    if 300 <= error.code < 400:
        told += "; redirects are not followed: give the final URL"
    wait = error.headers.get("Retry-After", "")
    return _Failure(told, error.code in _BUSY, float(wait) if wait.isdecimal() else 0.0)


def _said(endpoint: Endpoint, body: bytes) -> str:
    """The message of an error's body, in one line."""
    text = body.decode("utf-8", "replace")
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        found = text
    for key in ("error", "message"):
        found = found.get(key, found) if isinstance(found, dict) else found
    return quoted(_hidden(endpoint, str(found)))


def _reply(endpoint: Endpoint, body: bytes) -> Reply:
    """A chat completion's text."""
    where = f"endpoint {endpoint.url}: the reply is no chat completion"
    text = body.decode("utf-8", "replace")
    shown = quoted(_hidden(endpoint, text))
    try:
        choice = json.loads(text)["choices"][0]
        content, reason = choice["message"]["content"], choice.get("finish_reason")
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        raise EndpointError(f"{where}: {shown or 'it is empty'}") from error
    if not isinstance(content, str):
        raise EndpointError(f"{where} with a text in it: {shown}")
    return Reply(_hidden(endpoint, content), complete=reason != "length")


def quoted(text: str) -> str:
    """The beginning of a text in one line."""
    line = " ".join("".join(c if c.isprintable() else " " for c in text[: 4 * _QUOTED]).split())
    return line if len(line) <= _QUOTED else line[:_QUOTED] + "..."


def _hidden(endpoint: Endpoint, text: str) -> str:
    """The text without the key, which some servers repeat."""
    return text.replace(endpoint.key, f"[{KEY_VARIABLE}]") if endpoint.key else text
