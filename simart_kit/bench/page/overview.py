"""What the page says about a run as a whole: heading, counts, means, categories and explanations."""

from __future__ import annotations

from collections.abc import Sequence

from ..protocols import Metric, Protocol
from ..results import Group, Mean, Summary
from ..rows import Settings
from .markup import NOTHING, Markup, joined, lines, number, tag, text, undefined

MATCHED = "_matched"
_ARROWS = {"higher": "↑", "lower": "↓", "": ""}


def heading(settings: Settings, summary: Summary) -> Markup:
    """System, what it was scored on, and how many objects there are."""
    facts = {
        "Data": settings.data,
        "Variant": settings.variant,
        "Protocol": settings.protocol,
        "Placement": settings.placement,
        "simart-kit": settings.simart_kit,
    }
    group = summary.all
    counts = {
        "Objects": group.objects,
        "Scored": group.objects - group.failed,
        "Failed": group.failed,
        "Static": group.static,
        "Moving parts": group.moving_parts,
    }
    title = tag("h1", text(settings.system))
    return joined([title, _pairs(facts, "facts"), _pairs(counts, "counts")])


def summary_table(group: Group, metrics: Sequence[Metric]) -> Markup:
    """Means over objects; of metrics that come twice, penalised and over matched parts only."""
    twice = any(f"{metric.key}{MATCHED}" in group.means for metric in metrics)
    spans = ("Penalised", "Matched parts only") if twice else ("All objects",)
    top = [tag("th", text("Metric"), attributes={"scope": "col", "rowspan": "2"}), *map(_span, spans)]
    below = [
        tag("th", text(title), attributes={"scope": "col", "class": "number", "title": hint})
        for _ in spans
        for title, hint in _COLUMNS
    ]
    body = [
        tag(
            "tr",
            _metric_heading(metric),
            *_mean_cells(group.means.get(metric.key)),
            *(_mean_cells(group.means.get(f"{metric.key}{MATCHED}")) if twice else ()),
        )
        for metric in metrics
    ]
    return tag(
        "table",
        tag("thead", tag("tr", *top), tag("tr", *below)),
        tag("tbody", lines(body)),
        attributes={"class": "summary"},
    )


_COLUMNS = (
    ("Mean", "over the objects for which it is defined, each counting once"),
    ("95 % interval", "of the mean over objects, by bootstrap"),
    ("n", "objects for which it is defined"),
)


def categories_table(summary: Summary, metrics: Sequence[Metric]) -> Markup:
    """Penalised means of each category."""
    head = [
        tag("th", text("Category"), attributes={"scope": "col"}),
        *(_column(title, "") for title in ("Objects", "Failed", "Static")),
        *(_column(f"{m.title} {_ARROWS[m.better]}".strip(), explained(m)) for m in metrics),
    ]
    body = [_category(name, group, metrics) for name, group in summary.categories.items()]
    return tag("table", tag("thead", tag("tr", *head)), tag("tbody", lines(body)))


def explanations(protocol: Protocol) -> Markup:
    """Every metric in words, then what is known to be wrong with the protocol."""
    pairs = [
        tag("div", tag("dt", text(f"{m.title} {_ARROWS[m.better]}".strip())), tag("dd", text(explained(m))))
        for m in protocol.metrics
    ]
    source = tag("p", text(f"Protocol {protocol.tag}. Source: {protocol.source.rstrip('.')}."))
    return joined([source, tag("dl", *pairs, attributes={"class": "legend"}), _flaws(protocol)])


def explained(metric: Metric) -> str:
    """What a metric is, and which way is better, in words."""
    words = metric.text.rstrip(".")
    better = f"; {metric.better} is better" if metric.better else ""
    return f"{words[:1].upper()}{words[1:]}{better}."


def first_columns(protocol: Protocol) -> list[Metric]:
    """The metrics but for those that are another's column of matched parts."""
    keys = {metric.key for metric in protocol.metrics}
    return [m for m in protocol.metrics if m.key.removesuffix(MATCHED) not in keys - {m.key}]


def _flaws(protocol: Protocol) -> Markup:
    if not protocol.flaws:
        return NOTHING
    title = tag("h3", text("Known flaws of the protocol, kept as they are"))
    return joined([title, tag("ul", *(tag("li", text(flaw)) for flaw in protocol.flaws))])


def _pairs(values: dict[str, str] | dict[str, int], kind: str) -> Markup:
    pairs = [tag("div", tag("dt", text(k)), tag("dd", text(v))) for k, v in values.items() if v != ""]
    return tag("dl", *pairs, attributes={"class": kind})


def _span(title: str) -> Markup:
    return tag("th", text(title), attributes={"scope": "colgroup", "colspan": "3", "class": "span"})


def _metric_heading(metric: Metric) -> Markup:
    arrow = tag("span", text(_ARROWS[metric.better]), attributes={"class": "arrow"})
    name = joined([text(metric.title), text(" "), arrow])
    return tag("th", name, attributes={"scope": "row", "title": explained(metric)})


def _mean_cells(value: Mean | None) -> list[Markup]:
    """Mean, interval and count; empty for a metric that does not come in this way."""
    if value is None:
        return [tag("td")] * 3
    shown = undefined("any object") if value.mean is None else text(number(value.mean))
    ends = [value.lower, value.upper]
    interval = "" if None in ends else " \N{EN DASH} ".join(number(end) for end in ends if end is not None)
    return [
        tag("td", shown, attributes={"class": "number mean"}),
        tag("td", text(interval), attributes={"class": "number interval"}),
        tag("td", text(value.n), attributes={"class": "number"}),
    ]


def _column(title: str, hint: str) -> Markup:
    return tag("th", text(title), attributes={"scope": "col", "class": "number", "title": hint or False})


def _category(name: str, group: Group, metrics: Sequence[Metric]) -> Markup:
    counts = [tag("td", text(n), attributes={"class": "number"}) for n in _counts(group)]
    means = [tag("td", _mean(group.means.get(m.key)), attributes={"class": "number"}) for m in metrics]
    return tag("tr", tag("th", text(name), attributes={"scope": "row"}), *counts, *means)


def _counts(group: Group) -> tuple[int, int, int]:
    return group.objects, group.failed, group.static


def _mean(value: Mean | None) -> Markup:
    if value is None or value.mean is None:
        return undefined("any object of the category")
    return text(number(value.mean))
