"""The table at the end of a benchmark run, for people."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ...bench.protocols import Metric, protocol
from ...bench.results import matched_twin

if TYPE_CHECKING:
    from ...bench.results import Group, Mean
    from ...bench.run import Outcome, Plan


def summary_lines(plan: Plan, outcome: Outcome) -> list[str]:
    """Failures first, then the headline metrics, then their means within categories."""
    summary = outcome.summary
    metrics = protocol(plan.protocol).metrics
    found = summary.all
    lines = [f"{row.name}: failed: {row.error}" for row in outcome.rows if row.status == "failed"]
    lines.append(
        f"{summary.protocol}, {plan.system.name} on {plan.data.resolve().name}: {found.objects} object(s), "
        f"{found.failed} failed, {found.static} static, {found.moving_parts} true moving part(s) compared"
    )
    lines += [f"  {line}" for line in _aligned(_metric_rows(metrics, found))]
    if len(summary.categories) > 1:
        lines.append("by category:")
        lines += [f"  {line}" for line in _aligned(_category_rows(metrics, summary.categories.items()))]
    return lines


def _metric_rows(metrics: Sequence[Metric], group: Group) -> list[list[str]]:
    """Headline metrics with their intervals; beside each, that of matched parts only where there is one."""
    keys = [metric.key for metric in metrics]
    headlines = [metric for metric in metrics if metric.headline]
    twins = {metric.key: matched_twin(metric.key, keys) for metric in headlines}
    rows = [["", "better", "mean [95 %]", "n"]]
    for metric in headlines:
        rows.append([metric.title, metric.better, *_cells(group.means[metric.key])])
    if any(twins.values()):
        rows[0] += ["matched only", "n"]
        for row, twin in zip(rows[1:], twins.values(), strict=True):
            row += _cells(group.means[twin]) if twin else ["", ""]
    return rows


def _category_rows(metrics: Sequence[Metric], groups: Iterable[tuple[str, Group]]) -> list[list[str]]:
    headlines = [metric for metric in metrics if metric.headline]
    rows = [["", "objects", "failed", *(metric.title for metric in headlines)]]
    for name, group in groups:
        means = [_number(group.means[metric.key].mean) for metric in headlines]
        rows.append([name, str(group.objects), str(group.failed), *means])
    return rows


def _cells(mean: Mean) -> list[str]:
    if mean.lower is None or mean.upper is None:
        return [_number(mean.mean), str(mean.n)]
    return [f"{_number(mean.mean)} [{mean.lower:.3f}, {mean.upper:.3f}]", str(mean.n)]


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.3f}"


def _aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows
    ]
