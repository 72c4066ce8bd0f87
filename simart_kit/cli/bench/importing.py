"""`simart-kit bench import`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from ..options import Verbose


def import_objects(
    source: Annotated[Path, typer.Argument(metavar="SRC", help="Objects with ground truth, in any format.")],
    out: Annotated[Path, typer.Argument(metavar="OUT", help="Folder to write; a folder an object.")],
    verbose: Verbose = False,
) -> None:
    """Write objects as single meshes with ground truth.

    Reads PartNet-Mobility, PhysXNet, Particulate, URDF and MJCF; writes the SIMART-Bench format. The exit
    code is 1 if no object could be written.
    """
    from ...bench.importing import import_cases
    from ...bench.numbers import counted

    imported = import_cases(source, out, _tell)
    print(f"{counted(len(imported.written), 'object')} written to {out}, {len(imported.skipped)} skipped")
    if not imported.written:
        raise typer.Exit(1)


def _tell(name: str, text: str) -> None:
    print(f"{name}: {text}", file=sys.stderr)
