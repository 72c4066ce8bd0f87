"""The manifest of a data set: what it was made of and how, its shards and what they hold."""

from __future__ import annotations

import json
import os
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from simart_kit.errors import BadInputError

from .statistics import Statistics

MANIFEST = "manifest.json"
SCHEMA = 1
FORMAT = "simart-kit instruction data"


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class DataFolder(_Table):
    """A folder of objects with ground truth."""

    name: str = Field(description="Of the folder.")
    objects: int = Field(description="Objects found in it.")
    sha256: str = Field(description="Of the names of its objects, one a line.")


class BuildOptions(_Table):
    """All that decides which records come out; a folder holds records of one set of options."""

    data: tuple[DataFolder, ...] = Field(default=(), description="--data")
    generate: tuple[str, ...] = Field(default=(), description="--generate")
    count: int = Field(default=1, description="-n")
    seed: int = Field(default=0, description="--seed")
    states: int = Field(default=20, description="--states")
    pictures: bool = Field(default=True, description="--pictures")
    max_parts: int = Field(default=32, description="--max-parts")
    limit: int | None = Field(default=None, description="--limit")
    shard_size: int = Field(default=1000, description="--shard-size")
    codec: str = Field(description="--model")


class Shard(_Table):
    """A file of records."""

    file: str = Field(description="Name in the folder.")
    sha256: str = Field(description="Of the file.")
    bytes: int = Field(description="Of the file.")
    records: int = Field(description="Records in it.")


class Manifest(_Table):
    """What `manifest.json` holds."""

    format: str = FORMAT
    schema_version: int = SCHEMA
    options: BuildOptions
    grid: tuple[int, int, int] = Field(description="Cells along x, y and z.")
    codebook: int = Field(description="Codes.")
    shards: tuple[Shard, ...]
    statistics: Statistics
    skipped: tuple[tuple[str, str], ...] = Field(description="The first objects left out, and why.")


def read_manifest(folder: Path) -> Manifest:
    """The manifest of a data set; raises BadInputError where there is none, or it is damaged."""
    path = folder / MANIFEST
    if not folder.is_dir():
        raise BadInputError(f"no such folder: {folder}")
    if not path.is_file():
        raise BadInputError(
            f"{folder} holds no finished data set ({MANIFEST} is missing): "
            "make one with `simart-kit dataset build`, or run the same command again to finish it"
        )
    try:
        manifest = Manifest.model_validate_json(path.read_bytes())
    except (OSError, ValidationError) as error:
        raise BadInputError(f"{path} is damaged: {first_line(error)}") from error
    if manifest.schema_version != SCHEMA:
        raise BadInputError(f"{path}: schema {manifest.schema_version}, this version reads {SCHEMA}")
    return manifest


def write_whole(path: Path, table: BaseModel) -> None:
    """Write values as JSON; the file appears whole or not at all, even if the power fails."""
    partial = path.with_name(f"{path.name}.partial")
    text = json.dumps(table.model_dump(mode="json"), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    with partial.open("w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    partial.replace(path)


def first_line(error: Exception) -> str:
    """What is wrong, in one line."""
    if isinstance(error, ValidationError):
        first = error.errors()[0]
        return f"{'.'.join(map(str, first['loc']))}: {first['msg']}"
    return str(error)
