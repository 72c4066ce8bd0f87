"""Asking a model on a server: what is sent, and what is made of good, broken and hostile replies."""

import base64
import io
import re
import socket
import time

import numpy as np
import pytest
from PIL import Image
from simart_kit_plugins.simart.endpoint.asking import ask, prompt_messages
from simart_kit_plugins.simart.endpoint.client import chat
from simart_kit_plugins.simart.endpoint.values import Endpoint, EndpointError, endpoint_at
from simart_kit_plugins.simart.prompt.values import Prompt
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens

from simart_kit.errors import BadInputError
from simart_kit.timeout import time_limit

from .endpoint_cases import completion, serving, status

VOXELS = VoxelTokens(TokenGrid(), np.array([3, 43]), np.array([7, 1930]))
PROMPT = Prompt("Be strict.", "What is it?", VOXELS)
KEY = "sk-secret-0123456789"


@pytest.fixture(autouse=True)
def _direct(monkeypatch):
    monkeypatch.setenv("no_proxy", "*")
    monkeypatch.delenv("SIMART_API_KEY", raising=False)


def said(served, **changes):
    """The text of a reply, without long waits."""
    options = {"timeout": 5.0, "pause": 0.01, "retries": 2} | changes
    messages = [{"role": "user", "content": "hello"}]
    return chat(Endpoint(served.url, "simart", **options), messages, temperature=0.5, seed=3, max_tokens=99)


def refusal(*replies, **changes):
    """The message, and how often the server was asked."""
    with serving(*replies) as served, pytest.raises(EndpointError) as caught:
        said(served, **changes)
    message = str(caught.value)
    assert "\n" not in message
    assert served.url in message
    assert len(message) < 500
    return message, len(served.asked)


def test_a_question_is_sent_as_openai_has_it():
    with serving(completion("hi")) as served:
        reply = said(served, key=KEY)
    assert (reply.text, reply.complete) == ("hi", True)
    ((path, head, table),) = served.asked
    assert path == "/v1/chat/completions"
    assert head["Authorization"] == f"Bearer {KEY}"
    assert table == {
        "model": "simart",
        "messages": [{"role": "user", "content": "hello"}],
        "temperature": 0.5,
        "seed": 3,
        "max_tokens": 99,
    }


def test_a_prompt_is_picture_voxels_and_question_in_the_order_of_training():
    system, user = prompt_messages(Prompt("Be strict.", "What is it?", VOXELS, np.zeros((4, 4, 3), np.uint8)))
    assert system == {"role": "system", "content": "Be strict."}
    picture, text = user["content"]
    assert text["text"] == "<voxel><xyz_3><mesh_7><voxel><xyz_43><mesh_1930>What is it?"
    kind, data = picture["image_url"]["url"].split(",")
    assert kind == "data:image/png;base64"
    assert Image.open(io.BytesIO(base64.b64decode(data))).size == (4, 4)
    (alone,) = prompt_messages(Prompt("", "What is it?", VOXELS))
    assert [piece["type"] for piece in alone["content"]] == ["text"]


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
        (401, b"", "HTTP 401 Unauthorized; the key is read from SIMART_API_KEY, which is not set", 1),
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
    assert count == 1
    assert "no reply within 0.2 s: raise endpoint_timeout" in message


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
        chat(endpoint, [], temperature=0, seed=0, max_tokens=1)


def test_the_key_goes_to_no_other_server():
    with serving(completion("hi")) as other:
        message, count = refusal(status(307, Location=other.url), key=KEY)
        message, count = refusal(status(302, Location=other.url), key=KEY)
    assert other.asked == []
    assert count == 1
    assert "redirects are not followed" in message


def test_the_key_is_shown_nowhere(monkeypatch):
    monkeypatch.setenv("SIMART_API_KEY", KEY)
    endpoint = endpoint_at("http://localhost:8000/v1", "simart", 5.0)
    assert endpoint.key == KEY
    assert KEY not in repr(endpoint)
    for reply in (
        status(401, f"wrong key {KEY}".encode()),
        b"x" * 190 + KEY.encode(),
        status(500, KEY.encode()),
    ):
        message, _ = refusal(reply, key=KEY)
        assert KEY[:8] not in message
    with serving(completion(f"your key is {KEY}")) as served:
        assert said(served, key=KEY).text == "your key is [SIMART_API_KEY]"


@pytest.mark.parametrize(
    ("url", "model", "told"),
    [
        ("localhost:8000", "m", "give a URL such as http://localhost:8000/v1"),
        ("file:///etc/passwd", "m", "give a URL such as"),
        ("http://", "m", "give a URL such as"),
        ("http://host:99999999/v1", "m", "give a URL such as"),
        ("http://host/v1 evil", "m", "give a URL such as"),
        ("http://me:word@host/v1", "m", "give the URL alone; a key belongs in the environment variable"),
        ("me:word@host", "m", "give the URL alone"),
        ("http://host/v1?key=word", "m", "give the URL alone"),
        ("http://host/v1", "", "endpoint_model=NAME"),
    ],
)
def test_a_url_that_is_none_is_refused(url, model, told):
    with pytest.raises(EndpointError, match=re.escape(told)) as caught:
        endpoint_at(url, model, 5.0)
    assert "word" not in str(caught.value).replace("passwd", "")


@pytest.mark.parametrize(
    "url", ["http://a:1", "http://a:1/", "http://a:1/v1", "http://a:1/v1/", "http://a:1/v1/chat/completions"]
)
def test_the_address_is_found_however_the_url_is_given(url):
    assert Endpoint(url, "m").address == "http://a:1/v1/chat/completions"


def number(text):
    """What the tests read from a text."""
    if not text.isdecimal():
        raise BadInputError(f"{text!r} is no number")
    return int(text)


def asked(served):
    endpoint = Endpoint(served.url, "simart", timeout=5, pause=0.01, retries=0)
    return ask(endpoint, PROMPT, number, temperature=0.0, seed=4, max_tokens=50)


def test_an_answer_that_cannot_be_read_is_asked_for_once_more_with_the_mistake():
    with serving(completion("seven"), completion("7")) as served:
        told = asked(served)
    assert (told.text, told.value, told.mistake) == ("7", 7, "'seven' is no number")
    first, second = (table for _, _, table in served.asked)
    assert second["messages"][:2] == first["messages"]
    assert second["messages"][2] == {"role": "assistant", "content": "seven"}
    assert "'seven' is no number" in second["messages"][3]["content"]
    assert (first["seed"], second["seed"]) == (4, 5)


def test_two_answers_that_cannot_be_read_end_it():
    prose = "Sure! Here is your object: " + "it has doors. " * 100
    with serving(completion(prose)) as served, pytest.raises(EndpointError) as caught:
        asked(served)
    assert len(served.asked) == 2
    assert "two answers could not be read" in str(caught.value)
    assert "it said: Sure! Here is your object" in str(caught.value)


def test_an_answer_that_does_not_end_names_the_option():
    with (
        serving(completion("7", finish="length")) as served,
        pytest.raises(EndpointError, match=r"within max_tokens, 50: raise segmenter.options.max_tokens"),
    ):
        asked(served)
