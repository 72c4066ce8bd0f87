"""A row of the log as a line of text."""

from __future__ import annotations

from datetime import timedelta

from .plan import FinetunePlan
from .rows import LogRow


def row_line(row: LogRow, plan: FinetunePlan) -> str:
    """What is shown of a row, with the time left at the pace of the run so far."""
    left = timedelta(seconds=round(row.seconds / row.step * (plan.steps - row.step)))
    kinds = (
        ("cell", row.coordinate, row.right_coordinate),
        ("code", row.code, row.right_code),
        ("number", row.number, row.right_number),
        ("word", row.word, row.right_word),
    )
    each = "  ".join(f"{name} {loss:.2f} ({right:.0%})" for name, loss, right in kinds)
    return (
        f"step {row.step:>{len(str(plan.steps))}}/{plan.steps}  loss {row.loss:.3f}  {each}  "
        f"norm {row.norm:.2f}  rate {row.rate:.1e}  {row.rate_tokens:.0f} tokens/s  {left} left"
    )
