"""Commands that list and show, progress on a terminal, and how long the command line takes to start."""

import json
import re
import resource
import subprocess
import sys
from io import StringIO
from pathlib import Path
from types import SimpleNamespace

import pytest

from simart_kit.cli.main import run
from simart_kit.cli.progress import Bar, steps
from simart_kit.plugins import Plugins
from simart_kit.recipe import load_recipe

from .cli_home import FAKES, furnished


@pytest.fixture
def home(tmp_path, monkeypatch) -> Path:
    return furnished(tmp_path, monkeypatch)


def test_recipes_are_listed_shown_and_checked(home, capfd):
    assert run(["recipes", "list"]) == 0
    listed = {line.split()[0] for line in capfd.readouterr().out.splitlines()}
    assert {"default", "usd", "urdf", "mjcf", "all", "geometric"} <= listed

    change = ["--set", 'export=[{use="mjcf"}]']
    assert run(["recipes", "show", "default", *change]) == 0
    (home / "shown.toml").write_text(capfd.readouterr().out)
    plugins = Plugins(installed=False)
    assert load_recipe(home / "shown.toml", plugins) == load_recipe("default", plugins, change[1:])

    (home / "ships.py").write_text(
        "import simart_kit as sk\n@sk.hookimpl\ndef register_recipes(register):\n"
        "    register('shipped', 'recipe.toml')\n    register('lost', 'nowhere.toml')\n"
    )
    assert run(["recipes", "list", "--plugin", "fakes.py", "--plugin", "ships.py"]) == 0
    lines = capfd.readouterr().out.splitlines()
    assert any(re.fullmatch(r"shipped +for tests", line) for line in lines)
    assert any(re.match(r"lost +FAILED: cannot read recipe", line) for line in lines)

    assert run(["recipes", "check", "recipe.toml", "--plugin", "fakes.py"]) == 0
    assert capfd.readouterr().out == "ok: recipe.toml: labels > joints > text\n"


def test_plugins_list_marks_failures_and_conflicts(home, capfd):
    (home / "broken.py").write_text("1 / 0")
    (home / "twin.py").write_text(FAKES)

    assert run(["plugins", "list", "--check"]) == 0
    capfd.readouterr()
    files = ["--plugin", "broken.py", "--plugin", "fakes.py", "--plugin", "twin.py"]
    assert run(["plugins", "list", *files]) == 0
    out = capfd.readouterr().out
    assert "FAILED  broken during import: ZeroDivisionError: division by zero" in out
    assert "CONFLICT  segmenter 'labels' is registered by fakes (fakes.py) and by twin (twin.py)" in out
    assert re.search(r"^exporter +usd +simart_kit_exporters\.usd \(built in ", out, re.MULTILINE)

    assert run(["plugins", "list", "--check", "--json", *files]) == 1
    document = json.loads(capfd.readouterr().out)
    assert [(f["plugin"], f["phase"]) for f in document["failures"]] == [("broken", "import")]
    assert [group[0]["name"] for group in document["conflicts"]] == ["labels", "joints", "text"]
    assert ("exporter", "usd") in [(stage["kind"], stage["name"]) for stage in document["stages"]]


def test_plugins_show_prints_doc_and_options(home, capfd):
    assert run(["plugins", "show", "labels", "--plugin", "fakes.py"]) == 0
    out = capfd.readouterr().out
    assert "segmenter labels, from fakes (fakes.py)" in out
    assert "Labels a cabinet.\n\nKnows one cabinet only." in out
    assert re.search(r'fault +text +"" +What goes wrong\.', out)

    assert run(["plugins", "show", "geometric", "--json"]) == 0
    shown = json.loads(capfd.readouterr().out)
    assert [row["kind"] for row in shown] == ["segmenter", "joint predictor"]
    assert all(option["description"] for row in shown for option in row["options"])


def test_progress_on_a_terminal_shows_finished_stages_and_the_next():
    from rich.console import Console
    from rich.progress import Progress, TextColumn

    recipe = load_recipe("usd", Plugins(installed=False))
    screen = StringIO()
    console = Console(file=screen, force_terminal=True, width=80)
    with Progress(TextColumn("running {task.description}"), console=console, auto_refresh=False) as shown:
        bar = Bar(shown)
        bar.run_started(SimpleNamespace(recipe=recipe))
        bar.stage_finished("load", "glb", 0.25)
        assert shown.tasks[0].description == f"segment {recipe.segmenter.use}"
        for stage in steps(recipe)[1:]:
            bar.stage_finished(stage.split()[0], stage.split()[-1], 0.5)
        assert shown.tasks[0].finished
    assert "load glb" in screen.getvalue()
    assert "0.25 s" in screen.getvalue()


@pytest.mark.slow
def test_start_up_takes_little_more_cpu_time_than_its_libraries():
    # A share rather than seconds, which depend on the machine and on what else it does.
    # Pydantic loads most of itself when a name of it is used. The share is about 2 on a quiet machine and was
    # 2.7 on a busy one; torch alone is 7 times the libraries, trimesh 3.
    libraries = [sys.executable, "-c", "import numpy, pluggy, typer; from pydantic import BaseModel"]
    start_up = [
        [sys.executable, "-m", "simart_kit", *arguments] for arguments in (["--help"], ["plugins", "list"])
    ]
    # The first start compiles modules.
    seconds = [[_cpu_seconds(command) for command in (libraries, *start_up)] for _ in range(4)][1:]
    least_of_libraries, *least = map(min, zip(*seconds, strict=True))
    assert max(least) < 4 * least_of_libraries


def _cpu_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def test_plugins_list_imports_nothing_heavy():
    heavy = "torch pxr mujoco rerun trimesh scipy PIL embreex"
    code = (
        "import sys; from simart_kit.cli.main import run; run(['plugins', 'list']);"
        f"print(sorted(set('{heavy}'.split()) & set(sys.modules)))"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout

    assert out.splitlines()[-1] == "[]"
