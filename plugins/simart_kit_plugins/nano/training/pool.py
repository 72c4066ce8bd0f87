"""The objects of a training, made once by all processors and kept as files."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np

from simart_kit.errors import BadInputError, OutputError

from ...shapes.dice import Dice
from ..examples import example
from ..generate.catalogue import CATEGORIES, NAMELESS
from ..generate.category import Category
from ..generate.posing import ajar
from ..relief_examples import relief_example
from ..store import Stored, load, save, stored
from .plan import TrainingPlan

# Told after each file: objects done, and of how many.
Progress = Callable[[int, int], None]
Job = TypeVar("Job")
Done = TypeVar("Done")
SHARD = 500
# Streams of random numbers: objects to train on, to judge on, and to judge on of unseen categories.
TRAIN, SEEN, UNSEEN = range(3)


@dataclass(frozen=True)
class Shard:
    """A file of a pool.

    Attributes:
        path: of the file.
        names: categories that it draws from.
        static_share: how many of its objects do not move.
        nameless_share: how many are nothing in particular.
        skin_share: how many are one skin, as its solids show it.
        relief_share: how many are a closed skin.
        seed: of the training.
        stream: what the objects are for.
        first, count: numbers of its objects.
    """

    path: Path
    names: tuple[str, ...]
    static_share: float
    nameless_share: float
    skin_share: float
    relief_share: float
    seed: int
    stream: int
    first: int
    count: int


def shards(plan: TrainingPlan, folder: Path, stream: int) -> list[Shard]:
    """The files of the objects that a plan has for a use.

    Raises:
        BadInputError: an unseen category does not exist, or nothing is left to train on.
    """
    names = [category.name for category in CATEGORIES]
    unknown = [name for name in plan.unseen if name not in names]
    if unknown:
        raise BadInputError(f"unseen: no category '{unknown[0]}': there are {', '.join(names)}")
    wanted = tuple(name for name in names if (name in plan.unseen) == (stream == UNSEEN))
    if not wanted and stream != UNSEEN:
        raise BadInputError("unseen: all categories are, and nothing is left to train on")
    total = 0 if not wanted else plan.objects if stream == TRAIN else plan.held_out
    prefix = ("train", "seen", "unseen")[stream]
    return [
        Shard(
            folder / f"{prefix}-{first:06d}.npz",
            wanted,
            plan.static_share,
            plan.nameless_share,
            plan.skin_share,
            plan.relief_share,
            plan.seed,
            stream,
            first,
            min(SHARD, total - first),
        )
        for first in range(0, total, SHARD)
    ]


def make(files: Sequence[Shard], processes: int, progress: Progress) -> None:
    """Make the files that are not there yet.

    Raises:
        OutputError: they cannot be written.
    """
    missing = [shard for shard in files if not shard.path.exists()]
    total, done = sum(s.count for s in files), sum(s.count for s in files if s.path.exists())
    try:
        for shard in files[:1]:
            shard.path.parent.mkdir(parents=True, exist_ok=True)
        for count in each(_make, missing, processes):
            done += count
            progress(done, total)
    except OSError as error:
        raise OutputError(f"cannot write {files[0].path.parent}: {error.strerror or error}") from error


def read(files: Sequence[Shard]) -> list[Stored]:
    """All objects of the files."""
    return [one for shard in files for one in load(shard.path)]


def each(work: Callable[[Job], Done], jobs: Sequence[Job], processes: int) -> Iterator[Done]:
    """What comes of each job, in their order, by so many processes."""
    if processes < 2 or len(jobs) < 2:
        yield from map(work, jobs)
        return
    # Forked copies of a process with threads may hang.
    with multiprocessing.get_context("spawn").Pool(processes) as workers:
        yield from workers.imap(work, jobs)


def _make(shard: Shard) -> int:
    save([_object(shard, number) for number in range(shard.first, shard.first + shard.count)], shard.path)
    return shard.count


def _object(shard: Shard, number: int) -> Stored:
    key = (shard.seed, shard.stream, number)
    generator = np.random.default_rng(key)
    category = _drawn(shard, generator)
    made = ajar(category.make(Dice((*key, 1))), Dice((*key, 2)))
    if shard.relief_share and generator.random() < shard.relief_share:
        return stored(relief_example(made, generator))
    return stored(example(made, generator, shard.skin_share))


def _drawn(shard: Shard, generator: np.random.Generator) -> Category:
    known = [category for category in CATEGORIES if category.name in shard.names]
    still, nameless = generator.random(2) < (shard.static_share, shard.nameless_share)
    fit = [category for category in known if category.moves != still] or known
    chosen = [category for category in fit if (category.name in NAMELESS) == nameless] or fit
    return chosen[int(generator.integers(len(chosen)))]
