"""One object of a benchmark run: read its truth, get a prediction, score it, draw it, write its row."""

from __future__ import annotations

import shutil
import time
import traceback
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, ParamSpec, TypeVar

from ..errors import BadInputError, SimartKitError
from ..recipe import Recipe
from .cases import Prediction, Truth
from .fingerprint import fingerprint
from .formats import DEFAULT_VARIANT, TruthFormat, find_prediction
from .frame import Placement, place
from .preflight import check_predictions
from .protocols import Protocol, Scores, protocol
from .rows import Row, object_folder, read_row, write_row

if TYPE_CHECKING:
    from ..mesh import Mesh

P = ParamSpec("P")
T = TypeVar("T")
RECIPE_FILE, LOG_FILE, ERROR_FILE = "recipe.toml", "log.txt", "error.txt"
_AS_IS = Placement()
_DRAFT = "draft"  # holds the row while the pictures are drawn


class System(ABC):
    """What is scored.

    Attributes:
        name: as results carry it: "recipe NAME" or "predictions NAME".
        recipe: resolved, of a conversion; None for predictions that exist.
        placement: how predictions are brought to the frame of the truth.
    """

    name: str
    recipe: Recipe | None
    placement: Placement

    @abstractmethod
    def answer(self, job: Job, truth: Truth) -> Answer:
        """What it says about an object; raises SimartKitError where it has no answer."""

    @abstractmethod
    def check(self, names: Sequence[str]) -> None:
        """Raises BadInputError where it has no answer for any of the objects that are called so."""

    @abstractmethod
    def fingerprint(self, name: str) -> str:
        """One number for what is in the files that its answer for an object comes from; "" without files."""


@dataclass(frozen=True, eq=False)
class Answer:
    """A prediction and the truth that it is compared with.

    Attributes:
        truth: that of the data set, or as written for the conversion where there was no single mesh.
        prediction: in the frame of that truth.
        notes: what the conversion warned of.
    """

    truth: Truth
    prediction: Prediction
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Job:
    """An object to do; plain values, so that it can be sent to another process.

    Attributes:
        run: folder of the run.
        name: of the object.
        reader: of its truth.
        path: for that reader.
        variant: which mesh of the object.
        system: what is scored.
        protocol: name of the protocol.
        pictures: whether to draw it.
        died: how the process ended that did this before; then only the row that tells so is written.
    """

    run: Path
    name: str
    reader: TruthFormat
    path: Path
    variant: str
    system: System
    protocol: str
    pictures: bool = True
    died: str = ""

    @property
    def folder(self) -> Path:
        """Where everything of this object is kept."""
        return object_folder(self.run, self.name)


@dataclass(frozen=True)
class Conversions(System):
    """Predictions that a recipe makes.

    Attributes:
        name: "recipe NAME".
        recipe: resolved; in the run's folder as a file, too.
        plugins: files to load besides the installed plugins.
    """

    name: str
    recipe: Recipe
    plugins: tuple[Path, ...] = ()
    placement: Placement = _AS_IS

    def answer(self, job: Job, truth: Truth) -> Answer:
        """Convert the object's mesh; that of an object in pieces is written first."""
        from ..pipeline import convert
        from ..plugins import Plugins
        from .formats.output_folder import OutputFolder

        if truth.mesh is None:
            truth = _as_one_mesh(truth, job.folder / "input")
        out = job.folder / "output"
        result = convert(
            truth.mesh or "",
            job.run / RECIPE_FILE,
            out=out,
            up=truth.up,
            unit=truth.metres_per_unit,
            record=False,
            plugins=Plugins(files=self.plugins),
        )
        return Answer(truth, OutputFolder().read(out, truth), result.report.warnings)

    def check(self, names: Sequence[str]) -> None:
        """Nothing: what a recipe makes of an object is not known before."""

    def fingerprint(self, name: str) -> str:
        """Of the plugin files; the recipe is in the settings of the run."""
        return fingerprint(*self.plugins)


@dataclass(frozen=True)
class Predictions(System):
    """Predictions that exist.

    Attributes:
        name: "predictions NAME".
        folder: with a prediction an object.
        placement: how they are brought to the frame of the truth.
    """

    name: str
    folder: Path
    placement: Placement = _AS_IS
    recipe: None = None

    def answer(self, job: Job, truth: Truth) -> Answer:
        """Read what is there for the object; placed, unless its format tells the way to the truth's frame."""
        reader, path = find_prediction(self.folder, job.name)
        found = reader.read(path, truth)
        if not reader.knows_frame:
            return Answer(truth, place(found, truth, self.placement))
        unused = self.placement != _AS_IS
        notes = (f"--up and --fit not needed: {reader.name} tells its frame",) if unused else ()
        return Answer(truth, place(found, truth, None), notes)

    def check(self, names: Sequence[str]) -> None:
        """There must be a prediction for one of the objects at least."""
        check_predictions(self.folder, names)

    def fingerprint(self, name: str) -> str:
        """Of all that is in the object's folder, or of its file with what belongs to it."""
        paths = [self.folder / name]
        with suppress(BadInputError):  # there is none, or too many: the row will say so
            paths.append(find_prediction(self.folder, name)[1])
        return fingerprint(*(path for path in paths if path.exists()))


class _FailedError(Exception):
    """An object has no score; says why in one line.

    Attributes:
        notes: where to read more.
    """

    def __init__(self, reason: str, notes: tuple[str, ...] = ()) -> None:
        super().__init__(" ".join(reason.split()))
        self.notes = notes


def work(job: Job) -> None:
    """Do an object. Whatever goes wrong with it is written in its row."""
    _tidy(job)
    row = begun(job)
    start = time.perf_counter()
    scorer = protocol(job.protocol)
    truth, prediction = None, None
    try:
        truth = _attempt(job, "reading the truth", job.reader.read, job.path, job.variant)
        row = replace(row, category=truth.category, static=truth.articulation.is_static, notes=truth.notes)
        if job.died:
            raise _FailedError(job.died)
        answer = _attempt(job, "the prediction", job.system.answer, job, truth)
        truth, prediction = answer.truth, answer.prediction
        row = replace(row, notes=(*row.notes, *answer.notes, *prediction.notes))
        scores = _attempt(job, "scoring", scorer.score, truth, prediction)
    except _FailedError as failure:
        row = replace(row, status="failed", error=str(failure), notes=(*row.notes, *failure.notes))
        scores = _worst(job, scorer, truth)
    seconds = round(time.perf_counter() - start, 4)
    row = replace(row, scores=dict(scores.values), parts=scores.parts, seconds=seconds)
    row = replace(row, notes=(*row.notes, *scores.notes))
    _write(job, row, truth, prediction)


def begun(job: Job) -> Row:
    """What the row of an object begins with: of which files it will be."""
    files = fingerprint(job.path), job.system.fingerprint(job.name)
    return Row(job.name, truth_sha256=files[0], system_sha256=files[1])


def one_line(error: BaseException) -> str:
    """What an error says, in one line."""
    return " ".join(str(error).split()) or type(error).__name__


def _attempt(job: Job, what: str, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
    """Call a step; an error that is not of the input keeps its traceback in the object's folder."""
    try:
        return function(*args, **kwargs)
    except SimartKitError as error:
        notes = (text.replace(f"{job.folder}/", "") for text in getattr(error, "__notes__", ()))
        raise _FailedError(one_line(error), tuple(notes)) from error
    except (Exception, SystemExit) as error:
        (job.folder / ERROR_FILE).write_text(traceback.format_exc(), encoding="utf-8")
        reason = f"{what} failed: {type(error).__name__}: {one_line(error)}"
        raise _FailedError(reason, (f"the traceback is in {ERROR_FILE}",)) from error


def _worst(job: Job, scorer: Protocol, truth: Truth | None) -> Scores:
    """Scores of a failure; of an unknown object where the known one breaks the protocol."""
    try:
        return _attempt(job, "scoring", scorer.score, truth, None)
    except _FailedError:
        return scorer.score(None, None)


def _tidy(job: Job) -> None:
    """Remove what an unfinished attempt left, but for what tells why a process died."""
    keep = {LOG_FILE, ERROR_FILE, _DRAFT} if job.died else {LOG_FILE}
    for path in job.folder.iterdir():
        if path.is_dir() and path.name not in keep:
            shutil.rmtree(path)
        elif path.name not in keep:
            path.unlink()


def _write(job: Job, row: Row, truth: Truth | None, prediction: Prediction | None) -> None:
    """Pictures and the row. A process that dies of drawing leaves the scores for the one that follows."""
    draft = job.folder / _DRAFT
    drawn = read_row(draft, job.name) if job.died else None
    if drawn is not None:
        row = replace(drawn, notes=(*drawn.notes, f"no pictures: {job.died}"))
    elif job.pictures and truth is not None and not job.died:
        write_row(draft, row)
        row = _with_pictures(job, row, truth, prediction)
    shutil.rmtree(draft, ignore_errors=True)
    write_row(job.run, row)


def _with_pictures(job: Job, row: Row, truth: Truth, prediction: Prediction | None) -> Row:
    from .pictures import write_pictures

    try:
        look = _attempt(job, "drawing", _look, job, truth)
        files = _attempt(job, "drawing", write_pictures, job.folder, truth, prediction, look)
    except _FailedError as failure:
        return replace(row, notes=(*row.notes, f"no pictures: {failure}", *failure.notes))
    return replace(row, pictures=files)


def _look(job: Job, truth: Truth) -> Mesh | None:
    """The object as it looks, where it has a mesh that can be read."""
    from ..loading import read_source
    from ..plugins import Plugins

    if truth.mesh is None or not truth.mesh.is_file():
        return None
    files = job.system.plugins if isinstance(job.system, Conversions) else ()
    return read_source(truth.mesh, Plugins(files=files), truth.up, truth.metres_per_unit).mesh


def _as_one_mesh(truth: Truth, folder: Path) -> Truth:
    """The object written as a single mesh and read again: faces are as a system will see them."""
    from .formats.simart_bench import SimartBench
    from .importing import write_case

    write_case(truth, folder)
    (path,) = SimartBench().find(folder).values()
    again = SimartBench().read(path, DEFAULT_VARIANT)
    return replace(again, name=truth.name, category=truth.category, notes=())
