"""Answers of a vision-language model that are kept: found again, apart, whole, and without the key."""

import json
import socket
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pydantic import BaseModel, ConfigDict
from simart_kit_plugins.vlm import Question, Usage, VlmOptions, open_vlm
from simart_kit_plugins.vlm.cache import cache_folder

from simart_kit.errors import BadInputError

from .endpoint_cases import serving
from .vlm_server import KEY, client, played, said


class Count(BaseModel):
    model_config = ConfigDict(extra="forbid")

    doors: int
    names: tuple[str, ...] = ()


class Number(BaseModel):
    model_config = ConfigDict(extra="forbid")

    doors: int


PICTURE = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)
QUESTION = Question("Be strict.", "How many doors?", (PICTURE,), Count)
GOOD = {"doors": 2, "names": ["left", "Tür"]}
ANSWER = Count(doors=2, names=("left", "Tür"))


@pytest.fixture(autouse=True)
def _direct(monkeypatch):
    monkeypatch.setenv("no_proxy", "*")
    monkeypatch.setenv("SIMART_VLM_API_KEY", KEY)


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "kept"


def files(folder):
    return sorted(path for path in folder.rglob("*") if path.is_file())


def keep(folder, question=QUESTION):
    """Ask once, and return the file that the answer is in."""
    with played(lambda seen: GOOD) as served:
        client(served, cache=str(folder)).ask(question)
    (path,) = files(folder)
    return path


def replayed(folder, question=QUESTION, **changes):
    options = {"model": "Qwen3-VL", "cache": str(folder), "replay": True} | changes
    return open_vlm(VlmOptions(**options)).ask(question)


def test_a_question_is_asked_once(folder):
    with played(lambda seen: GOOD) as served:
        first = client(served, cache=str(folder)).ask(QUESTION)
        second = client(served, cache=str(folder)).ask(QUESTION)
    assert len(served.asked) == 1
    assert first.usage == Usage(1, 100, 20)
    assert second == replace(first, usage=Usage(1, 100, 20, cached=True))


def test_what_is_kept_is_replayed_without_a_network_or_a_key(folder, monkeypatch):
    keep(folder)
    monkeypatch.delenv("SIMART_VLM_API_KEY")

    def no_network(*_, **__):
        raise AssertionError("a socket was opened")

    monkeypatch.setattr(socket, "socket", no_network)
    assert replayed(folder).value == ANSWER
    assert replayed(folder, url="http://elsewhere:1/v1", max_tokens=99).value == ANSWER


OTHERS = (
    replace(QUESTION, system="Be kind."),
    replace(QUESTION, text="How many lids?"),
    replace(QUESTION, pictures=(PICTURE + 1,)),
    replace(QUESTION, pictures=(PICTURE.reshape(2, 8, 3),)),
    replace(QUESTION, pictures=(PICTURE, PICTURE)),
    replace(QUESTION, answer=Number),
)


@pytest.mark.parametrize("question", OTHERS)
def test_another_question_has_no_answer_in_replay(folder, question):
    keep(folder)
    with pytest.raises(BadInputError, match=r"replay: .*kept keeps no answer of model Qwen3-VL") as caught:
        replayed(folder, question)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "changes", [{"model": "GPT"}, {"seed": 1}, {"temperature": 0.5}, {"backend": "transformers"}]
)
def test_another_model_has_no_answer_in_replay(folder, changes):
    keep(folder)
    with pytest.raises(BadInputError, match="keeps no answer of model"):
        replayed(folder, **changes)


def damages():
    """What may have happened to a file, by name."""
    yield "cut", lambda text: text[: len(text) // 2]
    yield "empty", lambda text: ""
    yield "null", lambda text: "null"
    yield "answer", lambda text: text.replace('\\"doors\\": 2', '\\"doors\\": []')
    yield "format", lambda text: text.replace('"format": 1', '"format": 2')
    yield "more", lambda text: text.replace('"format": 1', '"format": 1, "extra": 3')
    yield "other", lambda text: json.dumps(json.loads(text) | {"key": "0" * 64})


@pytest.mark.parametrize("name", [name for name, _ in damages()])
def test_a_damaged_answer_is_asked_for_again_and_never_replayed(folder, name):
    path = keep(folder)
    before = path.read_text()
    damaged = dict(damages())[name](before)
    assert damaged != before
    path.write_text(damaged)
    with pytest.raises(BadInputError, match=f"{path.name}: the "):
        replayed(folder)
    with played(lambda seen: GOOD) as served:
        reply = client(served, cache=str(folder)).ask(QUESTION)
    assert len(served.asked) == 1
    assert reply.value == ANSWER
    assert reply.remarks == ("a damaged answer in the cache was asked for again",)
    assert path.read_text() == before


def test_wrong_answers_are_not_kept(folder):
    with serving(said("no idea")) as served, pytest.raises(BadInputError):
        client(served, cache=str(folder)).ask(QUESTION)
    assert not folder.exists()


def test_an_answer_that_cannot_be_kept_is_given_all_the_same(folder):
    folder.write_text("in the way")
    with played(lambda seen: GOOD) as served:
        reply = client(served, cache=str(folder)).ask(QUESTION)
    assert reply.value == ANSWER
    (remark,) = reply.remarks
    assert remark.startswith("an answer could not be kept in the cache: ")


def test_a_disk_that_is_full_leaves_no_half_of_a_file(folder, monkeypatch):
    def full(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    with played(lambda seen: GOOD) as served:
        reply = client(served, cache=str(folder)).ask(QUESTION)
    assert reply.remarks == ("an answer could not be kept in the cache: No space left on device",)
    assert files(folder) == []


def test_runs_at_once_share_a_folder(folder):
    def ask(number):
        question = replace(QUESTION, text=f"Which door is it? {number % 3}")
        return client(served, cache=str(folder)).ask(question).value

    with serving(said(GOOD)) as served, ThreadPoolExecutor(8) as pool:
        assert list(pool.map(ask, range(48))) == [ANSWER] * 48
    assert len(files(folder)) == 3
    for number in range(3):
        assert replayed(folder, replace(QUESTION, text=f"Which door is it? {number}")).value == ANSWER


def test_the_key_is_in_no_byte_of_the_cache(folder):
    leaky = {"doors": 2, "names": [KEY, f"Bearer {KEY}"]}
    escaped = json.dumps(leaky).replace("sk-", "\\u0073k-")
    with serving(said(f"I was called with {KEY}. {json.dumps(leaky)}"), said(escaped), said(GOOD)) as served:
        vlm = client(served, cache=str(folder))
        reply = vlm.ask(QUESTION)
        assert reply.value.names == ("[SIMART_VLM_API_KEY]", "Bearer [SIMART_VLM_API_KEY]")
        other = vlm.ask(replace(QUESTION, text="And now?"))
        assert other.value == ANSWER
    assert len(files(folder)) == 2
    secret = KEY.removeprefix("sk-").encode()
    assert not [path for path in files(folder) if secret in path.read_bytes()]
    assert secret not in repr((reply, other)).encode()
    sent = json.dumps([table for _, _, table in served.asked]).encode()
    assert secret not in sent  # not even in the words that correct an answer


def test_the_file_says_what_was_asked(folder):
    table = json.loads(keep(folder).read_text())
    assert table["question"]["text"] == "How many doors?"
    assert table["question"]["model"] == "Qwen3-VL"
    assert table["question"]["schema"] == Count.model_json_schema()
    assert len(table["question"]["pictures"][0]) == 64
    assert json.loads(table["raw"]) == GOOD


def test_the_usual_folder_is_the_users_cache(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folder("") == tmp_path / "simart-kit" / "vlm"
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("XDG_CACHE_HOME")
    assert cache_folder("") == tmp_path / ".cache" / "simart-kit" / "vlm"
    assert cache_folder("~/answers") == tmp_path / "answers"
