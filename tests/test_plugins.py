"""Finding plugins: whatever one of them does, the others load and the user is told."""

import sys
from importlib.metadata import EntryPoint

import pytest

import simart_kit as sk
from simart_kit import plugins as plugins_module
from simart_kit.errors import AmbiguousPluginError, PluginError, UnknownPluginError
from simart_kit.plugins import DEFAULT_PLUGINS, Owner, Plugins

GOOD = """
from __future__ import annotations
from typing import Literal
import simart_kit as sk

class Mirror(sk.Modifier):
    name = "mirror"
    class Options(sk.Options):
        axis: Literal["x", "y"] = "x"
    options: Options
    def modify(self, asset: sk.Asset) -> sk.Asset:
        return asset

@sk.hookimpl
def register_modifiers(register):
    register(Mirror)
"""


@pytest.fixture
def installed(monkeypatch, tmp_path):
    """Pretend that modules in a folder are installed plugins."""
    monkeypatch.syspath_prepend(tmp_path)

    def install(**modules: str) -> None:
        points = []
        for name, text in modules.items():
            (tmp_path / f"third_party_{name}.py").write_text(text)
            points.append(EntryPoint(name, f"third_party_{name}", "simart_kit"))
        monkeypatch.setattr(plugins_module, "_entry_points", lambda: points)

    yield install
    for name in [n for n in sys.modules if n.startswith("third_party_")]:
        del sys.modules[name]


def modifier(name: str) -> str:
    return GOOD.replace('"mirror"', f'"{name}"')


def names(plugins: Plugins, kind: str = "modifier") -> list[str]:
    return [r.name for r in plugins.registrations(kind)]


def test_all_built_in_plugins_load():
    plugins = Plugins(installed=False, strict=True)

    assert [owner.plugin for owner, _ in plugins.hooks()] == list(DEFAULT_PLUGINS)
    assert plugins.conflicts() == ()


def test_a_file_is_a_plugin_even_with_postponed_annotations(write):
    path = write("mirror.py", GOOD)

    found = Plugins(installed=False, strict=True, files=[path]).find("modifier", "mirror")

    assert found.owner == Owner("mirror", str(path), "")
    with pytest.raises(ValueError, match="axis"):
        found.value.Options(axis="z")


def test_files_of_one_name_do_not_disturb_each_other(write):
    files = [write("a/mine.py", modifier("one")), write("b/mine.py", modifier("two"))]

    plugins = Plugins(installed=False, strict=True, files=files)

    modules = {plugins.find("modifier", name).value.__module__ for name in ("one", "two")}
    assert len(modules) == 2


@pytest.mark.parametrize(
    ("text", "phase", "error"),
    [
        ("import module_that_nobody_has", "import", "ModuleNotFoundError"),
        ("raise SystemExit(1)", "import", "SystemExit"),
        ("def (", "import", "SyntaxError"),
        (GOOD + "    register(3)", "registration", "not a subclass of simart_kit.Modifier"),
        (GOOD + "    register(sk.Modifier)", "registration", "needs a class attribute `name`"),
        (GOOD.replace("def modify", "def change"), "registration", "does not implement modify()"),
        (GOOD.replace("(sk.Options)", ""), "registration", "not a subclass of simart_kit.Options"),
        (GOOD + "    raise RuntimeError('late')", "registration", "RuntimeError: late"),
        (GOOD + "\n@sk.hookimpl\ndef stage_ended(run): ...", "registration", "unknown hook"),
        (GOOD + "\n@sk.hookimpl\ndef run_started(runn): ...", "registration", "runn"),
        (
            GOOD.replace("@sk.hookimpl", ""),
            "registration",
            "no hook: mark functions named in docs/plugins.md",
        ),
    ],
)
def test_a_broken_plugin_is_recorded_and_leaves_no_trace(write, text, phase, error):
    good = write("good.py", modifier("good"))
    before = Plugins(installed=False)

    plugins = Plugins(installed=False, files=[write("broken.py", text), good])

    failure = plugins.failures[-1]
    assert (failure.owner.plugin, failure.phase) == ("broken", phase)
    assert error in failure.error
    assert "Traceback" in failure.trace
    assert names(plugins) == [*names(before), "good"]
    assert [owner.plugin for owner, _ in plugins.hooks()] == [
        *(owner.plugin for owner, _ in before.hooks()),
        "good",
    ]


def test_a_missing_file_is_a_failure(tmp_path):
    (failure,) = Plugins(installed=False, files=[tmp_path / "none.py"]).failures[-1:]

    assert "no plugin file" in failure.error


def test_strict_raises_the_first_failure(write, monkeypatch):
    broken = write("broken.py", "import module_that_nobody_has")

    with pytest.raises(PluginError, match="plugin broken during import: ModuleNotFoundError"):
        Plugins(installed=False, strict=True, files=[broken])

    monkeypatch.setenv("SIMART_STRICT_PLUGINS", "1")
    with pytest.raises(PluginError, match="plugin broken"):
        Plugins(installed=False, files=[broken])


def test_installed_plugins_load_and_a_broken_one_does_not_stop_them(installed):
    installed(broken="1 / 0", works=modifier("works"))

    plugins = Plugins()

    assert names(plugins)[-1] == "works"
    assert "broken during import: ZeroDivisionError: division by zero" in map(str, plugins.failures)


@pytest.mark.parametrize(
    ("variable", "loaded"),
    [(None, ["a", "b"]), ("b", ["b"]), (" b , a ", ["a", "b"]), ("", []), ("c", [])],
)
def test_an_environment_variable_picks_installed_plugins(installed, monkeypatch, variable, loaded):
    installed(a=modifier("a"), b=modifier("b"))
    if variable is not None:
        monkeypatch.setenv("SIMART_LOAD_PLUGINS", variable)

    assert [n for n in names(Plugins()) if n in ("a", "b")] == loaded


def test_two_stages_of_one_name_are_an_error_only_when_it_is_used(write):
    files = [write("a.py", modifier("same")), write("b.py", modifier("same")), write("c.py", modifier("c"))]

    plugins = Plugins(installed=False, files=files)

    assert plugins.find("modifier", "c").owner.plugin == "c"
    assert [r.owner.plugin for r in plugins.conflicts()[0]] == ["a", "b"]
    with pytest.raises(AmbiguousPluginError, match=r"modifier 'same' is registered by a \(.*\) and by b \("):
        plugins.find("modifier", "same")


def test_an_unknown_name_lists_known_ones_and_failures(write):
    plugins = Plugins(
        installed=False, files=[write("broken.py", "1 / 0"), write("mirror.py", modifier("mirror"))]
    )

    with pytest.raises(UnknownPluginError) as caught:
        plugins.find("modifier", "mirrror")

    assert "unknown modifier 'mirrror': known are " in str(caught.value)
    assert "mirror" in caught.value.missing.split("known are ")[1].split(", ")
    assert "broken during import: ZeroDivisionError" in str(caught.value)


def test_an_object_cannot_be_registered_twice_and_stays_registered():
    class Listener:
        @sk.hookimpl
        def run_started(self, run):
            raise RuntimeError("heard")

    plugins, listener = Plugins(installed=False), Listener()
    plugins.register(listener)

    with pytest.raises(PluginError, match=r"Listener .* is registered already"):
        plugins.register(listener)

    assert plugins.hooks()[-1][1] == ("run_started",)


def test_notify_reaches_everybody_and_returns_who_failed():
    heard = []

    class Fails:
        @sk.hookimpl
        def run_failed(self, error):
            raise KeyError("lost")

    class Hears:
        @sk.hookimpl
        def run_failed(self, stage):
            heard.append(stage)

    plugins = Plugins(installed=False)
    plugins.register(Fails(), Owner("fails", "d", "1"))
    plugins.register(Hears(), Owner("hears", "d", "1"))
    arguments = {"run": None, "stage": "mass", "error": ValueError()}
    mine = [item for item in plugins.notify("run_failed", arguments) if item[0].distribution == "d"]

    assert heard == ["mass"]
    assert [(str(owner), type(error)) for owner, error in mine] == [("fails (d 1)", KeyError)]


def test_plugins_of_two_instances_are_separate(write):
    with_file = Plugins(installed=False, files=[write("mirror.py", GOOD)])
    without = Plugins(installed=False)

    assert "mirror" in names(with_file)
    assert "mirror" not in names(without)
