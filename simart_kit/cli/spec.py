"""`simart-kit spec`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .common import load_plugins, print_json, print_rows, stdout_kept, warn
from .convert import RecipeName, Unit, Up
from .options import Json, PluginFiles, Sets, Verbose

Out = Annotated[
    Path | None,
    typer.Option("--out", "-o", metavar="FILE", help="A .toml or .json file; default: MESH.spec.toml, here."),
]
Force = Annotated[bool, typer.Option("--force", "-f", help="Write over a file that is there.")]


def spec(
    mesh: Annotated[Path, typer.Argument(metavar="MESH", help="Mesh file.")],
    recipe: RecipeName = "default",
    out: Out = None,
    sets: Sets = None,
    up: Up = None,
    unit: Unit = None,
    force: Force = False,
    plugin: PluginFiles = None,
    json: Json = False,
    verbose: Verbose = False,
) -> None:
    """Write what a recipe finds in a mesh as a kinematic spec, to edit.

    A picture beside it shows parts and pieces with their numbers. `convert --spec` keeps to the file.
    """
    from ..spec.drafting import draft
    from ..spec.files import spec_path, write_draft

    with stdout_kept(json):
        path = spec_path(mesh, out, force)
        plugins = load_plugins(plugin)
        warn(f"plugin {failure}" for failure in plugins.failures)
        found = draft(mesh, recipe, sets=sets or (), up=up, unit=unit, plugins=plugins)
        picture = write_draft(found, path, mesh, recipe)
    if json:
        print_json({"ok": True, "spec": found.spec.table(), "file": str(path), "picture": str(picture)})
        return
    rows = [
        (str(number), part.name, part.joint or "root", part.axis or "", _pieces(part.pieces))
        for number, part in enumerate(found.spec.parts)
    ]
    print_rows([("part", "name", "joint", "axis", "pieces"), *rows])
    print(f"spec    {path}\npicture {picture}")


def _pieces(numbers: tuple[int, ...] | None) -> str:
    return " ".join(map(str, numbers or ()))
