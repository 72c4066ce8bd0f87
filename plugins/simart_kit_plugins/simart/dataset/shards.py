"""Shards: tar files in the WebDataset layout, KEY.json and KEY.png side by side; the same bytes each time."""

from __future__ import annotations

import hashlib
import os
import tarfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from .manifest import Shard

JSON, PNG = ".json", ".png"


@dataclass(frozen=True, slots=True)
class Entry:
    """A record as files.

    Attributes:
        key: of the record.
        document: its JSON.
        picture: PNG file, or None.
    """

    key: str
    document: bytes
    picture: bytes | None


def shard_name(number: int) -> str:
    """File name of a shard."""
    return f"shard-{number:06d}.tar"


class ShardWriter:
    """A shard that is being written, record by record.

    Args:
        path: the file it becomes once it is closed.
        partial: where it is written until then, on the same file system.
    """

    def __init__(self, path: Path, partial: Path) -> None:
        self._path, self._partial = path, partial
        # Without a buffer, a full disk shows where it is written to, and not when the file is given up.
        self._file = partial.open("wb", buffering=0)
        self._hash = hashlib.sha256()
        self._size = 0
        self.records = 0

    def add(self, entries: Sequence[Entry]) -> None:
        """Append records."""
        for entry in entries:
            self._put(entry.key + JSON, entry.document)
            if entry.picture is not None:
                self._put(entry.key + PNG, entry.picture)
            self.records += 1

    def close(self) -> Shard:
        """Finish the file and put it in place, safe on the disk."""
        self._write(bytes(2 * tarfile.BLOCKSIZE))
        os.fsync(self._file.fileno())
        self._file.close()
        self._partial.replace(self._path)
        return Shard(
            file=self._path.name, sha256=self._hash.hexdigest(), bytes=self._size, records=self.records
        )

    def abandon(self) -> None:
        """Remove what was written, if it has not been put in place."""
        self._file.close()
        self._partial.unlink(missing_ok=True)

    def _put(self, name: str, data: bytes) -> None:
        # Everything else of a TarInfo is 0 or empty: no time, owner or machine leaves a trace.
        info = tarfile.TarInfo(name)
        info.size, info.mode = len(data), 0o644
        self._write(info.tobuf(tarfile.PAX_FORMAT) + data + bytes(-len(data) % tarfile.BLOCKSIZE))

    def _write(self, data: bytes) -> None:
        left = memoryview(data)
        while left:
            left = left[self._file.write(left) :]
        self._hash.update(data)
        self._size += len(data)
