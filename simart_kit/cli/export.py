"""`simart-kit export`."""

from __future__ import annotations

from typing import Annotated

import typer

from .common import load_plugins, warn
from .options import Folder, PluginFiles, Verbose


def export(
    folder: Folder,
    to: Annotated[str, typer.Option("--to", metavar="FORMAT", help="Exporter; see `plugins list`.")],
    plugin: PluginFiles = None,
    verbose: Verbose = False,
) -> None:
    """Write one more format of an asset.

    It comes from the folder's asset.json, which may have been edited; nothing runs again.
    """
    from ..exports import export_folder

    exported = export_folder(folder, to, load_plugins(plugin))
    warn((*(f"{to}: {text}" for text in exported.unsupported), *exported.kept))
    print(exported.main)
