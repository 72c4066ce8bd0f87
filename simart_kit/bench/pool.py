"""One child process a job, so that what breaks one job ends neither the others nor the run."""

from __future__ import annotations

import faulthandler
import multiprocessing
import os
import signal
import threading
import time
from collections import deque
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing.connection import wait
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from ..plugins import DEFAULT_PLUGINS

if TYPE_CHECKING:
    from multiprocessing.context import ForkServerContext, SpawnContext
    from multiprocessing.process import BaseProcess

J = TypeVar("J")
# Imported once, in the process that children are copies of.
_PRELOAD = (
    "embreex.rtcore_scene",
    "lxml.etree",
    "mujoco",
    "networkx",
    "PIL.Image",
    "scipy.optimize",
    "scipy.sparse.csgraph",
    "scipy.spatial",
    "trimesh",
    "typer",
    "simart_kit.bench.worker",
    "simart_kit.bench.formats",
    "simart_kit.bench.protocols",
    "simart_kit.bench.pictures",
    "simart_kit.pipeline",
    "simart_kit.render",
    *(name.partition(":")[0] for name in DEFAULT_PLUGINS),
)
# Sums of several threads depend on their number: with one, numbers do not depend on the machine.
_ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1", "VECLIB_MAXIMUM_THREADS": "1"}


@dataclass(frozen=True)
class _Child(Generic[J]):
    """A process at work, and when it has to be done [s of `time.monotonic`]."""

    job: J
    process: BaseProcess
    deadline: float


def run_each(
    work: Callable[[J], None],
    queue: deque[J],
    *,
    log: Callable[[J], Path],
    workers: int = 1,
    timeout: float = 600.0,
) -> Generator[tuple[J, str], None, None]:
    """Do every job of a queue in a process of its own; jobs may be added while this goes on.

    Children start as copies of a process that has loaded what they need. They end with this process, however
    it ends, and all at once when the iteration is left.

    Args:
        work: a function of a module; with one job it is called in a child.
        queue: emptied from the left.
        log: the file that gets what a job's child prints; its folder must exist.
        workers: how many children at a time. Of several, each computes in one thread.
        timeout: longest time of a job [s]; 0 means no limit.

    Yields:
        A job whose child has ended, and why it ended before its work did, or "".
    """
    context = _context()
    running: dict[int, _Child[J]] = {}
    try:
        while queue or running:
            while queue and len(running) < workers:
                job = queue.popleft()
                child = _started(context, work, job, log(job), workers > 1, timeout)
                running[child.process.sentinel] = child
            for sentinel in _ended(running):
                child = running.pop(sentinel)
                yield child.job, _reaped(child.process)
            for child in _late(running):
                running.pop(child.process.sentinel)
                _kill(child.process)
                yield child.job, f"took longer than {timeout:g} s"
    finally:
        for child in running.values():
            _kill(child.process)


def _context() -> ForkServerContext | SpawnContext:
    """Copies of a process without threads where the system can, fresh interpreters elsewhere."""
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    from multiprocessing import forkserver

    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(list(_PRELOAD))
    with _environment(_ONE_THREAD), _no_interrupts():
        forkserver.ensure_running()
    return context


def _started(
    context: ForkServerContext | SpawnContext,
    work: Callable[[J], None],
    job: J,
    log: Path,
    one_thread: bool,
    timeout: float,
) -> _Child[J]:
    process = context.Process(target=_child, args=(work, job, log, one_thread))
    with _environment(_ONE_THREAD):
        process.start()
    return _Child(job, process, time.monotonic() + (timeout or float("inf")))


def _ended(running: dict[int, _Child[Any]]) -> list[int]:
    """Sentinels of children that have ended, after waiting for one or for the first deadline."""
    left = min(child.deadline for child in running.values()) - time.monotonic()
    ready = wait(list(running), None if left == float("inf") else max(left, 0.0))
    return [sentinel for sentinel in running if sentinel in ready]


def _late(running: dict[int, _Child[J]]) -> list[_Child[J]]:
    now = time.monotonic()
    return [child for child in running.values() if child.deadline <= now]


def _reaped(process: BaseProcess) -> str:
    """How a process that is no more ended; "" for well."""
    process.join()
    status = process.exitcode or 0
    process.close()
    if status == 0:
        return ""
    if status > 0:
        return f"ended with exit status {status}"
    hint = ": killed, perhaps for want of memory" if status == -9 else ""
    return f"crashed (signal {-status}{hint})"


def _kill(process: BaseProcess) -> None:
    """End a process, and those it started where the system has groups of processes."""
    if hasattr(os, "killpg") and process.pid is not None:
        with suppress(ProcessLookupError, PermissionError):  # it has not got round to its own group
            os.killpg(process.pid, signal.SIGKILL)
    process.kill()
    process.join()
    process.close()


def _child(work: Callable[[J], None], job: J, log: Path, one_thread: bool) -> None:
    """What a child does."""
    if hasattr(os, "setpgid"):
        os.setpgid(0, 0)  # a key pressed in the terminal is for the parent alone
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
    threading.Thread(target=_end_with_parent, daemon=True).start()
    if one_thread:
        os.environ["OMP_NUM_THREADS"] = "1"  # torch reads it when it is imported
    _print_to(log)
    work(job)


def _end_with_parent() -> None:
    """An orphan would write into the folder of the run that follows."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        if hasattr(os, "killpg"):
            os.killpg(os.getpid(), signal.SIGKILL)
        os._exit(1)


def _print_to(log: Path) -> None:
    """Whatever is printed, by native code too, and where a crash happened, goes to a file."""
    handle = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    for stream in (1, 2):
        os.dup2(handle, stream)
    os.close(handle)
    faulthandler.enable(file=2)


@contextmanager
def _environment(values: dict[str, str]) -> Iterator[None]:
    """Variables for the processes started in the block; what the user has set stays."""
    added = {key: value for key, value in values.items() if key not in os.environ}
    os.environ.update(added)
    try:
        yield
    finally:
        for key in added:
            del os.environ[key]


@contextmanager
def _no_interrupts() -> Iterator[None]:
    """A process started in the block does not hear Ctrl-C, which would end it with a traceback."""
    previous = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, previous)
