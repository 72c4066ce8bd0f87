"""Progress of a run on stderr, by an observer like any other."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from ..hookspecs import hookimpl

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

    from ..recipe import Recipe
    from ..runner import Run


class Lines:
    """A plain line a finished stage."""

    @hookimpl
    def stage_finished(self, stage: str, name: str, seconds: float) -> None:
        """Print it with its time."""
        print(_line(stage, name, seconds), file=sys.stderr, flush=True)


class Bar:
    """Finished stages as lines above the one that runs.

    Args:
        shown: the display, already running.
    """

    def __init__(self, shown: Progress) -> None:
        self._shown = shown
        self._task: TaskID | None = None
        self._steps: list[str] = []

    @hookimpl
    def run_started(self, run: Run) -> None:
        """Show the first stage of as many as the recipe has."""
        self._steps = steps(run.recipe)
        self._task = self._shown.add_task(self._steps[0], total=len(self._steps))

    @hookimpl
    def stage_finished(self, stage: str, name: str, seconds: float) -> None:
        """Print its line and show the next stage."""
        self._shown.console.print(_line(stage, name, seconds), highlight=False, markup=False)
        if self._task is None:
            return
        done = int(self._shown.tasks[self._task].completed) + 1
        following = self._steps[done] if done < len(self._steps) else "finish"
        self._shown.update(self._task, completed=done, description=following)


class Silence:
    """Observes nothing."""


@contextmanager
def progress(quiet: bool = False) -> Iterator[object]:
    """An observer to register for one run; a moving display on a terminal, plain lines elsewhere."""
    if quiet:
        yield Silence()
        return
    if not sys.stderr.isatty():
        yield Lines()
        return
    from rich.console import Console
    from rich.progress import MofNCompleteColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), MofNCompleteColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as shown:
        yield Bar(shown)


def steps(recipe: Recipe) -> list[str]:
    """The stages of a run in order, as its observers will hear of them."""
    return [
        "load",
        f"segment {recipe.segmenter.use}",
        f"joints {recipe.joints.use}",
        *(f"modify {use.use}" for use in recipe.modify),
        "check",
        "preview",
        *(f"export {use.use}" for use in recipe.export),
    ]


def _line(stage: str, name: str, seconds: float) -> str:
    label = stage if stage in ("check", "preview") else f"{stage} {name}"
    return f"{label:<24} {seconds:7.2f} s"
