"""Two runs over the same objects: which is better, and is the difference more than chance."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from ..arrays import FloatArray
from ..errors import BadInputError
from .numbers import counted, listed
from .protocols import Metric, protocol
from .rows import ROW_FILE, Row, Settings, damaged_rows, object_folder, read_rows, read_settings
from .statistics import bootstrap_interval, mean, sign_flip_p

Verdict = Literal["better", "worse", "no clear difference", ""]
_MUST_AGREE = ("data", "protocol", "variant")
_MAY_DIFFER = ("placement", "simart_kit")
_EVEN = 1e-4  # scores that differ by no more are a tie
_CHANCE = 0.05  # differences that chance makes as often as this are not clear
_SHOWN = 5  # objects listed for each metric


@dataclass(frozen=True)
class ObjectChange:
    """An object's number in both runs; `difference` is B - A."""

    name: str
    a: float
    b: float
    difference: float


@dataclass(frozen=True)
class MetricChange:
    """How a metric changed from A to B, over the objects that have it in both.

    Attributes:
        metric: which.
        pairs: how many objects.
        unpaired: objects that have it in one run only, such as those where nothing was matched in the other.
        mean_a: mean of A over the pairs; None without one.
        mean_b: of B.
        difference: mean of B - A.
        interval: bootstrap interval of that mean, nominally 95 %, too narrow for few pairs; None for fewer
            than two.
        p: of the paired sign-flip test, in which ties are 0: how likely a difference so large is where both
            runs are equally good; None without a pair.
        wins: pairs where B is better; None, as the next two, for a metric of which no way is better.
        ties: pairs that are equal.
        losses: pairs where A is better.
        verdict: how B does against A. "no clear difference" where `p` is not below 0.05, as with fewer than
            six objects that changed; "" without a pair and for a metric of which no way is better. Each is
            judged by itself: of 20 metrics of two equal systems, one is expected to come out as different.
        changed: the objects that changed most, most first.
    """

    metric: Metric
    pairs: int
    unpaired: int
    mean_a: float | None
    mean_b: float | None
    difference: float | None
    interval: tuple[float, float] | None
    p: float | None
    wins: int | None
    ties: int | None
    losses: int | None
    verdict: Verdict
    changed: tuple[ObjectChange, ...]


@dataclass(frozen=True)
class Comparison:
    """Run B against run A.

    Attributes:
        a: settings of A.
        b: settings of B.
        objects: names of those in both.
        only_a: names of those that B lacks; they count for nothing here.
        only_b: names of those that A lacks.
        failed_a: of `objects`, those that failed in A; they count with the worst scores.
        failed_b: in B.
        metrics: in the order of the protocol.
        notes: what else differs between the runs, and rows that are damaged.
    """

    a: Settings
    b: Settings
    objects: tuple[str, ...]
    only_a: tuple[str, ...]
    only_b: tuple[str, ...]
    failed_a: tuple[str, ...]
    failed_b: tuple[str, ...]
    metrics: tuple[MetricChange, ...]
    notes: tuple[str, ...]

    def table(self) -> dict[str, Any]:
        """Plain values, for JSON."""
        return asdict(self)


def compare(a: Path, b: Path) -> Comparison:
    """Compare two run folders, object by object.

    Raises:
        BadInputError: a folder is no run, they differ in data, protocol or variant, no object is in both, or
            a row is damaged.
    """
    settings_a, settings_b = read_settings(a), read_settings(b)
    _check_alike(a, settings_a, b, settings_b)
    rows_a, rows_b = ({row.name: row for row in read_rows(run)} for run in (a, b))
    both = tuple(name for name in rows_a if name in rows_b)
    if not both:
        raise BadInputError(f"{a} and {b} have no object in common that is done: nothing to compare")
    scores_a = [_scores(a, rows_a[name]) for name in both]
    scores_b = [_scores(b, rows_b[name]) for name in both]
    metrics = protocol(settings_a.protocol.partition("/")[0]).metrics
    return Comparison(
        settings_a,
        settings_b,
        both,
        tuple(name for name in rows_a if name not in rows_b),
        tuple(name for name in rows_b if name not in rows_a),
        tuple(name for name in both if rows_a[name].status == "failed"),
        tuple(name for name in both if rows_b[name].status == "failed"),
        tuple(_change(metric, both, scores_a, scores_b) for metric in metrics),
        (*_notes(settings_a, settings_b), *_damage("A", a), *_damage("B", b)),
    )


def _check_alike(a: Path, settings_a: Settings, b: Path, settings_b: Settings) -> None:
    for name in _MUST_AGREE:
        one, two = getattr(settings_a, name), getattr(settings_b, name)
        if one != two:
            raise BadInputError(
                f"cannot compare: {name} is '{one}' in {a} and '{two}' in {b}; "
                "run or score one of them again like the other"
            )


def _notes(a: Settings, b: Settings) -> tuple[str, ...]:
    """What differs that may explain a change, and a protocol that is no longer known as it was."""
    notes = [
        f"{name} is '{getattr(a, name)}' in A and '{getattr(b, name)}' in B"
        for name in _MAY_DIFFER
        if getattr(a, name) != getattr(b, name)
    ]
    current = protocol(a.protocol.partition("/")[0]).tag
    if a.protocol != current:
        notes.append(f"both runs are of {a.protocol}; this version has {current}, whose metrics may differ")
    return tuple(notes)


def _damage(which: str, run: Path) -> list[str]:
    names = damaged_rows(run)
    if not names:
        return []
    return [f"{counted(len(names), 'row')} of {which} left out as damaged: {listed(names)}; run it again"]


def _scores(run: Path, row: Row) -> Mapping[str, float | None]:
    """The scores of a row; raises BadInputError when one is no number."""
    where = object_folder(run, row.name) / ROW_FILE
    if not isinstance(row.scores, Mapping):
        raise BadInputError(f"{where} is damaged: 'scores' is no table; remove it and run again")
    for key, value in row.scores.items():
        number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
        if value is not None and not number:
            raise BadInputError(f"{where} is damaged: score '{key}' is {value!r}; remove it and run again")
    return row.scores


def _change(
    metric: Metric,
    names: tuple[str, ...],
    scores_a: list[Mapping[str, float | None]],
    scores_b: list[Mapping[str, float | None]],
) -> MetricChange:
    changes, unpaired = [], 0
    for name, of_a, of_b in zip(names, scores_a, scores_b, strict=True):
        a, b = of_a.get(metric.key), of_b.get(metric.key)
        if a is not None and b is not None:
            changes.append(ObjectChange(name, a, b, b - a))
        unpaired += (a is None) != (b is None)
    differences = np.array([change.difference for change in changes])
    wins, ties, losses = _counts(metric, differences)
    p = sign_flip_p(np.where(np.abs(differences) > _EVEN, differences, 0.0))
    difference = mean(differences)
    moved = [change for change in changes if abs(change.difference) > _EVEN]
    return MetricChange(
        metric,
        len(changes),
        unpaired,
        mean(np.array([change.a for change in changes])),
        mean(np.array([change.b for change in changes])),
        difference,
        bootstrap_interval(differences),
        p,
        wins,
        ties,
        losses,
        _verdict(metric, difference, p),
        tuple(sorted(moved, key=lambda change: -abs(change.difference))[:_SHOWN]),
    )


def _counts(metric: Metric, differences: FloatArray) -> tuple[int | None, int | None, int | None]:
    """Wins, ties and losses."""
    if not metric.better:
        return None, None, None
    gain = differences if metric.better == "higher" else -differences
    wins, losses = int((gain > _EVEN).sum()), int((gain < -_EVEN).sum())
    return wins, len(gain) - wins - losses, losses


def _verdict(metric: Metric, difference: float | None, p: float | None) -> Verdict:
    if not metric.better or difference is None or p is None:
        return ""
    if p >= _CHANCE:
        return "no clear difference"
    return "better" if (difference > 0) == (metric.better == "higher") else "worse"
