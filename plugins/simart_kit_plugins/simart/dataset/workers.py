"""Jobs done by several processes at once, whose results come in the order of the jobs."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing.connection import wait
from typing import TypeVar

from simart_kit.errors import OutputError

J = TypeVar("J")
R = TypeVar("R")
# Results that wait for an earlier one, in jobs a process: bounds the memory.
_AHEAD = 2


def in_order(work: Callable[[J], R], jobs: Iterable[J], workers: int) -> Generator[R, None, None]:
    """The result of each job, in order, however many processes there are.

    Processes are fresh interpreters. They end with this one, however it ends, and at once when the iteration
    is left.

    Args:
        work: can be pickled, as jobs and results can.
        jobs: taken a few at a time, so there may be any number.
        workers: processes; with 1 this one does the work.

    Raises:
        OutputError: a process died, as those do that the system kills for want of memory.
    """
    if workers == 1:
        yield from map(work, jobs)
        return
    before = set(multiprocessing.active_children())
    pool = ProcessPoolExecutor(workers, multiprocessing.get_context("spawn"), _watch_parent)
    try:
        waiting: deque[Future[R]] = deque()
        for job in jobs:
            with _no_interrupts():
                waiting.append(pool.submit(work, job))
            if len(waiting) >= _AHEAD * workers:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    except BrokenProcessPool as error:
        raise OutputError(
            "a worker process died, perhaps for want of memory: give fewer --workers and run the same "
            "command again, it goes on where it stopped"
        ) from error
    finally:
        for process in set(multiprocessing.active_children()) - before:
            process.kill()
        pool.shutdown(cancel_futures=True)


def _watch_parent() -> None:
    """End this process when the one that started it ends without a word."""
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)


@contextmanager
def _no_interrupts() -> Iterator[None]:
    """A process started in the block never hears Ctrl-C: the parent alone decides what becomes of it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    previous = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, previous)
