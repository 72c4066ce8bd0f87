"""Tables of a run as CSV files, for people and plots."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

from simart_kit.errors import BadInputError, OutputError

LOG_FILE, EVALUATION_FILE = "log.csv", "evaluation.csv"


class CsvLog:
    """A CSV file whose first column is the step; every row is on the disk before training goes on.

    Args:
        path: of the file.
        names: of the columns.
        step: where the run goes on. Rows after it are dropped: their steps are done again.

    Attributes:
        last: the last row kept, or None.

    Raises:
        BadInputError: the file is no such table.
        OutputError: it cannot be written.
    """

    def __init__(self, path: Path, names: Sequence[str], step: int) -> None:
        self._path = path
        kept = [row for row in _rows(path, names) if int(row[0]) <= step] if path.exists() else []
        self.last = kept[-1] if kept else None
        partial = path.with_suffix(".partial")
        try:
            partial.write_text(_text([names, *kept]), encoding="utf-8")
            partial.replace(path)
        except OSError as error:
            raise OutputError(f"cannot write {path}: {error.strerror}") from error

    def add(self, values: Iterable[float]) -> None:
        """Write a row.

        Raises:
            OutputError: the file cannot be written.
        """
        row = [f"{value:.6g}" if isinstance(value, float) else str(value) for value in values]
        try:
            with self._path.open("a", encoding="utf-8", newline="") as file:
                file.write(_text([row]))
        except OSError as error:
            raise OutputError(f"cannot write {self._path}: {error.strerror}") from error


def _rows(path: Path, names: Sequence[str]) -> list[list[str]]:
    """The rows of a table without its head, and without a last one that was cut off."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
        table = list(csv.reader(line for line in lines if line.endswith("\n")))
        if not table or table[0] != list(names):
            raise ValueError("its head is another one")
        for step, *rest in table[1:]:
            if len([int(step), *map(float, rest)]) != len(names):
                raise ValueError(f"the row of step {step} is cut off")
    except (OSError, ValueError, csv.Error) as error:
        raise BadInputError(f"{path} is no table of such a run ({error}): move it away") from error
    return table[1:]


def _text(rows: Iterable[Sequence[str]]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerows(rows)
    return buffer.getvalue()
