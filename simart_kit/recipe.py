"""Recipes: TOML files that compose stages. `docs/recipes.md` is the reference."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterable, Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from .errors import PluginError, RecipeError, UnknownPluginError
from .plugins import Plugins, Registration
from .stages import Options, Stage

Table = dict[str, Any]
# The lists of a recipe, with the kind of stage that each holds.
_LISTS = {"modify": "modifier", "export": "exporter"}
_SINGLES = {"segmenter": "segmenter", "joints": "joint predictor"}


class Use(BaseModel):
    """One stage of a recipe: which plugin, and its options."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)
    use: str = Field(description="Registered name of the stage.")
    options: Table = Field(default_factory=dict, description="Options of that stage.")


class Recipe(BaseModel):
    """A resolved recipe: no parents left, every key known."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)
    # `schema` would hide a pydantic method, so the field has another name than its key.
    version: Literal[1] = Field(default=1, alias="schema", description="Version of the recipe format.")
    description: str = Field(default="", description="One line for `recipes list`.")
    seed: int = Field(default=0, ge=0, description="Seed of every random generator of the run.")
    stage_timeout: float = Field(
        default=600.0,
        ge=0,
        allow_inf_nan=False,
        description="Longest time a stage may take [s]; 0: no limit.",
    )
    segmenter: Use = Field(description="Finds the parts.")
    joints: Use = Field(description="Says how the parts move.")
    modify: tuple[Use, ...] = Field(default=(), description="Modifiers, in order.")
    export: tuple[Use, ...] = Field(default=(), description="Exporters.")

    def table(self) -> Table:
        """The recipe as plain values, a valid recipe itself."""
        return json.loads(self.model_dump_json(by_alias=True))  # type: ignore[no-any-return]


def packaged_recipes() -> dict[str, Path]:
    """Recipes that come with simart-kit, by name."""
    inside = Path(str(files("simart_kit"))) / "recipes"
    folder = inside if inside.is_dir() else Path(__file__).resolve().parents[1] / "recipes"
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def known_recipes(plugins: Plugins) -> dict[str, Path]:
    """Packaged recipes and those that plugins register; a plugin cannot replace a packaged one."""
    registered = {r.name: r.value for r in plugins.registrations("recipe")}
    return registered | packaged_recipes()


def load_recipe(source: str | Path, plugins: Plugins, sets: Iterable[str] = ()) -> Recipe:
    """Read a recipe, its parents and `--set` changes, and check all of it.

    Args:
        source: a packaged or registered name, a TOML file, or a provenance.json of an earlier run.
        plugins: says which stages exist.
        sets: `key=value` changes, see docs/recipes.md.

    Raises:
        RecipeError: listing every mistake at once.
    """
    table = _resolve(source, plugins, None, ())
    for text in sets:
        table = apply_set(table, text)
    return parse_recipe(table, plugins, str(source))


def parse_recipe(table: Mapping[str, Any], plugins: Plugins, where: str) -> Recipe:
    """Check a resolved table; raises RecipeError listing every mistake."""
    mistakes: list[str] = []
    recipe = None
    try:
        recipe = Recipe.model_validate_json(json.dumps(table, default=str))
    except ValidationError as error:
        mistakes += [_told(e["loc"], e) for e in error.errors()]
    found, failed = _stage_mistakes(table, plugins)
    mistakes += found
    if mistakes or recipe is None:
        told = "; ".join([*mistakes, *failed])
        raise RecipeError(f"recipe '{where}' has {len(mistakes)} mistake(s): {told}")
    return _with_defaults(recipe, plugins)


def build(use: Use, kind: str, plugins: Plugins, seed: int) -> tuple[Stage, Registration]:
    """Make a stage that a recipe names.

    Raises:
        RecipeError: its options are wrong.
        StageError: its constructor failed.
    """
    registration = plugins.find(kind, use.use)
    stage_class: type[Stage] = registration.value
    try:
        options = read_options(stage_class, use.options)
    except ValidationError as error:
        raise RecipeError("; ".join(_option_mistakes(kind, stage_class, error))) from error
    try:
        return stage_class(options, seed=seed), registration
    except Exception as cause:
        raise registration.failure(cause) from cause


def read_options(stage: type[Stage], table: Any) -> Options:
    """Validate an options table; by way of JSON, so that TOML arrays may fill tuples in strict mode."""
    return stage.Options.model_validate_json(json.dumps(table, default=str))


def apply_set(table: Table, text: str) -> Table:
    """Apply one `a.b=value`: the value is TOML (or a plain string); a list's entry is named by its `use`."""
    key, equals, value_text = text.partition("=")
    if not equals or not key.strip():
        raise RecipeError(f"--set '{text}': write key=value, such as segmenter.options.max_parts=8")
    path = key.strip().split(".")
    change: Any = _toml_value(value_text)
    if path[0] in _LISTS and len(path) > 1:
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


def _with_defaults(recipe: Recipe, plugins: Plugins) -> Recipe:
    """The recipe with every option spelled out, so that its provenance repeats the run."""

    def full(use: Use, kind: str) -> Use:
        options = read_options(plugins.find(kind, use.use).value, use.options)
        return Use(use=use.use, options=json.loads(options.model_dump_json()))

    changed: Table = {key: full(getattr(recipe, key), kind) for key, kind in _SINGLES.items()}
    changed |= {key: tuple(full(use, kind) for use in getattr(recipe, key)) for key, kind in _LISTS.items()}
    return recipe.model_copy(update=changed)


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
        f"unknown recipe '{source}': {asked}known are {', '.join(sorted(known))}, or give a .toml file"
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
        reason = "has no recipe in it" if isinstance(error, (KeyError, TypeError)) else str(error)
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


def _stage_mistakes(table: Mapping[str, Any], plugins: Plugins) -> tuple[list[str], set[str]]:
    """Unknown stages and wrong options, each with its place; and, told once, plugins that failed to load."""
    mistakes: list[str] = []
    failed: set[str] = set()
    uses = [(key, table.get(key), kind) for key, kind in _SINGLES.items()]
    for key, kind in _LISTS.items():
        entries = table.get(key, [])
        uses += [(key, entry, kind) for entry in (entries if isinstance(entries, list) else [])]
    for key, use, kind in uses:
        if not isinstance(use, Mapping) or not isinstance(use.get("use"), str):
            continue  # told already by the recipe's own check
        try:
            stage: type[Stage] = plugins.find(kind, use["use"]).value
            if isinstance(use.get("options", {}), Mapping):
                read_options(stage, use.get("options", {}))
        except UnknownPluginError as error:
            mistakes.append(f"{_place(key, use)}: {error.missing}")
            failed |= {error.failed} - {""}
        except PluginError as error:
            mistakes.append(f"{_place(key, use)}: {error}")
        except ValidationError as error:
            mistakes += _option_mistakes(_place(key, use), stage, error)
    return mistakes, failed


def _place(key: str, use: Mapping[str, Any]) -> str:
    """Where a stage stands, as `--set` names it."""
    return key if key in _SINGLES else f"{key}.{use['use']}"


def _option_mistakes(place: str, stage: type[Stage], error: ValidationError) -> list[str]:
    known = ", ".join(stage.Options.model_fields) or "none"
    return [_told((place, "options", *e["loc"]), e, known) for e in error.errors()]


def _told(location: tuple[int | str, ...], error: Any, known: str = "") -> str:
    place = ".".join(str(part) for part in location)
    text = f"{place}: {error['msg']}"
    if error["type"] != "missing":
        text += f" (got {error['input']!r})"
    if error["type"] == "extra_forbidden" and known:
        text += f", known are {known}"
    return text
