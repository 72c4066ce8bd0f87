"""Answers of workers on the disk: what was computed once is not computed again, and needs no GPU then."""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from uuid import uuid4

import numpy as np

from simart_kit.errors import OutputError

from .array_files import Arrays, Expected, read_arrays
from .failures import WorkerError
from .surface import Surface


@dataclass(frozen=True)
class AnswerCache:
    """A folder with an .npz for each answer, under its key.

    Attributes:
        folder: made when it is first needed.
    """

    folder: Path

    def get(self, key: str, expected: Mapping[str, Expected], most: int) -> Arrays | None:
        """The arrays of an answer; None when there is none, or its file is damaged."""
        try:
            return read_arrays(self.folder / f"{key}.npz", expected, most)
        except WorkerError:
            return None

    def check_writable(self) -> None:
        """See, before hours of work, that an answer can be kept.

        Raises:
            OutputError: the folder cannot be written.
        """
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryFile(dir=self.folder):
                pass
        except OSError as error:
            raise self._unwritable(error) from error

    def put(self, key: str, arrays: Arrays) -> None:
        """Store in one move, so that runs that share the folder never see half a file.

        Raises:
            OutputError: the folder cannot be written.
        """
        partial = self.folder / f"{key}.{uuid4().hex}.partial"
        try:
            with partial.open("wb") as file:
                np.savez_compressed(file, **dict(arrays))  # type: ignore[arg-type]
            partial.replace(self.folder / f"{key}.npz")
        except OSError as error:
            raise self._unwritable(error) from error
        finally:
            partial.unlink(missing_ok=True)

    def keep_log(self, key: str, text: str) -> Path:
        """Keep what a worker that failed has printed; the log of an earlier failure is replaced."""
        path = self.folder / f"{key}.log"
        try:
            path.write_text(text, encoding="utf-8")
        except OSError as error:
            raise self._unwritable(error) from error
        return path

    def _unwritable(self, error: OSError) -> OutputError:
        why = error.strerror or error
        return OutputError(f"cannot write {self.folder}: {why}; give another with segmenter.options.cache")


def cache_folder(chosen: str, name: str) -> Path:
    """Where answers of a worker are kept: below the chosen folder, or simart-kit in the user's cache."""
    base = os.environ.get("XDG_CACHE_HOME")
    home = Path(base) if base else Path.home() / ".cache"
    return (Path(chosen) if chosen else home / "simart-kit") / name


def answer_key(name: str, version: int, options: Mapping[str, Any], surface: Surface) -> str:
    """What an answer depends on, as 32 hexadecimal digits.

    Args:
        name: of the worker.
        version: of its adapter: raise it when the same answer would mean another thing.
        options: those that the answer depends on.
        surface: what is sent.
    """
    told = json.dumps([name, version, dict(options)], sort_keys=True)
    digest = hashlib.sha256(told.encode())
    for array in (surface.vertices, surface.faces):
        digest.update(f"{array.dtype}{array.shape}".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()[:32]
