"""Stand-ins for plugins, each with exactly the behaviour that a test asks for.

plugins = Plugins(installed=False)
plugins.register(fakes.plugin(segmenter=fakes.segmenter(error=RuntimeError("out of memory"))))
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..asset import Asset, Joint
from ..checks import CheckResult
from ..hookspecs import Register, RegisterRecipe, hookimpl
from ..mesh import Mesh
from ..stages import Check, Exporter, JointPredictor, Modifier, PartGuess, Segmentation, Segmenter

if TYPE_CHECKING:
    from ..checks.subject import Subject
    from ..report import Report
    from ..runner import Run

Labels = ArrayLike | Callable[[Mesh], ArrayLike]


def segmenter(
    labels: Labels | None = None,
    parts: Sequence[PartGuess] | None = None,
    joints: Sequence[Joint] | None = None,
    error: BaseException | None = None,
    name: str = "fake",
) -> type[Segmenter]:
    """A Segmenter class.

    Args:
        labels: (F,) what it returns as `face_part`, right or wrong, or a function of the mesh; the default
            puts all faces in one part.
        parts: its guesses; the default is one a label: part_0, part_1 …
        joints: its joint hints.
        error: raised instead.
        name: in recipes.
    """

    class FakeSegmenter(Segmenter):
        """Answers what the test said."""

        def segment(self, mesh: Mesh) -> Segmentation:
            if error is not None:
                raise error
            said = labels(mesh) if callable(labels) else labels
            face_part = np.zeros(len(mesh.faces), np.int32) if said is None else np.asarray(said)
            guesses = [PartGuess(f"part_{i}") for i in range(len(np.unique(face_part)))]
            chosen = tuple(guesses if parts is None else parts)
            return Segmentation(face_part, chosen, None if joints is None else tuple(joints))

    FakeSegmenter.name = name
    return FakeSegmenter


def joint_predictor(
    joints: Sequence[Joint] = (), error: BaseException | None = None, name: str = "fake"
) -> type[JointPredictor]:
    """A JointPredictor class that returns these joints, or raises."""

    class FakeJointPredictor(JointPredictor):
        """Answers what the test said."""

        def predict(self, mesh: Mesh, segmentation: Segmentation) -> tuple[Joint, ...]:
            if error is not None:
                raise error
            return tuple(joints)

    FakeJointPredictor.name = name
    return FakeJointPredictor


def modifier(
    change: Callable[[Asset], Asset] = lambda asset: asset,
    error: BaseException | None = None,
    name: str = "fake",
) -> type[Modifier]:
    """A Modifier class that applies a function, or raises."""

    class FakeModifier(Modifier):
        """Does what the test said."""

        def modify(self, asset: Asset) -> Asset:
            if error is not None:
                raise error
            return change(asset)

    FakeModifier.name = name
    return FakeModifier


def exporter(
    files: Mapping[str, str] = MappingProxyType({"model.txt": "a model\n"}),
    main: str | Path | None = None,
    unsupported: Sequence[str] = (),
    error: BaseException | None = None,
    name: str = "fake",
) -> type[Exporter]:
    """An Exporter class.

    Args:
        files: what it writes, text by relative path.
        main: what it returns: a path under its directory, by default the first file; an absolute path stays.
        unsupported: what it says it cannot express.
        error: raised when the files are written, so that a half-written export is left behind.
        name: in recipes.
    """

    class FakeExporter(Exporter):
        """Writes what the test said."""

        def export(self, asset: Asset, directory: Path) -> Path:
            for file, text in files.items():
                (directory / file).parent.mkdir(parents=True, exist_ok=True)
                (directory / file).write_text(text, encoding="utf-8", newline="\n")
            if error is not None:
                raise error
            return directory / (next(iter(files)) if main is None else main)

        def unsupported(self, asset: Asset) -> tuple[str, ...]:
            return told

    told = tuple(unsupported)
    FakeExporter.name = name
    return FakeExporter


def check(
    passed: bool = True,
    text: str = "as the test said",
    error: BaseException | None = None,
    name: str = "fake",
) -> type[Check]:
    """A Check class with this verdict, or that raises."""

    class FakeCheck(Check):
        """Judges as the test said."""

        def check(self, subject: Subject) -> CheckResult:
            if error is not None:
                raise error
            return CheckResult(name, passed, text)

    FakeCheck.name = name
    return FakeCheck


@dataclass(frozen=True, eq=False)
class FakePlugin:
    """A plugin that registers what it was given; make it with `plugin`."""

    segmenters: tuple[type[Segmenter], ...] = ()
    joint_predictors: tuple[type[JointPredictor], ...] = ()
    modifiers: tuple[type[Modifier], ...] = ()
    exporters: tuple[type[Exporter], ...] = ()
    checks: tuple[type[Check], ...] = ()
    recipes: Mapping[str, Path] = field(default_factory=dict)
    meshes: Mapping[Path, Mesh] = field(default_factory=dict)

    @hookimpl
    def register_segmenters(self, register: Register) -> None:
        for stage in self.segmenters:
            register(stage)

    @hookimpl
    def register_joint_predictors(self, register: Register) -> None:
        for stage in self.joint_predictors:
            register(stage)

    @hookimpl
    def register_modifiers(self, register: Register) -> None:
        for stage in self.modifiers:
            register(stage)

    @hookimpl
    def register_exporters(self, register: Register) -> None:
        for stage in self.exporters:
            register(stage)

    @hookimpl
    def register_checks(self, register: Register) -> None:
        for stage in self.checks:
            register(stage)

    @hookimpl
    def register_recipes(self, register: RegisterRecipe) -> None:
        for name, path in self.recipes.items():
            register(name, path)

    @hookimpl
    def load_mesh(self, path: Path) -> Mesh | None:
        return self.meshes.get(path)


def plugin(
    segmenter: type[Segmenter] | None = None,
    joint_predictor: type[JointPredictor] | None = None,
    modifier: type[Modifier] | None = None,
    exporter: type[Exporter] | None = None,
    check: type[Check] | None = None,
    recipes: Mapping[str, Path] = MappingProxyType({}),
    meshes: Mapping[Path, Mesh] = MappingProxyType({}),
) -> FakePlugin:
    """A plugin to `register`, with a stage of each kind at most.

    Args:
        segmenter: registered if given; so are the next four.
        joint_predictor: see segmenter.
        modifier: see segmenter.
        exporter: see segmenter.
        check: see segmenter.
        recipes: TOML files by the name to register.
        meshes: what `load_mesh` answers for a path; the file must exist and not be empty.
    """
    return FakePlugin(
        segmenters=(segmenter,) if segmenter else (),
        joint_predictors=(joint_predictor,) if joint_predictor else (),
        modifiers=(modifier,) if modifier else (),
        exporters=(exporter,) if exporter else (),
        checks=(check,) if check else (),
        recipes=recipes,
        meshes=meshes,
    )


@dataclass(frozen=True)
class Event:
    """What an observer was told: the hook, and the stage and name where it has them."""

    hook: str
    stage: str = ""
    name: str = ""
    value: object = None


class FakeObserver:
    """An observer to `register`; it remembers all that it is told.

    Args:
        error: raised on every call, after it is remembered.

    Attributes:
        events: what it was told, in order.
    """

    def __init__(self, error: Exception | None = None) -> None:
        self.events: tuple[Event, ...] = ()
        self._error = error

    @hookimpl
    def run_started(self, run: Run) -> None:
        self._remember(Event("run_started", name=run.name))

    @hookimpl
    def stage_finished(self, run: Run, stage: str, name: str, value: object, seconds: float) -> None:
        self._remember(Event("stage_finished", stage, name, value))

    @hookimpl
    def run_failed(self, run: Run, stage: str, error: BaseException) -> None:
        self._remember(Event("run_failed", stage, run.name, error))

    @hookimpl
    def run_finished(self, run: Run, report: Report) -> None:
        self._remember(Event("run_finished", name=run.name, value=report))

    def _remember(self, event: Event) -> None:
        self.events += (event,)
        if self._error is not None:
            raise self._error
