"""Conversions with `p3sam-vlm` and a server on loopback: whatever it does, an asset or one clear line."""

import functools
import json
import os
import re
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from simart_kit_plugins.vlm.endpoint import Endpoint

import simart_kit as sk
from simart_kit.asset_io import load_asset
from simart_kit.cli.main import run
from simart_kit.errors import StageError
from simart_kit.testing.fingerprint import fingerprint, folder_fingerprint

from .marks_cases import small_pictures
from .marks_server import CRATE, DRAWER, cut, half, model, plain, prose, right, silent, spoken, told, truth
from .mesh_files import gltf, save_glb
from .recordings import chunks
from .vlm_server import KEY

pytestmark = pytest.mark.slow

BARE = ["export=[]", "modify=[]", 'segmenter.options.proposer={use="geometric"}']


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    """A folder with the crate, its front to +z and up +y as glTF has it; the key is set."""
    x, y, z = CRATE.vertices.T
    save_glb(tmp_path / "crate.glb", gltf(np.stack([x, z, -y], axis=1), CRATE.faces))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SIMART_VLM_API_KEY", KEY)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("no_proxy", "*")
    return tmp_path


@pytest.fixture
def quick(monkeypatch):
    """Small pictures, and short pauses between two tries."""
    small_pictures(monkeypatch)
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
    monkeypatch.setattr("simart_kit_plugins.vlm.opening.Endpoint", functools.partial(Endpoint, pause=0.01))


def asking(url, **options):
    """Changes to the recipe for a server at a URL."""
    named = {"url": url, "model": "Qwen3-VL", "retries": 2, "timeout": 20.0} | options
    return [*BARE, *(f"segmenter.options.{key}={json.dumps(value)}" for key, value in named.items())]


def command(sets, *more):
    changes = [word for change in sets for word in ("--set", change)]
    return ["convert", "crate.glb", "--recipe", "p3sam-vlm", "--out", "made", *changes, *more]


def known(asset):
    """Whether an asset is what the model knows."""
    (joint,) = asset.joints
    return (
        [part.name for part in asset.parts] == ["body", "drawer"]
        and np.array_equal(asset.face_part, DRAWER)
        and (joint.kind, joint.parent, joint.child) == ("prismatic", "body", "drawer")
        and np.allclose(joint.axis, (0, -1, 0))
        and joint.limits.upper > 0.1
    )


def whole(home, *, made, outputs=""):
    """Check that only output and kept answers are left, and that the key is nowhere in them."""
    assert {path.name for path in home.iterdir()} <= {"crate.glb", "cache", "made", "small.py", "__pycache__"}
    assert ((home / "made" / "asset.json").exists(), (home / "made" / "failed").exists()) == (made, not made)
    files = [path for path in home.rglob("*") if path.is_file()]
    assert not [path for path in files if path.name.endswith((".part", ".tmp"))]
    assert not holds_key(outputs)
    for path in files:
        assert not holds_key(str(path))
        assert not holds_key(path.read_bytes().decode("latin-1")), path
        assert not holds_key(unpacked(path)), path


def holds_key(text):
    """Whether a text has the key, also where its s are written as JSON may write them."""
    return KEY in text or KEY in re.sub(r"\\+u0073", "s", text)


def unpacked(path):
    """What a file holds that is compressed in it."""
    if path.suffix == ".rrd":
        return "".join(str(chunk.to_record_batch().to_pydict()) for chunk in chunks(path))
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:
            return "".join(archive.read(name).decode("latin-1") for name in archive.namelist())
    return ""


MENDED = {
    "right": [],
    "busy": [plain(429)],
    "broken twice": [plain(500), plain(503)],
    "silent once": [silent],
    "cut off once": [cut],
    "half of the JSON": [spoken(half)],
    "at the limit of tokens": [spoken(half, finish="length")],
    "another schema": [spoken(lambda text: '{"links": "many"}')],
    "a letter that is none": [right, spoken(lambda text: '{"letter": "?", "confidence": 1}')],
    "a text without JSON": [spoken(lambda text: "I see a crate.")],
    "2 million characters": [spoken(lambda text: '{"category": "' + "x" * 2_000_000 + '"}')],
    "no response_format": [told(400, "response_format is not supported")],
}


@pytest.mark.parametrize("replies", MENDED.values(), ids=MENDED)
def test_what_can_be_mended_ends_right(home, quick, capfd, replies):
    with model(*replies, right) as served:
        options = {"timeout": 1.5} if silent in replies else {}
        code = run(command(asking(served.url, **options), "--no-record"))
    out, err = capfd.readouterr()
    assert (code, len(served.asked)) == (0, max(2, len(replies) + (2 if right not in replies else 1)))
    assert known(load_asset(home / "made"))
    assert "Traceback" not in err
    whole(home, made=True, outputs=out + err)


def test_prose_around_the_json_is_left_out(home, quick):
    with model(spoken(prose)) as served:
        assert known(sk.convert("crate.glb", "p3sam-vlm", sets=asking(served.url), record=False).asset)
    assert len(served.asked) == 2


def test_what_the_model_took_is_in_provenance(home, quick):
    prices = {"price_in": 2.0, "price_out": 10.0}
    with model(right) as served:
        sk.convert("crate.glb", "p3sam-vlm", out="made", sets=asking(served.url, **prices), record=False)
        sk.convert("crate.glb", "p3sam-vlm", out="again", sets=asking(served.url, **prices), record=False)
    (took,), (kept,) = (
        json.loads((home / f / "provenance.json").read_text())["models"] for f in ("made", "again")
    )
    # Two answers of 100 tokens read and 20 written each, at 2 and 10 a million.
    whose = {"stage": "segment", "name": "p3sam-vlm", "model": "Qwen3-VL", "answers": 2}
    assert took == whose | {"cached": 0, "calls": 2, "input_tokens": 200, "output_tokens": 40, "cost": 8e-4}
    assert kept == whose | {"cached": 2, "calls": 0, "input_tokens": 0, "output_tokens": 0, "cost": 0.0}


BAD = "two answers could not be used: "
FAULTS = {
    "silent": ([silent], r"no reply within 0\.3 s: raise timeout \(2 times\)", 2),
    "broken": ([told(500, "out of memory")], r"HTTP 500 .*out of memory \(3 times\)", 3),
    "broken later": ([right, plain(500)], r"HTTP 500 .*\(3 times\)", 4),
    "busy": ([plain(429)], r"HTTP 429 .*\(3 times\)", 3),
    "busy for an hour": ([plain(429, Retry_After="3600")], r"asks to be left alone for 3600 s", 1),
    "half": ([spoken(half)], BAD + "the JSON is broken at character", 2),
    "at the limit": ([spoken(half, finish="length")], BAD + "it is cut off at max_tokens, 4096", 2),
    "another schema": ([spoken(lambda text: '{"links": "many"}')], BAD + "category: Field required", 2),
    "no letter": ([right, spoken(lambda text: '{"letter": "?"}')], BAD + r"letter: .*there is no letter", 3),
    "nothing": (
        [spoken(lambda text: "")],
        BAD + "there is no JSON object in the answer; it said: nothing",
        2,
    ),
    "long text": ([spoken(lambda text: text + " " * 2_000_000)], BAD + "the answer has 2000", 2),
    "long reply": ([plain(200, b"x" * (9 << 20))], "the reply is longer than 8 MB", 1),
    "a page": ([plain(200, b"<html>Log in</html>")], "the reply is no chat completion: <html>", 1),
    "cut off": ([cut], r"the connection broke: IncompleteRead.*\(3 times\)", 3),
    "refused": ([told(401, "who are you?")], "HTTP 401 .*the key is read from SIMART_VLM_API_KEY", 1),
}


@pytest.mark.parametrize(("replies", "line", "times"), FAULTS.values(), ids=FAULTS)
def test_what_cannot_be_mended_is_one_line(home, quick, capfd, replies, line, times):
    with model(*replies) as served:
        options = {"timeout": 0.3} if silent in replies else {}
        code = run(command(asking(served.url, **options), "--quiet", "--no-record"))
    out, err = capfd.readouterr()
    assert (code, out, err.count("\n"), len(served.asked)) == (1, "", 1, times)
    assert re.match(rf"error: segmenter 'p3sam-vlm' failed .*{line}.* are in made/failed$", err)
    assert len(err) < 900
    whole(home, made=False, outputs=err)


def test_a_server_that_is_gone_is_one_line(home, quick, capfd):
    with model(right) as served:
        pass
    code = run(command(asking(served.url), "--quiet", "--no-record"))
    out, err = capfd.readouterr()
    assert (code, out, err.count("\n")) == (1, "", 1)
    assert re.search(r"cannot be reached: Connection refused: is the server running\? \(3 times\)", err)
    whole(home, made=False, outputs=err)


def test_the_time_limit_of_a_run_ends_its_waiting(home, quick):
    with model(silent) as served, pytest.raises(StageError, match=r"longer than 1 s .*stage_timeout"):
        sk.convert("crate.glb", "p3sam-vlm", out="made", sets=[*asking(served.url), "stage_timeout=1"])
    whole(home, made=False)


@pytest.mark.parametrize(("option", "told"), [("model", "option model"), ("url", "option url")])
def test_what_is_not_named_is_one_line(home, quick, capfd, option, told):
    code = run(command(asking(**{"url": "http://127.0.0.1:9/v1", option: ""}), "--quiet", "--no-record"))
    err = capfd.readouterr().err
    assert (code, err.count("\n")) == (1, 1)
    assert told in err


def test_a_proposer_that_is_not_installed_is_one_line(home, quick, capfd, monkeypatch):
    monkeypatch.delenv("SIMART_P3SAM_FOLDER", raising=False)
    with model(right) as served:
        code = run(command([change for change in asking(served.url) if "proposer" not in change], "--quiet"))
    err = capfd.readouterr().err
    assert (code, err.count("\n"), served.asked) == (1, 1, [])
    assert re.search(r"proposer p3sam: .*SIMART_P3SAM_FOLDER.* such as --set .*use=\"geometric\"", err)


def test_a_key_among_the_options_is_refused_and_not_shown(home, capfd):
    code = run(command(["segmenter.options.api_key=sk-typed-4711"]))
    out, err = capfd.readouterr()
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "SIMART_VLM_API_KEY" in err
    assert "sk-typed" not in err


def test_codes_for_a_terminal_do_not_come_through(home, quick, capfd, monkeypatch):
    def colored(text):
        answer = json.loads(text)
        if "links" in answer:
            answer["category"] = answer["links"][1]["label"] = "a\x1b[2J\x00 crate\n"
        return json.dumps(answer)

    fault = {"link": "drawer", "wrong": "direction", "reason": "it\x1b[31m sticks"}
    monkeypatch.setitem(truth().answers, "CriticAnswer", lambda question: {"faults": [fault]})
    with model(spoken(colored)) as served:
        assert run(command(asking(served.url, critic=1), "-v", "--no-record")) == 0
    said = "".join(capfd.readouterr())
    assert "category: a [2J crate" in said
    assert "it [31m sticks" in said
    assert "\x1b" not in said
    assert load_asset(home / "made").parts[1].label == "a [2j crate"


def test_a_run_that_fails_leaves_an_earlier_one_as_it_was(home, quick):
    with model(right) as served:
        assert run(command(asking(served.url), "--no-record")) == 0
        before = folder_fingerprint(home / "made")
    with model(right, plain(500)) as served:
        assert run(command(asking(served.url, cache="off"), "--no-record")) == 1
    after = folder_fingerprint(home / "made")
    assert {name: after[name] for name in before} == before
    assert {name.split("/")[0] for name in after if name not in before} == {"failed"}


def test_a_run_is_repeated_with_no_server_and_no_key(home, quick, monkeypatch):
    with model(right) as served:
        sets = asking(served.url, critic=1)
        first = sk.convert("crate.glb", "p3sam-vlm", sets=sets, out="one", record=False)
    assert len(served.asked) == 3
    monkeypatch.delenv("SIMART_VLM_API_KEY")
    again = [*asking("", critic=1), "segmenter.options.replay=true"]
    second = sk.convert("crate.glb", "p3sam-vlm", sets=again, out="two", record=False)
    assert known(second.asset)
    assert fingerprint(replace(second.asset, notes=())) == fingerprint(replace(first.asset, notes=()))
    assert any("answers: 3, 3 from the cache" in note.text for note in second.report.notes)
    asset = load_asset(home / "two")
    assert fingerprint(replace(asset, notes=())) == fingerprint(replace(load_asset(home / "one"), notes=()))
    with pytest.raises(StageError, match=r"replay: .* keeps no answer of model Qwen3-VL to the question"):
        sk.convert("crate.glb", "p3sam-vlm", sets=[*again, "segmenter.options.cache=none"], record=False)


def echoed(text):
    """The right answer, with the key before it, in it, and in it as JSON may also write it."""
    answer = json.loads(text)
    if "links" in answer:
        answer["category"] = f"key {KEY}"
        answer["links"][1]["label"] = f"the key {KEY}"
    return f"I was sent Bearer {KEY}.\n{json.dumps(answer)}"


def test_a_server_that_repeats_the_key_in_answers_spreads_it_nowhere(home, quick, capfd):
    wrong = spoken(lambda text: json.dumps({KEY: KEY}))
    with model(wrong, spoken(echoed)) as served:
        code = run(command(asking(served.url, critic=1), "-v"))
    out, err = capfd.readouterr()
    assert code == 0
    assert all(head["Authorization"] == f"Bearer {KEY}" for _, head, _ in served.asked)
    assert not any(KEY in json.dumps(table) for _, _, table in served.asked)  # nor does it hear it again
    asset = load_asset(home / "made")
    assert known(asset)
    assert asset.parts[1].label == "the key [simart_vlm_api_key]"
    assert "[SIMART_VLM_API_KEY]" in unpacked(home / "made" / "crate.rrd")
    whole(home, made=True, outputs=out + err)


ECHOES = {
    "status": [told(401, f"Incorrect API key provided: {KEY}")],
    "reason": [lambda handler, text: reasoned(handler)],
    "head": [plain(500, X_Key=KEY, Retry_After=KEY)],
    "no answer": [plain(200, json.dumps({"authorization": f"Bearer {KEY}"}).encode())],
    "no JSON": [plain(200, f"Bearer {KEY}".encode())],
    "no HTTP": [lambda handler, text: handler.wfile.write(f"{KEY}\r\n\r\n".encode())],
    "useless": [spoken(lambda text: json.dumps({KEY: KEY}))],
    "escaped": [spoken(lambda text: json.dumps({"a": KEY}).replace("s", r"\u0073"))],
    "later": [right, spoken(lambda text: json.dumps({"letter": KEY, "confidence": 1}))],
}


def reasoned(handler):
    handler.send_response(403, f"no {KEY}")
    handler.send_header("Content-Length", "0")
    handler.end_headers()


@pytest.mark.parametrize("replies", ECHOES.values(), ids=ECHOES)
def test_a_server_that_repeats_the_key_in_errors_spreads_it_nowhere(home, quick, capfd, replies):
    with model(*replies) as served:
        code = run(command(asking(served.url), "-v", *(["--no-record"] if right not in replies else [])))
    out, err = capfd.readouterr()
    assert code == 1
    assert "error: segmenter 'p3sam-vlm' failed" in err
    assert (home / "made" / "failed" / "crate.rrd").exists() == (right in replies)
    whole(home, made=False, outputs=out + err)


SMALL = """
from simart_kit import hookimpl
from simart_kit_plugins.marks import axis_sheet, sheets
from simart_kit.drawing import preview

@hookimpl
def register_modifiers(register):
    sheets.PANEL = axis_sheet.PANEL = 40
    sheets.TILE, preview.PANEL = 32, (80, 64)
"""


def process(sets, *more):
    """The command as users start it, but for the size of its pictures."""
    Path("small.py").write_text(SMALL)
    words = [sys.executable, "-m", "simart_kit", *command(sets, "--plugin", "small.py", *more)]
    return subprocess.run(words, capture_output=True, text=True, timeout=120, check=False, env={**os.environ})


def test_the_command_as_users_start_it_writes_all_that_it_writes(home):
    with model(plain(429), spoken(echoed)) as served:
        changes = [change for change in asking(served.url, critic=1) if "=[]" not in change]
        done = process(changes, "-v")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    assert known(load_asset(home / "made"))
    names = {path.name for path in (home / "made").rglob("*")}
    assert names >= {"crate.urdf", "crate.xml", "crate.usda", "crate.rrd", "preview.png", "provenance.json"}
    checks = json.loads((home / "made" / "report.json").read_text())["checks"]
    assert {check["name"] for check in checks if not check["passed"]} <= {"realtime"}  # of a busy machine
    whole(home, made=True, outputs=done.stdout + done.stderr)


def test_the_command_fails_with_one_line(home):
    with model(told(500, KEY)) as served:
        done = process(asking(served.url, retries=0), "--quiet", "--no-record")
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (1, "", 1)
    whole(home, made=False, outputs=done.stderr)
