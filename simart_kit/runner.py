"""Runs stages: times them, names the one that fails, and tells the observers."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, ParamSpec, TypeVar

from .assemble import Articulation
from .asset_io import save_value
from .errors import SimartKitError, StageError
from .mesh import Note
from .plugins import Plugins, Registration
from .stages import Segmentation
from .timeout import time_limit

if TYPE_CHECKING:
    from .recipe import Recipe
    from .usage import ModelUsage

P = ParamSpec("P")
T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Run:
    """What observers are told about a run.

    Attributes:
        name: the asset's.
        source: the file that is converted.
        recipe: resolved.
        folder: where files of this run are being written; moved to the output folder at the end.
        record: whether the user wants a recording.
    """

    name: str
    source: Path
    recipe: Recipe
    folder: Path
    record: bool = True


class Runner:
    """Calls one stage after the other.

    Attributes:
        run: what it works on.
        seconds: (stage, name, wall time) of each finished stage.
        used: registrations of the stages that ran.
        usage: (stage, name, what it took of a model) of each stage that asked one.
        notes: observers that failed; they never stop a run.
    """

    def __init__(self, run: Run, plugins: Plugins) -> None:
        self.run = run
        self.seconds: tuple[tuple[str, str, float], ...] = ()
        self.used: tuple[Registration, ...] = ()
        self.usage: tuple[tuple[str, str, ModelUsage], ...] = ()
        self.notes: tuple[Note, ...] = ()
        self._plugins = plugins
        self._begun: Callable[[], object] | None = None
        self._told = False

    def call(self, stage: str, name: str, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
        """Run a step of the core's own; its errors pass through, once observers are told of them."""
        start = time.perf_counter()
        try:
            value = function(*args, **kwargs)
        except SimartKitError as error:
            self.failed(stage, error)
            raise
        self._finished(stage, name, value, time.perf_counter() - start)
        return value

    def begin(self, stage: str, name: str, result: Callable[[], object]) -> None:
        """Let a step of the core's own go on beside the next ones, until `settle` or until one of them fails.

        Args:
            stage: which.
            name: of the step.
            result: waits for it; its errors pass through.
        """
        self._begun = partial(self.call, stage, name, result)

    def settle(self) -> None:
        """Wait for what was begun, so that observers see it finished."""
        begun, self._begun = self._begun, None
        if begun is not None:
            begun()

    def stage(
        self,
        stage: str,
        registration: Registration,
        function: Callable[P, T],
        *args: P.args,
        **kwargs: P.kwargs,
    ) -> T:
        """Run a plugin's step; see `attempt`."""
        start = time.perf_counter()
        value = self.attempt(stage, registration, function, *args, **kwargs)
        self.used += (registration,)
        self._finished(stage, registration.name, value, time.perf_counter() - start)
        return value

    def attempt(
        self,
        stage: str,
        registration: Registration,
        function: Callable[P, T],
        *args: P.args,
        **kwargs: P.kwargs,
    ) -> T:
        """Call what a plugin wrote; whatever it raises becomes a StageError that names it.

        The first argument is saved when it fails, as `failed/input`.
        """
        try:
            with time_limit(self.run.recipe.stage_timeout):
                return function(*args, **kwargs)
        except (Exception, SystemExit) as cause:
            error = registration.failure(cause)
            self.failed(stage, error)
            self._save(args[0], error)
            raise error from cause

    def failed(self, stage: str, error: SimartKitError) -> None:
        """Tell observers, once, when what was begun has come to its end; that must not hide the failure."""
        if self._told:
            return
        self._told = True
        try:
            self.settle()
        except Exception as another:
            error.add_note(f"what went on beside it failed too: {another}")
        self.tell("run_failed", stage=stage, error=error)

    def tell(self, hook: str, **arguments: object) -> None:
        """Call an observer hook; an observer that fails is noted and the others still hear."""
        for owner, error in self._plugins.notify(hook, {"run": self.run, **arguments}):
            text = f"{owner} failed in {hook}: {type(error).__name__}: {error}"
            self.notes += (Note("observer", "warning", text),)

    def _save(self, value: object, error: StageError) -> None:
        """Keep a failed stage's input; a value too damaged to be written must not hide the error."""
        try:
            save_value(value, self.run.folder / "failed" / "input")
        except Exception as unsaved:
            error.add_note(f"its input could not be saved: {unsaved}")

    def _finished(self, stage: str, name: str, value: object, seconds: float) -> None:
        self.seconds += ((stage, name, seconds),)
        if isinstance(value, Segmentation | Articulation):
            self.usage += tuple((stage, name, used) for used in value.usage)
        self.tell("stage_finished", stage=stage, name=name, value=value, seconds=seconds)
