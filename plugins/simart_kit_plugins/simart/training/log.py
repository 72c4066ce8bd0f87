"""The log of a run: a CSV file for people and plots."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import astuple, dataclass, fields
from pathlib import Path

from simart_kit.errors import BadInputError, OutputError

LOG_FILE = "log.csv"


@dataclass(frozen=True)
class LogRow:
    """One line. Losses and IoU are of the batch of this step; use of the codebook is since the last row.

    Attributes:
        step: steps done.
        stage: 1 or 2.
        rate: learning rate of the step.
        total: weighted sum of the losses below.
        reconstruction: binary cross-entropy, mean over voxels.
        dice: 1 - dice overlap, mean over grids.
        codebook: squared distance of entries to features.
        commitment: the same distance, of features to entries.
        iou: intersection over union of voxels, mean over grids; 0..1.
        codes_used: codes that stood for geometry at least once.
        perplexity: how many equally frequent codes would have the same entropy.
        revived: entries that were replaced for want of use.
        seconds: of training, of all runs that led here [s].
    """

    step: int
    stage: int
    rate: float
    total: float
    reconstruction: float
    dice: float
    codebook: float
    commitment: float
    iou: float
    codes_used: int
    perplexity: float
    revived: int
    seconds: float


_NAMES = tuple(field.name for field in fields(LogRow))


class Log:
    """The CSV file of a run; every row is on the disk before training goes on.

    Args:
        path: of the file.
        step: where the run goes on. Rows after it are dropped: their steps are done again.

    Attributes:
        seconds: those of the last row kept [s].

    Raises:
        BadInputError: the file is no log.
        OutputError: it cannot be written.
    """

    def __init__(self, path: Path, step: int) -> None:
        self._path = path
        kept = [row for row in _rows(path) if int(row[0]) <= step] if path.exists() else []
        self.seconds = float(kept[-1][-1]) if kept else 0.0
        partial = path.with_suffix(".partial")
        try:
            partial.write_text(_text([_NAMES, *kept]), encoding="utf-8")
            partial.replace(path)
        except OSError as error:
            raise OutputError(f"cannot write the log {path}: {error.strerror}") from error

    def add(self, row: LogRow) -> None:
        """Write a row.

        Raises:
            OutputError: the file cannot be written.
        """
        values = [f"{value:.6g}" if isinstance(value, float) else str(value) for value in astuple(row)]
        try:
            with self._path.open("a", encoding="utf-8", newline="") as file:
                file.write(_text([values]))
        except OSError as error:
            raise OutputError(f"cannot write the log {self._path}: {error.strerror}") from error


def _rows(path: Path) -> list[list[str]]:
    """The rows of a log without its head, and without a last one that was cut off."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
        table = list(csv.reader(line for line in lines if line.endswith("\n")))
        if not table or tuple(table[0]) != _NAMES:
            raise ValueError("its head is another one")
        for step, *rest in table[1:]:
            if len([int(step), *map(float, rest)]) != len(_NAMES):
                raise ValueError(f"the row of step {step} is cut off")
    except (OSError, ValueError, csv.Error) as error:
        raise BadInputError(f"{path} is no log of a training run ({error}): move it away") from error
    return table[1:]


def _text(rows: Iterable[Sequence[str]]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerows(rows)
    return buffer.getvalue()
