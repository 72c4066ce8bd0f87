"""A second core: a process of its own that calls functions while this one goes on."""

from __future__ import annotations

import pickle
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
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
        """Let a function be called there, after those that were asked for before.

        Args:
            function: of a module that can be imported.
            *args: as they are now; whatever can be pickled.
            **kwargs: the same.
        """
        later = self._planned(partial(function, *args, **kwargs))
        if not any(waiting.runs for waiting in self._behind):  # that takes long: this process is faster
            for planned in (later, *self._behind):
                planned.begin()
        return later

    def ask_behind(self, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> Later[T]:
        """As `ask`, but what is asked for next comes first: for what takes long, and is not wanted soon."""
        later = self._planned(partial(function, *args, **kwargs))
        self._behind.append(later)
        return later

    def _planned(self, here: Callable[[], T]) -> Later[T]:
        if self._process is None:
            return Later(here, None)
        try:
            question = pickle.dumps(here, pickle.HIGHEST_PROTOCOL)
        except (pickle.PicklingError, AttributeError, TypeError):  # a function or a value of the caller's own
            return Later(here, None)
        return Later(here, partial(self._talking.submit, _answer, self._process, question))


class Later(Generic[T]):
    """What a function returns that another process may be calling.

    Args:
        here: calls it in this process.
        there: asks for it there; None where nobody calls it.
    """

    def __init__(self, here: Callable[[], T], there: Callable[[], Future[T]] | None) -> None:
        self._here, self._there = here, there
        self._answer: Future[T] | None = None

    @property
    def runs(self) -> bool:
        """Whether it was asked for there, and the answer is not here yet."""
        return self._answer is not None and not self._answer.done()

    def begin(self) -> None:
        """Ask for it there, unless that is done."""
        if self._there is not None and self._answer is None:
            self._answer = self._there()

    def result(self) -> T:
        """What it returns, or raises; done now where the other process was not asked, or could not do it."""
        if self._answer is None or isinstance(self._answer.exception(), _EndedError):
            return self._here()
        return self._answer.result()


class _EndedError(Exception):
    """The process is no more: it was killed, or what it was asked for raised something."""


@runtime_checkable
class HelpedModifier(Protocol):
    """A modifier that can let another process do some of what takes long."""

    def modify_beside(self, asset: Asset, beside: Beside) -> Asset:
        """The same asset as `modify` gives."""


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
