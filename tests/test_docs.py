"""docs/plugins.md says what is true: its hooks are the hooks, and its code runs."""

import inspect
import re
import shutil
import subprocess
import sys
from importlib.metadata import EntryPoint, distributions
from pathlib import Path

import pytest

import simart_kit as sk
from simart_kit import hookspecs
from simart_kit.cli.help import help_text
from simart_kit.stages import Composed, Stage
from simart_kit.testing import contracts, pytest_plugin

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "examples" / "cabinet.glb"
TEXT = (ROOT / "docs" / "plugins.md").read_text(encoding="utf-8")
HOOKS = {name: value for name, value in vars(hookspecs).items() if hasattr(value, "simart_kit_spec")}


def code_files() -> dict[str, str]:
    """Python blocks that begin with a file name in a comment."""
    blocks = re.findall(r"^```python\n# (\w+\.py)\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)
    return dict(blocks)


@pytest.fixture
def written(tmp_path: Path) -> Path:
    """A folder with the code of the page."""
    for name, code in code_files().items():
        (tmp_path / name).write_text(code, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("name", sorted(HOOKS))
def test_hook_is_documented_with_its_arguments(name: str) -> None:
    signature = f"`{name}({', '.join(inspect.signature(HOOKS[name]).parameters)})`"
    assert signature in TEXT


def test_every_documented_hook_exists() -> None:
    documented = set(re.findall(r"^\| `(\w+)\(", TEXT, re.MULTILINE))
    assert documented == set(HOOKS)


@pytest.mark.parametrize("kind", [kind for kind in Stage.__subclasses__() if kind is not Composed])
def test_stage_kind_is_documented_with_its_method(kind: type[Stage]) -> None:
    (method,) = kind.__abstractmethods__
    arguments = [name for name in inspect.signature(getattr(kind, method)).parameters if name != "self"]
    assert f"| {kind.kind} | `{kind.__name__}` | `{method}({', '.join(arguments)})" in TEXT


def test_example_segmenter_is_about_20_lines() -> None:
    lines = [line for line in code_files()["slices.py"].splitlines() if line.strip()]
    assert len(lines) <= 26


@pytest.mark.slow
def test_example_plugins_keep_their_contracts(written: Path) -> None:
    options = ["-q", "-p", "no:cacheprovider", "-W", "error", "--rootdir", str(written)]
    command = [sys.executable, "-m", "pytest", *options, str(written)]
    done = subprocess.run(command, cwd=written, capture_output=True, text=True, timeout=170)
    assert done.returncode == 0, done.stdout
    assert " skipped" not in done.stdout
    assert sum(name.startswith("test_") for name in code_files()) == 4


def test_example_plugins_run_from_their_files(
    written: Path, run_recipe: pytest_plugin.RunRecipe, cabinet_mesh: sk.Mesh
) -> None:
    plugins = sk.Plugins(
        installed=False, strict=True, files=[written / "slices.py", written / "joint_table.py"]
    )
    recipe = {
        "schema": 1,
        "segmenter": {"use": "slices", "options": {"count": 4}},
        "joints": {"use": "geometric"},
        "export": [{"use": "joint_table"}],
    }
    result = run_recipe(cabinet_mesh, recipe, plugins)
    assert len(result.asset.parts) == 4
    assert len(result.paths["joint_table"].read_text().splitlines()) == 1 + len(result.asset.joints)
    assert result.report.unsupported["joint_table"]


def test_packaging_snippet_installs_the_example(
    written: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    (snippet,) = re.findall(r"^```toml\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)
    (written / "pyproject.toml").write_text(snippet, encoding="utf-8")
    site = tmp_path_factory.mktemp("site")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--quiet", "--no-index"]
    command = [*pip, "--no-deps", "--no-build-isolation", "--target", str(site), str(written)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    (found,) = entry_points_in(site)
    assert (found.group, found.name, found.value) == ("simart_kit", "slices", "slices")
    assert [path.name for path in site.glob("*.py")] == ["slices.py"]


def entry_points_in(site: Path) -> list[EntryPoint]:
    return [point for found in distributions(path=[str(site)]) for point in found.entry_points]


@pytest.mark.slow
def test_command_of_the_page_works(written: Path) -> None:
    (line,) = re.findall(r"^    simart-kit (convert .*)$", TEXT, re.MULTILINE)
    shutil.copy(EXAMPLE, written / "cabinet.glb")
    command = [sys.executable, "-m", "simart_kit", *line.split(), "--no-record", "--json"]
    done = subprocess.run(command, cwd=written, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    asset = sk.load_asset(written / "out" / "cabinet")
    assert [part.name for part in asset.parts] == [f"slice_{i}" for i in range(4)]


def test_testing_kit_is_documented() -> None:
    classes = [n for n, v in vars(contracts).items() if n.endswith("Contract") and n != "StageContract"]
    fixtures = [n for n, v in vars(pytest_plugin).items() if "fixture" in type(v).__name__.lower()]
    assert (len(classes), len(fixtures)) == (5, 4)
    assert [name for name in classes + fixtures if f"`{name}`" not in TEXT] == []


def commands(*words: str) -> list[str]:
    """All commands below one, as its help lists them."""
    listed = help_text(words).partition("\nCommands:\n")[2]
    below = re.findall(r"^  (\S+)  ", listed, re.MULTILINE)
    return [one for name in below for one in commands(*words, name)] if below else [" ".join(words)]


def test_the_page_of_commands_has_all() -> None:
    page = (ROOT / "docs" / "cli.md").read_text(encoding="utf-8")
    headings = re.findall(r"^## simart-kit (.+)$", page, re.MULTILINE)
    assert {"convert", "spec", "train nano", "bench run"} <= set(headings)
    assert sorted(headings) == sorted(commands())
