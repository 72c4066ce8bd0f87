"""What unfolds below an object: why it failed, its parts, all its numbers, and notes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ..describe import explained, untwinned
from ..metrics.parts import FOUND_IOU
from ..numbers import number, titled
from ..protocols import Metric, Protocol
from ..results import matched_twin
from ..rows import Row
from .markup import NOTHING, Markup, joined, tag, text, undefined, value_text

_KIND = "_kind"  # ends the key of what is told below the name of a part
_FOUND = "found"  # whether a pair overlaps enough; told below its outcome where it does not
_HEADINGS = {"outcome": "Outcome", "true": "True part", "predicted": "Predicted part"}


def details_of(row: Row, protocol: Protocol) -> Markup:
    """All that is known of an object."""
    pieces = [
        tag("p", text(row.error), attributes={"class": "error"}) if row.error else NOTHING,
        _parts(row, protocol),
        _all_metrics(row, protocol),
        _notes(row),
    ]
    return tag("div", *pieces, attributes={"class": "inside"})


def score_text(row: Row, key: str) -> Markup:
    """A number of an object."""
    value = row.scores.get(key)
    return undefined("this object") if value is None else text(number(value))


def _parts(row: Row, protocol: Protocol) -> Markup:
    """The parts, with a column for every key for which any of them has a value."""
    if not row.parts:
        return tag("p", text("No parts were compared."), attributes={"class": "quiet"})
    known = {metric.key: metric for metric in protocol.metrics}
    found = dict.fromkeys(key for part in row.parts for key, value in part.items() if value is not None)
    keys = [
        key for key in found if key != _FOUND and not (key.endswith(_KIND) and key[: -len(_KIND)] in found)
    ]
    classes = {key: _class(part.get(key) for part in row.parts) for key in keys}
    metrics = {key: known.get(key) or known.get(matched_twin(key, known) or "") for key in keys}
    head = [_part_heading(key, metrics[key], classes[key]) for key in keys]
    body = [
        tag(
            "tr",
            *(_part_cell(part, key, classes[key]) for key in keys),
            attributes={"class": _outcome(part)},
        )
        for part in row.parts
    ]
    table = tag("table", tag("thead", tag("tr", *head)), tag("tbody", *body), attributes={"class": "parts"})
    return joined([tag("h4", text("Parts")), tag("div", table, attributes={"class": "scroll"})])


def _class(values: Iterable[object]) -> str:
    """Whether a column holds numbers, which are set to the right."""
    words = (isinstance(value, bool) or not isinstance(value, int | float | None) for value in values)
    return "word" if any(words) else "number"


def _part_heading(key: str, metric: Metric | None, kind: str) -> Markup:
    title = _HEADINGS.get(key, key.replace("_", " ")) if metric is None else titled(metric)
    hint = False if metric is None else explained(metric)
    return tag("th", text(title), attributes={"scope": "col", "class": kind, "title": hint})


def _part_cell(part: Mapping[str, Any], key: str, kind: str) -> Markup:
    """A value; below a part's name its kind, below a pair that does not count as found why not."""
    below = part.get(f"{key}{_KIND}")
    if key == "outcome" and part.get(key) == "matched" and part.get(_FOUND) is False:
        below = f"IoU < {FOUND_IOU:g}"
    small = NOTHING if below is None else tag("small", text(below))
    return tag("td", value_text(part.get(key)), small, attributes={"class": kind})


def _outcome(part: Mapping[str, Any]) -> str:
    outcome = part.get("outcome")
    return outcome if outcome in ("matched", "missed", "invented") else ""


def _all_metrics(row: Row, protocol: Protocol) -> Markup:
    """Every number of an object; those over matched parts stand beside the penalised ones."""
    keys = {metric.key for metric in protocol.metrics}
    twins = {metric.key: matched_twin(metric.key, keys) for metric in untwinned(protocol.metrics)}
    pairs = []
    for metric in untwinned(protocol.metrics):
        twin = twins[metric.key]
        name = tag("dt", text(titled(metric)), attributes={"title": explained(metric)})
        beside = NOTHING if twin is None else score_text(row, twin)
        second = tag("dd", beside, attributes={"class": "second", "title": "matched parts only"})
        pairs.append(tag("div", name, tag("dd", score_text(row, metric.key)), second))
    title = "All metrics; grey: matched parts only" if any(twins.values()) else "All metrics"
    return joined([tag("h4", text(title)), tag("dl", *pairs, attributes={"class": "metrics"})])


def _notes(row: Row) -> Markup:
    if not row.notes:
        return NOTHING
    items = [tag("li", text(note)) for note in row.notes]
    return joined([tag("h4", text("Notes")), tag("ul", *items, attributes={"class": "notes"})])
