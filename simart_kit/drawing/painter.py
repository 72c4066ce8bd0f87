"""The preview, drawn by a second core in a process of its own while formats are written and checked."""

from __future__ import annotations

import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

from .. import render
from ..asset import Asset
from ..machine import usable_cores

_WORKER = (sys.executable, "-P", "-m", f"{__package__}.painter_worker")
_MANY = 5_000  # faces from which on drawing takes longer than the start of a process


class Painter:
    """Draws one preview; for a mesh of many faces beside what the caller does until it asks for it.

    The process is there from the start, so that what it imports is too. Use it as a context: leaving ends it.

    Args:
        faces: how many the mesh has.
        alone: without a process in any case, as for a recording: it shows the preview even where a format
            fails, so that this comes first.
        worker: command that answers as `painter_worker` does.
    """

    def __init__(self, faces: int, *, alone: bool = False, worker: tuple[str, ...] = _WORKER) -> None:
        beside = not alone and faces >= _MANY and usable_cores() > 1
        self._process = _started(worker) if beside else None

    def __enter__(self) -> Painter:
        return self

    def __exit__(self, *_: object) -> None:
        if self._process is not None:
            with self._process as process:
                process.kill()

    def begin(self, folder: Path) -> bool:
        """Let `folder/preview.png` be drawn of the asset saved there; False where nobody stands by."""
        if self._process is None:
            return False
        assert self._process.stdin is not None
        with suppress(OSError), self._process.stdin as told:  # one that ended is seen by `finish`
            told.write(os.fsencode(folder.resolve()))
        return True

    def finish(self, asset: Asset, folder: Path) -> None:
        """See to it that `folder/preview.png` is there.

        Wait for the process, if one has begun; what it could not draw is drawn now, or says why not.
        """
        if self._process is None or self._process.wait() != 0:
            render.write_preview(asset, folder / "preview.png")


def _started(worker: tuple[str, ...]) -> subprocess.Popen[bytes] | None:
    """The process, in a session of its own, for an interrupt is the caller's to answer; None for no room."""
    quiet = subprocess.DEVNULL
    try:
        return subprocess.Popen(
            worker, stdin=subprocess.PIPE, stdout=quiet, stderr=quiet, start_new_session=True
        )
    except OSError:
        return None
