"""Records to train on and records to judge on: no object is in both."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from simart_kit.errors import BadInputError

from ..dataset.manifest import read_manifest
from ..dataset.reading import read_shard
from ..dataset.record import Record

_HASHES = 2**32


@dataclass(frozen=True)
class Records:
    """The records of folders of instruction data, read shard by shard.

    Attributes:
        shards: files of the folders, in order.
        held_out: share of the objects that training never sees.
        fingerprint: of the shards.
    """

    shards: tuple[Path, ...]
    held_out: float
    fingerprint: str

    def training(self, seed: int, epoch: int, lane: int, lanes: int) -> Iterator[Record]:
        """A lane's records of an epoch, the shards in an order of the epoch's own.

        Lanes share the shards out, or the records of every shard where shards are few.
        """
        order = np.random.default_rng((seed, epoch)).permutation(len(self.shards))
        by_shard = len(self.shards) >= lanes
        own = order[lane::lanes] if by_shard else order
        for place, record in enumerate(r for shard in own for r in read_shard(self.shards[shard])):
            if (by_shard or place % lanes == lane) and not self._kept_out(record):
                yield record

    def judged(self, count: int) -> tuple[Record, ...]:
        """Up to `count` records that training never sees, each of another object, in a shuffled order."""
        if not count or not self.held_out:
            return ()
        found: dict[str, Record] = {}
        for shard in self.shards:
            for record in read_shard(shard):
                if self._kept_out(record):
                    found.setdefault(record.object, record)
        return tuple(found[name] for name in sorted(found, key=_hash)[:count])

    def _kept_out(self, record: Record) -> bool:
        return _hash(record.object) < self.held_out * _HASHES


def find_records(folders: Sequence[Path], held_out: float, codec: str) -> Records:
    """The records of data sets that `dataset build` finished.

    Args:
        folders: of the data sets.
        held_out: share of their objects that training never sees.
        codec: fingerprint of the voxel model whose codes the model will know.

    Raises:
        BadInputError: there is no finished data set, or its codes are those of another voxel model.
    """
    shards: list[Path] = []
    told: list[str] = []
    for folder in folders:
        manifest = read_manifest(folder)
        if manifest.options.codec != codec:
            raise BadInputError(
                f"{folder} holds codes of the voxel model {manifest.options.codec}, not of {codec}: "
                "build the data set with the same --model"
            )
        shards += [folder / shard.file for shard in manifest.shards]
        told += [shard.sha256 for shard in manifest.shards]
    fingerprint = hashlib.sha256("\n".join(told).encode()).hexdigest()[:16]
    return Records(tuple(shards), held_out, fingerprint)


def _hash(name: str) -> int:
    return int.from_bytes(hashlib.blake2b(name.encode(), digest_size=4).digest(), "big")
