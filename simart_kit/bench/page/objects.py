"""The table of objects: a group of two table rows each, of which the second is unfolded for details."""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from pathlib import Path

from ..describe import explained
from ..numbers import titled
from ..pictures import PICTURES
from ..protocols import Metric, Protocol
from ..rows import Row, object_folder
from .details import details_of, score_text
from .markup import NOTHING, Attributes, Markup, breakable, joined, lines, tag, text

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
        *(_sortable(m.key, titled(m), explained(m), m.better or "lower") for m in headlines),
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
        _cell("seconds", repr(row.seconds), text(f"{row.seconds:.1f}"), "Seconds"),
        *(_picture_cell(run, row, key) for key in PICTURES),
    ]
    attributes: Attributes = {
        "data-rank": str(rank),
        "data-failed": row.status == "failed",
        "data-static": bool(row.static),
        "class": row.status,
    }
    inside = tag("td", details_of(row, protocol), attributes={"colspan": str(len(cells))})
    more = tag("tr", inside, attributes={"class": "details", "id": details, "hidden": True})
    return tag("tbody", tag("tr", *cells, attributes={"class": "object"}), more, attributes=attributes)


def _cell(key: str, value: str | bool, shown: Markup, label: str = "") -> Markup:
    """A cell with the value to sort by; one of a number has a label, for where headings are out of sight."""
    kind: Attributes = {"class": "number", "data-label": label} if label else {"class": "word"}
    return tag("td", shown, attributes={"data-key": key, "data-value": value, **kind})


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
    """An undefined number has no value to sort by."""
    value = row.scores.get(metric.key)
    plain = False if value is None else repr(value)
    return _cell(metric.key, plain, score_text(row, metric.key), titled(metric))


def _picture_cell(run: Path, row: Row, key: str) -> Markup:
    source = _embedded(object_folder(run, row.name) / Path(row.pictures.get(key, "")).name)
    attributes: Attributes = {"class": "view", "data-picture": key, "data-label": CAPTIONS[key]}
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
