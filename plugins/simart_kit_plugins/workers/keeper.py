"""Keeps watch over a program: ends it, with all that it started, once it is done or nobody waits for it.

A program of its own, run by its path; it imports the standard library only. Its arguments are the command to
run. Its stdin is a pipe: that closes when whoever asked no longer wants an answer, or is gone, even if it was
killed. What the program started and left behind becomes a child of this process (a Linux subreaper), so that
nothing gets away. Its exit status is the program's, or 128 plus the number of the signal that ended it.
"""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import suppress
from pathlib import Path

_SUBREAPER = 36  # PR_SET_CHILD_SUBREAPER of Linux
_PATIENCE = 5.0  # for what a signal does not end at once, such as a call into a driver [s]
_PAUSE = 0.01  # [s]


def main() -> None:
    """Run the command to its end, or until stdin closes."""
    ctypes.CDLL(None).prctl(_SUBREAPER, 1, 0, 0, 0)
    try:
        child = subprocess.Popen(sys.argv[1:], stdin=subprocess.DEVNULL)
    except OSError as error:
        os.write(2, f"cannot start {sys.argv[1]}: {error.strerror}\n".encode())
        os._exit(127)
    threading.Thread(target=_end_when_left, daemon=True).start()
    status = _waited(child.pid)
    _end_the_rest()
    os._exit(status)  # a normal exit would wait for the thread, which reads


def _waited(pid: int) -> int:
    """Exit status of a child; whatever else ends meanwhile is buried too."""
    while True:
        ended, status = os.waitpid(-1, 0)
        if ended == pid:
            code = os.waitstatus_to_exitcode(status)
            return code if code >= 0 else 128 - code


def _end_when_left() -> None:
    while os.read(0, 4096):
        pass
    while True:  # until the main thread has seen the program end
        _kill(_descendants())
        time.sleep(_PAUSE)


def _end_the_rest() -> None:
    latest = time.monotonic() + _PATIENCE
    while time.monotonic() < latest:
        with suppress(ChildProcessError):
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        left = _descendants()
        if not left:
            return
        _kill(left)
        time.sleep(_PAUSE)


def _kill(processes: list[int]) -> None:
    for pid in processes:
        with suppress(ProcessLookupError, PermissionError):
            os.kill(pid, signal.SIGKILL)


def _descendants() -> list[int]:
    """Ids of the processes that come from this one and still run."""
    children: dict[int, list[int]] = {}
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            with suppress(OSError):  # it has ended meanwhile
                # pid (name) state parent ...: the name may hold anything
                parent = int((folder / "stat").read_text(errors="replace").rpartition(")")[2].split()[1])
                children.setdefault(parent, []).append(int(folder.name))
    found = list(children.get(os.getpid(), ()))
    for pid in found:  # grows while it is gone through
        found += children.get(pid, ())
    return found


if __name__ == "__main__":
    main()
