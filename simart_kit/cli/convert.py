"""`simart-kit convert`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from .common import load_plugins, print_json, stdout_kept, warn
from .options import Json, PluginFiles, Sets, Verbose

RecipeName = Annotated[
    str, typer.Option("--recipe", "-r", metavar="NAME|FILE", help="Recipe; see `recipes list`.")
]
Out = Annotated[
    Path | None, typer.Option("--out", "-o", metavar="DIR", help="Output folder; default: out/NAME.")
]
Up = Annotated[
    Literal["+x", "-x", "+y", "-y", "+z", "-z"] | None,
    typer.Option(metavar="+x|-x|..|-z", help="Up axis, where the file says it wrong or not at all."),
]
Unit = Annotated[
    str | None, typer.Option(metavar="mm|cm|m|in|ft|NUMBER", help="The file's unit, or metres a unit.")
]


def convert(
    mesh: Annotated[Path, typer.Argument(metavar="MESH", help="Mesh file.")],
    recipe: RecipeName = "default",
    out: Out = None,
    name: Annotated[
        str | None, typer.Option(metavar="NAME", help="Name of the asset; default: the file's.")
    ] = None,
    sets: Sets = None,
    up: Up = None,
    unit: Unit = None,
    height: Annotated[float | None, typer.Option(metavar="M", help="Real height of the object [m].")] = None,
    scale: Annotated[float | None, typer.Option(metavar="F", help="Factor on the size.")] = None,
    floating: Annotated[
        bool, typer.Option("--floating", help="Leave the base free instead of fixed to the world.")
    ] = False,
    plugin: PluginFiles = None,
    no_record: Annotated[bool, typer.Option("--no-record", help="Write no rerun recording.")] = False,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but errors.")] = False,
) -> None:
    """Turn a mesh file into an articulated asset.

    It is written in every format of the recipe.
    """
    from ..pipeline import convert as run
    from .progress import progress
    from .summary import document, text

    if verbose and quiet:
        raise typer.BadParameter("--verbose and --quiet exclude each other")
    with stdout_kept(json):
        plugins = load_plugins(plugin)
        if not quiet:
            warn(f"plugin {failure}" for failure in plugins.failures)
        with progress(quiet) as observer:
            plugins.register(observer)
            result = run(
                mesh,
                recipe,
                out=out,
                name=name,
                sets=sets or (),
                up=up,
                unit=unit,
                height=height,
                scale=scale,
                floating=floating,
                record=not no_record,
                plugins=plugins,
            )
    if json:
        print_json(document(result))
    elif not quiet:
        print(text(result, verbose))
