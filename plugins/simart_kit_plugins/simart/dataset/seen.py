"""The 64-bit hashes of all objects so far: 8 bytes each, in memory and on disk."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from simart_kit.errors import BadInputError

# New hashes are kept in a set until there are so many, then sorted in with the others.
_RECENT = 1 << 16
_TYPE = np.dtype("<u8")


class SeenHashes:
    """A set of 64-bit numbers that is also a file, to which it only appends.

    Args:
        path: of the file; made if it is not there.
        count: how many of its numbers are meant; what a killed run wrote after them is cut off.

    Raises:
        BadInputError: the file has fewer.
    """

    def __init__(self, path: Path, count: int) -> None:
        data = path.read_bytes() if path.exists() else b""
        if len(data) < count * _TYPE.itemsize:
            raise BadInputError(f"{path} is damaged: remove the folder and start again")
        self._sorted: NDArray[np.uint64] = np.sort(np.frombuffer(data, _TYPE, count))
        self._recent: set[int] = set()
        self._unwritten: list[int] = []
        self._path = path
        with path.open("ab") as file:
            file.truncate(count * _TYPE.itemsize)
        self.count = count

    def add(self, value: int) -> bool:
        """Take a number up; False where it is there already."""
        place = int(np.searchsorted(self._sorted, np.uint64(value)))
        there = place < len(self._sorted) and int(self._sorted[place]) == value
        if there or value in self._recent:
            return False
        self._recent.add(value)
        self._unwritten.append(value)
        self.count += 1
        if len(self._recent) >= _RECENT:
            fresh = np.fromiter(self._recent, dtype=np.uint64)
            self._sorted = np.sort(np.concatenate([self._sorted, fresh]))
            self._recent.clear()
        return True

    def save(self) -> None:
        """Append what is new to the file, safe on the disk."""
        with self._path.open("ab") as file:
            file.write(np.array(self._unwritten, dtype=_TYPE).tobytes())
            file.flush()
            os.fsync(file.fileno())
        self._unwritten.clear()
