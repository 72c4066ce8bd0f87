"""Building a data set: jobs to records to shards, so that a build may be killed at any moment and goes on."""

from __future__ import annotations

import errno
import shutil
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from simart_kit.errors import BadInputError, OutputError
from simart_kit.output import claimed

from ..default_model import LoadedModel
from ..tokens import TokenGrid
from .jobs import Jobs
from .making import Made, Order, make
from .manifest import MANIFEST, BuildOptions, Manifest, read_manifest, write_whole
from .progress import FOLDER, Progress, begun, finished, saved
from .records import RecordOptions
from .seen import SeenHashes
from .shards import ShardWriter, shard_name
from .statistics import Statistics, skip
from .workers import in_order

DUPLICATE = "equal to an earlier object"
_TOLD = 100
"""So many of the objects that were left out are named in the manifest."""

# Told after each shard.
Report = Callable[[Progress], None]


@dataclass(frozen=True, slots=True)
class Build:
    """What is to be built.

    Attributes:
        jobs: all objects.
        options: as the manifest states them.
        grid: of the model's tokens.
        model: folder of the model; None for the shipped one.
        workers: processes.
    """

    jobs: Jobs
    options: BuildOptions
    grid: TokenGrid
    model: Path | None = None
    workers: int = 1


def build_options(
    jobs: Jobs,
    codec: LoadedModel,
    states: int,
    pictures: bool,
    max_parts: int,
    shard_size: int,
    limit: int | None,
) -> BuildOptions:
    """All that decides the records, for the manifest."""
    return BuildOptions(
        data=jobs.folders,
        generate=jobs.categories,
        count=jobs.count,
        seed=jobs.seed,
        states=states,
        pictures=pictures,
        max_parts=max_parts,
        limit=limit,
        shard_size=shard_size,
        codec=codec.fingerprint,
    )


def build(asked: Build, out: Path, report: Report) -> Manifest:
    """Make a data set, or go on with one; a finished one is left as it is.

    Args:
        asked: what to build.
        out: folder of the data set; made if it is not there.
        report: told how far it is after each shard.

    Raises:
        BadInputError: the folder holds something else or records of other options, or no object can be used.
        OutputError: the folder cannot be written, the disk is full, another run writes to it, or a worker
            died.
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
        with claimed(out):
            if not finished(out, asked.options):
                _build(asked, out, begun(out, asked.options), report)
            return read_manifest(out)
    except OSError as error:
        if error.errno in (errno.ENOSPC, errno.EDQUOT):
            raise OutputError(
                f"the disk of {out} is full: make room and run the same command again, "
                "it goes on where it stopped"
            ) from error
        raise OutputError(f"cannot write to {out}: {error.strerror or error}") from error


def _build(asked: Build, out: Path, progress: Progress, report: Report) -> None:
    seen = SeenHashes(out / FOLDER / "hashes", progress.hashes)
    order = Order(
        asked.model,
        asked.options.max_parts,
        RecordOptions(asked.options.states, asked.options.seed, asked.options.pictures),
    )
    jobs = asked.jobs.starting(progress.jobs)
    with closing(in_order(partial(make, order), jobs, asked.workers)) as results:
        more = True
        while more:
            progress, more = _shard(results, out, progress, seen)
            saved(out, progress)
            if more:
                report(progress)
    _finish(out, progress, asked)


def _shard(results: Iterator[Made], out: Path, progress: Progress, seen: SeenHashes) -> tuple[Progress, bool]:
    """Write the next shard; also whether there may be another."""
    options = progress.options
    writer = ShardWriter(out / shard_name(len(progress.shards)), out / FOLDER / "shard")
    counts, skipped, jobs, more = progress.statistics, list(progress.skipped), progress.jobs, True
    try:
        while more and writer.records < options.shard_size:
            made = None if counts.objects == options.limit else next(results, None)
            if made is None:
                more = False
                break
            jobs += 1
            fresh = _without_duplicates(made, seen)
            counts = counts.plus(fresh.statistics)
            writer.add(fresh.entries)
            if fresh.fault and len(skipped) < _TOLD:
                skipped.append((fresh.key, fresh.fault))
        shards = (*progress.shards, writer.close()) if writer.records else progress.shards
    finally:
        writer.abandon()
    seen.save()
    return (
        Progress(
            options=options,
            jobs=jobs,
            hashes=seen.count,
            shards=shards,
            statistics=counts,
            skipped=tuple(skipped),
        ),
        more,
    )


def _without_duplicates(made: Made, seen: SeenHashes) -> Made:
    if made.fault or seen.add(made.shape):
        return made
    return Made(made.key, made.shape, (), skip(DUPLICATE), DUPLICATE)


def _finish(out: Path, progress: Progress, asked: Build) -> None:
    if not progress.shards:
        shutil.rmtree(out / FOLDER)
        raise BadInputError(
            f"none of {asked.jobs.total} objects can be used: {_reasons(progress.statistics)}"
        )
    manifest = Manifest(
        options=progress.options,
        grid=asked.grid.shape,
        codebook=asked.grid.codebook,
        shards=progress.shards,
        statistics=progress.statistics,
        skipped=progress.skipped,
    )
    write_whole(out / MANIFEST, manifest)
    shutil.rmtree(out / FOLDER)


def _reasons(statistics: Statistics) -> str:
    return "; ".join(f"{reason} ({count})" for reason, count in statistics.skipped.items())
