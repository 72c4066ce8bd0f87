"""`simart-kit bench run`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..common import load_plugins, stdout_kept
from ..options import Json, PluginFiles, Sets, Verbose
from .options import (
    OUT,
    Data,
    Jobs,
    NoPictures,
    Only,
    Out,
    ProtocolName,
    Quiet,
    Retry,
    Timeout,
    Variant,
)

RecipeName = Annotated[
    str, typer.Option("--recipe", "-r", metavar="NAME|FILE", help="Recipe; see `recipes list`.")
]


def run(
    data: Data,
    recipe: RecipeName = "default",
    variant: Variant = "input",
    protocol: ProtocolName = "simart",
    out: Out = OUT,
    sets: Sets = None,
    plugin: PluginFiles = None,
    only: Only = None,
    jobs: Jobs = None,
    timeout: Timeout = 600.0,
    no_pictures: NoPictures = False,
    retry: Retry = False,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Convert objects with a recipe and score what comes out.

    Every object has a process of its own: one that crashes or hangs is a row that says so. A run that was
    stopped goes on where it was when the same command is given again. Exports are MJCF alone, for the
    simulator. The exit code is 1 if no object could be scored.
    """
    with stdout_kept(json):
        from ...bench.run import Plan
        from ...bench.worker import Conversions
        from ...machine import usable_cores
        from ...recipe import check_extras, load_recipe
        from .perform import perform, tell

        plugins = load_plugins(plugin)
        resolved = load_recipe(recipe, plugins, [*(sets or ()), 'export=[{use="mjcf"}]'])
        check_extras(resolved.uses(), plugins)
        files = tuple(file.resolve() for file in plugin or ())
        plan = Plan(
            data=data,
            out=out,
            system=Conversions(f"recipe {Path(recipe).stem}", resolved, files),
            protocol=protocol,
            variant=variant,
            only=tuple(only or ()),
            jobs=jobs or usable_cores(),
            timeout=timeout,
            pictures=not no_pictures,
            retry=retry,
        )
        outcome = perform(plan, quiet)
    tell(plan, outcome, json, quiet, verbose)
