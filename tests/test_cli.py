"""The command line: what it prints, on which stream, and with which exit code."""

import json
import re
import signal
import sys
import time
from importlib.metadata import EntryPoint
from pathlib import Path
from types import SimpleNamespace

import pytest

from simart_kit.asset_io import save_asset
from simart_kit.cli.main import run
from simart_kit.testing.meshes import cabinet_asset, static_asset

from .cli_home import CONVERT, finish, furnished, process


@pytest.fixture
def home(tmp_path, monkeypatch) -> Path:
    return furnished(tmp_path, monkeypatch)


def test_convert_tells_what_was_found_and_where_it_is(home, capfd):
    code = run(CONVERT)

    out, err = capfd.readouterr()
    assert code == 0
    assert "cupboard: 3 parts, 2 joints: door (revolute), drawer (prismatic)" in out
    assert re.search(r"door +revolute +-86 \.\. 0 deg on body, confidence 100%$", out, re.MULTILINE)
    assert re.search(r"drawer +prismatic +0\.000 \.\. 0\.300 m on body", out)
    for check in ("collision", "joints", "mass"):
        assert re.search(rf"^  (ok  |FAIL)  {check}: ", out, re.MULTILINE)
    for word, path in (("text", "text/main.txt"), ("asset", "asset.json"), ("picture", "preview.png")):
        assert re.search(rf"^  {word} +out/cupboard/{path}$", out, re.MULTILINE)
        assert (home / "out" / "cupboard" / path).is_file()
    assert re.search(r"^segment labels +\d+\.\d\d s$", err, re.MULTILINE)
    assert [line.split("  ")[0] for line in err.splitlines()] == [
        "load fake",
        "segment labels",
        "joints joints",
        "preview",
        "export text",
        "check",
    ]


def test_convert_verbosely_tells_what_was_decided(home, capfd):
    run(CONVERT)
    assert "load: up is" not in capfd.readouterr().out

    assert run([*CONVERT, "-v", "--up", "-y"]) == 0

    assert re.search(r"^  load: up is -y \(--up\)", capfd.readouterr().out, re.MULTILINE)


def test_convert_warns_of_an_installed_plugin_that_did_not_load(home, capfd, monkeypatch):
    broken = EntryPoint("shaky", "module_that_nobody_has", "simart_kit")
    monkeypatch.setattr("simart_kit.plugins._entry_points", lambda: [broken])

    assert run(CONVERT) == 0
    assert "warning: plugin shaky during import: ModuleNotFoundError" in capfd.readouterr().err


def test_convert_quietly_says_nothing(home, capfd):
    code = run([*CONVERT, "-q", "--out", "here", "--name", "My Cupboard!"])

    out, err = capfd.readouterr()
    assert (code, err) == (0, "")
    assert sorted(out.splitlines()) == ["noise from native code", "noise from python"]
    assert json.loads((home / "here" / "asset.json").read_text())["name"] == "my_cupboard"


def test_json_is_one_document_on_stdout_whatever_plugins_print(home):
    code, out, err = finish(process(*CONVERT, "--json"))

    document = json.loads(out)
    assert (code, document["ok"]) == (0, True)
    assert {"noise from native code", "noise from python"} <= set(err.splitlines())
    assert document["report"] == json.loads((home / "out" / "cupboard" / "report.json").read_text())
    assert Path(document["files"]["text"]).is_file()
    assert [row["stage"] for row in document["seconds"]][:3] == ["load", "segment", "joints"]


def test_a_failed_json_run_is_one_document_too(home, capfd):
    code = run([*CONVERT, "--json", "--set", "segmenter.options.fault=raise"])

    out, err = capfd.readouterr()
    document = json.loads(out)
    assert (code, document["ok"], document["exit_code"]) == (1, False, 1)
    assert f"error: {document['error']}" in err.splitlines()


@pytest.mark.parametrize(
    ("arguments", "code", "told"),
    [
        (["convert", "none.glb"], 2, "no such file: none.glb"),
        (["convert", "."], 2, "is a folder"),
        (["convert", "recipe.toml"], 2, "no plugin reads '.toml' files"),
        (["convert", "cupboard.fake", "--recipe", "nobody"], 2, "unknown recipe 'nobody': no such file"),
        ([*CONVERT, "--set", "segmenter.options.fault=raise"], 1, "RuntimeError: out of ideas"),
        ([*CONVERT, "--set", "segmenter.use=lasso"], 2, "unknown segmenter 'lasso': known are"),
        ([*CONVERT, "--unit", "furlong"], 2, "unit 'furlong'"),
        ([*CONVERT, "--up", "north"], 2, "--up"),
        ([*CONVERT, "--height", "tall"], 2, "--height"),
        ([*CONVERT, "-v", "-q"], 2, "exclude each other"),
        ([*CONVERT, "--plugin", "missing.py"], 2, "no plugin file missing.py"),
        ([*CONVERT, "--bogus"], 2, "--bogus"),
        (["convert"], 2, "MESH"),
        (["frobnicate"], 2, "frobnicate"),
        (["export", ".", "--to", "urdf"], 2, "has no asset.json"),
        (["check", "nowhere"], 2, "nowhere: no such file or folder"),
        (["inspect", "."], 2, "has no recording"),
        (["recipes", "check", "nobody"], 2, "unknown recipe 'nobody'"),
        (["plugins", "show", "nobody"], 2, "unknown stage or command 'nobody'"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_a_mistake_is_one_line_and_an_exit_code(home, capfd, arguments, code, told):
    assert run(arguments) == code

    lines = [line for line in capfd.readouterr().err.splitlines() if not re.search(r"\d s$", line)]
    assert len(lines) == 1, lines
    assert lines[0].startswith("error: ")
    assert told in lines[0]


def test_a_bug_is_one_line_that_asks_for_a_report_and_verbose_shows_where(home, capfd, monkeypatch):
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: 1 / 0)

    assert run(CONVERT) == 1
    assert capfd.readouterr().err.splitlines()[-1] == (
        "error: unexpected ZeroDivisionError: division by zero; "
        "run with -v for the traceback, and please report it"
    )
    assert run([*CONVERT, "-v"]) == 1
    err = capfd.readouterr().err
    assert "Traceback (most recent call last)" in err
    assert err.splitlines()[-1] == "error: unexpected ZeroDivisionError: division by zero"
    assert not (home / "out").exists()


def test_an_interrupt_in_a_stage_is_clean(home, capfd):
    assert run([*CONVERT, "-q", "--set", "segmenter.options.fault=interrupt"]) == 130

    assert capfd.readouterr().err == "interrupted\n"
    assert not (home / "out").exists()


def test_an_interrupted_json_run_prints_one_document(home, capfd):
    assert run([*CONVERT, "--json", "--set", "segmenter.options.fault=interrupt"]) == 130

    assert json.loads(capfd.readouterr().out) == {"ok": False, "error": "interrupted", "exit_code": 130}


def test_a_failed_stage_tells_where_its_input_is(home, capfd):
    assert run([*CONVERT, "-q", "--set", "segmenter.options.fault=raise"]) == 1

    (line,) = capfd.readouterr().err.splitlines()
    kept = Path(re.search(r"; its input and the traceback are in (\S+)$", line).group(1))
    assert sorted(path.name for path in kept.iterdir()) == ["error.txt", "input"]


def test_what_a_failed_stage_held_is_no_leak_that_libraries_tell_of(home):
    code, _, err = finish(process(*CONVERT, "-q", "--set", "segmenter.options.fault=raise with a solid"))

    assert (code, len(err.splitlines())) == (1, 1), err


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM], ids=["ctrl-c", "kill"])
def test_a_signal_ends_a_run_that_hangs_and_leaves_nothing(home, sent):
    running = process(*CONVERT, "--set", "segmenter.options.fault=hang")
    while not any((home / "out").rglob(".simart-kit-*")):
        assert running.poll() is None
        time.sleep(0.02)
    assert running.stderr.readline().startswith("load fake")
    time.sleep(0.1)
    running.send_signal(sent)

    code, _, err = finish(running)

    assert code == 130
    assert err.splitlines()[-1] == "interrupted"
    assert not (home / "out").exists()


def test_a_reader_that_goes_away_is_no_error(home):
    running = process("recipes", "show", "all")
    running.stdout.close()

    assert running.stderr.read() == ""
    assert running.wait() == 141
    running.stderr.close()


def test_letters_that_the_output_lacks_do_not_end_a_run(home, monkeypatch):
    monkeypatch.setenv("PYTHONIOENCODING", "ascii")

    code, out, err = finish(process(*CONVERT, "--out", "Küche"))

    assert (code, Path("Küche", "asset.json").is_file()) == (0, True), err
    assert "files in K\\xfcche:" in out


def test_the_advice_how_to_look_at_a_run_can_be_pasted(home, capfd):
    assert run([*CONVERT[:-1], "--out", "my cupboard", "-v"]) == 0

    assert capfd.readouterr().out.splitlines()[-1] == "look at it: simart-kit inspect 'my cupboard'"


@pytest.mark.parametrize("group", ["recipes", "plugins"])
def test_a_group_alone_shows_its_commands(home, capfd, group):
    assert run([group]) == 2

    out, err = capfd.readouterr()
    assert out == ""
    assert re.search(r"^  list ", err, re.MULTILINE)
    assert re.search(r"^  show ", err, re.MULTILINE)


def test_help_and_versions(home, capfd):
    assert run(["--help"]) == 0
    assert re.search(r"Exit codes: 0 done;.*1 .*2 .*130", capfd.readouterr().out, re.DOTALL)
    assert run([]) == 2
    assert "Usage:" in capfd.readouterr().err
    assert run(["--version"]) == 0
    assert run(["version"]) == 0
    first, second = capfd.readouterr().out.splitlines()
    assert first == second
    assert re.fullmatch(r"simart-kit \d+\.\d+\.\d+\S*", first)


def test_export_writes_the_edited_asset_and_nothing_else_runs(home, capfd):
    run([*CONVERT, "-q"])
    path = home / "out" / "cupboard" / "asset.json"
    table = json.loads(path.read_text())
    table["joints"][0]["limits"]["lower"] = -1.25
    path.write_text(json.dumps(table))
    capfd.readouterr()

    assert run(["export", "out/cupboard", "--to", "text", "--plugin", "fakes.py"]) == 0

    assert capfd.readouterr().out == "out/cupboard/text/main.txt\n"
    assert "lower=-1.25" in Path("out/cupboard/text/main.txt").read_text()


def test_export_names_the_field_that_an_edit_broke(home, capfd):
    save_asset(cabinet_asset(), home / "made")
    path = home / "made" / "asset.json"
    path.write_text(path.read_text().replace('"revolute"', '"revolving"'))

    assert run(["export", "made", "--to", "urdf"]) == 2

    assert "joints.0.kind" in capfd.readouterr().err


def test_check_fails_with_the_asset(home, capfd):
    save_asset(static_asset(), home / "good")
    save_asset(cabinet_asset(physics=False), home / "bad")

    assert run(["check", "good"]) == 0
    assert all(line.startswith("ok ") for line in capfd.readouterr().out.splitlines())
    assert run(["check", "bad"]) == 1
    assert re.search(r"^FAIL  mass: ", capfd.readouterr().out, re.MULTILINE)
    assert run(["check", "bad", "--json"]) == 1
    document = json.loads(capfd.readouterr().out)
    assert (document["ok"], {c["name"]: c["passed"] for c in document["checks"]}["mass"]) == (False, False)


@pytest.mark.skipif(sys.platform != "linux", reason="other systems always have a display")
def test_inspect_without_a_display_says_what_to_do(home, capfd, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    (home / "cupboard.rrd").write_bytes(b"x")

    assert run(["inspect", "."]) == 2
    assert "no display" in capfd.readouterr().err


@pytest.mark.parametrize("place", [".", "failed"])
def test_inspect_opens_the_viewer_on_the_recording(home, monkeypatch, place):
    called = []
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(
        "simart_kit.cli.inspect.subprocess.run",
        lambda command, check: called.append(command) or SimpleNamespace(returncode=0),
    )
    (home / place).mkdir(exist_ok=True)
    (home / place / "cupboard.rrd").write_bytes(b"x")

    assert run(["inspect", str(home)]) == 0
    assert called[0][-1] == str(home / place / "cupboard.rrd")
