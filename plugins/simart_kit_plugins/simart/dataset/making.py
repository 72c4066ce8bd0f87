"""One job to what is written of it: the work of a process, which shares nothing with others."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from simart_kit.errors import BadInputError

from ..codec import TokenModel, nearest_codes
from ..default_model import load_model
from .jobs import Job
from .record_json import to_json
from .records import RecordOptions, records_of, shape_hash, voxels_of
from .shards import Entry
from .source_object import UnusableError, check_usable
from .statistics import Statistics, of_records, skip


@dataclass(frozen=True, slots=True)
class Order:
    """What is made of every job.

    Attributes:
        model: folder of the model that gives tokens; None for the shipped one.
        max_parts: objects of more are left out.
        records: states, seed and pictures.
    """

    model: Path | None
    max_parts: int
    records: RecordOptions


@dataclass(frozen=True, eq=False, slots=True)
class Made:
    """What became of a job.

    Attributes:
        key: of the object.
        shape: hash of its voxels and part names; 0 where it was left out.
        entries: its records; none where it was left out.
        statistics: counts of them, or of the reason.
        fault: why it was left out, or "".
    """

    key: str
    shape: int
    entries: tuple[Entry, ...]
    statistics: Statistics
    fault: str = ""


def make(order: Order, job: Job) -> Made:
    """Do a job. An object that cannot be used is told of, not raised."""
    try:
        made = check_usable(job.make(), order.max_parts)
        grids = voxels_of(made)
        model = _model(order.model)
        with _no_shape_cache():
            records = tuple(records_of(made, grids, model, order.records))
    except UnusableError as error:
        return Made(job.key, 0, (), skip(error.reason), str(error))
    except BadInputError as error:
        return Made(job.key, 0, (), skip("cannot be used"), str(error))
    except (ValueError, ArithmeticError, LookupError) as error:
        # One odd object in a million must not end a build of days; its fault is kept for who looks into it.
        return Made(job.key, 0, (), skip("failed"), f"{job.key}: {type(error).__name__}: {error}")
    entries = tuple(Entry(record.key, to_json(record), record.picture) for record in records)
    shape = shape_hash(grids, [part.name for part in made.asset.parts])
    return Made(job.key, shape, entries, of_records(records))


@contextmanager
def _no_shape_cache() -> Iterator[None]:
    """In the block torch does without oneDNN, which keeps code for each size of a batch it meets.

    Every object has its own number of cells, so that this grew by half a megabyte an object.
    """
    import torch

    before = torch.backends.mkldnn.set_flags(False)[0]  # type: ignore[no-untyped-call]
    try:
        yield
    finally:
        torch.backends.mkldnn.set_flags(before)  # type: ignore[no-untyped-call]


@lru_cache(maxsize=1)
def _model(folder: Path | None) -> TokenModel:
    """The model, read once a process; one thread, since sums of several depend on their number."""
    import torch

    torch.set_num_threads(1)
    return nearest_codes(load_model(folder).model)
