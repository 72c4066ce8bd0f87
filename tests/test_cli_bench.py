"""`simart-kit bench`: what it prints, on which stream, and with which exit code."""

import json
import re
import resource
import signal
import subprocess
import sys
import time
from io import StringIO
from pathlib import Path

import pytest

from simart_kit.bench.rows import Row
from simart_kit.cli.bench.progress import Bar
from simart_kit.cli.main import run

from .bench_runs import converted, write_home

RUN = ["bench", "run", "data", "--recipe", "recipe.toml", "--plugin", "cabinets.py", "--no-pictures", "-j1"]


@pytest.fixture
def home(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    write_home(tmp_path, ["cabinet", "block", "raise"])
    return tmp_path


def test_a_run_tells_failures_as_they_happen_and_ends_with_a_table_and_where_the_files_are(home, capfd):
    assert run(RUN) == 0

    out, err = capfd.readouterr()
    lines = out.splitlines()
    assert re.fullmatch(r"simart/\S+, recipe recipe on data: 3 objects, 1 failed, 1 static", lines[0])
    # Two doors and a drawer each of the cabinet and of the object that failed.
    assert lines[1] == "6 moving parts: 3 found, 3 missed, 0 invented (IoU >= 0.5)"
    assert re.fullmatch(r" +better +mean \[95 %\] +n +matched only +n", lines[2])
    # The cabinet and the block are right, and the failure counts with 0: a mean of 2/3.
    assert re.search(r"^  Type +higher +0\.667 \[0\.000, 1\.000\] +3 +1\.000 +1$", out, re.MULTILINE)
    assert re.search(r"^  F1 +higher +0\.667 \[\d\.\d+, \d\.\d+\] +3$", out, re.MULTILINE)
    # Of categories: one right cabinet and the failure, and the block.
    assert re.search(r"^  +objects +failed +Type ", out, re.MULTILINE)
    assert re.search(r"^  cabinet +2 +1 +0\.500 ", out, re.MULTILINE)
    assert re.search(r"^  block +1 +0 +1\.000 ", out, re.MULTILINE)
    for word, name in (("results", "results.json"), ("table", "results.csv"), ("page", "report.html")):
        assert re.search(rf"^  {word} +out/bench/{name}$", out, re.MULTILINE)
        assert (home / "out" / "bench" / name).is_file()
    assert err.splitlines()[0] == "3 objects"
    assert [line.split()[:2] for line in err.splitlines()[1:]] == [
        ["[1/3]", "block"],
        ["[2/3]", "cabinet"],
        ["[3/3]", "raise"],
    ]
    assert "out of ideas" in err
    assert "out of ideas" not in out

    assert run(RUN) == 0  # what was not told this time is told at the end
    out, err = capfd.readouterr()
    assert err.splitlines() == ["3 objects, 3 done before"]
    assert re.match(r"raise: failed before: .*out of ideas", out)


def test_json_is_one_document_on_stdout(home, capfd):
    assert run([*RUN, "--json", "--out", "here", "--only", "cab*", "-j", "2"]) == 0

    document = json.loads(capfd.readouterr().out)
    assert (document["ok"], document["folder"], document["failed"]) == (True, "here", {})
    assert document["summary"]["all"]["means"]["iou"]["n"] == 1
    assert document["summary"] == json.loads(Path("here/results.json").read_text())["summary"]


def test_a_run_without_a_score_is_a_failure(home, capfd):
    assert run([*RUN, "-q", "--only", "raise"]) == 1

    assert capfd.readouterr() == ("", f"error: no object could be scored: {row_error(home, 'raise')}\n")


def row_error(home: Path, name: str) -> str:
    return json.loads((home / "out" / "bench" / "objects" / name / "row.json").read_text())["error"]


def test_predictions_are_scored_compared_and_shown_again(home, capfd):
    assert run([*RUN, "-q", "--out", "a"]) == 0
    predictions = home / "predictions"
    predictions.mkdir()
    (home / "a" / "objects" / "cabinet" / "output").rename(predictions / "cabinet")
    Path("a/report.html").unlink()

    assert run(["bench", "score", "data", "predictions", "--out", "b", "--no-pictures", "-q"]) == 0
    assert run(["bench", "compare", "a", "b"]) == 0
    assert run(["bench", "compare", "a", "b", "--json"]) == 0
    assert run(["bench", "report", "a"]) == 0

    text, brace, rest = capfd.readouterr().out.partition("\n{")
    assert "A  a: recipe recipe, 1 failed" in text
    assert "B  b: predictions predictions, 2 failed" in text
    # The block fell from 1 to 0; the cabinet and the failure are as before.
    assert re.search(r"^F1 +3 +0\.667 +0\.333 +-0\.333 .* 0/2/1 ", text, re.MULTILINE)
    document, end = json.JSONDecoder().raw_decode(brace.strip() + rest)
    assert document["objects"] == ["block", "cabinet", "raise"]
    assert (brace.strip() + rest)[end:].split() == ["a/report.html"]
    assert Path("a/report.html").is_file()


def test_what_makes_results_worth_less_is_a_warning_on_stderr(home, capfd):
    (home / "urdf" / "cabinet").mkdir(parents=True)
    mesh = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n"
    (home / "urdf" / "cabinet" / "a.obj").write_text(mesh)
    link = '<link name="a"><visual><geometry><mesh filename="a.obj"/></geometry></visual></link>'
    (home / "urdf" / "cabinet" / "cabinet.urdf").write_text(f'<robot name="r">{link}</robot>')
    command = ["bench", "score", "data", "urdf", "--only", "cab*", "--out", "b", "--no-pictures", "-j1"]

    assert run([*command, "-v"]) == 0
    told = "prediction does not fit the truth's box: see --up and --fit"
    err = capfd.readouterr().err.splitlines()
    assert f"warning: 1 {told}" in err
    assert any(re.fullmatch(r"\d notes? on 1 object: see b/report.html", line) for line in err)

    assert run([*command, "--json"]) == 0
    out, err = capfd.readouterr()
    assert json.loads(out)["warnings"] == [f"1 {told}"]
    assert not any("note" in line for line in err.splitlines())

    (home / "b" / "objects" / "cabinet" / "row.json").write_text("{")
    assert run(["bench", "report", "b"]) == 0
    assert "warning: 1 row left out as damaged: cabinet; run it again" in capfd.readouterr().err


def test_objects_are_imported(home, capfd):
    (home / "data" / "raise" / "gt.json").write_text("{}")

    assert run(["bench", "import", "data", "imported"]) == 0

    out, err = capfd.readouterr()
    assert out == "2 objects written to imported, 1 skipped\n"
    assert [line.split(":")[0] for line in err.splitlines()] == ["block", "cabinet", "raise"]
    assert Path("imported/cabinet/gt.json").is_file()


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["run", "nowhere"], "no such folder: nowhere"),
        (["run", "predictions"], "holds no object with ground truth"),
        (["run", "data", "--recipe", "nobody"], "unknown recipe 'nobody'"),
        (["run", "data", "--protocol", "paper"], "unknown protocol 'paper': known are simart"),
        (["run", "data", "--plugin", "missing.py"], "no plugin file missing.py"),
        (["run", "data", "--jobs", "0"], "--jobs"),
        (["run", "data", "--timeout", "soon"], "--timeout"),
        (["run", "data", "--only", "fridge"], "no object is called fridge"),
        (["run", "data", "--out", "data"], "data is not empty and no benchmark run"),
        (["run", "data", "--out", "recipe.toml"], "it is a file"),
        (["run", "data", "--variant", "fused"], "no object has the variant 'fused': "),
        (["score", "data", "nowhere"], "no such folder: nowhere"),
        (["score", "data", "recipe.toml"], "recipe.toml is a file: give its folder"),
        (
            ["score", "data", "predictions"],
            "/predictions: it is empty; name files and folders by their objects",
        ),
        (["score", "data", "predictions", "--up", "north"], "--up"),
        (["compare", "data", "data"], "is no folder of a benchmark run"),
        (["report", "data"], "is no folder of a benchmark run"),
        (["import", "nowhere", "out"], "no such folder: nowhere"),
        (["frobnicate"], "frobnicate"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_a_mistake_is_one_line_and_exit_code_2(home, capfd, arguments, told):
    (home / "predictions").mkdir()

    assert run(["bench", *arguments]) == 2

    (line,) = capfd.readouterr().err.splitlines()
    assert line.startswith("error: ")
    assert told in line
    assert not (home / "out").exists()


@pytest.mark.parametrize(
    "sent",
    [
        pytest.param(signal.SIGINT, id="ctrl-c", marks=pytest.mark.slow),
        pytest.param(signal.SIGTERM, id="kill", marks=pytest.mark.slow),
    ],
)
def test_an_interrupted_run_keeps_what_is_done_and_tells_how_to_go_on(home, capfd, sent):
    write_home(home, ["slow_1", "slow_2"])
    command = [*RUN, "--only", "cab*", "--only", "slow*"]
    running = subprocess.Popen(
        [sys.executable, "-m", "simart_kit", *command],
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    while converted(home) != ["cabinet", "slow_1"]:
        assert running.poll() is None
        time.sleep(0.02)

    running.send_signal(sent)
    out, err = running.communicate(timeout=20)

    assert (running.returncode, out) == (130, "")
    assert err.splitlines()[-2:] == [
        "2 objects left to do: run the same command again to go on",
        "interrupted",
    ]
    assert run([*command, "-q"]) == 0
    assert converted(home) == ["cabinet", "slow_1", "slow_1", "slow_2"]


def test_a_bar_tells_failures_above_it_and_the_mean_time():
    from rich.console import Console
    from rich.progress import Progress, TextColumn

    screen = StringIO()
    console = Console(file=screen, force_terminal=True, width=80)
    with Progress(TextColumn("{task.description}"), console=console, auto_refresh=False) as shown:
        bar = Bar(shown)
        bar.started(5, 2, ("one",))
        bar.finished(Row("one", seconds=1.0))
        bar.finished(Row("two", status="failed", error="crashed (signal 11)", seconds=2.0))
        (task,) = shown.tasks
        assert (task.completed, task.total, task.description) == (4, 5, "1.5 s an object")
    assert "5 objects, 2 done before, 1 changed since and done again: one" in screen.getvalue()
    assert re.search(r"two +failed: crashed \(signal 11\)", screen.getvalue())


def test_help_loads_nothing_of_the_bench():
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    code = (
        "import sys; from simart_kit.cli.main import run; run(['bench', 'run', '--help']);"
        "print([name for name in sys.modules if name.startswith(('simart_kit.bench', 'numpy', 'rich'))])"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout

    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert out.splitlines()[-1] == "[]"
    assert after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime < 1.0
