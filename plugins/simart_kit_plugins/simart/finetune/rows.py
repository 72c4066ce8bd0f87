"""What is told of a run while it goes on."""

from __future__ import annotations

import time
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from .kinds import KINDS

if TYPE_CHECKING:
    from torch import Tensor


@dataclass(frozen=True)
class LogRow:
    """One line; losses are means over the steps since the last one.

    Attributes:
        step: steps done.
        rate: learning rate of the step.
        loss: weighted mean, what is minimised.
        coordinate: cross-entropy of cells that the model chose.
        code: of their codes.
        number: of digits.
        word: of names, types and where lists end.
        right_coordinate: share of cells that would have been right.
        right_code: of codes.
        right_number: of digits.
        right_word: of the rest.
        norm: of the last step's gradient, before clipping.
        tokens: read so far, of all processes, without padding.
        rate_tokens: tokens a second since the last row.
        seconds: of training, of all runs that led here.
    """

    step: int
    rate: float
    loss: float
    coordinate: float
    code: float
    number: float
    word: float
    right_coordinate: float
    right_code: float
    right_number: float
    right_word: float
    norm: float
    tokens: int
    rate_tokens: float
    seconds: float


LOG_COLUMNS = tuple(field.name for field in fields(LogRow))


class Window:
    """Sums over the steps since the last row.

    Args:
        tokens: read by the runs that led here.
        seconds: that they took.
    """

    def __init__(self, tokens: int, seconds: float) -> None:
        self.tokens = tokens
        self._seconds, self._from = seconds, time.perf_counter()
        self._sums: Tensor | None = None

    def add(self, sums: Tensor) -> None:
        """Add a step's sums: loss, weight, tokens, then losses, counts and hits by kind."""
        self._sums = sums if self._sums is None else self._sums + sums
        self.tokens += int(sums[2])

    def close(self, step: int, rate: float, norm: float) -> LogRow:
        """The row, and begin the next."""
        now = time.perf_counter()
        spent = now - self._from
        self._seconds, self._from = self._seconds + spent, now
        if self._sums is None:
            raise ValueError("a row of the log needs a step")
        loss, weight, tokens, *rest = self._sums.double().tolist()
        kinds = len(KINDS)
        counts = [max(count, 1.0) for count in rest[kinds : 2 * kinds]]
        means = [value / count for value, count in zip(rest[:kinds], counts, strict=True)]
        right = [value / count for value, count in zip(rest[2 * kinds :], counts, strict=True)]
        self._sums = None
        coordinate, code, number, word = means
        right_coordinate, right_code, right_number, right_word = right
        return LogRow(
            step=step,
            rate=rate,
            loss=loss / max(weight, 1e-9),
            coordinate=coordinate,
            code=code,
            number=number,
            word=word,
            right_coordinate=right_coordinate,
            right_code=right_code,
            right_number=right_number,
            right_word=right_word,
            norm=norm,
            tokens=self.tokens,
            rate_tokens=tokens / spent,
            seconds=self._seconds,
        )
