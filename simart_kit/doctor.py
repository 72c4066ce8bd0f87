"""examine(): what is installed, what each plugin needs, and which recipes can run."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from importlib.metadata import requires, version
from typing import Any

from .errors import SimartKitError
from .extras import EXTRAS
from .findings import Finding, library, named_weights
from .machine import machine
from .plugins import Owner, Plugins
from .recipe import Recipe, load_recipe
from .recipe_files import known_recipes

DEFAULT_RECIPE = "default"
# Extras that only those who develop simart-kit want.
_NOT_TOLD = frozenset({"test", "dev"})
# Libraries that every conversion needs, whatever its recipe; plugins tell of the others themselves.
_ALWAYS = frozenset({"embreex", "manifold3d", "mujoco", "numpy", "pillow", "pydantic", "scipy", "trimesh"})


@dataclass(frozen=True)
class PluginFindings:
    """What a plugin needs.

    Attributes:
        owner: the plugin.
        stages: kind and name of what it registers.
        findings: its own, in its order; empty where it needs nothing besides the core.
    """

    owner: Owner
    stages: tuple[tuple[str, str], ...]
    findings: tuple[Finding, ...]


@dataclass(frozen=True)
class Diagnosis:
    """What the doctor found.

    Attributes:
        version: of simart-kit.
        machine: what it runs on.
        libraries: of simart-kit's own requirements and extras.
        plugins: in loading order; those that did not load have one broken finding.
        recipes: a finding a recipe: whether it can run, and what keeps it.
    """

    version: str
    machine: tuple[Finding, ...]
    libraries: tuple[Finding, ...]
    plugins: tuple[PluginFindings, ...]
    recipes: tuple[Finding, ...]

    @property
    def ok(self) -> bool:
        """Whether the default recipe can run."""
        return all(recipe.ok for recipe in self.recipes if recipe.subject == DEFAULT_RECIPE)


def examine(plugins: Plugins) -> Diagnosis:
    """Look at everything; nothing heavy is imported and nothing runs."""
    libraries, told = _libraries(), _plugin_findings(plugins)
    lacking = [found for found in libraries if found.subject in _ALWAYS and not found.ok]
    recipes = tuple(_recipe(name, plugins, told, lacking) for name in sorted(known_recipes(plugins)))
    return Diagnosis(version("simart-kit"), machine(), libraries, told, recipes)


def _libraries() -> tuple[Finding, ...]:
    """A finding for each requirement of simart-kit itself, then for those of its extras.

    A library of several extras is told once, with the extra that brings least besides.
    """
    base: list[Finding] = []
    extras: dict[str, tuple[str, str]] = {}
    for line in requires("simart-kit") or ():
        requirement, _, marker = line.partition(";")
        found = re.match(r"\s*([\w.-]+)(?:\[.*\])?\s*(.*)", requirement)
        extra = re.search(r"extra\s*==\s*['\"]([\w-]+)['\"]", marker)
        if found is None or (extra and extra[1] in _NOT_TOLD):
            continue
        name, wanted = found[1].lower(), found[2].strip(" ()")
        if extra is None:
            base.append(library(name, wanted=wanted))
        elif name not in extras or len(EXTRAS[extra[1]]) < len(EXTRAS[extras[name][0]]):
            extras[name] = extra[1], wanted
    rows = extras.items()
    return (*base, *(library(name, wanted=w, extra=extra, stages=()) for name, (extra, w) in rows))


def _plugin_findings(plugins: Plugins) -> tuple[PluginFindings, ...]:
    """Of every plugin what its `diagnose` says; one that raises, or says something else, is broken itself."""
    objects = [plugin for _, plugin in plugins.manager.list_name_plugin()]
    owners = dict(zip(map(id, objects), (owner for owner, _ in plugins.hooks()), strict=True))
    answers: dict[int, tuple[Finding, ...]] = {}
    for implementation in plugins.manager.hook.diagnose.get_hookimpls():
        answers[id(implementation.plugin)] = _answer(implementation.function)
    loaded = [
        PluginFindings(owner, _registered(plugins, owner), answers.get(key, ()))
        for key, owner in owners.items()
    ]
    failed = [
        PluginFindings(
            f.owner, (), (Finding("loading", "broken", f"{f.phase}: {f.error}", _remedy(f.owner)),)
        )
        for f in plugins.failures
    ]
    return (*loaded, *failed)


def _answer(diagnose: Any) -> tuple[Finding, ...]:
    try:
        found = tuple(diagnose() or ())
        wrong = [value for value in found if not isinstance(value, Finding)]
        if wrong:
            raise TypeError(f"diagnose() returned {type(wrong[0]).__name__}, expected findings")
    except (Exception, SystemExit) as error:
        told = " ".join(f"{type(error).__name__}: {error}".split())
        return (Finding("diagnose()", "broken", told, "tell who wrote the plugin", stages=()),)
    return found


def _registered(plugins: Plugins, owner: Owner) -> tuple[tuple[str, str], ...]:
    return tuple((r.kind, r.name) for r in plugins.registrations() if r.owner == owner)


def _remedy(owner: Owner) -> str:
    if owner.distribution == "built in":
        return "pip install --force-reinstall simart-kit"
    return "repair or uninstall it; `simart-kit plugins list -v` shows the traceback"


def _recipe(
    name: str, plugins: Plugins, told: Iterable[PluginFindings], lacking: Iterable[Finding]
) -> Finding:
    """Whether a recipe resolves and nothing that its stages need is missing or broken."""
    try:
        recipe = load_recipe(name, plugins)
    except SimartKitError as error:
        return Finding(name, "broken", " ".join(str(error).split()), f"simart-kit recipes check {name}")
    wrong = [*lacking, *_needed(recipe, plugins, told), *_models(recipe)]
    if not wrong:
        return Finding(name, "ok", recipe.description)
    parts = dict.fromkeys(f"{found.subject} is {found.state} ({found.detail})" for found in wrong)
    remedies = dict.fromkeys(found.remedy for found in wrong if found.remedy)
    return Finding(name, wrong[0].state, "; ".join(parts), "; ".join(remedies))


def _needed(recipe: Recipe, plugins: Plugins, told: Iterable[PluginFindings]) -> list[Finding]:
    """What the plugins of a recipe's stages lack for these."""
    used = [plugins.find(kind, use.use) for kind, use in recipe.uses()]
    return [
        finding
        for plugin in told
        for finding in plugin.findings
        if not finding.ok and any(r.owner == plugin.owner and _depends(r.name, finding) for r in used)
    ]


def _depends(stage: str, finding: Finding) -> bool:
    return finding.stages is None or stage in finding.stages


def _models(recipe: Recipe) -> list[Finding]:
    """Weights that stages of a recipe name in an option `model` and that are not there."""
    uses = (recipe.segmenter, recipe.joints, *recipe.modify)
    names = [(use.use, use.options.get("model")) for use in uses]
    looked = [named_weights(f"model of {use}", name) for use, name in names if name and isinstance(name, str)]
    return [found for found in looked if not found.ok]
