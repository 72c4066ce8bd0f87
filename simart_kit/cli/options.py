"""Options that several commands share."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from ..plugins import Owner, Plugins


@dataclass
class Flags:
    """What is found out while a command line is parsed, above all how errors are told.

    Attributes:
        verbose: with a traceback.
        json: also as a JSON document.
        plugins: those that may have commands, once the command line has looked for some.
        owner: the plugin whose command runs; None for the core's own.
    """

    verbose: bool = False
    json: bool = False
    plugins: Plugins | None = None
    owner: Owner | None = None


def _note_verbose(context: typer.Context, value: bool) -> bool:
    context.obj.verbose = value
    return value


def _note_json(context: typer.Context, value: bool) -> bool:
    context.obj.json = value
    return value


Folder = Annotated[Path, typer.Argument(metavar="FOLDER", help="Output folder of a conversion.")]
Json = Annotated[
    bool,
    typer.Option(
        "--json",
        callback=_note_json,
        is_eager=True,
        help="Print one JSON document on stdout, everything else on stderr.",
    ),
]
PluginFiles = Annotated[
    list[Path] | None,
    typer.Option("--plugin", metavar="FILE", help="Load a Python file as a plugin; may be repeated."),
]
Sets = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Change the recipe, such as segmenter.options.max_parts=8; may be repeated.",
    ),
]
Verbose = Annotated[
    bool,
    typer.Option(
        "--verbose",
        "-v",
        callback=_note_verbose,
        is_eager=True,
        help="Say more, and show the traceback of an error.",
    ),
]
