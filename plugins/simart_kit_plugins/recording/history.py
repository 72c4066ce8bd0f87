"""What the recorder has heard of one run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from simart_kit.assemble import Articulation
from simart_kit.asset import Asset, clean_name, unique_names
from simart_kit.checks import CheckResult
from simart_kit.evidence import Evidence
from simart_kit.loading import Source
from simart_kit.recipe import Recipe
from simart_kit.report import Report
from simart_kit.stages import Segmentation

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Event:
    """A stage that returned.

    Attributes:
        stage: "load", "segment", "joints", "modify", "check", "preview" or "export".
        name: of the plugin, or of the core's own step.
        value: what it returned.
        seconds: wall time [s].
    """

    stage: str
    name: str
    value: object
    seconds: float


@dataclass(frozen=True, eq=False)
class Failure:
    """What ended the run: the stage, and the error it raised."""

    stage: str
    error: BaseException


@dataclass(frozen=True, eq=False)
class Step:
    """The asset after one stage.

    Attributes:
        name: of the stage's plugin, numbered when it runs again: "snap", "snap_2".
        asset: what it returned.
    """

    name: str
    asset: Asset


@dataclass(frozen=True, eq=False)
class History:
    """One run, up to now.

    Attributes:
        name: the asset's.
        recipe: resolved.
        events: stages in order.
        failure: what ended the run, if it failed.
        report: the run's report, if it finished.
    """

    name: str
    recipe: Recipe
    events: tuple[Event, ...] = ()
    failure: Failure | None = None
    report: Report | None = None

    @property
    def source(self) -> Source | None:
        """What was loaded."""
        return self._last(Source)

    @property
    def segmentation(self) -> Segmentation | None:
        """The parts found."""
        return self._last(Segmentation)

    @property
    def asset(self) -> Asset | None:
        """The asset as the last stage left it."""
        return self._last(Asset) or self.predicted

    @property
    def predicted(self) -> Asset | None:
        """The asset before the first modifier."""
        found = self._last(Articulation)
        return found.asset if found else None

    @property
    def evidence(self) -> tuple[Evidence, ...]:
        """How parts and joints came about."""
        parts, joints = self.segmentation, self._last(Articulation)
        return (parts.evidence if parts else ()) + (joints.evidence if joints else ())

    @property
    def steps(self) -> tuple[Step, ...]:
        """The asset after each modifier."""
        modified = [e for e in self.events if e.stage == "modify" and isinstance(e.value, Asset)]
        names = unique_names([clean_name(e.name, "modifier") for e in modified])
        return tuple(
            Step(name, e.value) for name, e in zip(names, modified, strict=True) if isinstance(e.value, Asset)
        )

    @property
    def checks(self) -> tuple[CheckResult, ...]:
        """Verdicts, none before the checks ran."""
        found = [e.value for e in self.events if e.stage == "check" and isinstance(e.value, tuple)]
        return found[-1] if found else ()

    def _last(self, kind: type[T]) -> T | None:
        return next((e.value for e in reversed(self.events) if isinstance(e.value, kind)), None)
