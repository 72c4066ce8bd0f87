"""Progress of a benchmark run on stderr."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from ...bench.run import Watcher

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

    from ...bench.rows import Row


class Lines(Watcher):
    """A plain line an object."""

    def __init__(self) -> None:
        self._objects = self._done = 0

    def started(self, objects: int, done: int, changed: tuple[str, ...]) -> None:
        """Tell how much was done before."""
        self._objects, self._done = objects, done
        print(_begun(objects, done, changed), file=sys.stderr, flush=True)

    def finished(self, row: Row) -> None:
        """Print its line."""
        self._done += 1
        done = str(self._done).rjust(len(str(self._objects)))
        print(f"[{done}/{self._objects}] {_line(row)}", file=sys.stderr, flush=True)


class Bar(Watcher):
    """A bar with the time left; objects that failed as lines above it.

    Args:
        shown: the display, already running.
    """

    def __init__(self, shown: Progress) -> None:
        self._shown = shown
        self._task: TaskID | None = None
        self._seconds: list[float] = []

    def started(self, objects: int, done: int, changed: tuple[str, ...]) -> None:
        """Show the bar, as far as it was done before."""
        self._shown.console.print(_begun(objects, done, changed), highlight=False, markup=False)
        self._task = self._shown.add_task("", total=objects, completed=done)

    def finished(self, row: Row) -> None:
        """Go on by one, with the mean time of those that were done now."""
        if row.status == "failed":
            self._shown.console.print(_line(row), highlight=False, markup=False)
        if self._task is not None:
            self._seconds.append(row.seconds)
            mean = sum(self._seconds) / len(self._seconds)
            self._shown.update(self._task, advance=1, description=f"{mean:.1f} s an object")


@contextmanager
def progress(quiet: bool = False) -> Iterator[Watcher]:
    """A watcher for one run; a moving bar on a terminal, plain lines elsewhere."""
    if quiet:
        yield Watcher()
        return
    if not sys.stderr.isatty():
        yield Lines()
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.description}"),
        TextColumn("ETA"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as shown:
        yield Bar(shown)


def _begun(objects: int, done: int, changed: tuple[str, ...]) -> str:
    from ...bench.numbers import counted, listed

    before = f", {done} done before" if done else ""
    again = f", {len(changed)} changed since and done again: {listed(changed)}" if changed else ""
    return f"{counted(objects, 'object')}{before}{again}"


def _line(row: Row) -> str:
    how = f"{row.seconds:7.2f} s" if row.status == "scored" else f"failed: {row.error}"
    return f"{row.name:<28} {how}"
