"""`simart-kit tokens`."""

from __future__ import annotations

import sys
from contextlib import redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from simart_kit.cli.common import load_plugins, print_json, print_rows, stdout_kept, warn
from simart_kit.cli.options import Json, PluginFiles, Verbose

if TYPE_CHECKING:
    from ..tokens import VoxelTokens
    from .token_rows import Row
    from .tokenise import Tokenised

Form = Literal["text", "atoms", "ids"]
Parts = Annotated[
    Path | None,
    typer.Option(
        "--parts",
        metavar="NPZ|ASSET",
        help="Labels (an .npz with face_part), or a converted asset's folder; default: labels beside MESH.",
    ),
]
RecipeName = Annotated[
    str | None,
    typer.Option(
        "--recipe",
        "-r",
        metavar="NAME|FILE",
        help="Take parts from its segmenter; used where there are no labels.",
    ),
]
Model = Annotated[
    Path | None, typer.Option("--model", metavar="DIR", help="Folder of a model; default: the shipped one.")
]
Out = Annotated[
    Path | None, typer.Option("--out", "-o", metavar="FILE", help="Write object and parts as a tokens file.")
]
FormName = Annotated[
    Form,
    typer.Option(
        "--format",
        metavar="text|atoms|ids",
        help="`<voxel> 43 1930`, `<voxel><xyz_43><mesh_1930>`, or numbers of those names from 0.",
    ),
]


def tokens(
    mesh: Annotated[Path, typer.Argument(metavar="MESH", help="Mesh file.")],
    parts: Parts = None,
    recipe: RecipeName = None,
    model: Model = None,
    out: Out = None,
    form: FormName = "text",
    plugin: PluginFiles = None,
    json: Json = False,
    verbose: Verbose = False,
) -> None:
    """Turn a mesh and its parts into voxel tokens.

    Counts them, and says what decoding loses. The object's tokens go to stdout and the table to stderr; with
    --out the tokens go to that file and the table to stdout.
    """
    from ..tokens_file import write_tokens_file
    from .tokenise import tokenise

    if parts is not None and recipe is not None:
        raise typer.BadParameter("--parts and --recipe exclude each other")
    if out is not None and form == "ids":
        raise typer.BadParameter("--format ids: a tokens file holds text or atoms")
    with stdout_kept(True):
        made = tokenise(mesh, parts, recipe, model, load_plugins(plugin))
    if out is not None and form != "ids":
        write_tokens_file(made.file, out, form)
    warn(made.warnings)
    if json:
        print_json(_document(made, form, out))
        return
    with redirect_stdout(sys.stderr if out is None else sys.stdout):
        _print_table(made, verbose)
    print(_words(made.file.object, form) if out is None else f"tokens in {out}")


def _print_table(made: Tokenised, verbose: bool) -> None:
    from .token_rows import HEAD

    rows: list[Row] = [made.whole, *made.parts, made.mean]
    print_rows([HEAD, *(row.texts() for row in rows)])
    print(f"parts from {made.source}")
    if verbose:
        grid = made.file.object.grid
        size = "x".join(map(str, grid.shape))
        print(f"model {made.file.model}: {size} cells, {grid.codebook} codes, in {made.folder}")


def _document(made: Tokenised, form: Form, out: Path | None) -> dict[str, Any]:
    grid = made.file.object.grid
    parts = zip(made.parts, made.file.parts, strict=True)
    return {
        "ok": True,
        "model": made.file.model,
        "grid": "x".join(map(str, grid.shape)),
        "codebook": grid.codebook,
        "parts_from": made.source,
        "warnings": list(made.warnings),
        "object": made.whole.table() | {"tokens": _value(made.file.object, form)},
        "parts": [
            row.table() | {"label": part.label, "tokens": _value(part.tokens, form)} for row, part in parts
        ],
        "mean_of_parts": made.mean.table(),
        "file": None if out is None else str(out),
    }


def _words(tokens: VoxelTokens, form: Form) -> str:
    value = _value(tokens, form)
    return value if isinstance(value, str) else " ".join(map(str, value))


def _value(tokens: VoxelTokens, form: Form) -> str | list[int]:
    from ..vocabulary import Vocabulary

    if form == "ids":
        return [int(value) for value in Vocabulary(tokens.grid, 0).encode(tokens)]
    return tokens.text() if form == "text" else tokens.atoms()
