"""A vision-language model on a real server: what it is sent, and how good and bad replies end."""

import json
import re
import socket
import time
from dataclasses import replace

import numpy as np
import pytest
from pydantic import BaseModel, ConfigDict, ValidationError
from simart_kit_plugins.vlm import Ledger, Question, Reply, Usage, VlmOptions, open_vlm
from simart_kit_plugins.vlm.pacing import Pace

from simart_kit import Note
from simart_kit.errors import BadInputError
from simart_kit.usage import ModelUsage

from .endpoint_cases import serving, status
from .vlm_server import KEY, asked, client, options_for, played, said


class Count(BaseModel):
    model_config = ConfigDict(extra="forbid")

    doors: int


PICTURES = (np.zeros((4, 6, 3), np.uint8), np.arange(75, dtype=np.uint8).reshape(5, 5, 3))
QUESTION = Question("Be strict.", "How many doors?", PICTURES, Count)
GOOD = {"doors": 2}


@pytest.fixture(autouse=True)
def _direct(monkeypatch):
    monkeypatch.setenv("no_proxy", "*")
    monkeypatch.setenv("SIMART_VLM_API_KEY", KEY)


def refusal(*replies, **changes):
    """The one line that a question ends in, and how often the server was asked."""
    with serving(*replies) as served, pytest.raises(BadInputError) as caught:
        client(served, **changes).ask(QUESTION)
    told = str(caught.value)
    assert "\n" not in told
    assert len(told) < 700
    assert served.url in told
    assert KEY not in told
    return told, len(served.asked)


def answered(*replies, **changes):
    """The reply to replies in turn, and the requests."""
    with serving(*replies) as served:
        return client(served, **changes).ask(QUESTION), [table for _, _, table in served.asked]


def test_a_question_is_sent_with_its_pictures_and_schema():
    with played(lambda seen: GOOD) as served:
        reply = client(served, seed=7, max_tokens=50).ask(QUESTION)
    assert reply == Reply(Count(doors=2), Usage(1, 100, 20), "Qwen3-VL", '{"doors": 2}')
    ((path, head, table),) = served.asked
    assert path == "/v1/chat/completions"
    assert head["Authorization"] == f"Bearer {KEY}"
    sent = asked(table)
    assert sent.text == "How many doors?"
    assert [picture.tolist() for picture in sent.pictures] == [picture.tolist() for picture in PICTURES]
    assert sent.system.startswith("Be strict.\n\n")
    assert json.loads(sent.system.splitlines()[-1]) == Count.model_json_schema()
    form = table["response_format"]
    assert form["type"] == "json_schema"
    assert form["json_schema"] == {"name": "Count", "schema": Count.model_json_schema(), "strict": True}
    rest = {name: table[name] for name in ("model", "temperature", "seed", "max_tokens")}
    assert rest == {"model": "Qwen3-VL", "temperature": 0.0, "seed": 7, "max_tokens": 50}


def test_no_key_is_sent_where_none_is_set(monkeypatch):
    monkeypatch.delenv("SIMART_VLM_API_KEY")
    monkeypatch.setenv("OPENAI_API_KEY", KEY)  # of another server
    with played(lambda seen: GOOD) as served:
        client(served).ask(QUESTION)
    assert "Authorization" not in served.asked[0][1]


@pytest.mark.parametrize("code", [429, 500])
def test_a_busy_server_is_asked_again(code):
    reply, tables = answered(status(code), status(code), said(GOOD))
    assert reply.value == Count(doors=2)
    assert len(tables) == 3


@pytest.mark.parametrize(
    ("bad", "told"),
    [
        ("Two doors.", "there is no JSON object in the answer"),
        ('{"doors": ', "the JSON is broken at character 10"),
        ({"doors": "many"}, "doors: Input should be a valid integer"),
        ({"doors": 2, "lids": 0}, "lids: Extra inputs are not permitted"),
    ],
)
def test_a_wrong_answer_is_asked_for_once_more_with_the_mistake(bad, told):
    reply, (first, second) = answered(said(bad), said(GOOD, tokens=(150, 8)))
    assert reply.value == Count(doors=2)
    assert reply.usage == Usage(2, 250, 28)
    (remark,) = reply.remarks
    assert remark.startswith(f"a first answer could not be used ({told}")
    assert second["messages"][:2] == first["messages"]
    text = bad if isinstance(bad, str) else json.dumps(bad)
    assert second["messages"][2] == {"role": "assistant", "content": text}
    assert told in second["messages"][3]["content"]


def test_prose_around_the_json_needs_no_second_question():
    reply, tables = answered(said(f"Here you are:\n```json\n{json.dumps(GOOD)}\n```"))
    assert (reply.value, len(tables), reply.remarks) == (Count(doors=2), 1, ())


def test_two_wrong_answers_end_it():
    told, count = refusal(said("Two doors, I think.\nOr three."))
    assert count == 2
    assert "two answers could not be used: there is no JSON object" in told
    assert told.endswith("it said: Two doors, I think. Or three.")


def test_an_answer_that_is_cut_off_names_the_option():
    told, count = refusal(said('{"doors"', finish="length"), max_tokens=50)
    assert count == 2
    assert "it is cut off at max_tokens, 50: the JSON is broken" in told


def test_a_model_that_only_thought_is_told_as_cut_off():
    thinking = json.dumps({"choices": [{"message": {"content": None}, "finish_reason": "length"}]}).encode()
    told, _ = refusal(thinking)
    assert "it is cut off at max_tokens, 4096" in told


def huge(handler):
    handler.send_response(200)
    handler.end_headers()
    for _ in range(20):
        handler.wfile.write(b" " * (1 << 20))


@pytest.mark.parametrize(
    ("reply", "told", "asked"),
    [
        (status(429), r"HTTP 429 Too Many Requests \(3 times\)$", 3),
        (status(500, b"out of memory"), r"HTTP 500 Internal Server Error: out of memory \(3 times\)$", 3),
        (said(GOOD)[:-30], "the reply is no chat completion", 1),
        (b"", "the reply is no chat completion: it is empty$", 1),
        (huge, "the reply is longer than 8 MB: it is no answer$", 1),
        (said("x" * (2 << 20)), "two answers could not be used: the answer has 2097152 characters", 2),
        (status(307, Location="http://127.0.0.1:1/v1"), "redirects are not followed: give the final URL$", 1),
        (status(401, f"no such key: {KEY}".encode()), r"401 Unauthorized: no such key: \[SIMART_VLM_", 1),
        (status(404, b'{"error": "no such model"}'), "HTTP 404 Not Found: no such model$", 1),
        (said({"doors": KEY}), r"it said: .*\[SIMART_VLM_API_KEY\]", 2),
    ],
)
def test_whatever_a_server_does_ends_in_one_line(reply, told, asked):
    line, count = refusal(reply)
    assert re.search(told, line), line
    assert count == asked


def test_a_slow_server_is_waited_for_twice():
    line, count = refusal(lambda handler: time.sleep(0.5), timeout=0.15)
    assert line.endswith("no reply within 0.15 s: raise timeout (2 times)")
    assert count == 2


def test_a_server_that_is_not_there_is_told():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        url = f"http://127.0.0.1:{taken.getsockname()[1]}"
    options = VlmOptions(url=url, model="m", cache="off", retries=0)
    with pytest.raises(BadInputError, match=r"cannot be reached: Connection refused: is the server running"):
        open_vlm(options).ask(QUESTION)


def test_a_server_without_response_format_is_asked_without_it_from_then_on():
    no = status(400, b'{"error": {"message": "response_format is not supported"}}')
    with serving(no, said(GOOD)) as served:
        vlm = client(served)
        first, second = vlm.ask(QUESTION), vlm.ask(QUESTION)
    assert first.value == second.value == Count(doors=2)
    assert ["response_format" in table for _, _, table in served.asked] == [True, False, False]
    assert first.remarks == ("the server takes no response_format: the schema was told in the prompt alone",)


def test_settings_that_newer_servers_do_not_take_are_left_out_one_by_one():
    reply, tables = answered(
        status(400, b"Unsupported parameter: 'max_tokens'. Use 'max_completion_tokens' instead."),
        status(400, b"Unsupported value: 'temperature' does not support 0"),
        said(GOOD),
    )
    assert reply.value == Count(doors=2)
    last = tables[-1]
    assert last["max_completion_tokens"] == 4096
    assert {"max_tokens", "temperature"}.isdisjoint(last)
    assert "seed" in last


def test_a_wrong_request_for_another_reason_is_not_repeated():
    told, count = refusal(status(400, b"'max_tokens' is too large for the context length"))
    assert told.endswith("HTTP 400 Bad Request: 'max_tokens' is too large for the context length")
    assert count == 1
    # A setting that goes on being refused is left out once.
    _, count = refusal(status(422, b"bad seed"))
    assert count == 2


def test_requests_keep_their_distance(monkeypatch):
    now, slept = [100.0], []
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    monkeypatch.setattr(time, "sleep", slept.append)
    pace = Pace(rate=30)
    pace.wait()
    now[0] = 100.5
    pace.wait()
    pace.wait()
    now[0] = 200.0
    pace.wait()
    assert slept == [1.5, 3.5]  # two seconds after one another, and after a pause at once


def test_retries_keep_their_distance_too():
    start = time.monotonic()
    answered(status(503), status(503), said(GOOD), rate_limit=400)
    assert time.monotonic() - start >= 2 * 60 / 400


def test_what_answers_took_is_summed_and_told():
    options = VlmOptions(model="Qwen3-VL", price_in=0.5, price_out=2.0)
    ledger = Ledger()
    assert ledger.notes("segment", options) == ledger.usage(options) == ()
    fresh = Reply(Count(doors=1), Usage(2, 250_000, 28_000), "Qwen3-VL", "", ("asked twice",))
    kept = replace(fresh, usage=Usage(1, 10**7, 10**7, cached=True))
    ledger = ledger.plus(fresh).plus(kept).plus(fresh)
    assert (ledger.answers, ledger.cached, ledger.calls) == (3, 1, 4)
    # 500 000 tokens at 0.5 a million, and 56 000 at 2.
    assert ledger.cost(options) == pytest.approx(0.25 + 0.112)
    told = (
        "vision-language model Qwen3-VL, answers: 3, 1 from the cache; calls: 4, 500000 tokens read, "
        "56000 written, cost 0.362 at the given prices"
    )
    assert ledger.usage(options) == (ModelUsage("Qwen3-VL", 3, 1, 4, 500_000, 56_000, ledger.cost(options)),)
    assert ledger.notes("segment", options) == (
        Note("segment", "info", told),
        Note("segment", "info", "asked twice"),
    )


def test_a_server_that_does_not_count_tokens_is_no_reason_to_invent_them():
    reply, _ = answered(said(GOOD, tokens=None))
    assert reply.usage == Usage(1, 0, 0)
    priced = VlmOptions(price_in=1.0)
    assert Ledger().plus(reply).usage(priced) == (ModelUsage("Qwen3-VL", 1, 0, 1, None, None, None),)
    (note,) = Ledger().plus(reply).notes("segment", priced)
    assert note.text.endswith("calls: 1, tokens not told by the server")


def test_the_key_reaches_no_option_no_error_and_no_value():
    with played(lambda seen: GOOD) as served:
        vlm = client(served)
        reply = vlm.ask(QUESTION)
        options = options_for(served)
    for thing in (vlm, vlm.speaker, reply, options, options.model_dump_json()):
        assert KEY not in repr(thing)


@pytest.mark.parametrize(
    ("table", "told"),
    [
        ({"url": "http://me:word@host/v1"}, "SIMART_VLM_API_KEY"),
        (
            {"api_key": KEY},
            "there is no option api_key: the key is read from the environment variable SIMART_",
        ),
        ({"url": "localhost:8000"}, "give a URL such as"),
        ({"replay": True, "cache": "off"}, "replay takes answers from the cache, and cache is off"),
        ({"rate_limit": -1.0}, "greater than or equal to 0"),
        ({"backend": "ollama"}, "'server' or 'transformers'"),
    ],
)
def test_wrong_options_are_refused(table, told):
    with pytest.raises(ValidationError, match=told):
        VlmOptions(**table)


@pytest.mark.parametrize(
    ("table", "told"),
    [
        ({"url": "http://host/v1"}, "no vision-language model is named: set the option model"),
        ({"model": "m"}, "no server is named: set the option url"),
    ],
)
def test_what_is_not_named_is_told_before_anything_is_asked(table, told):
    with pytest.raises(BadInputError, match=told):
        open_vlm(VlmOptions(**table))


@pytest.mark.parametrize("shape", [(4, 4), (4, 4, 4), (0, 4, 3)])
def test_a_picture_of_another_shape_is_the_authors_mistake(shape):
    with pytest.raises(ValueError, match="a picture is"):
        Question("", "?", (np.zeros(shape, np.uint8),), Count)


def test_an_answer_that_lets_anything_through_is_the_authors_mistake():
    class Loose(BaseModel):
        doors: int

    with pytest.raises(ValueError, match="Loose must have extra='forbid'"):
        Question("", "?", (), Loose)
