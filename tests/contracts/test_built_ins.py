"""The list of built-in plugins, their contract classes and the packaged recipes belong together."""

import importlib
import re
from pathlib import Path

import pytest
import simart_kit_exporters
import simart_kit_plugins

import simart_kit.checks
from simart_kit import Plugins
from simart_kit.plugins import DEFAULT_PLUGINS
from simart_kit.recipe import load_recipe
from simart_kit.recipe_files import packaged_recipes
from simart_kit.testing.contracts import StageContract


def test_default_plugins_are_the_modules_that_implement_hooks() -> None:
    found = set()
    for package in (simart_kit_plugins, simart_kit_exporters, simart_kit.checks):
        root = Path(package.__path__[0])
        for path in root.rglob("*.py"):
            if re.search(r"^\s*@.*\bhookimpl\b", path.read_text(encoding="utf-8"), re.MULTILINE):
                inside = (package.__name__, *path.relative_to(root).with_suffix("").parts)
                found.add(".".join(inside[:-1] if inside[-1] == "__init__" else inside))
    assert found == {name.partition(":")[0] for name in DEFAULT_PLUGINS}


def test_every_built_in_stage_keeps_a_contract() -> None:
    covered = set()
    for path in Path(__file__).parent.glob("test_*s.py"):
        if path.name == Path(__file__).name:
            continue
        module = importlib.import_module(f"{__package__}.{path.stem}")
        classes = [v for v in vars(module).values() if isinstance(v, type) and issubclass(v, StageContract)]
        covered |= {c.stage for c in classes if hasattr(c, "stage")}
    stages = [
        r
        for r in Plugins(installed=False, strict=True).registrations()
        if r.kind not in ("recipe", "command")
    ]
    assert {r.value for r in stages} == covered


@pytest.mark.parametrize("name", sorted(packaged_recipes()))
def test_packaged_recipe_resolves(name: str) -> None:
    recipe = load_recipe(name, Plugins(installed=False, strict=True))
    assert recipe.description, "recipes list shows a line for each recipe"
    assert recipe.export, "a recipe that writes nothing is of no use"
