"""The table at the end of a benchmark run, for people."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ...bench.numbers import counted, number, titled
from ...bench.protocols import Metric, protocol
from ...bench.results import matched_twin

if TYPE_CHECKING:
    from ...bench.results import Group, Mean
    from ...bench.run import Outcome, Plan


def summary_lines(plan: Plan, outcome: Outcome) -> list[str]:
    """Counts, then the headline metrics, then their means within categories.

    Failures of this time were told as they happened; those of objects that had been done before come first.
    """
    summary = outcome.summary
    metrics = protocol(plan.protocol).metrics
    found = summary.all
    lines = [
        f"{row.name}: failed before: {row.error}"
        for row in outcome.rows
        if row.status == "failed" and row.name in outcome.before
    ]
    lines += [
        f"{summary.protocol}, {plan.system.name} on {plan.data.resolve().name}: "
        f"{counted(found.objects, 'object')}, {found.failed} failed, {found.static} static",
        _parts_line(found),
    ]
    lines += [f"  {line}" for line in _aligned(_metric_rows(metrics, found))]
    if len(summary.categories) > 1:
        lines.append("by category:")
        lines += [f"  {line}" for line in _aligned(_category_rows(metrics, summary.categories.items()))]
    return lines


def _parts_line(group: Group) -> str:
    parts = counted(group.true_parts, "moving part")
    if group.found is None:
        return parts
    return f"{parts}: {group.found} found, {group.missed} missed, {group.invented} invented (IoU >= 0.5)"


def _metric_rows(metrics: Sequence[Metric], group: Group) -> list[list[str]]:
    """Headline metrics with their intervals; beside each, that of matched parts only where there is one."""
    keys = [metric.key for metric in metrics]
    headlines = [metric for metric in metrics if metric.headline]
    twins = {metric.key: matched_twin(metric.key, keys) for metric in headlines}
    rows = [["", "better", "mean [95 %]", "n"]]
    for metric in headlines:
        rows.append([titled(metric), metric.better, *_cells(group.means[metric.key])])
    if any(twins.values()):
        rows[0] += ["matched only", "n"]
        for row, twin in zip(rows[1:], twins.values(), strict=True):
            row += _cells(group.means[twin]) if twin else ["", ""]
    return rows


def _category_rows(metrics: Sequence[Metric], groups: Iterable[tuple[str, Group]]) -> list[list[str]]:
    headlines = [metric for metric in metrics if metric.headline]
    rows = [["", "objects", "failed", *(titled(metric) for metric in headlines)]]
    for name, group in groups:
        means = [number(group.means[metric.key].mean) for metric in headlines]
        rows.append([name, str(group.objects), str(group.failed), *means])
    return rows


def _cells(mean: Mean) -> list[str]:
    if mean.lower is None or mean.upper is None:
        return [number(mean.mean), str(mean.n)]
    return [f"{number(mean.mean)} [{number(mean.lower)}, {number(mean.upper)}]", str(mean.n)]


def _aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows
    ]
