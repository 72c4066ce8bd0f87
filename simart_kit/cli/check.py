"""`simart-kit check`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .common import load_plugins, print_json, stdout_kept
from .options import Json, PluginFiles, Sets, Verbose

if TYPE_CHECKING:
    from ..checks.subject import Subject
    from ..plugins import Plugins
    from ..recipe import Recipe

Checked = Annotated[
    Path,
    typer.Argument(
        metavar="PATH", help="Output folder of a conversion, or a URDF, MJCF or USD file, of anybody."
    ),
]
RecipeName = Annotated[
    str | None,
    typer.Option(
        "--recipe",
        "-r",
        metavar="NAME|FILE",
        help="Whose thresholds; default: those that the folder was made with.",
    ),
]


def check(
    path: Checked,
    recipe: RecipeName = None,
    sets: Sets = None,
    plugin: PluginFiles = None,
    json: Json = False,
    verbose: Verbose = False,
) -> None:
    """Check that an asset or a file is ready for simulation.

    Every check says one line; -v adds the numbers behind it. The exit code is 1 if a check fails.
    """
    from ..checks import run_checks
    from ..checks.subject import subject_of
    from ..recipe import build_checks
    from .summary import evidence, verdict

    with stdout_kept(json):
        plugins = load_plugins(plugin)
        subject = subject_of(path)
        thresholds = _recipe(path, recipe, sets or (), plugins)
        results = run_checks(build_checks(thresholds, plugins), subject)
    passed = all(result.passed for result in results)
    if json:
        print_json({"ok": passed, "files": _files(subject), "checks": [result.table() for result in results]})
    else:
        for result in results:
            print(verdict(result))
            if verbose:
                print(evidence(result))
    if not passed:
        raise typer.Exit(1)


def _recipe(path: Path, recipe: str | None, sets: list[str] | tuple[str, ...], plugins: Plugins) -> Recipe:
    """The recipe asked for, or that of the folder, or the default."""
    from ..output import PROVENANCE
    from ..recipe import load_recipe

    own = path / PROVENANCE
    return load_recipe(recipe or (own if own.is_file() else "default"), plugins, sets)


def _files(subject: Subject) -> dict[str, str]:
    return {kind: str(path) for kind, path in subject.files.items()}
