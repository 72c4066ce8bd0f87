"""A comparison of two runs as rows of text."""

from __future__ import annotations

from .compare import Comparison, MetricChange
from .numbers import number, titled
from .results import matched_twin

_SHORT = {"no clear difference": "unclear", "": "-"}


def metric_rows(comparison: Comparison, *, headline: bool = False) -> list[list[str]]:
    """Rows of text, a heading first: a metric each; those of the summary table only, if asked."""
    rows = [["metric", "n", "A", "B", "B - A", "95 % interval", "won/even/lost", "p", "B is"]]
    keys = [change.metric.key for change in comparison.metrics]
    twins = {
        matched_twin(key, keys) for key in keys
    }  # below the metrics that they belong to, which tell units
    for change in comparison.metrics:
        title = change.metric.title if change.metric.key in twins else titled(change.metric)
        if change.metric.headline or not headline:
            rows.append([title, *_cells(change)])
    return rows


def changed_rows(comparison: Comparison) -> list[list[str]]:
    """Rows of text, a heading first: the objects that changed most, by the metrics of the summary table."""
    rows = [["metric", "object", "A", "B", "B - A"]]
    for change in comparison.metrics:
        if change.metric.headline:
            rows += [
                [titled(change.metric), c.name, number(c.a), number(c.b), number(c.difference, sign=True)]
                for c in change.changed
            ]
    return rows


def unpaired_texts(comparison: Comparison, *, headline: bool = False) -> list[str]:
    """For each metric that some objects have in one run only, its title and how many."""
    return [
        f"{change.metric.title}: {change.unpaired}"
        for change in comparison.metrics
        if change.unpaired and (change.metric.headline or not headline)
    ]


def _cells(change: MetricChange) -> list[str]:
    counts = (change.wins, change.ties, change.losses)
    ends = change.interval
    return [
        str(change.pairs),
        number(change.mean_a),
        number(change.mean_b),
        number(change.difference, sign=True),
        "-" if ends is None else f"{number(ends[0])}, {number(ends[1])}",
        "-" if None in counts else "/".join(map(str, counts)),
        _p(change.p) if change.metric.better else "-",
        _SHORT.get(change.verdict, change.verdict),
    ]


def _p(value: float | None) -> str:
    return "-" if value is None else "<0.001" if value < 0.001 else f"{value:.3f}"
