"""What data sets say of parts beside their shapes and joints: materials, and descriptions in words.

SIMART-Bench  gt.json: `material` of a part, a key of the material table
PhysXNet      finaljson/ID.json: object_name; of a part material, density ("2.5 g/cm^3"), and the texts
Basic_description and Functional_description
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from simart_kit.errors import BadInputError

from ..answer.choices import choose_material
from ..prompt.texts import plain_text

_TEXTS = ("Basic_description", "Functional_description")


@dataclass(frozen=True, slots=True)
class StatedPart:
    """One part.

    Attributes:
        material: key of the material table, "" where nobody says.
        texts: descriptions.
    """

    material: str = ""
    texts: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Stated:
    """An object.

    Attributes:
        name: of the object, or "".
        parts: by the name that the reader of the format gives to their link.
    """

    name: str = ""
    parts: Mapping[str, StatedPart] = field(default_factory=dict)


NOTHING_SAID = Stated()


def stated(source: str, path: Path) -> Stated:
    """What is said beside the truth; nothing where the format has no place for it.

    The reader of the format has read the file without complaint; what it does not look at may still be of any
    kind, and counts as not said where it makes no sense.

    Args:
        source: name of the format.
        path: as its reader takes it.
    """
    if source == "physxnet":
        return _physxnet(json.loads(path.read_text(encoding="utf-8")))
    if source == "simart-bench":
        table = path / "gt.json" if path.is_dir() else path
        rows = json.loads(table.read_text(encoding="utf-8"))["parts"]
        return Stated("", {row["name"]: StatedPart(_material(row.get("material"), None)) for row in rows})
    return NOTHING_SAID


def _physxnet(table: Mapping[str, Any]) -> Stated:
    rows = {str(row.get("label")): row for row in table["parts"]}
    groups = [entry if key == "0" else entry[0] for key, entry in table["group_info"].items()]
    whole = {str(labels[0]) for labels in groups if len(labels) == 1}
    by_name: dict[str, list[StatedPart]] = {}
    for label, row in rows.items():
        # Of several parts that move as one a text describes only its own.
        texts = _texts(row) if label in whole else ()
        told = StatedPart(_material(row.get("material"), row.get("density")), texts)
        by_name.setdefault(str(row.get("name", "")), []).append(told)
    name = table.get("object_name")
    return Stated(
        name if isinstance(name, str) else "", {key: _common(parts) for key, parts in by_name.items()}
    )


def _common(parts: list[StatedPart]) -> StatedPart:
    """What is true of all parts of one name; a text that is meant for one of several tells nobody which."""
    materials = {part.material for part in parts}
    return StatedPart(
        parts[0].material if len(materials) == 1 else "", parts[0].texts if len(parts) == 1 else ()
    )


def _material(text: object, density: object) -> str:
    """Key of the material table for a name, "" where it is none of those known."""
    if not isinstance(text, str):
        return ""
    number = re.match(r"\s*([0-9.]+)", density) if isinstance(density, str) else None
    try:
        value = float(number[1]) if number else None
    except ValueError:
        value = None
    choice = choose_material(text, value or None)
    return choice.material if choice.by == "name" else ""


def _texts(row: Mapping[str, Any]) -> tuple[str, ...]:
    return tuple(_usable(row.get(name) for name in _TEXTS))


def _usable(texts: Iterable[object]) -> Iterable[str]:
    """Those that can be put into a question."""
    for text in texts:
        try:
            yield plain_text(text if isinstance(text, str) else "", "description").rstrip(".")
        except BadInputError:
            continue
