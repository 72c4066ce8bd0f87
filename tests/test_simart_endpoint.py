"""Asking a SIMART model on a server: what is sent, and what is made of answers that cannot be read."""

import base64
import io
import re
import time
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from simart_kit_plugins.simart.endpoint.asking import ask, prompt_messages
from simart_kit_plugins.simart.endpoint.client import chat
from simart_kit_plugins.simart.endpoint.values import Endpoint, EndpointError, endpoint_at
from simart_kit_plugins.simart.prompt.values import Prompt
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens

from simart_kit.errors import BadInputError

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
    endpoint = replace(endpoint_at(served.url, "simart", 5.0), **{"pause": 0.01, "retries": 0} | changes)
    messages = [{"role": "user", "content": "hello"}]
    return chat(endpoint, messages, temperature=0.5, seed=3, max_tokens=99)


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


def test_what_to_set_is_told_by_its_own_name():
    message, _ = refusal(status(401))
    assert message.endswith("HTTP 401 Unauthorized; the key is read from SIMART_API_KEY, which is not set")
    message, _ = refusal(lambda handler: time.sleep(0.5), timeout=0.2)
    assert message.endswith("no reply within 0.2 s: raise endpoint_timeout")


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
