"""Requests over HTTP: a server that is busy, slow, broken, hostile or gone ends in a reply or one line."""

import json
import re
import socket
import time
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from email.utils import format_datetime

import pytest
from simart_kit_plugins.vlm.chat import chat
from simart_kit_plugins.vlm.endpoint import Endpoint, EndpointError, key_of, require_url

from simart_kit.timeout import time_limit

from .endpoint_cases import completion, serving, status

KEY = "sk-secret-0123456789"


@pytest.fixture(autouse=True)
def _direct(monkeypatch):
    monkeypatch.setenv("no_proxy", "*")


def said(served, **changes):
    """The text of a reply, without long waits."""
    endpoint = replace(Endpoint(served.url, "simart", timeout=5.0, pause=0.01, retries=2), **changes)
    return chat(endpoint, {"messages": [], "max_tokens": 99})


def refusal(*replies, **changes):
    """The message, and how often the server was asked."""
    with serving(*replies) as served, pytest.raises(EndpointError) as caught:
        said(served, **changes)
    message = str(caught.value)
    assert "\n" not in message
    assert served.url in message
    assert len(message) < 500
    return message, len(served.asked)


@pytest.mark.parametrize("code", [429, 500, 503])
def test_a_busy_server_is_asked_again(code):
    with serving(status(code), status(code), completion("hi")) as served:
        assert said(served).text == "hi"
    assert len(served.asked) == 3


def test_a_server_says_how_long_to_wait():
    with serving(status(429, Retry_After="1"), completion("hi")) as served:
        start = time.monotonic()
        assert said(served).text == "hi"
    assert time.monotonic() - start >= 1


@pytest.mark.parametrize("form", ["number", "date"])
def test_a_server_that_asks_for_an_hour_is_left_alone(form):
    date = format_datetime(datetime.now(UTC) + timedelta(hours=1), usegmt=True)
    message, count = refusal(status(429, Retry_After="3600" if form == "number" else date))
    assert count == 1
    assert re.search(r"it asks to be left alone for 3(600|599) s: try again then$", message)


@pytest.mark.parametrize(
    "wait", ["Sat, 01 Jan 2000 00:00:00 GMT", "soon", "-5", "Sat, 01 Jan 9999999999 00:00"]
)
def test_a_wait_that_is_over_or_none_is_no_wait(wait):
    start = time.monotonic()
    with serving(status(503, Retry_After=wait), completion("hi")) as served:
        assert said(served).text == "hi"
    assert time.monotonic() - start < 0.9


@pytest.mark.parametrize(
    ("code", "body", "told", "asked"),
    [
        (429, b"", r"HTTP 429 Too Many Requests \(3 times\)", 3),
        (
            500,
            b'{"error": {"message": "CUDA is gone"}}',
            r"Internal Server Error: CUDA is gone \(3 times\)",
            3,
        ),
        (502, b"\xff\x00" * 100_000, "HTTP 502 Bad Gateway", 3),
        (400, b'{"message": "context length is 4096"}', "HTTP 400 Bad Request: context length is 4096$", 1),
        (404, b'{"error": "no model simart"}', "HTTP 404 Not Found: no model simart$", 1),
        (401, b"", "HTTP 401 Unauthorized; the key is read from SIMART_VLM_API_KEY, which is not set", 1),
    ],
)
def test_a_refusal_is_told_with_what_the_server_said(code, body, told, asked):
    message, count = refusal(status(code, body))
    assert count == asked
    assert re.search(told, message), message


@pytest.mark.parametrize(
    "body",
    [
        completion("hi")[:-20],
        b"<html>It works!</html>",
        b"",
        b"null",
        b"[1, 2]",
        b'{"choices": []}',
        b'{"choices": [{"message": {"content": null}}]}',
        b'{"choices": [{"message": {"content": [{"type": "text"}]}}]}',
        b'{"choices": {"0": 1}}',
        b"[" * 100_000,
        b"\xff\xfe\x00",
    ],
)
def test_what_is_no_chat_completion_is_quoted_and_not_asked_for_again(body):
    message, count = refusal(body)
    assert "is no chat completion" in message
    assert count == 1


def test_a_slow_server_is_not_waited_for():
    start = time.monotonic()
    message, count = refusal(lambda handler: time.sleep(1.5), timeout=0.2)
    assert time.monotonic() - start < 1.2
    assert count == 2  # of the three that the retries allow: who is silent twice will not speak
    assert message.endswith("no reply within 0.2 s: raise timeout (2 times)")


def test_a_server_that_wakes_up_is_asked_again():
    with serving(lambda handler: time.sleep(0.5), completion("hi")) as served:
        assert said(served, timeout=0.2).text == "hi"


def test_the_time_limit_of_a_run_is_not_taken_for_the_servers():
    with (
        serving(lambda handler: time.sleep(1)) as served,
        pytest.raises(TimeoutError, match="stage_timeout"),
        time_limit(0.2),
    ):
        said(served)


def test_a_server_that_drips_is_not_waited_for():
    def drip(handler):
        handler.send_response(200)
        handler.send_header("Content-Length", "1000")
        handler.end_headers()
        for _ in range(30):
            handler.wfile.write(b" ")
            time.sleep(0.05)

    start = time.monotonic()
    message, _ = refusal(drip, timeout=0.3)
    assert time.monotonic() - start < 1
    assert "no reply within 0.3 s" in message


def test_a_reply_without_an_end_is_not_kept():
    def endless(handler):
        handler.send_response(200)
        handler.end_headers()
        for _ in range(40):
            handler.wfile.write(b" " * (1 << 20))

    message, count = refusal(endless)
    assert "longer than 8 MB: it is no answer" in message
    assert count == 1


def test_a_connection_that_breaks_is_tried_again():
    def broken(handler):
        handler.send_response(200)
        handler.send_header("Content-Length", "1000")
        handler.end_headers()
        handler.wfile.write(b"{")

    with serving(broken, lambda handler: handler.connection.close(), completion("hi")) as served:
        assert said(served).text == "hi"
    message, count = refusal(broken)
    assert "the connection broke" in message
    assert count == 3


def test_a_server_that_is_not_there_is_told():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        endpoint = Endpoint(f"http://127.0.0.1:{taken.getsockname()[1]}", "simart", pause=0.01, retries=1)
    with pytest.raises(EndpointError, match=r"cannot be reached: .*is the server running\? \(2 times\)"):
        chat(endpoint, {})


def test_the_key_goes_to_no_other_server():
    with serving(completion("hi")) as other:
        message, count = refusal(status(307, Location=other.url), key=KEY)
        message, count = refusal(status(302, Location=other.url), key=KEY)
    assert other.asked == []
    assert count == 1
    assert "redirects are not followed" in message


def test_the_key_is_shown_nowhere():
    endpoint = Endpoint("http://localhost:8000/v1", "simart", key=KEY)
    assert KEY not in repr(endpoint)
    escaped = KEY.replace("s", "\\u0073", 1)
    for reply in (
        status(401, f"wrong key {KEY}".encode()),
        status(401, json.dumps({"error": {"message": f"wrong key {KEY}"}}).encode()),
        status(400, f'{{"detail": "{{\\"key\\": \\"{escaped}\\"}}"}}'.encode()),
        b"x" * 190 + KEY.encode(),
        f"<html>{escaped}</html>".encode(),
        status(307, Location=f"http://elsewhere/{KEY}"),
        status(500, KEY.encode()),
        lambda handler: handler.wfile.write(f"HTTP/1.1 403 No {KEY}\r\n\r\n".encode()),
        lambda handler: handler.wfile.write(f"HTTP/1.1 403 {'x' * 190}{KEY}\r\n\r\n".encode()),
        lambda handler: handler.wfile.write(f"{KEY}\r\n\r\n".encode()),
    ):
        message, _ = refusal(reply, key=KEY)
        assert KEY[:8] not in message
        assert KEY[-12:] not in message
    with serving(completion(f"your key is {KEY}")) as served:
        assert said(served, key=KEY).text == "your key is [SIMART_VLM_API_KEY]"
    with serving(completion(f'{{"name": "{escaped}"}}')) as served:
        assert KEY[-12:] not in said(served, key=KEY).text


def test_a_word_that_is_no_secret_is_left_in_answers():
    with serving(completion("EMPTY shelf")) as served:
        assert said(served, key="EMPTY").text == "EMPTY shelf"


def test_a_key_with_a_line_break_is_refused_without_showing_it(monkeypatch):
    monkeypatch.setenv("SIMART_VLM_API_KEY", "sk-one\nsk-two")
    with pytest.raises(EndpointError, match="SIMART_VLM_API_KEY holds characters that no key has") as caught:
        key_of("SIMART_VLM_API_KEY")
    assert "sk-" not in str(caught.value)


def test_the_variable_of_the_key_is_told_where_a_url_holds_one():
    with pytest.raises(EndpointError, match="SIMART_VLM_API_KEY") as caught:
        require_url("http://me:word@host/v1")
    assert "word" not in str(caught.value)


@pytest.mark.parametrize(
    "url", ["http://a:1", "http://a:1/", "http://a:1/v1", "http://a:1/v1/", "http://a:1/v1/chat/completions"]
)
def test_the_address_is_found_however_the_url_is_given(url):
    assert Endpoint(url, "m").address == "http://a:1/v1/chat/completions"
