"""Protocols: which numbers an object gets, and how. One file each; `PROTOCOLS` lists them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from ...errors import BadInputError
from ..cases import Prediction, Truth


@dataclass(frozen=True)
class Metric:
    """A number that a protocol gives every object.

    Attributes:
        key: in results.json and results.csv.
        title: heading of its column.
        better: which way is better; "" for a number that is neither.
        text: one sentence: what it is.
        headline: whether the summary table shows it.
        unit: such as "rad", or "size" for the object's longest side; "" for a number without one.
    """

    key: str
    title: str
    better: Literal["higher", "lower", ""]
    text: str
    headline: bool = False
    unit: str = ""


@dataclass(frozen=True)
class Scores:
    """What one object got.

    Attributes:
        values: by metric key; None where the metric is not defined for this object.
        parts: a row a matched, missed or invented part: names, how it ended, its own numbers by key.
        notes: what a person should know besides, a sentence each.
    """

    values: Mapping[str, float | None]
    parts: tuple[Mapping[str, Any], ...] = ()
    notes: tuple[str, ...] = ()


class Protocol(ABC):
    """A way to score one object.

    Attributes:
        name: for `--protocol`.
        version: raised whenever the same files could get other numbers.
        source: where the protocol is written down.
        flaws: what is known to be wrong with it and kept all the same, a sentence each.
        metrics: what it gives, in the order of columns.
    """

    name: ClassVar[str]
    version: ClassVar[str]
    source: ClassVar[str]
    flaws: ClassVar[tuple[str, ...]] = ()
    metrics: ClassVar[tuple[Metric, ...]]

    @abstractmethod
    def score(self, truth: Truth | None, prediction: Prediction | None) -> Scores:
        """Score a prediction; the same input gives the same numbers.

        Args:
            truth: None when it could not be read: then the scores are the worst that the protocol knows.
            prediction: in the frame of the truth; None, for an object that failed, gets the worst, too.
        """

    @property
    def tag(self) -> str:
        """Name and version, as results carry them."""
        return f"{self.name}/{self.version}"


def protocols() -> dict[str, type[Protocol]]:
    """All protocols by name."""
    from .particulate import Particulate
    from .s2o import S2O
    from .simart import Simart
    from .urdf_anything import UrdfAnything

    return {p.name: p for p in (Simart, Particulate, S2O, UrdfAnything)}


def protocol(name: str) -> Protocol:
    """The protocol of this name; raises BadInputError naming those that exist."""
    known = protocols()
    if name not in known:
        raise BadInputError(f"unknown protocol '{name}': known are {', '.join(known)}")
    return known[name]()
