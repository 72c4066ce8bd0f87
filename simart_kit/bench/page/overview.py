"""What the page says about a run as a whole: heading, counts, means, categories and explanations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..describe import FLAWS, explained, untwinned
from ..metrics.parts import FOUND_IOU
from ..numbers import number, titled
from ..protocols import Metric, Protocol
from ..results import Group, Mean, Summary, matched_twin
from ..rows import Settings
from .markup import NOTHING, Attributes, Markup, breakable, joined, lines, prose, tag, text, undefined

_SPANS = {
    "Penalised": "missed and invented parts count with the worst",
    "Matched parts only": "missed and invented parts are left out",
    "All objects": "",
}
_ARROWS = {"higher": "↑", "lower": "↓", "": ""}
_COLUMNS = (
    ("Mean", "over the objects for which it is defined, each counting once"),
    ("95 % interval", "of the mean over objects, by bootstrap; somewhat too narrow for few objects"),
    ("n", "objects for which it is defined"),
)


def heading(settings: Settings, summary: Summary) -> Markup:
    """System, what it was scored on, and what it found of how many objects and parts."""
    facts = {
        "Variant": settings.variant,
        "Protocol": settings.protocol,
        "Placement": settings.placement,
        "simart-kit": settings.simart_kit,
    }
    pairs = [tag("div", tag("dt", text(k)), tag("dd", text(v))) for k, v in facts.items() if v]
    title = tag("h1", breakable(f"{settings.system} on {settings.data}"))
    return joined([title, tag("dl", *pairs, attributes={"class": "facts"}), _counts_told(summary.all)])


def summary_table(group: Group, metrics: Sequence[Metric]) -> Markup:
    """Means over objects; of metrics that come twice, penalised and over matched parts only."""
    twins = {metric.key: matched_twin(metric.key, group.means) for metric in metrics}
    twice = any(twins.values())
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
            *(_mean_cells(group.means.get(twins[metric.key] or "")) if twice else ()),
        )
        for metric in metrics
    ]
    return tag(
        "table",
        tag("thead", tag("tr", *top), tag("tr", *below)),
        tag("tbody", lines(body)),
        attributes={"class": "summary"},
    )


def categories_table(summary: Summary, metrics: Sequence[Metric]) -> Markup:
    """Penalised means of each category."""
    head = [
        tag("th", text("Category"), attributes={"scope": "col"}),
        *(_column(title, "") for title in ("Objects", "Failed", "Static")),
        *(_column(_arrowed(m), explained(m)) for m in metrics),
    ]
    body = [_category(name, group, metrics) for name, group in summary.categories.items()]
    return tag("table", tag("thead", tag("tr", *head)), tag("tbody", lines(body)))


def explanations(protocol: Protocol) -> Markup:
    """Every metric in words, then what is known to be wrong with the protocol."""
    told = untwinned(protocol.metrics)
    pairs = [tag("div", tag("dt", text(_arrowed(m))), tag("dd", prose(explained(m)))) for m in told]
    source = f"Protocol {protocol.tag}. Source: {protocol.source.rstrip('.')}."
    if len(told) < len(protocol.metrics):
        source += " The columns of matched parts have the same of those parts only."
    legend = tag("dl", *pairs, attributes={"class": "legend"})
    return joined([tag("p", text(source)), legend, _flaws(protocol)])


def _flaws(protocol: Protocol) -> Markup:
    if not protocol.flaws:
        return NOTHING
    return joined([tag("h3", text(FLAWS)), tag("ul", *(tag("li", prose(flaw)) for flaw in protocol.flaws))])


def _counts_told(group: Group) -> Markup:
    """A line about objects and, where the protocol says which parts were found, one about those that move."""
    scored = group.objects - group.failed
    shares = {"scored": scored, "failed": group.failed, "static": group.static}
    objects = _count_line(group.objects, "object", shares)
    if group.found is None or group.missed is None or group.invented is None:
        return objects
    ends = {"found": group.found, "missed": group.missed, "invented": group.invented}
    note = f" (IoU \N{GREATER-THAN OR EQUAL TO} {FOUND_IOU:g})"
    return joined([objects, _count_line(group.true_parts, "moving part", ends, note)])


def _count_line(total: int, noun: str, shares: Mapping[str, int], note: str = "") -> Markup:
    """Such as "3 objects: 2 scored, 1 failed"."""
    whole = _counted(total, noun if total == 1 else f"{noun}s")
    told = Markup(", ".join(_counted(count, word) for word, count in shares.items()))
    small = tag("small", text(note)) if note else NOTHING
    return tag("p", whole, text(": "), told, small, attributes={"class": "counts"})


def _counted(count: int, word: str) -> Markup:
    return joined([tag("b", text(count)), text(f" {word}")])


def _span(title: str) -> Markup:
    hint = _SPANS[title] or False
    attributes: Attributes = {"scope": "colgroup", "colspan": "3", "class": "span", "title": hint}
    return tag("th", text(title), attributes=attributes)


def _arrowed(metric: Metric) -> str:
    return f"{titled(metric)} {_ARROWS[metric.better]}".strip()


def _metric_heading(metric: Metric) -> Markup:
    return tag("th", text(_arrowed(metric)), attributes={"scope": "row", "title": explained(metric)})


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
