"""`simart-kit ground`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .common import load_plugins, print_json, print_rows, stdout_kept, warn
from .convert import RecipeName, Unit, Up
from .options import Json, PluginFiles, Sets, Verbose

if TYPE_CHECKING:
    from ..grounding import Grounding

Described = Annotated[
    str, typer.Argument(metavar="DESCRIPTION", help='The part, such as "the lid" or "upper left door".')
]
Out = Annotated[
    Path | None, typer.Option("--out", "-o", metavar="DIR", help="Output folder; default: out/MESH_PART.")
]
_DOUBTFUL = 0.5
_LONGEST = 80  # characters of the default folder
Top = Annotated[int, typer.Option(min=1, metavar="N", help="How many parts to list, the best first.")]


def ground(
    mesh: Annotated[Path, typer.Argument(metavar="MESH", help="Mesh file.")],
    description: Described,
    recipe: RecipeName = "default",
    out: Out = None,
    sets: Sets = None,
    top: Top = 5,
    up: Up = None,
    unit: Unit = None,
    plugin: PluginFiles = None,
    json: Json = False,
    verbose: Verbose = False,
) -> None:
    """Find the part of a mesh that a description means.

    The recipe's segmenter is asked, if it can tell; else the names of the parts that it finds are compared
    with the description. Writes the part as GLB, a picture, its faces and the scores.
    """
    from ..asset import clean_name
    from ..grounding import ground as run
    from ..grounding_files import table

    with stdout_kept(json):
        plugins = load_plugins(plugin)
        warn(f"plugin {failure}" for failure in plugins.failures)
        folder = out or Path("out") / clean_name(f"{mesh.stem}_{description}", "part")[:_LONGEST]
        found = run(mesh, description, recipe, out=folder, sets=sets or (), up=up, unit=unit, plugins=plugins)
    if json:
        paths = {key: str(path) for key, path in found.paths.items()}
        print_json({"ok": True, **table(found), "folder": str(found.folder), "paths": paths})
        return
    warn(f"{note.stage}: {note.text}" for note in found.notes if note.level == "warning")
    if found.grounded.score < _DOUBTFUL:
        warn([f"score {found.grounded.score:.2f}: see {found.paths['picture']} whether this is meant"])
    _tell(found, top, verbose)


def _tell(found: Grounding, top: int, verbose: bool) -> None:
    """The choice, the best parts, and where the files are."""
    grounded = found.grounded
    print(f"{found.description}: score {grounded.score:.2f}, {grounded.reason}")
    share = f"{100 * found.area_share:.1f} % of the surface"
    print(f"  {int(grounded.faces.sum())} of {len(found.mesh.faces)} faces, {share}")
    ranked = sorted(grounded.candidates, key=lambda c: (not c.chosen, -c.score))[:top]
    if ranked:
        print_rows([("*" if c.chosen else " ", c.name, f"{c.score:.2f}", c.reason) for c in ranked], "  ")
    if verbose:
        print_rows([(note.stage, note.text) for note in found.notes] or [("", "")], "  ")
    print_rows([(key, str(path)) for key, path in found.paths.items()], "  ")
