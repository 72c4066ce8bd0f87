"""Reading a data set: records one after another, a shard's worth of memory at most."""

from __future__ import annotations

import tarfile
from collections.abc import Collection, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from simart_kit.errors import BadInputError
from simart_kit.provenance import file_hash

from .manifest import Manifest, Shard, read_manifest
from .record import Record, Task
from .record_json import from_json
from .shards import JSON, PNG

ALL_TASKS: tuple[Task, ...] = ("urdf", "grounding")


def record_count(folder: Path) -> int:
    """Number of records of a finished data set; raises BadInputError where it is none."""
    return read_manifest(folder).statistics.records


def read_records(
    folder: Path, shuffle_seed: int | None = None, tasks: Collection[Task] = ALL_TASKS
) -> Iterator[Record]:
    """The records of a finished data set.

    Args:
        folder: of the data set.
        shuffle_seed: None for the order they were written in; else shards come in a random order and the
            records of a shard, too, by this seed. A shard is then held in memory.
        tasks: pairs of other tasks are left out, and records without a pair left.

    Raises:
        BadInputError: there is no finished data set, or a shard is missing or damaged.
    """
    manifest = read_manifest(folder)
    generator = None if shuffle_seed is None else np.random.default_rng(shuffle_seed)
    for shard in _ordered(manifest, generator):
        records = read_shard(folder / shard.file, shard)
        if generator is not None:
            every = list(records)
            records = iter([every[n] for n in generator.permutation(len(every))])
        for record in records:
            pairs = tuple(pair for pair in record.pairs if pair.task in tasks)
            if pairs:
                yield record if len(pairs) == len(record.pairs) else replace(record, pairs=pairs)


def read_shard(path: Path, expected: Shard | None = None) -> Iterator[Record]:
    """The records of one shard, in their order.

    Args:
        path: of the tar file.
        expected: what the manifest says of it.

    Raises:
        BadInputError: it is missing, damaged, cut off, or has not the records that are expected.
    """
    if not path.is_file():
        raise BadInputError(f"{path} is missing: copy the data set again, or build it again")
    if expected is not None and path.stat().st_size != expected.bytes:
        raise BadInputError(f"{path} has {path.stat().st_size} bytes, not {expected.bytes}: copy it again")
    count = 0
    try:
        for key, document, picture in _entries(path):
            yield from_json(document, picture, f"{path}: {key}")
            count += 1
    except (tarfile.TarError, OSError, EOFError) as error:
        raise BadInputError(f"{path} is damaged: {error}; copy it again") from error
    if expected is not None and count != expected.records:
        raise BadInputError(f"{path} has {count} records, not {expected.records}: copy it again")


def check_hashes(folder: Path) -> None:
    """Compare every shard with the manifest; raises BadInputError naming the first that differs."""
    for shard in read_manifest(folder).shards:
        path = folder / shard.file
        if not path.is_file() or file_hash(path) != shard.sha256:
            raise BadInputError(f"{path} is missing or damaged: copy it again")


def _ordered(manifest: Manifest, generator: np.random.Generator | None) -> list[Shard]:
    shards = list(manifest.shards)
    return shards if generator is None else [shards[n] for n in generator.permutation(len(shards))]


def _entries(path: Path) -> Iterator[tuple[str, bytes, bytes | None]]:
    """Key, document and picture of each record; the picture comes after the document."""
    waiting: tuple[str, bytes] | None = None
    with tarfile.open(path, "r|") as tar:
        for member in tar:
            file = tar.extractfile(member)
            data = b"" if file is None else file.read()
            if member.name.endswith(JSON):
                if waiting is not None:
                    yield (*waiting, None)
                waiting = (member.name.removesuffix(JSON), data)
            elif waiting is None or member.name != waiting[0] + PNG:
                raise BadInputError(
                    f"{path} holds '{member.name}', which belongs to no record: copy it again"
                )
            else:
                yield (*waiting, data)
                waiting = None
    if waiting is not None:
        yield (*waiting, None)
