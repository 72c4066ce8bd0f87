"""How many parts that move there are, how many of them were found, and how many were invented."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .rows import Row


@dataclass(frozen=True)
class Counts:
    """Parts that move. The last three are None for a protocol that does not say which parts were found.

    Attributes:
        true_parts: in truth; those of objects whose truth could not be read are not known.
        found: of them, those that some predicted part covers with an IoU of at least 0.5.
        missed: the others.
        invented: predicted parts that cover no true one so.
    """

    true_parts: int
    found: int | None
    missed: int | None
    invented: int | None


def tells_found(rows: Sequence[Row]) -> bool:
    """Whether the rows are of a protocol that says of every matched part whether it was found."""
    return all("found" in part for row in rows for part in row.parts if part.get("outcome") == "matched")


def count_parts(rows: Sequence[Row], *, found_told: bool) -> Counts:
    """Count the parts of some objects.

    Args:
        rows: of the objects.
        found_told: what `tells_found` says of all rows of the run.
    """
    parts = [part for row in rows for part in row.parts]
    true_parts = sum(_moves(part, "true") for part in parts)
    if not found_told:
        return Counts(true_parts, None, None, None)
    found = sum(_moves(part, "true") and bool(part.get("found")) for part in parts)
    invented = sum(_moves(part, "predicted") and not part.get("found") for part in parts)
    return Counts(true_parts, found, true_parts - found, invented)


def _moves(part: Mapping[str, Any], side: str) -> bool:
    """Whether a row tells of a true or predicted part that moves."""
    return bool(part.get(side)) and part.get(f"{side}_kind") != "fixed"
