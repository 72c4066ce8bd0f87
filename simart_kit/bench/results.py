"""What a benchmark run found: means over objects, over parts and within categories; results.json and .csv."""

from __future__ import annotations

import csv
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..provenance import write_json
from .counts import count_parts, tells_found
from .protocols import Protocol
from .rows import Row, Settings
from .statistics import bootstrap_interval, mean

RESULTS_FILE, TABLE_FILE = "results.json", "results.csv"
SCHEMA = 1
_COUNTS = ("found", "missed", "invented")
# What protocols add to a metric's key for the same number without penalties.
_MATCHED = ("_matched", "_nopunish")


@dataclass(frozen=True)
class Mean:
    """A metric over several objects.

    Attributes:
        mean: over the objects for which it is defined, each counting once; None where it is for none.
        lower: lower end of the bootstrap interval of the mean, nominally 95 %, too narrow for few objects;
            None for less than two.
        upper: its upper end.
        n: objects for which it is defined.
        micro: mean over all their parts, each counting once; None where no part has this number.
        parts: parts that count in `micro`.
    """

    mean: float | None
    lower: float | None
    upper: float | None
    n: int
    micro: float | None = None
    parts: int = 0


@dataclass(frozen=True)
class Group:
    """Some objects of a run.

    Attributes:
        objects: how many.
        failed: how many of them have no score and count with the worst.
        static: how many have nothing that moves.
        true_parts: true parts that move, of the objects whose truth could be read.
        found: of them, those that a predicted part covers with an IoU of at least 0.5; None, as the next two,
            where the protocol does not tell.
        missed: the other true ones.
        invented: predicted parts that move and cover no true one so.
        means: by metric key, in the protocol's order.
    """

    objects: int
    failed: int
    static: int
    true_parts: int
    found: int | None
    missed: int | None
    invented: int | None
    means: Mapping[str, Mean]


@dataclass(frozen=True)
class Summary:
    """All objects of a run.

    Attributes:
        protocol: name and version.
        all: of them together.
        categories: by category, where objects have one.
    """

    protocol: str
    all: Group
    categories: Mapping[str, Group]


def summarise(rows: Sequence[Row], protocol: Protocol) -> Summary:
    """Means of a protocol's metrics. Objects that failed count with their scores, which are the worst."""
    names = sorted({row.category for row in rows} - {""})
    told = tells_found(rows)
    groups = {name: _group([row for row in rows if row.category == name], protocol, told) for name in names}
    return Summary(protocol.tag, _group(rows, protocol, told), groups)


def matched_twin(key: str, keys: Collection[str]) -> str | None:
    """The key of the same metric over matched parts only; None where the protocol has none."""
    return next((key + end for end in _MATCHED if key + end in keys), None)


def write_results(run: Path, settings: Settings, rows: Sequence[Row], protocol: Protocol) -> Summary:
    """Write results.json and results.csv of a run; what they say is the same for equal settings, times aside.

    Returns:
        What results.json tells besides the rows.
    """
    summary = summarise(rows, protocol)
    table = {
        "schema": SCHEMA,
        "protocol": protocol.tag,
        "settings": asdict(settings),
        "summary": asdict(summary),
        "rows": [{key: value for key, value in asdict(row).items() if key != "seconds"} for row in rows],
        "seconds": {row.name: row.seconds for row in rows},
    }
    draft = run / f".{RESULTS_FILE}"
    write_json(draft, table)
    draft.replace(run / RESULTS_FILE)
    _write_table(run, rows, protocol)
    return summary


def _group(rows: Sequence[Row], protocol: Protocol, found_told: bool) -> Group:
    keys = [metric.key for metric in protocol.metrics]
    parts = count_parts(rows, found_told=found_told)
    return Group(
        objects=len(rows),
        failed=sum(row.status == "failed" for row in rows),
        static=sum(row.static is True for row in rows),
        true_parts=parts.true_parts,
        found=parts.found,
        missed=parts.missed,
        invented=parts.invented,
        means={key: _mean(rows, key, _part_key(key, keys)) for key in keys},
    )


def _part_key(key: str, keys: Collection[str]) -> str | None:
    """What the rows of parts call a metric; those of matched parts know nothing of penalties."""
    if matched_twin(key, keys) is not None:
        return None
    return next((key.removesuffix(end) for end in _MATCHED if key.endswith(end)), key)


def _mean(rows: Sequence[Row], key: str, part_key: str | None) -> Mean:
    values = _numbers(row.scores.get(key) for row in rows)
    parts = _numbers(part.get(part_key) for row in rows for part in row.parts if part_key)
    lower, upper = bootstrap_interval(values) or (None, None)
    return Mean(mean(values), lower, upper, len(values), mean(parts), len(parts))


def _numbers(values: Iterable[Any]) -> FloatArray:
    return np.array([v for v in values if isinstance(v, int | float)], dtype=np.float64)


def _write_table(run: Path, rows: Sequence[Row], protocol: Protocol) -> None:
    keys = [metric.key for metric in protocol.metrics]
    draft = run / f".{TABLE_FILE}"
    told = tells_found(rows)
    with draft.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["name", "category", "status", "error", "static", *_COUNTS, *keys, "seconds"])
        for row in rows:
            scores = [row.scores.get(key) for key in keys]
            static = "" if row.static is None else str(row.static).lower()
            known = told and row.static is not None  # of a truth that cannot be read, nothing is
            parts = asdict(count_parts([row], found_told=known))
            counts = [parts[key] for key in _COUNTS]
            head = [row.name, row.category, row.status, row.error, static]
            writer.writerow([*head, *counts, *scores, row.seconds])
    draft.replace(run / TABLE_FILE)
