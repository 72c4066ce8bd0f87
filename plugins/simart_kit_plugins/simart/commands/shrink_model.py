"""`simart-kit model shrink`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from simart_kit.cli.common import print_json, stdout_kept
from simart_kit.cli.options import Json, Verbose

from .model_folder import check_folder, put_model

Model = Annotated[Path, typer.Argument(metavar="MODEL", help="Folder of a model.")]
Out = Annotated[
    Path, typer.Argument(metavar="OUT", help="Folder to write; a model that it holds is replaced.")
]


def shrink_model(model: Model, out: Out, json: Json = False, verbose: Verbose = False) -> None:
    """Write a model in a small form, for shipping.

    Weights are in half precision, codebooks in 8 bits; training state is left out. It is read as any model.
    """
    with stdout_kept(json):
        check_folder(out)
        from ..vqvae.checkpoint import WEIGHTS_FILE, load_checkpoint

        put_model(load_checkpoint(model), out, compact=True)
        size = (out / WEIGHTS_FILE).stat().st_size
    if json:
        print_json({"ok": True, "model": str(out), "bytes": size})
        return
    print(f"{out}: {size / 1e6:.1f} MB")
