"""`simart-kit convert`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from .common import load_plugins, print_json, stdout_kept, uncollected, warn
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
TransferMode = Annotated[
    Literal["seeds", "segments"] | None,
    typer.Option(
        "--transfer",
        metavar="seeds|segments",
        help="For segmenters that decode voxels, such as tokens: label each face by itself, or also each "
        "segment whose faces agree. Short for --set segmenter.options.transfer=...",
    ),
]
Photo = Annotated[
    Path | None,
    typer.Option(
        "--image",
        metavar="PHOTO",
        help="For segmenters that look at a picture, such as simart: a photo of the object instead of a "
        "rendered one. Short for --set segmenter.options.image=...",
    ),
]
Words = Annotated[
    str | None,
    typer.Option(
        "--text",
        metavar="TEXT",
        help="For segmenters that read text, such as simart: what the object is, such as 'a fridge'. Short "
        "for --set segmenter.options.text=...",
    ),
]
SpecFile = Annotated[
    Path | None,
    typer.Option(
        "--spec",
        metavar="FILE",
        help="What moves, as you state it: a TOML or JSON file such as `simart-kit spec` writes.",
    ),
]
Name = Annotated[str | None, typer.Option(metavar="NAME", help="Name of the asset; default: the file's.")]
Floating = Annotated[
    bool, typer.Option("--floating", help="Leave the base free instead of fixed to the world.")
]
Strict = Annotated[
    bool, typer.Option("--strict", help="Exit with 1 if a check fails; files are written all the same.")
]


def convert(
    mesh: Annotated[Path, typer.Argument(metavar="MESH", help="Mesh file.")],
    recipe: RecipeName = "default",
    out: Out = None,
    name: Name = None,
    sets: Sets = None,
    transfer: TransferMode = None,
    image: Photo = None,
    words: Words = None,
    spec: SpecFile = None,
    up: Up = None,
    unit: Unit = None,
    height: Annotated[float | None, typer.Option(metavar="M", help="Real height of the object [m].")] = None,
    scale: Annotated[float | None, typer.Option(metavar="F", help="Factor on the size.")] = None,
    floating: Floating = False,
    plugin: PluginFiles = None,
    strict: Strict = False,
    no_record: Annotated[bool, typer.Option("--no-record", help="Write no rerun recording.")] = False,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but errors.")] = False,
) -> None:
    """Turn a mesh file into an articulated asset, written in every format of the recipe."""
    from ..pipeline import convert as run
    from .progress import progress
    from .shorthands import shorthand_sets
    from .summary import document, text

    if verbose and quiet:
        raise typer.BadParameter("--verbose and --quiet exclude each other")
    with stdout_kept(json), uncollected():
        plugins = load_plugins(plugin)
        if not quiet:
            warn(f"plugin {failure}" for failure in plugins.failures)
        with progress(quiet) as observer:
            plugins.register(observer)
            short = {"transfer": transfer, "image": image, "text": words}
            result = run(
                mesh,
                recipe,
                out=out,
                name=name,
                sets=[*(sets or ()), *shorthand_sets(short, recipe, sets or (), plugins)],
                up=up,
                unit=unit,
                height=height,
                scale=scale,
                floating=floating,
                spec=spec,
                record=not no_record,
                plugins=plugins,
            )
    if json:
        print_json(document(result))
    elif not quiet:
        print(text(result, verbose))
    if strict and not result.report.passed:
        raise typer.Exit(1)
