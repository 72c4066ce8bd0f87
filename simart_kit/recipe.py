"""Recipes: TOML files that compose stages. `docs/recipes.md` is the reference."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Literal, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from .errors import PluginError, RecipeError, UnknownPluginError
from .extras import require_extra
from .physics_overrides import MaterialChange, PartChange, PhysicsTable
from .plugins import Plugins, Registration
from .recipe_files import LISTS, Table, read_table
from .recipe_files import packaged_recipes as packaged_recipes
from .stages import Check, Composed, Options, Stage

S = TypeVar("S", bound=Stage)
_SINGLES = {"segmenter": "segmenter", "joints": "joint predictor"}
# Mistakes for which pydantic has Python's words.
_WORDS = {
    "extra_forbidden": "no such key",
    "missing": "missing",
    "model_type": "must be a table",
    "dict_type": "must be a table",
    "tuple_type": "must be a list",
}


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
    physics: PhysicsTable = Field(
        default=PhysicsTable(), description="Materials and masses that a person states."
    )
    checks: dict[str, Table | Literal[False]] = Field(
        default_factory=dict, description="Thresholds of checks by name, or false to leave one out."
    )

    def uses(self) -> tuple[tuple[str, Use], ...]:
        """Kind and use of each of its stages, in their order; checks are not among them."""
        singles = [(kind, getattr(self, key)) for key, kind in _SINGLES.items()]
        lists = [(kind, use) for key, kind in LISTS.items() for use in getattr(self, key)]
        return (*singles, *lists)

    def table(self) -> Table:
        """The recipe as plain values, a valid recipe itself."""
        return json.loads(self.model_dump_json(by_alias=True))  # type: ignore[no-any-return]


def load_recipe(source: str | Path, plugins: Plugins, sets: Iterable[str] = ()) -> Recipe:
    """Read a recipe, its parents and `--set` changes, and check all of it.

    Args:
        source: a packaged or registered name, a TOML file, or a provenance.json of an earlier run.
        plugins: says which stages exist.
        sets: `key=value` changes, see docs/recipes.md.

    Raises:
        RecipeError: listing every mistake at once.
    """
    changes = list(sets)
    # Not their values, which may be secret.
    keys = ", ".join(change.partition("=")[0] for change in changes)
    where = f"{source}' with changes of '{keys}" if changes else str(source)
    return parse_recipe(read_table(source, plugins, changes), plugins, where)


def parse_recipe(table: Mapping[str, Any], plugins: Plugins, where: str) -> Recipe:
    """Check a resolved table; raises RecipeError listing every mistake."""
    mistakes: list[str] = []
    recipe = None
    try:
        recipe = Recipe.model_validate_json(json.dumps(table, default=str))
    except ValidationError as error:
        mistakes += [_told(e["loc"], e, _keys(e["loc"])) for e in error.errors()]
    found, failed = _stage_mistakes(table, plugins)
    mistakes += found
    if mistakes or recipe is None:
        told = "; ".join([*mistakes, *failed])
        raise RecipeError(f"recipe '{where}' has {len(mistakes)} mistake(s): {told}")
    return _with_defaults(recipe, plugins)


def check_extras(uses: Iterable[tuple[str, Use]], plugins: Plugins) -> None:
    """Refuse stages that lack an extra of simart-kit, before any of them works.

    Args:
        uses: kind and use of each; see `Recipe.uses`.
        plugins: where to find them.

    Raises:
        BadInputError: says which stage needs what.
    """
    for kind, use in uses:
        options = read_options(plugins.find(kind, use.use).value, use.options)
        for extra in options.needed_extras():
            require_extra(extra, f"{kind} '{use.use}'")


def build(use: Use, base: type[S], plugins: Plugins, seed: int) -> tuple[S, Registration]:
    """Make a stage that a recipe names.

    Args:
        use: the name and the options.
        base: what it is: `Segmenter`, `JointPredictor`, `Modifier` or `Exporter`.
        plugins: where to find it.
        seed: of its random generators.

    Raises:
        UnknownPluginError, AmbiguousPluginError: there is no stage of that name, or several.
        RecipeError: its options are wrong.
        StageError: its constructor failed.
    """
    registration = plugins.find(base.kind, use.use)
    stage_class: type[S] = registration.value
    try:
        options = read_options(stage_class, use.options)
    except ValidationError as error:
        raise RecipeError("; ".join(_option_mistakes((base.kind, "options"), stage_class, error))) from error
    try:
        if issubclass(stage_class, Composed):
            return stage_class(options, seed=seed, plugins=plugins), registration
        return stage_class(options, seed=seed), registration
    except (Exception, SystemExit) as cause:
        raise registration.failure(cause) from cause


def build_checks(recipe: Recipe, plugins: Plugins) -> list[tuple[Check, Registration]]:
    """The checks that a recipe does not leave out, in the order in which they are registered."""
    names = [r.name for r in plugins.registrations(Check.kind) if recipe.checks.get(r.name) is not False]
    uses = [Use(use=name, options=recipe.checks.get(name) or {}) for name in dict.fromkeys(names)]
    return [build(use, Check, plugins, recipe.seed) for use in uses]


def read_options(stage: type[Stage], table: Any) -> Options:
    """Validate an options table; by way of JSON, so that TOML arrays may fill tuples in strict mode."""
    return stage.Options.model_validate_json(json.dumps(table, default=str))


def _with_defaults(recipe: Recipe, plugins: Plugins) -> Recipe:
    """The recipe with every option spelled out, so that its provenance repeats the run."""

    def full(use: Use, kind: str) -> Use:
        options = read_options(plugins.find(kind, use.use).value, use.options)
        return Use(use=use.use, options=json.loads(options.model_dump_json()))

    changed: Table = {key: full(getattr(recipe, key), kind) for key, kind in _SINGLES.items()}
    changed |= {key: tuple(full(use, kind) for use in getattr(recipe, key)) for key, kind in LISTS.items()}
    changed["checks"] = {
        name: table if table is False else full(Use(use=name, options=table), Check.kind).options
        for name, table in recipe.checks.items()
    }
    return recipe.model_copy(update=changed)


def _stage_mistakes(table: Mapping[str, Any], plugins: Plugins) -> tuple[list[str], set[str]]:
    """Unknown stages and wrong options, each with its place; and, told once, plugins that failed to load."""
    mistakes: list[str] = []
    failed: set[str] = set()
    uses = [(key, table.get(key), kind) for key, kind in _SINGLES.items()]
    for key, kind in LISTS.items():
        entries = table.get(key, [])
        uses += [(key, entry, kind) for entry in (entries if isinstance(entries, list) else [])]
    thresholds = table.get("checks", {})
    for name, options in thresholds.items() if isinstance(thresholds, Mapping) else ():
        uses.append(("checks", {"use": name, "options": {} if options is False else options}, Check.kind))
    # The recipe's own check has told of the others.
    stages = [
        (key, use, kind)
        for key, use, kind in uses
        if isinstance(use, Mapping) and isinstance(use.get("use"), str)
    ]
    for key, use, kind in stages:
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
            # The thresholds of a check are its table; other stages have theirs in `options`.
            inside = () if key == "checks" else ("options",)
            mistakes += _option_mistakes((_place(key, use), *inside), stage, error)
    formats = Counter(use["use"] for key, use, _ in stages if key == "export")
    twice = [name for name, times in formats.items() if times > 1]
    mistakes += [f"export.{name}: it is listed twice, and its files would be at one place" for name in twice]
    return mistakes, failed


def _place(key: str, use: Mapping[str, Any]) -> str:
    """Where a stage stands, as `--set` names it."""
    return key if key in _SINGLES else f"{key}.{use['use']}"


def _option_mistakes(place: tuple[str, ...], stage: type[Stage], error: ValidationError) -> list[str]:
    known = ", ".join(stage.Options.model_fields) or "none"
    return [_told((*place, *e["loc"]), e, known) for e in error.errors()]


def _keys(location: tuple[int | str, ...]) -> str:
    """The keys that there are where one of a recipe is wrong; "" where its own table tells."""
    match location:
        case (_,):
            table: type[BaseModel] = Recipe
        case ("physics", _):
            table = PhysicsTable
        case ("physics", "materials", _, _):
            table = MaterialChange
        case ("physics", "parts", _, _):
            table = PartChange
        case (str(key), *_) if key in (*_SINGLES, *LISTS):
            table = Use
        case _:
            return ""
    parents = ["extends"] if table is Recipe else []
    return ", ".join([*parents, *(field.alias or name for name, field in table.model_fields.items())])


def _told(location: tuple[int | str, ...], error: Any, known: str = "") -> str:
    place = ".".join(str(part) for part in location)
    text = f"{place}: {_WORDS.get(error['type'], error['msg'].removeprefix('Value error, '))}"
    if error["type"] not in ("missing", "value_error"):
        text += f" (got {error['input']!r})"
    if error["type"] == "extra_forbidden" and known:
        text += f", known are {known}"
    return text
