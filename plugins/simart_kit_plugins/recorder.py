"""Observer that writes a run as a rerun recording: what went in, what each stage made of it, how it moves."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

from simart_kit.findings import Finding, library
from simart_kit.hookspecs import hookimpl

from .recording.history import Event, Failure, History

if TYPE_CHECKING:
    from simart_kit.report import Report
    from simart_kit.runner import Run


class Recorder:
    """Remembers what stages return, and writes `NAME.rrd` into the run's folder when the run ends or fails.

    The stages' values are frozen, so keeping them is free; writing once, at the end, lets the layout of the
    recording depend on all that was found. Nothing happens, and rerun is not imported, without `run.record`.
    """

    def __init__(self) -> None:
        # Weak, so that a run that is interrupted leaves nothing behind.
        self._histories: WeakKeyDictionary[Run, History] = WeakKeyDictionary()

    @hookimpl
    def run_started(self, run: Run) -> None:
        """Begin an empty history."""
        if run.record:
            self._histories[run] = History(run.name, run.recipe)

    @hookimpl
    def stage_finished(self, run: Run, stage: str, name: str, value: object, seconds: float) -> None:
        """Remember a stage's value."""
        if run in self._histories:
            history = self._histories[run]
            event = Event(stage, name, value, seconds)
            self._histories[run] = replace(history, events=(*history.events, event))

    @hookimpl
    def run_failed(self, run: Run, stage: str, error: BaseException) -> None:
        """Write everything up to the failure, and the failure."""
        if run in self._histories:
            self._write(run, replace(self._histories.pop(run), failure=Failure(stage, error)))

    @hookimpl
    def run_finished(self, run: Run, report: Report) -> None:
        """Write the whole run."""
        if run in self._histories:
            self._write(run, replace(self._histories.pop(run), report=report))

    @hookimpl
    def diagnose(self) -> list[Finding]:
        """The recordings' own library; without it a run goes on."""
        return [library("rerun-sdk", stages=())]

    def _write(self, run: Run, history: History) -> None:
        from .recording.write import write_recording

        write_recording(history, run.folder / f"{run.name}.rrd", run.folder / "preview.png")
