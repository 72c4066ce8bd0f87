"""A second core: a process of its own that calls functions while this one goes on."""

from __future__ import annotations

import pickle
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, ParamSpec, Protocol, TypeVar, runtime_checkable

from .asset import Asset
from .machine import usable_cores
from .stages import Modifier

P = ParamSpec("P")
T = TypeVar("T")
_WORKER = (sys.executable, "-P", "-m", f"{__package__}.beside_worker")


class Beside:
    """Calls functions in another process, one after the other, if there are cores for it.

    The process is there from the start, so that what it imports is too. Use it as a context: leaving ends it.

    Args:
        wanted: whether there shall be a process at once, or not before `start`.
        worker: command that answers as `beside_worker` does.
    """

    def __init__(self, wanted: bool = True, *, worker: tuple[str, ...] = _WORKER) -> None:
        self._worker = worker
        self._process: subprocess.Popen[bytes] | None = None
        if wanted:
            self.start()
        self._talking = ThreadPoolExecutor(1)  # starts no thread before there is something to say
        self._asked: list[Future[Any]] = []
        self._behind: list[Later[Any]] = []

    def start(self) -> None:
        """Have a process, if there are cores for it, unless there is one."""
        if self._process is None and usable_cores() > 1:
            self._process = _started(self._worker)

    @property
    def helps(self) -> bool:
        """Whether there is a process."""
        return self._process is not None

    def __enter__(self) -> Beside:
        return self

    def __exit__(self, *_: object) -> None:
        if self._process is not None:
            with self._process as process:
                process.kill()
                self._talking.shutdown(cancel_futures=True)
                assert process.stdin is not None
                with suppress(OSError):  # what it had not read yet
                    process.stdin.close()

    def ask(self, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> Later[T]:
        """Let a function be called there, after those that were asked for before, or here if that is sooner.

        Args:
            function: of a module that can be imported.
            *args: as they are now; whatever can be pickled.
            **kwargs: the same.
        """
        later = self._planned(partial(function, *args, **kwargs))
        later.begin()
        self.go_on()
        return later

    def ask_behind(self, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> Later[T]:
        """As `ask`, but what is asked for next comes first: for what takes long, and is not wanted soon."""
        later = self._planned(partial(function, *args, **kwargs))
        self._behind.append(later)
        return later

    def go_on(self) -> None:
        """Let what waits behind the next question begin, for there is none."""
        for waiting in self._behind:
            waiting.begin()

    def _planned(self, here: Callable[[], T]) -> Later[T]:
        if self._process is None:
            return Later(here, None)
        try:
            question = pickle.dumps(here, pickle.HIGHEST_PROTOCOL)
        except (pickle.PicklingError, AttributeError, TypeError):  # a function or a value of the caller's own
            return Later(here, None)
        return Later(here, partial(self._sent, self._process, question))

    def _sent(self, process: subprocess.Popen[bytes], question: bytes) -> _Turn:
        """The answer to come, behind those that are not here yet."""
        before = tuple(answer for answer in self._asked if not answer.done())
        turn = _Turn(self._talking.submit(_answer, process, question), before)
        self._asked = [*before, turn.answer]
        return turn


@dataclass(frozen=True, eq=False)
class _Turn:
    """A question's place among those that another process is asked.

    Attributes:
        answer: to come.
        before: answers to what it was asked for before.
    """

    answer: Future[Any]
    before: tuple[Future[Any], ...]

    def given_up(self) -> bool:
        """Whether it is no more to be answered there, for it still waits for those before it."""
        waits = not all(answer.done() for answer in self.before)
        return self.answer.cancelled() or (waits and self.answer.cancel())


class Later(Generic[T]):
    """What a function returns that another process may be calling.

    Args:
        here: calls it in this process.
        there: asks for it there; None where nobody calls it.
    """

    def __init__(self, here: Callable[[], T], there: Callable[[], _Turn] | None) -> None:
        self._here, self._there = here, there
        self._turn: _Turn | None = None

    @property
    def runs(self) -> bool:
        """Whether it was asked for there, and the answer is not here yet."""
        return self._turn is not None and not self._turn.answer.done()

    def begin(self) -> None:
        """Ask for it there, unless that is done."""
        if self._there is not None and self._turn is None:
            self._turn = self._there()

    def result(self) -> T:
        """What it returns, or raises.

        It is done now where the other process was not asked, is still at what it was asked for before, or
        could not do it.
        """
        self._there = None  # it is wanted now: nobody need begin it any more
        turn = self._turn
        if turn is None or turn.given_up() or isinstance(turn.answer.exception(), _EndedError):
            return self._here()
        answer: T = turn.answer.result()
        return answer


class _EndedError(Exception):
    """The process is no more: it was killed, or what it was asked for raised something."""


@runtime_checkable
class HelpedModifier(Protocol):
    """A modifier that can let another process do some of what takes long."""

    def modify_beside(self, asset: Asset, beside: Beside) -> Asset:
        """The same asset as `modify` gives."""


@runtime_checkable
class EarlyModifier(Protocol):
    """A modifier that can have another process begin while those before it still correct joints."""

    def begun(self, asset: Asset, beside: Beside) -> Modifier:
        """One that makes the same of any asset, and does so sooner if surface and parts stay as they are."""


def begun_by(modifier: Modifier, asset: Asset, beside: Beside) -> Modifier:
    """The modifier, which has begun if it can and there is another process."""
    if beside.helps and isinstance(modifier, EarlyModifier):
        return modifier.begun(asset, beside)
    return modifier


def modify_by(modifier: Modifier, asset: Asset, beside: Beside) -> Asset:
    """What a modifier makes of an asset, with help if it takes any."""
    if isinstance(modifier, HelpedModifier):
        return modifier.modify_beside(asset, beside)
    return modifier.modify(asset)


def _started(worker: tuple[str, ...]) -> subprocess.Popen[bytes] | None:
    """The process, in a session of its own, for an interrupt is the caller's to answer; None for no room."""
    pipe = subprocess.PIPE
    try:
        return subprocess.Popen(
            worker, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, start_new_session=True
        )
    except OSError:
        return None


def _answer(process: subprocess.Popen[bytes], question: bytes) -> Any:
    assert process.stdin is not None
    assert process.stdout is not None
    try:
        process.stdin.write(question)
        process.stdin.flush()
        return pickle.load(process.stdout)
    except (OSError, EOFError, ValueError, pickle.UnpicklingError) as error:
        raise _EndedError from error


ALONE = Beside(wanted=False)
"""Nobody: what it is asked for is done in this process, once its result is wanted."""
