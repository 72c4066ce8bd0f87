"""One request to a server: sent, waited for, sent again where that may help, its reply read whole."""

from __future__ import annotations

import http.client
import json
import math
import socket
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from typing import Any
from urllib.error import HTTPError, URLError
from urllib.request import HTTPRedirectHandler, Request, build_opener

from .endpoint import Endpoint, EndpointError, RefusedError

# An answer of 64 parts has some 100 kB.
_LARGEST = 8 << 20
_CHUNK = 1 << 16
_QUOTED = 200
_LONGEST_PAUSE = 30.0
# A server may ask for more patience than that, within reason.
_LONGEST_WAIT = 120.0
# A time limit of the run also ends a wait, by a TimeoutError of its own, before the endpoint's is over.
_EARLY = 0.05
_BUSY = (408, 429, 500, 502, 503, 504)


@dataclass(frozen=True, slots=True)
class _Failure:
    """Why there is no reply.

    Attributes:
        told: in one line.
        tries: after how many of them to give up; infinite: as many as the endpoint allows.
        after: seconds that the server asks to be left alone.
        code: HTTP status, or 0.
        said: by the server.
    """

    told: str
    tries: float = 1
    after: float = 0.0
    code: int = 0
    said: str = ""


class _StayHere(HTTPRedirectHandler):
    """Follows no redirect: the key would go along to whoever the server names."""

    def redirect_request(self, *_: Any) -> None:
        return None


def post(endpoint: Endpoint, table: Mapping[str, Any], turn: Callable[[], None] = lambda: None) -> bytes:
    """The body of the server's reply to a JSON table.

    Args:
        endpoint: the server.
        table: what is sent.
        turn: called before each request, to wait for its turn.

    Raises:
        RefusedError: the server answers with a status that says no.
        EndpointError: no reply came in time or after all retries, or one too long. The message is one line.
    """
    sent, tried = json.dumps(table).encode(), 1
    turn()
    got = _posted(endpoint, sent)
    while isinstance(got, _Failure) and tried < got.tries and tried <= endpoint.retries:
        time.sleep(max(got.after, min(_LONGEST_PAUSE, endpoint.pause * 2 ** (tried - 1))))
        turn()
        got, tried = _posted(endpoint, sent), tried + 1
    if isinstance(got, bytes):
        return got
    tries = f" ({tried} times)" if tried > 1 else ""
    message = endpoint.hidden(f"endpoint {endpoint.url}: {got.told}{tries}")
    raise RefusedError(message, got.code, got.said) if got.code else EndpointError(message)


def quoted(text: str) -> str:
    """The beginning of a text in one line."""
    line = " ".join("".join(c if c.isprintable() else " " for c in text[: 4 * _QUOTED]).split())
    return line if len(line) <= _QUOTED else line[:_QUOTED] + "..."


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
        # A server that was silent twice is not worth further minutes.
        return _Failure(f"no reply within {endpoint.timeout:g} s: raise {endpoint.timeout_option}", tries=2)
    if not unreached:
        told = quoted(endpoint.hidden(f"{type(error).__name__}: {error}"))
        return _Failure(f"the connection broke: {told}", tries=math.inf)
    told = getattr(reason, "strerror", None) or str(reason)
    unknown = isinstance(reason, socket.gaierror)
    return _Failure(f"cannot be reached: {told}: is the server running?", tries=1 if unknown else math.inf)


def _read(response: Any, deadline: float) -> bytes | _Failure:
    """The whole body. Raises TimeoutError when it is not there in time, and OSError where it is cut off."""
    chunks, size = [], 0
    while chunk := response.read1(_CHUNK):
        size += len(chunk)
        if size > _LARGEST:
            return _Failure(f"the reply is longer than {_LARGEST >> 20} MB: it is no answer")
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
    told = f"HTTP {error.code} {quoted(endpoint.hidden(error.reason))}" + (f": {said}" if said else "")
    if error.code in (401, 403):
        told += f"; the key is read from {endpoint.key_variable}"
        told += "" if endpoint.key else ", which is not set"
    if 300 <= error.code < 400:
        told += "; redirects are not followed: give the final URL"
    after = _patience(error.headers.get("Retry-After", ""))
    if after > _LONGEST_WAIT:
        told += f"; it asks to be left alone for {after:.0f} s: try again then"
    tries = math.inf if error.code in _BUSY and after <= _LONGEST_WAIT else 1
    return _Failure(told, tries, after, error.code, said)


def _patience(wait: str) -> float:
    """Seconds of a Retry-After, which is a number of them or a date; 0 where it is neither."""
    if wait.isascii() and wait.isdecimal():
        return float(wait)
    try:
        date = parsedate_to_datetime(wait)
    except (ValueError, OverflowError):
        return 0.0
    return max(0.0, ((date if date.tzinfo else date.replace(tzinfo=UTC)) - datetime.now(UTC)).total_seconds())


def _said(endpoint: Endpoint, body: bytes) -> str:
    """The message of an error's body, in one line."""
    text = body.decode("utf-8", "replace")
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        found = text
    for key in ("error", "message"):
        found = found.get(key, found) if isinstance(found, dict) else found
    return quoted(endpoint.hidden(str(found)))
