"""`simart-kit generate`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from simart_kit.cli.common import print_json, stdout_kept
from simart_kit.cli.options import Json, Verbose

if TYPE_CHECKING:
    from ..generate.category import Category

What = Annotated[str, typer.Argument(metavar="CATEGORY|all", help="Such as cabinet; a wrong name lists all.")]
Out = Annotated[Path, typer.Argument(metavar="OUT", help="Folder to write, one folder an object.")]
Count = Annotated[int, typer.Option("--count", "-n", min=1, metavar="N", help="Objects of each category.")]
Seed = Annotated[int, typer.Option(min=0, metavar="N", help="Decides all that is random.")]
Open = Annotated[
    float, typer.Option("--open", min=0, max=1, metavar="X", help="Share of the joints that stand open.")
]
Skins = Annotated[
    bool, typer.Option("--skins", help="Write a closed skin of each, too: fused.glb and fused.npz.")
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but the result.")]
_EVERY = 50


def generate(
    what: What,
    out: Out,
    count: Count = 1,
    seed: Seed = 0,
    open_share: Open = 1 / 3,
    skins: Skins = False,
    json: Json = False,
    verbose: Verbose = False,
    quiet: Quiet = False,
) -> None:
    """Write made-up articulated objects: textured GLBs with their parts and joints.

    Each is a SIMART-Bench folder (input.glb, gt.npz, gt.json), to train and to measure on; free of rights
    (CC0). The same seed gives the same objects.
    """
    with stdout_kept(json):
        from ..generate.data_set import write_objects

        def progress(done: int, of: int) -> None:
            if not quiet and done % _EVERY == 0:
                print(f"objects made: {done} of {of}", file=sys.stderr, flush=True)

        folders = write_objects(_chosen(what), count, seed, out, open_share, progress, skins)
    if json:
        print_json({"ok": True, "objects": [str(folder) for folder in folders]})
        return
    print(f"{out}: {len(folders)} objects")


def _chosen(what: str) -> tuple[Category, ...]:
    from ..generate.catalogue import CATEGORIES
    from ..generate.category import named

    return CATEGORIES if what == "all" else (named(what, CATEGORIES),)
