"""Numbers as people read them, in tables and on the page."""

from __future__ import annotations

import math

from .protocols import Metric


def number(value: float | None, *, sign: bool = False) -> str:
    """A number to three places, or to two digits where that would show 0 for something else; "-" for None.

    Args:
        value: the number.
        sign: whether to write "+" before what is not below 0.
    """
    if value is None:
        return "-"
    plus = "+" if sign else ""
    if not math.isfinite(value):
        return f"{value:{plus}}"
    if value != 0 and abs(value) < 0.0005:
        return f"{value:{plus}.1e}"
    return f"{value:{plus}.3f}" if abs(value) < 1000 else f"{value:{plus}.4g}"


def titled(metric: Metric) -> str:
    """The heading of a metric with its unit, such as "Axis [rad]"."""
    return f"{metric.title} [{metric.unit}]" if metric.unit else metric.title


def counted(count: int, noun: str) -> str:
    """A count and its noun, such as "1 object" or "2 objects"."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def listed(names: tuple[str, ...] | list[str], most: int = 5) -> str:
    """Names with commas; of many, the first few and how many more there are."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more
