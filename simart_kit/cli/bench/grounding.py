"""`simart-kit bench grounding`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..common import load_plugins, print_json, print_rows, stdout_kept, warn
from ..options import Json, PluginFiles, Sets, Verbose
from .options import Data, Only, Quiet
from .run import RecipeName

if TYPE_CHECKING:
    from ...bench.grounding_run import ObjectScores

Baseline = Annotated[
    str, typer.Option(metavar="NAME|FILE", help="Recipe whose parts the simple rivals choose from.")
]


def grounding(
    data: Data,
    recipe: RecipeName = "default",
    baseline: Baseline = "nano",
    sets: Sets = None,
    plugin: PluginFiles = None,
    only: Only = None,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Score how well a recipe finds the parts that descriptions mean.

    Every part with a name of its own is asked for as "the NAME". Beside stand two rivals: the part whose name
    has the most letters in common, and the largest part. The exit code is 1 if nothing could be scored.
    """
    with stdout_kept(json):
        from ...bench.grounding_run import grounding_scores
        from ...recipe import load_recipe

        plugins = load_plugins(plugin)
        recipes = load_recipe(recipe, plugins, sets or ()), load_recipe(baseline, plugins)
        objects = []
        for found in grounding_scores(data, *recipes, plugins, only or ()):
            objects.append(found)
            told = [found.failed] if found.failed else [part.failed for part in found.parts if part.failed]
            warn(f"{found.name}: {text}" for text in dict.fromkeys(told))
            if not (found.failed or quiet):
                print(f"{found.name}: {len(found.parts)} parts", file=sys.stderr)
    if json:
        print_json(_document(objects))
    elif not quiet:
        _print(objects, verbose)
    if all(part.failed for found in objects for part in found.parts):
        raise typer.Exit(1)


def _print(objects: list[ObjectScores], verbose: bool) -> None:
    from ...bench.grounding_run import means

    if verbose:
        rows = [
            (part.object, part.description, *(f"{score.iou:.3f}" for score in part.scores))
            for found in objects
            for part in found.parts
        ]
        print_rows([("object", "description", "recipe", "nearest", "largest"), *rows])
    failed = sum(bool(found.failed) for found in objects)
    print(f"{sum(len(found.parts) for found in objects)} parts of {len(objects)} objects, {failed} failed")
    mean = [(name, f"{score.iou:.3f}", f"{score.cd:.3f}") for name, score in means(objects).items()]
    print_rows([("", "IoU (higher)", "CD (lower)"), *mean], "  ")


def _document(objects: list[ObjectScores]) -> dict[str, Any]:
    from ...bench.grounding_run import SYSTEMS, means

    parts = [
        {
            "object": part.object,
            "part": part.part,
            "description": part.description,
            "failed": part.failed,
            **{name: vars(score) for name, score in zip(SYSTEMS, part.scores, strict=True)},
        }
        for found in objects
        for part in found.parts
    ]
    mean = {name: vars(score) for name, score in means(objects).items()}
    failures = {found.name: found.failed for found in objects if found.failed}
    return {"ok": bool(parts), "mean": mean, "parts": parts, "failures": failures}
