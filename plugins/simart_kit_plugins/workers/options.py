"""Options of every segmenter that runs a program of others."""

from __future__ import annotations

from pydantic import Field

import simart_kit


class WorkerOptions(simart_kit.Options):
    """Where the program is, how long it may take, and where its answers are kept."""

    python: str = Field(
        default="", description="Its python interpreter; empty: as its environment variable says."
    )
    folder: str = Field(default="", description="Its checkout; empty: as its environment variable says.")
    timeout: float = Field(default=1800.0, gt=0, le=1e6, description="Longest time that it may take [s].")
    cache: str = Field(
        default="", description="Folder for its answers; empty: simart-kit in $XDG_CACHE_HOME or ~/.cache."
    )
