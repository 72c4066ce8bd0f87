"""Going on with a run: which rows still stand, and what becomes of those that do not."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

from .fingerprint import fingerprint
from .formats import TruthFormat
from .numbers import counted, listed
from .rows import Row, damaged_rows, read_rows, set_aside
from .worker import System


@dataclass(frozen=True)
class Standing:
    """What a folder has of a run that is gone on with.

    Attributes:
        rows: by name, those whose files are as they were.
        changed: names of objects that are to be done again because their files, or those of their
            prediction, have changed.
        warnings: what was left out of the results.
    """

    rows: Mapping[str, Row]
    changed: tuple[str, ...]
    warnings: tuple[str, ...]


def standing(
    run: Path, system: System, truths: Mapping[str, tuple[TruthFormat, Path]], chosen: Collection[str]
) -> Standing:
    """Compare the rows of a run with the files of today.

    Rows that do not stand and are not done again now are set aside, so that results hold no mixture.

    Args:
        run: folder of the run.
        system: what is scored.
        truths: all objects of the data set.
        chosen: names of those that the run is about to do.
    """
    rows = {row.name: row for row in read_rows(run)}
    gone = [name for name in rows if name not in truths]
    stand = {n: row for n, row in rows.items() if n in truths and _stands(row, system, truths[n][1])}
    changed = [name for name in rows if name in truths and name not in stand]
    outdated = [name for name in changed if name not in chosen]
    damaged = [name for name in damaged_rows(run) if name not in chosen]
    for name in (*gone, *outdated, *damaged):
        set_aside(run, name)
    return Standing(
        stand,
        tuple(name for name in changed if name in chosen),
        (
            *_left_out(gone, "no longer in DATA"),
            *_left_out(outdated, "of files that have changed since: give no --only to do them again"),
            *_left_out(damaged, "damaged: give no --only to do them again"),
        ),
    )


def _stands(row: Row, system: System, path: Path) -> bool:
    return (row.truth_sha256, row.system_sha256) == (fingerprint(path), system.fingerprint(row.name))


def _left_out(names: list[str], why: str) -> list[str]:
    if not names:
        return []
    return [f"left out {counted(len(names), 'row')} ({listed(names)}), {why}"]
