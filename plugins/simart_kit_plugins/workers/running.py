"""Runs a program of others for a limited time; its last words are kept, and nothing stays behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from simart_kit.errors import BadInputError

_KEEPER = Path(__file__).with_name("keeper.py")
_PATIENCE = 10.0  # for the keeper to end what it keeps [s]
_MOST_OUTPUT = 1 << 20  # of what is printed, the last bytes are kept
# Of this process's python: they would lead another astray.
_OURS = ("PYTHONHOME", "PYTHONPATH", "PYTHONSTARTUP", "PYTHONSAFEPATH", "__PYVENV_LAUNCHER__")


@dataclass(frozen=True)
class Ended:
    """How a program ended.

    Attributes:
        status: its exit status, 128 + n when signal n ended it; None: it took too long and was stopped.
        output: the last of what it printed, on stdout and stderr.
    """

    status: int | None
    output: str


def run(command: Sequence[str], folder: Path, seconds: float) -> Ended:
    """Run a program to its end; it and all that it started are gone when this returns or raises.

    That holds for an interrupt (Ctrl-C), too, and when this process itself is killed.

    Args:
        command: the program and its arguments.
        folder: where it runs.
        seconds: after which it is stopped.

    Raises:
        BadInputError: this is not Linux.
    """
    if sys.platform != "linux":
        raise BadInputError(
            "programs in other environments are run on Linux only (on Windows, WSL is one): "
            "run it there, and read the files that it writes"
        )
    with _kept(command, folder) as (keeper, words):
        try:
            status: int | None = keeper.wait(seconds)
        except subprocess.TimeoutExpired:
            status = None
    return Ended(status, words.text())


class _LastWords:
    """The last bytes that a program prints, read as they come: a full pipe would stop it."""

    def __init__(self, file: int) -> None:
        self._file, self._bytes = file, b""
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def text(self) -> str:
        """All that was kept, once the program is gone."""
        self._thread.join(_PATIENCE)
        return self._bytes.decode(errors="replace")

    def _read(self) -> None:
        with suppress(OSError):
            while some := os.read(self._file, 1 << 16):
                self._bytes = (self._bytes + some)[-_MOST_OUTPUT:]


@contextmanager
def _kept(command: Sequence[str], folder: Path) -> Iterator[tuple[subprocess.Popen[bytes], _LastWords]]:
    """The running keeper of a command; stopped at the end, whatever happens."""
    keeper = subprocess.Popen(
        [sys.executable, "-I", "-S", str(_KEEPER), *command],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        cwd=folder,
        env={key: value for key, value in os.environ.items() if key not in _OURS} | {"PYTHONUNBUFFERED": "1"},
        start_new_session=True,  # so that Ctrl-C reaches this process alone
    )
    assert keeper.stdin is not None
    assert keeper.stdout is not None
    try:
        words = _LastWords(keeper.stdout.fileno())
        yield keeper, words
    finally:
        keeper.stdin.close()
        try:
            keeper.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            _kill_group(keeper.pid)
            keeper.wait()
        if keeper.returncode < 0:  # the keeper itself was killed
            _kill_group(keeper.pid)
        words.text()
        keeper.stdout.close()


def _kill_group(leader: int) -> None:
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(leader, signal.SIGKILL)
