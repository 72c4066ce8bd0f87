"""Rows and settings of a benchmark run: what is kept in its folder."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal

from ..errors import BadInputError
from ..provenance import write_json

SETTINGS_FILE, ROW_FILE, OBJECTS = "bench.json", "row.json", "objects"
OLD_ROW_FILE = "old_row.json"
SCHEMA = 1


@dataclass(frozen=True)
class Settings:
    """What decides the numbers of a run. Two runs with equal settings give equal numbers.

    Attributes:
        data: name of the folder with the objects.
        protocol: name and version, such as "simart/1".
        system: what was scored: "recipe NAME" or "predictions NAME".
        variant: which mesh of each object was converted.
        recipe: the resolved recipe of a run; None where predictions were scored.
        placement: how predictions were brought to the frame of the truth.
        simart_kit: version of this program.
    """

    data: str
    protocol: str
    system: str
    variant: str
    recipe: Mapping[str, Any] | None
    placement: str
    simart_kit: str


@dataclass(frozen=True)
class Row:
    """What one object got.

    Attributes:
        name: of the object.
        category: of the object, or "".
        status: "scored"; or "failed", and then the scores are the worst that the protocol knows.
        error: why it failed, one line; "" when it did not.
        static: whether nothing moves in truth; None where the truth could not be read.
        scores: by metric key; None where a metric is not defined for this object.
        parts: a row a part, as the protocol gives it.
        notes: what readers decided and conversions warned of.
        seconds: wall time that conversion and scoring took.
        pictures: file names in the object's folder by what they show: "input", "truth", "prediction",
            "truth_open", "prediction_open".
        truth_sha256: over the files of the truth, see `fingerprint`.
        system_sha256: over the files of the prediction, or over the plugin files that were given for a
            conversion; "" where there are none.
    """

    name: str
    category: str = ""
    status: Literal["scored", "failed"] = "scored"
    error: str = ""
    static: bool | None = None
    scores: Mapping[str, float | None] = field(default_factory=dict)
    parts: tuple[Mapping[str, Any], ...] = ()
    notes: tuple[str, ...] = ()
    seconds: float = 0.0
    pictures: Mapping[str, str] = field(default_factory=dict)
    truth_sha256: str = ""
    system_sha256: str = ""


def object_folder(run: Path, name: str) -> Path:
    """Where a run keeps what belongs to an object."""
    return run / OBJECTS / name


def write_row(run: Path, row: Row) -> None:
    """Write a row whole or not at all: one that exists is done."""
    folder = object_folder(run, row.name)
    folder.mkdir(parents=True, exist_ok=True)
    draft = folder / f".{ROW_FILE}"
    write_json(draft, asdict(row))
    draft.replace(folder / ROW_FILE)


def read_row(run: Path, name: str) -> Row | None:
    """The row of an object; None when it is not done, or its file is damaged."""
    try:
        table = json.loads((object_folder(run, name) / ROW_FILE).read_text(encoding="utf-8"))
        # The folder names the object: a row that was copied elsewhere is that of another.
        values = {"name": name, "parts": tuple(table["parts"]), "notes": tuple(table["notes"])}
        return Row(**{**table, **values})
    except (OSError, ValueError, TypeError, KeyError):
        return None


def set_aside(run: Path, name: str) -> None:
    """Let the row of an object count no more, and keep its file under another name."""
    folder = object_folder(run, name)
    (folder / ROW_FILE).replace(folder / OLD_ROW_FILE)


def read_settings(run: Path) -> Settings:
    """The settings of a run; raises BadInputError when the folder is none."""
    path = run / SETTINGS_FILE
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
        return Settings(**table["settings"])
    except (OSError, ValueError, TypeError, KeyError) as error:
        raise BadInputError(
            f"{run} is no folder of a benchmark run: {SETTINGS_FILE} is missing or damaged; "
            "make one with `simart-kit bench run` or `bench score`"
        ) from error


def write_settings(run: Path, settings: Settings) -> None:
    """Write them; `run` must exist."""
    write_json(run / SETTINGS_FILE, {"schema": SCHEMA, "settings": asdict(settings)})


def read_rows(run: Path) -> tuple[Row, ...]:
    """All rows that are done, by name."""
    found = (read_row(run, name) for name in _names(run))
    return tuple(row for row in found if row is not None)


def damaged_rows(run: Path) -> tuple[str, ...]:
    """Names of the objects that have a row which cannot be read."""
    return tuple(name for name in _names(run) if read_row(run, name) is None)


def _names(run: Path) -> list[str]:
    return [path.parent.name for path in sorted((run / OBJECTS).glob(f"*/{ROW_FILE}"))]
