"""Asks a program of others, unless its answer is known; what it failed with is one line and a log."""

from __future__ import annotations

import tempfile
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Generic, TypeVar

from .array_files import Arrays, Expected
from .caching import AnswerCache
from .failures import WorkerError, last_lines, reason
from .running import run

T = TypeVar("T")
_ROOM = 16 << 20  # bytes of an answer, whatever the mesh
_ROOM_PER_FACE = 512  # bytes


@dataclass(frozen=True)
class Call:
    """How a program is run.

    Attributes:
        command: program and arguments.
        folder: where it runs.
    """

    command: Sequence[str]
    folder: Path


class Program(ABC, Generic[T]):
    """A program with what it is asked about one object.

    Attributes:
        name: for messages.
        expected: the arrays that an answer is, by name.
    """

    name: ClassVar[str]
    expected: ClassVar[Mapping[str, Expected]]

    @abstractmethod
    def prepare(self, place: Path) -> Call:
        """Write what it needs into an empty folder; raise BadInputError where it is not installed."""

    @abstractmethod
    def collect(self, place: Path, most: int) -> Arrays:
        """Read what it wrote there, no more than so many bytes; raise WorkerError where that is no answer."""

    @abstractmethod
    def understand(self, arrays: Arrays) -> T:
        """Make a value of an answer; raise WorkerError where it makes no sense."""


def answer(program: Program[T], key: str, faces: int, seconds: float, cache: AnswerCache) -> T:
    """What a program says, from the cache if it is there and can be understood.

    Args:
        program: with what it is asked.
        key: what the answer depends on.
        faces: of what is sent; how long an answer may be follows.
        seconds: how long it may take.
        cache: of answers.

    Raises:
        BadInputError: it is not installed.
        WorkerError: it failed, took too long or answered nonsense.
        OutputError: the cache cannot be written.
    """
    most = _ROOM + _ROOM_PER_FACE * faces
    known = cache.get(key, program.expected, most)
    if known is not None:
        try:
            return program.understand(known)
        except WorkerError:
            pass  # damage that shows only now: it is asked again
    cache.check_writable()
    arrays, value = _asked(program, key, most, seconds, cache)
    cache.put(key, arrays)
    return value


def _asked(program: Program[T], key: str, most: int, seconds: float, cache: AnswerCache) -> tuple[Arrays, T]:
    with tempfile.TemporaryDirectory(prefix="simart-kit-", ignore_cleanup_errors=True) as folder:
        place = Path(folder)
        call = program.prepare(place)
        ended = run(call.command, call.folder, seconds)
        try:
            if ended.status != 0:
                raise WorkerError(reason(ended, seconds))
            arrays = program.collect(place, most)
            return arrays, program.understand(arrays)
        except WorkerError as error:
            log, said = cache.keep_log(key, ended.output), last_lines(ended.output)
            printed = f"; it printed: {said}" if said else ""
            raise WorkerError(f"{program.name} {error}{printed}; all of that is in {log}") from None
