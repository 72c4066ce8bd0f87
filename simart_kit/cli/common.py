"""What several commands do: load plugins, print tables and JSON, keep stdout clean."""

from __future__ import annotations

import gc
import json
import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from ..errors import PluginError

if TYPE_CHECKING:
    from ..plugins import Plugins


def help_when_alone(context: typer.Context) -> None:
    """Callback of a group of commands: without one of them, show which there are."""
    if context.invoked_subcommand is None:
        typer.echo(context.get_help(), err=True)
        raise typer.Exit(2)


def load_plugins(files: Sequence[Path] | None) -> Plugins:
    """All plugins; one that was asked for with `--plugin` and does not load is an error."""
    from ..plugins import Plugins

    with uncollected():
        plugins = Plugins(files=files or ())
    asked = {str(file) for file in files or ()}
    for failure in plugins.failures:
        if failure.owner.distribution in asked:
            raise PluginError(f"plugin {failure}")
    return plugins


def warn(texts: Iterable[str]) -> None:
    """A line on stderr for each."""
    for text in texts:
        print(f"warning: {text}", file=sys.stderr)


def print_json(document: Any) -> None:
    """The one document of a `--json` run."""
    print(json.dumps(document, indent=1, ensure_ascii=False))


def print_rows(rows: Sequence[Sequence[str]], indent: str = "") -> None:
    """Columns padded to their widest cell."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = [cell.ljust(width) for cell, width in zip(row, widths, strict=True)]
        print(indent + "  ".join(cells).rstrip())


@contextmanager
def stdout_kept(wanted: bool) -> Iterator[None]:
    """In the block, whatever writes to stdout, native libraries too, reaches stderr instead."""
    if not wanted:
        yield
        return
    sys.stdout.flush()
    stdout = os.dup(1)
    os.dup2(2, 1)
    try:
        with redirect_stdout(sys.stderr):
            yield
    finally:
        os.dup2(stdout, 1)
        os.close(stdout)


@contextmanager
def uncollected() -> Iterator[None]:
    """Leave out garbage collection where little is thrown away and many small objects would be searched."""
    found = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if found:
            gc.enable()
