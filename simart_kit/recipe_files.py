"""Recipe files: where they are, what they inherit, and `--set` changes to them."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterable, Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

from .errors import RecipeError
from .plugins import Plugins

Table = dict[str, Any]
# The lists of a recipe, with the kind of stage that each holds.
LISTS = {"modify": "modifier", "export": "exporter"}


def packaged_recipes() -> dict[str, Path]:
    """Recipes that come with simart-kit, by name."""
    inside = Path(str(files("simart_kit"))) / "recipes"
    folder = inside if inside.is_dir() else Path(__file__).resolve().parents[1] / "recipes"
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def known_recipes(plugins: Plugins) -> dict[str, Path]:
    """Packaged recipes and those that plugins register; a plugin cannot replace a packaged one."""
    registered = {r.name: r.value for r in plugins.registrations("recipe")}
    return registered | packaged_recipes()


def read_table(source: str | Path, plugins: Plugins, sets: Iterable[str] = ()) -> Table:
    """A recipe with its parents and `--set` changes merged into one table, not checked yet.

    Args:
        source: a packaged or registered name, a TOML file, or a provenance.json of an earlier run.
        plugins: may have registered recipes.
        sets: `key=value` changes, see `apply_set`.

    Raises:
        RecipeError: there is no such recipe, a file cannot be read, or a change cannot be made.
    """
    table = _resolve(source, plugins, None, ())
    for text in sets:
        table = apply_set(table, text)
    return table


def apply_set(table: Table, text: str) -> Table:
    """Apply one `a.b=value`: the value is TOML (or a plain string); a list's entry is named by its `use`."""
    key, equals, value_text = text.partition("=")
    if not equals or not key.strip():
        raise RecipeError(f"--set '{text}': write key=value, such as segmenter.options.max_parts=8")
    path = [word.strip("\"'") for word in key.strip().split(".")]  # as TOML would quote them
    change: Any = _toml_value(value_text)
    if path[0] in LISTS and len(path) > 1:
        name, rest = path[1], path[2:]
        entries = table.get(path[0], [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            raise RecipeError(f"--set '{text}': the recipe's {path[0]} is not a list of tables")
        entries = list(entries)
        matching = [i for i, entry in enumerate(entries) if entry.get("use") == name]
        if not matching:
            known = ", ".join(str(e.get("use")) for e in entries) or "none"
            raise RecipeError(f"--set '{text}': the recipe's {path[0]} list has no '{name}': it has {known}")
        for index in matching:
            entries[index] = _merge(entries[index], _nest(rest, change, text))
        return {**table, path[0]: entries}
    return _merge(table, _nest(path, change, text))


def _resolve(source: str | Path, plugins: Plugins, base: Path | None, chain: tuple[str, ...]) -> Table:
    path = _find(source, plugins, base)
    chain = (*chain, str(path))
    if path.resolve() in {Path(earlier).resolve() for earlier in chain[:-1]}:
        raise RecipeError(f"recipes extend each other in a loop: {' -> '.join(chain)}")
    table = _read(path)
    parent = table.pop("extends", None)
    if parent is None:
        return table
    if not isinstance(parent, str):
        raise RecipeError(f"{path}: extends must be one recipe name or file, got {parent!r}")
    return _merge(_resolve(parent, plugins, path.parent, chain), table)


def _find(source: str | Path, plugins: Plugins, base: Path | None) -> Path:
    name, known = str(source), known_recipes(plugins)
    if name in known:
        return packaged_recipes().get(name) or Path(plugins.find("recipe", name).value)
    path = (base or Path()) / source
    if path.is_file():
        return path
    asked = f"extended from {base}, " if base else ""
    raise RecipeError(
        f"unknown recipe '{source}': {asked}no such file, and known are {', '.join(sorted(known))}"
    )


def _read(path: Path) -> Table:
    try:
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".json":
            return dict(json.loads(text)["recipe"])
        return tomllib.loads(text)
    except (
        OSError,
        UnicodeDecodeError,
        tomllib.TOMLDecodeError,
        json.JSONDecodeError,
        KeyError,
        TypeError,
    ) as error:
        reason = str(error)
        if isinstance(error, (KeyError, TypeError)):
            reason = "has no recipe in it"
        elif isinstance(error, UnicodeDecodeError):
            reason = "it is not UTF-8 text"
        raise RecipeError(f"cannot read recipe {path}: {reason}") from error


def _merge(parent: Mapping[str, Any], child: Mapping[str, Any]) -> Table:
    """Tables merge, arrays and scalars replace; a new `use` drops the parent's options."""
    if "use" in child and child["use"] != parent.get("use"):
        parent = {k: v for k, v in parent.items() if k != "options"}
    merged = dict(parent)
    for key, value in child.items():
        old = merged.get(key)
        merged[key] = _merge(old, value) if isinstance(old, dict) and isinstance(value, dict) else value
    return merged


def _nest(path: list[str], value: Any, text: str) -> Table:
    if not path:
        raise RecipeError(f"--set '{text}': name a field too, such as options.mode=...")
    for key in reversed(path):
        value = {key: value}
    return dict(value)


def _toml_value(text: str) -> Any:
    try:
        table = tomllib.loads(f"v = {text}")
    except tomllib.TOMLDecodeError:
        return text
    return table["v"] if table.keys() == {"v"} else text
