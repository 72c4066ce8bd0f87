"""Reading a kinematic spec: TOML or JSON, all mistakes told at once by their place."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from ..errors import BadInputError
from .contradictions import contradictions
from .values import KindSpec, Merge, PartSpec, Spec, Split

# Mistakes for which pydantic has Python's words.
_WORDS = {
    "extra_forbidden": "no such key",
    "missing": "missing",
    "model_type": "must be a table",
    "dict_type": "must be a table",
    "tuple_type": "must be a list",
}
_ROWS: dict[str, type[BaseModel]] = {"parts": PartSpec, "kinds": KindSpec, "merge": Merge, "split": Split}


def read_spec(source: str | Path | Mapping[str, Any] | Spec) -> Spec:
    """A spec from a TOML or JSON file, or from plain values.

    Raises:
        BadInputError: it cannot be read, is not of the format, or contradicts itself; every mistake is told.
    """
    if isinstance(source, Spec):
        spec, where = source, "spec"
    else:
        where = "spec" if isinstance(source, Mapping) else str(source)
        spec = _parsed(source if isinstance(source, Mapping) else _table(Path(source)), where)
    refuse(where, contradictions(spec))
    return spec


def refuse(where: str, mistakes: list[str]) -> None:
    """Raise BadInputError with all mistakes in one line, if there are any."""
    if mistakes:
        raise BadInputError(f"{where} has {len(mistakes)} mistake(s): {'; '.join(mistakes)}")


def _table(path: Path) -> dict[str, Any]:
    try:
        text = path.read_text(encoding="utf-8")
        table = json.loads(text) if path.suffix.lower() == ".json" else tomllib.loads(text)
    except UnicodeDecodeError as error:
        raise BadInputError(f"cannot read spec {path}: it is not UTF-8 text") from error
    except (OSError, json.JSONDecodeError, tomllib.TOMLDecodeError, RecursionError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise BadInputError(f"cannot read spec {path}: {reason}") from error
    if not isinstance(table, dict):
        raise BadInputError(
            f"spec {path} must be a table of keys, such as schema and parts: see docs/spec.md"
        )
    return table


def _parsed(table: Mapping[str, Any], where: str) -> Spec:
    """By way of JSON, so that lists may fill tuples in strict mode."""
    try:
        return Spec.model_validate_json(json.dumps(dict(table), default=str))
    except ValidationError as error:
        refuse(where, [_told(mistake) for mistake in error.errors()])
        raise


def _told(mistake: Any) -> str:
    location = mistake["loc"]
    text = f"{'.'.join(map(str, location))}: {_WORDS.get(mistake['type'], mistake['msg'])}"
    if mistake["type"] == "missing":
        return text
    if mistake["type"] == "extra_forbidden":
        model = _ROWS.get(str(location[0]), Spec) if len(location) > 1 else Spec
        known = ", ".join(field.alias or name for name, field in model.model_fields.items())
        return f"{text}, known are {known}"
    return f"{text} (got {mistake['input']!r})"
