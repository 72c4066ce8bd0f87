"""What is to be made: the objects of all sources in a fixed order, each as a small value."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from simart_kit.asset import unique_names

from .generated import GeneratedJob, category_names
from .manifest import DataFolder
from .truths import TruthJob, truth_jobs

if TYPE_CHECKING:
    from .source_object import SourceObject


class Job(Protocol):
    """An object that can be made, in any process."""

    @property
    def key(self) -> str:
        """Of the object."""

    def make(self) -> SourceObject:
        """The object in the pose of its source; raises BadInputError where it cannot be read or used."""


@dataclass(frozen=True, eq=False)
class Jobs:
    """All objects of a data set.

    Attributes:
        truths: those that files hold.
        folders: where these are.
        categories: of those that are generated.
        count: objects of each category.
        seed: of what is generated.
    """

    truths: tuple[TruthJob, ...]
    folders: tuple[DataFolder, ...]
    categories: tuple[str, ...]
    count: int
    seed: int

    @property
    def total(self) -> int:
        """How many there are."""
        return len(self.truths) + len(self.categories) * self.count

    def starting(self, first: int) -> Iterator[Job]:
        """The jobs from this number on: files in order, then object 0 of all categories, object 1, ..."""
        yield from self.truths[first:]
        for number in range(max(first - len(self.truths), 0), len(self.categories) * self.count):
            turn, category = divmod(number, len(self.categories))
            yield GeneratedJob(self.categories[category], self.seed, turn)


def find_jobs(data: Sequence[Path], generate: Sequence[str], count: int, seed: int) -> Jobs:
    """The objects of folders and of categories.

    Raises:
        BadInputError: a folder does not exist or holds no object; no such category.
    """
    truths = [truth_jobs(folder) for folder in data]
    categories = list(dict.fromkeys(name for which in generate for name in category_names(which)))
    return Jobs(
        _unique([job for jobs in truths for job in jobs]),
        tuple(_folder(path, [job.key for job in jobs]) for path, jobs in zip(data, truths, strict=True)),
        tuple(categories),
        count,
        seed,
    )


def _folder(path: Path, keys: Sequence[str]) -> DataFolder:
    digest = hashlib.sha256("\n".join(keys).encode()).hexdigest()
    return DataFolder(name=path.resolve().name, objects=len(keys), sha256=digest)


def _unique(jobs: Sequence[TruthJob]) -> tuple[TruthJob, ...]:
    """The jobs with the second and later uses of a key numbered: two folders may hold objects of one name."""
    keys = unique_names([job.key for job in jobs])
    return tuple(replace(job, key=key) for job, key in zip(jobs, keys, strict=True))
