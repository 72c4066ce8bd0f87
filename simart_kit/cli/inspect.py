"""`simart-kit inspect`."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from ..errors import BadInputError, SimartKitError
from .options import Folder, Verbose


def inspect(folder: Folder, verbose: Verbose = False) -> None:
    """Open a conversion's recording in the rerun viewer."""
    recording = find_recording(folder)
    if sys.platform == "linux" and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise BadInputError(
            f"there is no display to open a viewer on: run `rerun {recording.name}` on a machine with one; "
            f"the recording is {recording}"
        )
    # The viewer would listen on all interfaces.
    viewer = [sys.executable, "-m", "rerun", "--bind", "127.0.0.1", str(recording)]
    status = subprocess.run(viewer, check=False).returncode
    if status != 0:
        raise SimartKitError(f"the rerun viewer ended with status {status}")


def find_recording(folder: Path) -> Path:
    """The recording of a run in its folder, or of its failure; raises BadInputError when there is none."""
    for place in (folder, folder / "failed"):
        recordings = sorted(place.glob("*.rrd"))
        if recordings:
            return max(recordings, key=lambda path: path.stat().st_mtime)
    raise BadInputError(
        f"{folder} has no recording (.rrd): give the output folder of a run without --no-record"
    )
