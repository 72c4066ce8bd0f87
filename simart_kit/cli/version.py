"""`simart-kit version` and `simart-kit --version`."""

from __future__ import annotations

import typer


def version() -> None:
    """Show the version."""
    from importlib.metadata import version as installed

    print(f"simart-kit {installed('simart-kit')}")


def print_version(wanted: bool) -> None:
    """Callback of `--version`: show it and stop."""
    if wanted:
        version()
        raise typer.Exit
