"""provenance.json: what made the files beside it. The only file of a run that holds a time."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

from .plugins import Failure, Registration
from .recipe import Recipe
from .usage import ModelUsage


def provenance(
    *,
    source: Path,
    source_hash: str,
    recipe: Recipe,
    used: Iterable[Registration],
    failures: Iterable[Failure],
    outputs: Mapping[str, str],
    earlier_outputs: Mapping[str, str],
    seconds: Iterable[tuple[str, str, float]],
    usage: Iterable[tuple[str, str, ModelUsage]],
    arguments: Mapping[str, Any],
) -> dict[str, Any]:
    """The record as plain values; `recipe` in it is a valid recipe that repeats the run."""
    return {
        "schema": 1,
        "simart_kit": version("simart-kit"),
        "python": platform.python_version(),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "input": {"file": source.name, "sha256": source_hash, "bytes": source.stat().st_size},
        "arguments": dict(arguments),
        "recipe": recipe.table(),
        "stages": [
            {
                "kind": r.kind,
                "name": r.name,
                "plugin": r.owner.plugin,
                "distribution": r.owner.distribution,
                "version": r.owner.version,
            }
            for r in used
        ],
        "plugin_failures": [str(f) for f in failures],
        "seconds": [{"stage": stage, "name": name, "seconds": round(s, 4)} for stage, name, s in seconds],
        # Tokens and money that models took which a stage asked; of answers of a cache, neither.
        "models": [{"stage": stage, "name": name} | used.table() for stage, name, used in usage],
        "outputs": dict(outputs),
        # Files that earlier runs left in the folder and this run did not write: not of this asset.
        "earlier_outputs": dict(earlier_outputs),
    }


def file_hash(path: Path) -> str:
    """SHA-256 of a file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def write_json(path: Path, table: Mapping[str, Any]) -> None:
    """Write plain values, readable and always the same."""
    path.write_text(json.dumps(table, indent=1, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8")
