"""Commands that plugins add: listed without being imported, run like the core's own."""

import re
import subprocess
import sys
from importlib.metadata import EntryPoint

import pytest
from typer.main import get_command

from simart_kit.cli.app import app
from simart_kit.cli.main import run
from simart_kit.commands import CORE_NAMES
from simart_kit.plugins import COMMAND_PLUGINS, Plugins

PLUGIN = """
import simart_kit as sk

@sk.hookimpl
def register_commands(register):
    register("{name}", "{target}", "Greet somebody.")
"""
GREET = '''
from typing import Annotated
import typer
from simart_kit.cli.options import Verbose
from simart_kit.errors import BadInputError

def greet(name: Annotated[str, typer.Argument()], loud: bool = False, verbose: Verbose = False) -> None:
    """Greet somebody by name."""
    if name == "nobody":
        raise BadInputError("nobody is here")
    print(f"hello {name}" + "!" * loud + f" {1 / len(name):.1f}")
'''


@pytest.fixture
def install(monkeypatch, tmp_path):
    """Pretend that modules in a folder are installed plugins, or modules that these need."""
    monkeypatch.syspath_prepend(tmp_path)
    points = []
    monkeypatch.setattr("simart_kit.plugins._entry_points", lambda: points)

    def install(plugins=(), **modules):
        for name, text in modules.items():
            (tmp_path / f"third_party_{name}.py").write_text(text)
        points.extend(EntryPoint(name, f"third_party_{name}", "simart_kit") for name in plugins)

    yield install
    for name in [name for name in sys.modules if name.startswith("third_party_")]:
        del sys.modules[name]


def plugin(name, target="third_party_greet:greet"):
    return PLUGIN.format(name=name, target=target)


def greeter(install, name):
    install(["polite"], polite=plugin(name), greet=GREET)


def error_line(capfd):
    (line,) = capfd.readouterr().err.splitlines()
    assert line.startswith("error: ")
    return line


@pytest.mark.parametrize(
    ("name", "listing"),
    [("greet", []), ("train greet", ["train"]), ("model greet", ["model"]), ("bench greet", ["bench"])],
)
def test_a_command_is_listed_unimported_and_runs(install, capfd, name, listing):
    greeter(install, name)

    assert run([*listing, "--help"]) == 0
    assert re.search(r"^  greet +Greet somebody\.$", capfd.readouterr().out, re.MULTILINE)
    assert run(["--help"]) == 0
    assert run(["plugins", "list"]) == 0
    assert re.search(rf"^command +{name} +polite \(", capfd.readouterr().out, re.MULTILINE)
    assert "third_party_greet" not in sys.modules

    assert run([*name.split(), "Ada", "--loud"]) == 0
    assert capfd.readouterr().out == "hello Ada! 0.3\n"
    assert run([*name.split(), "--help"]) == 0
    out = capfd.readouterr().out
    assert f"Usage: simart-kit {name} [OPTIONS]" in out
    assert "Greet somebody by name." in out
    assert "--loud" in out


def test_a_group_alone_shows_its_commands(install, capfd):
    greeter(install, "train greet")

    assert run(["train"]) == 2
    out, err = capfd.readouterr()
    assert out == ""
    assert "Train a model." in err
    assert re.search(r"^  greet +Greet somebody\.$", err, re.MULTILINE)


def test_a_group_without_commands_does_not_exist(install, capfd, monkeypatch):
    monkeypatch.setattr("simart_kit.plugins.COMMAND_PLUGINS", ())

    assert run(["--help"]) == 0
    assert not re.search(r"^  (train|model) ", capfd.readouterr().out, re.MULTILINE)
    assert run(["train"]) == 2
    assert "No such command 'train'" in error_line(capfd)


def test_errors_are_told_as_those_of_other_commands(install, capfd):
    greeter(install, "greet")

    assert run(["greet", "nobody"]) == 2
    assert error_line(capfd) == "error: nobody is here"
    assert run(["greet", "nobody", "-v"]) == 2
    assert "Traceback (most recent call last)" in capfd.readouterr().err
    assert run(["greet", "Ada", "--softly"]) == 2
    assert "--softly" in error_line(capfd)
    assert run(["greet", ""]) == 1
    assert "unexpected ZeroDivisionError in plugin polite (" in error_line(capfd)


@pytest.mark.parametrize(
    ("target", "told"),
    [
        ("third_party_nowhere:greet", "ModuleNotFoundError: No module named 'third_party_nowhere'"),
        ("third_party_greet:wave", "AttributeError: module 'third_party_greet' has no attribute 'wave'"),
        ("third_party_exits:greet", "SystemExit: 3"),
    ],
)
def test_a_command_that_cannot_be_imported_names_its_plugin(install, capfd, target, told):
    install(["polite"], polite=plugin("greet", target), greet=GREET, exits="raise SystemExit(3)")

    assert run(["--help"]) == 0
    capfd.readouterr()
    assert run(["greet", "Ada"]) == 2
    line = error_line(capfd)
    assert "command 'greet' of plugin polite (" in line
    assert told in line
    assert run(["greet", "Ada", "-v"]) == 2
    assert "Traceback (most recent call last)" in capfd.readouterr().err


def test_two_commands_of_one_name_are_an_error_when_it_is_used(install, capfd):
    other = "third_party_greet:greet"
    install(
        ["a", "b", "c"], a=plugin("train x"), b=plugin("train x"), c=plugin("train y", other), greet=GREET
    )

    assert run(["train", "--help"]) == 0
    out = capfd.readouterr().out
    assert re.search(r"^  x +Registered by 2 plugins: see `plugins list`\.$", out, re.MULTILINE)
    assert run(["train", "y", "Ada"]) == 0
    capfd.readouterr()
    assert run(["train", "x", "Ada"]) == 2
    assert re.search(r"command 'train x' is registered by a \(.*\) and by b \(", error_line(capfd))
    assert run(["plugins", "list", "--check"]) == 1
    assert "CONFLICT  command 'train x' is registered by a (" in capfd.readouterr().out


def test_the_core_s_names_are_those_of_its_commands():
    tree = get_command(app)
    names = set(tree.commands) | {f"bench {name}" for name in tree.commands["bench"].commands}
    assert names | {"train", "model", "dataset"} == CORE_NAMES


@pytest.mark.parametrize("name", ["version", "bench", "bench score", "train"])
def test_a_core_name_is_refused_with_both_owners_and_the_core_s_command_works(install, capfd, name):
    greeter(install, name)

    assert run(["version"]) == 0
    assert capfd.readouterr().out.startswith("simart-kit ")
    assert run(["plugins", "list", "--check"]) == 1
    told = f"command '{name}' is registered by simart_kit (built in) and by polite ("
    assert re.search(
        f"^FAILED  polite during registration: .*{re.escape(told)}", capfd.readouterr().out, re.M
    )
    assert run(["greet"]) == 2
    assert told in error_line(capfd)


@pytest.mark.parametrize(
    ("name", "target", "told"),
    [
        ("Greet", "a:b", "is not one or two words"),
        ("train a b", "a:b", "is not one or two words"),
        ("", "a:b", "is not one or two words"),
        ("--greet", "a:b", "is not one or two words"),
        ("recipes greet", "a:b", "is in no group that takes commands: bench, dataset, model, train"),
        ("greet", "a.b", "is not of the form package.module:function"),
    ],
)
def test_a_malformed_registration_is_a_failure_of_the_plugin(write, name, target, told):
    path = write("polite.py", plugin(name, target))

    failure = Plugins(installed=False, files=[path]).failures[-1]

    assert failure.phase == "registration"
    assert told in failure.error


def test_a_plugin_that_fails_is_told_where_a_command_is_unknown_and_nowhere_else(install, capfd):
    install(["broken"], broken="print('noise'); 1 / 0")

    assert run(["--help"]) == 0
    out, err = capfd.readouterr()
    assert (err, "noise" in out) == ("noise\n", False)
    assert run(["grete"]) == 2
    *_, line = capfd.readouterr().err.splitlines()
    assert "No such command 'grete'" in line
    assert "1 plugin(s) failed to load: broken during import: ZeroDivisionError" in line


@pytest.mark.parametrize(
    ("arguments", "loads"),
    [
        (["version"], 0),
        (["bench", "report", "nowhere"], 0),
        (["convert", "nowhere.glb"], 1),
        (["recipes", "list"], 1),
        (["--help"], 1),
        (["bench", "--help"], 1),
        (["train", "--help"], 1),
        (["frobnicate"], 1),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_plugins_are_loaded_once_at_most_and_not_for_what_the_core_knows(
    tmp_path, monkeypatch, arguments, loads
):
    counted = []
    original = Plugins.__init__

    def counting(self, **options):
        counted.append(options)
        original(self, **options)

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(Plugins, "__init__", counting)
    run(arguments)

    assert len(counted) == loads


def test_help_imports_no_numpy():
    code = (
        "import sys; from simart_kit.cli.main import run; run(['--help']);"
        "print(sorted({'numpy', 'torch', 'scipy'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)

    assert done.stdout.splitlines()[-1] == "[]"
    assert re.search(r"^  train +Train a model\.$", done.stdout, re.MULTILINE)


def test_built_in_plugins_with_commands_are_those_that_help_loads():
    plugins = Plugins(installed=False)

    implementing = {owner.plugin for owner, hooks in plugins.hooks() if "register_commands" in hooks}
    assert implementing == set(COMMAND_PLUGINS)
    quick = Plugins(installed=False, strict=True, commands_only=True)
    assert quick.registrations() == plugins.registrations("command")


@pytest.mark.parametrize("name", [r.name for r in Plugins(installed=False).registrations("command")])
def test_every_built_in_command_has_help(capfd, name):
    assert run([*name.split(), "--help"]) == 0
    assert f"Usage: simart-kit {name} [OPTIONS]" in capfd.readouterr().out


def test_plugins_show_tells_of_a_command(install, capfd):
    greeter(install, "train greet")

    assert run(["plugins", "show", "train greet"]) == 0
    out = capfd.readouterr().out
    assert "command train greet, from polite (" in out
    assert "Greet somebody." in out
    assert "simart-kit train greet --help" in out
    assert run(["plugins", "show", "train greet", "--json"]) == 0
    assert '"target": "third_party_greet:greet"' in capfd.readouterr().out
