"""`simart-kit check`."""

from __future__ import annotations

import typer

from .common import print_json, stdout_kept
from .options import Folder, Json, Verbose


def check(folder: Folder, json: Json = False, verbose: Verbose = False) -> None:
    """Check that an asset is ready for simulation.

    The exit code is 1 if a check fails.
    """
    from ..asset_io import load_asset
    from ..checks import run_checks
    from .summary import verdict

    with stdout_kept(json):
        results = run_checks(load_asset(folder))
    passed = all(result.passed for result in results)
    if json:
        print_json({"ok": passed, "checks": [result.table() for result in results]})
    else:
        print("\n".join(verdict(result) for result in results))
    if not passed:
        raise typer.Exit(1)
