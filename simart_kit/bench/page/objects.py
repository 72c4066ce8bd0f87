"""The table of objects: a group of two table rows each, of which the second is unfolded for details."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

from ..pictures import PICTURES
from ..protocols import Metric, Protocol
from ..rows import Row, object_folder
from .markup import (
    NOTHING,
    Attributes,
    Markup,
    breakable,
    joined,
    lines,
    number,
    tag,
    text,
    undefined,
    value_text,
)
from .overview import MATCHED, explained, first_columns

CAPTIONS = {
    "input": "Input",
    "truth": "Truth",
    "prediction": "Prediction",
    "truth_open": "Truth, open",
    "prediction_open": "Prediction, open",
}
_QUALITY = 90


def ranked(rows: Sequence[Row], protocol: Protocol) -> tuple[Row, ...]:
    """Failed objects first, then from worst to best by the first headline number, then those without it."""
    first = next((metric for metric in protocol.metrics if metric.headline), None)
    sign = -1.0 if first is not None and first.better == "lower" else 1.0

    def place(row: Row) -> tuple[bool, bool, float, str]:
        value = None if first is None else row.scores.get(first.key)
        return row.status != "failed", value is None, sign * (value or 0.0), row.name

    return tuple(sorted(rows, key=place))


def objects_table(run: Path, rows: Sequence[Row], protocol: Protocol) -> Markup:
    """All objects, in the order given."""
    headlines = [metric for metric in protocol.metrics if metric.headline]
    bodies = [_object(run, row, protocol, headlines, rank) for rank, row in enumerate(rows)]
    return tag("table", _head(headlines), lines(bodies), attributes={"id": "objects"})


def _head(headlines: Sequence[Metric]) -> Markup:
    columns = [
        _sortable("name", "Object", "name of the object"),
        _sortable("category", "Category", "category of the object"),
        _sortable("status", "Status", "whether there is a prediction to score"),
        *(_sortable(m.key, m.title, explained(m), m.better or "lower") for m in headlines),
        _sortable("seconds", "Seconds", "wall time of conversion and scoring [s]", "lower"),
        *(tag("th", text(CAPTIONS[key]), attributes={"scope": "col", "class": "view"}) for key in PICTURES),
    ]
    return tag("thead", tag("tr", *columns))


def _sortable(key: str, title: str, hint: str, better: str = "") -> Markup:
    """A heading that sorts; those of numbers say which way is better, and put the worst first."""
    attributes: Attributes = {
        "scope": "col",
        "data-key": key,
        "data-better": better,
        "aria-sort": "none",
        "class": "number" if better else "word",
    }
    return tag("th", tag("button", text(title), attributes={"title": hint}), attributes=attributes)


def _object(run: Path, row: Row, protocol: Protocol, headlines: Sequence[Metric], rank: int) -> Markup:
    details = f"details-{rank}"
    cells = [
        _name_cell(row, details),
        _cell("category", row.category, breakable(row.category)),
        _cell("status", _status(row), _status_mark(row)),
        *(_score_cell(row, metric) for metric in headlines),
        _cell("seconds", repr(row.seconds), text(f"{row.seconds:.1f}"), "number"),
        *(_picture_cell(run, row, key) for key in PICTURES),
    ]
    attributes: Attributes = {
        "data-rank": str(rank),
        "data-failed": row.status == "failed",
        "data-static": bool(row.static),
        "class": row.status,
    }
    inside = tag("td", _details(row, protocol), attributes={"colspan": str(len(cells))})
    more = tag("tr", inside, attributes={"class": "details", "id": details, "hidden": True})
    return tag("tbody", tag("tr", *cells, attributes={"class": "object"}), more, attributes=attributes)


def _cell(key: str, value: str, shown: Markup, kind: str = "word") -> Markup:
    return tag("td", shown, attributes={"data-key": key, "data-value": value, "class": kind})


def _name_cell(row: Row, details: str) -> Markup:
    toggle: Attributes = {
        "class": "toggle",
        "aria-label": row.name,
        "aria-expanded": "false",
        "aria-controls": details,
    }
    button = tag("button", breakable(row.name), attributes=toggle)
    attributes = {"scope": "row", "data-key": "name", "data-value": row.name, "class": "name"}
    return tag("th", button, attributes=attributes)


def _status(row: Row) -> str:
    return f"{row.status}, static" if row.static else row.status


def _status_mark(row: Row) -> Markup:
    mark = tag(
        "span", text(row.status), attributes={"class": f"status {row.status}", "title": row.error or False}
    )
    still: Attributes = {"class": "static", "title": "nothing moves in truth"}
    return joined([mark, tag("span", text("static"), attributes=still) if row.static else NOTHING])


def _score_cell(row: Row, metric: Metric) -> Markup:
    """A cell with the value to sort by, which an undefined number has not."""
    value = row.scores.get(metric.key)
    plain = False if value is None else repr(value)
    attributes: Attributes = {"data-key": metric.key, "data-value": plain, "class": "number"}
    return tag("td", _score(row, metric.key), attributes=attributes)


def _picture_cell(run: Path, row: Row, key: str) -> Markup:
    source = _embedded(object_folder(run, row.name) / Path(row.pictures.get(key, "")).name)
    attributes: Attributes = {"class": "view", "data-picture": key}
    if source is None:
        nothing = tag("span", text("\N{EN DASH}"), attributes={"class": "none", "title": "no picture"})
        return tag("td", nothing, attributes=attributes)
    label = f"{CAPTIONS[key]}: {row.name}"
    sizes = {"width": "60", "height": "60", "loading": "lazy", "decoding": "async"}
    image = tag("img", attributes={"src": source, "alt": label, **sizes})
    button: Attributes = {"class": "thumbnail", "aria-haspopup": "dialog", "title": "show larger"}
    return tag("td", tag("button", image, attributes=button), attributes=attributes)


def _embedded(path: Path) -> str | None:
    """A picture as a WebP data address, some five times smaller than its PNG; None where there is none."""
    from PIL import Image

    if not path.is_file():
        return None
    buffer = io.BytesIO()
    try:
        with Image.open(path) as picture:
            picture.convert("RGB").save(buffer, "WEBP", quality=_QUALITY)
    except (OSError, SyntaxError):  # what Pillow raises for files that are no pictures, or damaged ones
        return None
    return f"data:image/webp;base64,{base64.b64encode(buffer.getvalue()).decode('ascii')}"


def _details(row: Row, protocol: Protocol) -> Markup:
    pieces = [
        tag("p", text(row.error), attributes={"class": "error"}) if row.error else NOTHING,
        _parts(row, protocol),
        _all_metrics(row, protocol),
        _notes(row),
    ]
    return tag("div", *pieces, attributes={"class": "inside"})


def _parts(row: Row, protocol: Protocol) -> Markup:
    """The parts, with a column for every key that any of them has."""
    if not row.parts:
        return tag("p", text("No parts were compared."), attributes={"class": "quiet"})
    known = {metric.key: metric for metric in protocol.metrics}
    keys = list(dict.fromkeys(key for part in row.parts for key in part))
    kinds = {key: _kind(part.get(key) for part in row.parts) for key in keys}
    head = [_part_heading(key, known.get(key), kinds[key]) for key in keys]
    body = [
        tag(
            "tr",
            *(_part_cell(part.get(key), kinds[key]) for key in keys),
            attributes={"class": _outcome(part)},
        )
        for part in row.parts
    ]
    table = tag("table", tag("thead", tag("tr", *head)), tag("tbody", *body), attributes={"class": "parts"})
    return joined([tag("h4", text("Parts")), tag("div", table, attributes={"class": "scroll"})])


def _kind(values: Iterable[object]) -> str:
    """Whether a column holds numbers, which are set to the right."""
    words = (isinstance(value, bool) or not isinstance(value, int | float | None) for value in values)
    return "word" if any(words) else "number"


def _part_heading(key: str, metric: Metric | None, kind: str) -> Markup:
    title = key.replace("_", " ") if metric is None else metric.title
    hint = False if metric is None else explained(metric)
    return tag("th", text(title), attributes={"scope": "col", "class": kind, "title": hint})


def _part_cell(value: object, kind: str) -> Markup:
    return tag("td", value_text(value), attributes={"class": kind})


def _outcome(part: object) -> str:
    outcome = part.get("outcome") if isinstance(part, dict) else None
    return outcome if outcome in ("matched", "missed", "invented") else ""


def _all_metrics(row: Row, protocol: Protocol) -> Markup:
    """Every number of an object; those over matched parts stand beside the penalised ones."""
    keys = {metric.key for metric in protocol.metrics}
    pairs = []
    for metric in first_columns(protocol):
        second = f"{metric.key}{MATCHED}"
        beside = _score(row, second) if second in keys else NOTHING
        name = tag("dt", text(metric.title), attributes={"title": explained(metric)})
        second_dd = tag("dd", beside, attributes={"class": "second", "title": "matched parts only"})
        pairs.append(tag("div", name, tag("dd", _score(row, metric.key)), second_dd))
    title = (
        "All metrics; grey: matched parts only"
        if any(f"{key}{MATCHED}" in keys for key in keys)
        else "All metrics"
    )
    return joined([tag("h4", text(title)), tag("dl", *pairs, attributes={"class": "metrics"})])


def _score(row: Row, key: str) -> Markup:
    value = row.scores.get(key)
    return undefined("this object") if value is None else text(number(value))


def _notes(row: Row) -> Markup:
    if not row.notes:
        return NOTHING
    items = [tag("li", text(note)) for note in row.notes]
    return joined([tag("h4", text("Notes")), tag("ul", *items, attributes={"class": "notes"})])
