"""Protocols, metrics and formats in words: for the page and as Markdown for the documentation."""

from __future__ import annotations

import inspect
from collections.abc import Sequence

from ..describe import table
from .formats import prediction_formats, truth_formats
from .numbers import titled
from .protocols import Metric, Protocol, protocols
from .results import matched_twin

FLAWS = "Known flaws and departures, kept as they are"
"""Heading of a protocol's flaws."""


def explained(metric: Metric) -> str:
    """What a metric is, and which way is better, in words."""
    words = metric.text.rstrip(".")
    better = f"; {metric.better} is better" if metric.better else ""
    return f"{words[:1].upper()}{words[1:]}{better}."


def untwinned(metrics: Sequence[Metric]) -> list[Metric]:
    """The metrics but for those that are another's twin over matched parts only."""
    keys = {metric.key for metric in metrics}
    twins = {matched_twin(key, keys) for key in keys}
    return [metric for metric in metrics if metric.key not in twins]


def protocols_text() -> str:
    """Every protocol: what it does, its flaws, and a table of its numbers."""
    return "\n".join(_protocol_text(protocol) for protocol in protocols().values())


def formats_text() -> str:
    """Two tables: formats of truths and of predictions, each with the files that it is known by."""
    sides = (("Truth", truth_formats()), ("Prediction", prediction_formats()))
    return "\n".join(table((side, "Files"), ((r.name, r.layout) for r in found)) for side, found in sides)


def _protocol_text(protocol: type[Protocol]) -> str:
    flaws = "".join(f"- {flaw}\n" for flaw in protocol.flaws)
    told = f"{FLAWS}:\n\n{flaws}\n" if flaws else ""
    return (
        f"### `{protocol.name}`, version {protocol.version}\n\n{inspect.getdoc(protocol)}\n\n"
        f"Source: {protocol.source}.\n\n{told}{_metrics_text(protocol.metrics)}"
    )


def _metrics_text(metrics: Sequence[Metric]) -> str:
    """A table with a row a metric; twins stand in the row of the metric that they repeat."""
    keys = {metric.key for metric in metrics}
    endings = {m.key: twin.removeprefix(m.key) for m in metrics if (twin := matched_twin(m.key, keys))}
    rows = [
        (_keys_text(m.key, endings.get(m.key)), titled(m), m.better or "-", m.text.rstrip("."))
        for m in untwinned(metrics)
    ]
    text = table(("Key", "Title", "Better", "What"), rows)
    if not endings:
        return text
    key, ending = next(iter(endings.items()))
    told = f"Keys with `+{ending}` come twice: `{key}{ending}` is `{key}` over matched parts only."
    return f"{told}\n\n{text}"


def _keys_text(key: str, ending: str | None) -> str:
    return f"`{key}` `+{ending}`" if ending else f"`{key}`"
