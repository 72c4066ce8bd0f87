"""What `train vqvae` says while it works, on stderr."""

from __future__ import annotations

import sys
from datetime import timedelta
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..training.config import TrainingConfig
    from ..training.evaluation import Evaluation
    from ..training.log import LogRow

# Lines of progress where stderr is no terminal.
_LINES = 10


class Display:
    """A line for each row of the log, and how far other tasks have come.

    Args:
        quiet: say nothing.
    """

    def __init__(self, quiet: bool) -> None:
        self._quiet = quiet
        self._terminal = sys.stderr.isatty()
        self._begun: LogRow | None = None

    def progress(self, task: str, done: int, of: int) -> None:
        """How far a task has come: one line that changes on a terminal, a few lines elsewhere."""
        if self._quiet:
            return
        last = done == of
        if self._terminal:
            print(f"\r{task}: {done} of {of}", end="\n" if last else "", file=sys.stderr, flush=True)
        elif last or done * _LINES // of != (done - 1) * _LINES // of:
            print(f"{task}: {done} of {of}", file=sys.stderr, flush=True)

    def say(self, text: str) -> None:
        """A line."""
        if not self._quiet:
            print(text, file=sys.stderr, flush=True)

    def row(self, row: LogRow, config: TrainingConfig, codes: int) -> None:
        """A line for a row of the log, with the time left once a second row tells the pace.

        Args:
            row: to show.
            config: of the run.
            codes: how many codes stand for geometry.
        """
        self._begun = self._begun or row
        steps, seconds = row.step - self._begun.step, row.seconds - self._begun.seconds
        left = f"  {_clock(seconds / steps * (config.steps - row.step))} left" if steps else ""
        self.say(
            f"step {row.step:>{len(str(config.steps))}}/{config.steps} stage {row.stage}"
            f"  loss {row.total:.4f} (bce {row.reconstruction:.4f} codebook {row.codebook:.4f})"
            f"  iou {row.iou:.3f}  codes {row.codes_used}/{codes} perplexity {row.perplexity:.0f}"
            f" revived {row.revived}  rate {row.rate:.1e}  {_clock(row.seconds)}{left}"
        )


def judged(evaluation: Evaluation) -> str:
    """A model's scores on one line."""
    use = evaluation.usage
    return (
        f"IoU {evaluation.iou:.4f}, CD {evaluation.cd_squared:.2e}, MSE {evaluation.mse:.2e}, "
        f"{use.used} codes used, perplexity {use.perplexity:.0f}"
    )


def _clock(seconds: float) -> str:
    return str(timedelta(seconds=round(seconds)))


def advice(run: Path, checkpoint: Path | None) -> str:
    """What to do with a run that was stopped; `checkpoint` is its last one."""
    if checkpoint is None:
        return f"{run} has no checkpoint yet: the same command begins again"
    return f"{run} has a checkpoint, {checkpoint.name}: the same command with --resume goes on from it"
