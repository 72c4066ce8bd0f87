"""A benchmark run: every object of a data set done once, in a folder that can be gone on with."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import asdict, dataclass, replace
from fnmatch import fnmatchcase
from importlib.metadata import version
from pathlib import Path
from typing import TypeAlias

from ..errors import BadInputError, OutputError
from ..output import claimed
from ..toml_text import recipe_text
from .formats import DEFAULT_VARIANT, TruthFormat, find_truths
from .frame import MISFIT
from .numbers import counted
from .pool import run_each
from .preflight import check_variant
from .protocols import Protocol, protocol
from .results import Summary, write_results
from .resuming import Standing, standing
from .rows import (
    ROW_FILE,
    SETTINGS_FILE,
    Row,
    Settings,
    object_folder,
    read_row,
    read_rows,
    read_settings,
    write_row,
    write_settings,
)
from .worker import LOG_FILE, RECIPE_FILE, Job, System, begun, work

Truths: TypeAlias = dict[str, tuple[TruthFormat, Path]]


@dataclass(frozen=True)
class Plan:
    """What to run.

    Attributes:
        data: folder of objects with ground truth.
        out: folder of the run; made, or gone on with.
        system: what is scored.
        protocol: its name.
        variant: which mesh of each object.
        only: patterns such as "fridge*"; the objects whose names fit one of them. None: all.
        jobs: how many objects at a time.
        timeout: longest time of an object [s]; 0 means no limit.
        pictures: whether to draw each object.
        retry: whether to do objects again that failed.
    """

    data: Path
    out: Path
    system: System
    protocol: str = "simart"
    variant: str = DEFAULT_VARIANT
    only: tuple[str, ...] = ()
    jobs: int = 1
    timeout: float = 600.0
    pictures: bool = True
    retry: bool = False


class Watcher:
    """Is told how a run goes on; this one does nothing with it."""

    def started(self, objects: int, done: int, changed: tuple[str, ...]) -> None:
        """Of so many objects, so many were done before; some are done again as their files have changed."""

    def finished(self, row: Row) -> None:
        """An object is done."""


@dataclass(frozen=True)
class Outcome:
    """What a run left.

    Attributes:
        summary: over all rows in the folder.
        rows: by name.
        page: the page to look at.
        before: names of the objects that had been done before.
        warnings: what makes the results worth less than they look.
    """

    summary: Summary
    rows: tuple[Row, ...]
    page: Path
    before: frozenset[str] = frozenset()
    warnings: tuple[str, ...] = ()


def run(plan: Plan, watcher: Watcher | None = None) -> Outcome:
    """Do every object that is not done yet, each in a process of its own, and write the results.

    Scripts that call this need the `if __name__ == "__main__":` of multiprocessing.

    Raises:
        BadInputError: there are no such objects, no such protocol, no object has the variant or a
            prediction, or the folder is of another run.
        OutputError: the folder cannot be written, or another run is writing to it.
    """
    watcher = watcher or Watcher()
    scorer = protocol(plan.protocol)
    truths = find_truths(plan.data)
    chosen = _selected(truths, plan.only)
    check_variant(chosen, plan.variant)
    plan.system.check(tuple(chosen))
    settings = _settings(plan, scorer)
    with _opened(plan, settings):
        kept = standing(plan.out, plan.system, truths, chosen)
        left = {name: found for name, found in chosen.items() if not _is_done(plan, kept, name)}
        watcher.started(len(chosen), len(chosen) - len(left), kept.changed)
        for row in _done(plan, left, scorer):
            watcher.finished(row)
        return _outcome(plan, settings, scorer, frozenset(kept.rows.keys() - left.keys()), kept.warnings)


def _outcome(
    plan: Plan, settings: Settings, scorer: Protocol, before: frozenset[str], warnings: tuple[str, ...]
) -> Outcome:
    """Write the results of all rows in the folder."""
    from .page import write_page

    rows = read_rows(plan.out)
    summary = write_results(plan.out, settings, rows, scorer)
    return Outcome(summary, rows, write_page(plan.out), before, (*warnings, *_misfits(rows)))


def _misfits(rows: Sequence[Row]) -> list[str]:
    """A warning where predictions do not lie where the truth does."""
    notes = [note for row in rows for note in row.notes if note.startswith(MISFIT)]
    if not notes:
        return []
    do = "does" if len(notes) == 1 else "do"
    where = "see --up and --fit" if any("--up" in note for note in notes) else "see the notes on the page"
    return [f"{counted(len(notes), 'prediction')} {do} not fit the truth's box: {where}"]


def left_to_do(plan: Plan) -> int:
    """How many objects of a run have no row yet."""
    truths = _selected(find_truths(plan.data), plan.only)
    return sum(read_row(plan.out, name) is None for name in truths)


def _selected(truths: Truths, only: Sequence[str]) -> Truths:
    found = {n: t for n, t in truths.items() if not only or any(fnmatchcase(n, glob) for glob in only)}
    if not found:
        names = ", ".join(truths)
        raise BadInputError(f"no object is called {' or '.join(only)}: there are {names}")
    return found


def _settings(plan: Plan, scorer: Protocol) -> Settings:
    recipe = plan.system.recipe
    return Settings(
        data=plan.data.resolve().name,
        protocol=scorer.tag,
        system=plan.system.name,
        variant=plan.variant,
        recipe=recipe.table() if recipe else None,
        placement=plan.system.placement.text,
        simart_kit=version("simart-kit"),
    )


@contextmanager
def _opened(plan: Plan, settings: Settings) -> Iterator[None]:
    """The folder of the run, ours alone: a new one, or one with the same settings."""
    out = plan.out
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = "it is a file" if isinstance(error, FileExistsError) else error.strerror
        raise OutputError(
            f"cannot write to output folder {out}: {reason}; choose another with --out"
        ) from error
    with claimed(out):
        if (out / SETTINGS_FILE).exists():
            _check_same(out, read_settings(out), settings)
        elif any(out.iterdir()):
            raise BadInputError(f"{out} is not empty and no benchmark run: choose another folder with --out")
        if plan.system.recipe is not None:
            (out / RECIPE_FILE).write_text(recipe_text(plan.system.recipe), encoding="utf-8")
        write_settings(out, settings)
        yield


def _check_same(out: Path, before: Settings, now: Settings) -> None:
    old, new = asdict(before), asdict(now)
    said = [
        f"{key} '{old[key]}', not '{new[key]}'" for key in old if key != "recipe" and old[key] != new[key]
    ]
    one, two = old["recipe"] or {}, new["recipe"] or {}
    changed = [key for key in sorted({*one, *two}) if one.get(key) != two.get(key)]
    if changed and not said:
        said = [f"another recipe: {', '.join(changed)} differ"]
    if said:
        raise BadInputError(f"{out} is a run with {'; '.join(said)}: choose another folder with --out")


def _is_done(plan: Plan, kept: Standing, name: str) -> bool:
    row = kept.rows.get(name)
    return row is not None and not (plan.retry and row.status == "failed")


def _done(plan: Plan, truths: Truths, scorer: Protocol) -> Iterator[Row]:
    """Rows in the order in which objects are done. One that ends its process gets another, to tell so."""
    queue = deque(_job(plan, name, *found) for name, found in truths.items())
    children = run_each(work, queue, log=_log, workers=plan.jobs, timeout=plan.timeout)
    with closing(children):
        for job, died in children:
            row = read_row(plan.out, job.name)
            if row is None and not job.died:
                queue.appendleft(replace(job, died=died or "ended without a result"))
                continue
            if row is None:
                scores = scorer.score(None, None)
                row = replace(begun(job), status="failed", error=job.died, scores=dict(scores.values))
                write_row(plan.out, row)
            _drop_empty(job)
            yield row


def _job(plan: Plan, name: str, reader: TruthFormat, path: Path) -> Job:
    (object_folder(plan.out, name) / ROW_FILE).unlink(missing_ok=True)
    return Job(plan.out, name, reader, path, plan.variant, plan.system, plan.protocol, pictures=plan.pictures)


def _log(job: Job) -> Path:
    job.folder.mkdir(parents=True, exist_ok=True)
    log = job.folder / LOG_FILE
    if not job.died:
        log.unlink(missing_ok=True)
    return log


def _drop_empty(job: Job) -> None:
    log = job.folder / LOG_FILE
    if log.is_file() and log.stat().st_size == 0:
        log.unlink()
