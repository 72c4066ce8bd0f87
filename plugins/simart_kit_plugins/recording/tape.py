"""The recording file being written: static values, and values over the sweep."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.recipe import Recipe

APPLICATION = "simart-kit"
TIMELINE = "sweep"


class Tape:
    """A rerun recording stream that raises on misuse, where rerun itself would only warn."""

    def __init__(self, stream: Any) -> None:
        self._stream = stream

    def static(self, path: str, *archetypes: Any) -> None:
        """Log values that hold at all times.

        Stage results have no time: on another timeline than the sweep they would be invisible while it plays.
        """
        for archetype in archetypes:
            self._stream.log(path, archetype, static=True, strict=True)

    def over_sweep(self, path: str, seconds: FloatArray, columns: Any) -> None:
        """Log a column of values at (T,) times [s] on the sweep timeline."""
        import rerun as rr

        # Whole microseconds: pyarrow hands finer times to Python only where pandas is installed.
        stamps = np.round(seconds * 1e6).astype("timedelta64[us]")
        self._stream.send_columns(path, [rr.TimeColumn(TIMELINE, duration=stamps)], columns, strict=True)


@contextmanager
def recording(path: Path, name: str, recipe: Recipe, blueprint: Any) -> Iterator[Tape]:
    """Open a recording file that shows `blueprint`; it is complete on disk when the context ends."""
    import rerun as rr
    from rerun.error_utils import catch_and_log_exceptions

    # Properties carry the time of the run, which would make two recordings of one input differ.
    stream = rr.RecordingStream(APPLICATION, recording_id=recording_id(name, recipe), send_properties=False)
    try:
        with catch_and_log_exceptions(strict=True):
            stream.save(path)
            # Active, not only the default: a viewer that is open would keep the layout of another run.
            stream.send_blueprint(blueprint, make_active=True, make_default=True)
            stream.send_recording_name(name)
            yield Tape(stream)
    finally:
        stream.flush()
        stream.disconnect()


def recording_id(name: str, recipe: Recipe) -> str:
    """The same for the same name and recipe, so that a new run replaces the old one in an open viewer."""
    text = json.dumps([name, recipe.table()], sort_keys=True)
    return f"{name}-{hashlib.sha256(text.encode()).hexdigest()[:16]}"
