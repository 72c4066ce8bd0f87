"""The config file beside a model's weights: its kind and all of its sizes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, ValidationError

from simart_kit.errors import BadInputError

from ...tables import Table, told
from ..models import VoxelConfig, kind_of, model_kind


class _ConfigFile(Table):
    """The JSON file."""

    schema_version: Literal[1] = Field(alias="schema")
    model: str
    config: dict[str, Any]


def write_config(config: VoxelConfig, path: Path) -> None:
    """Write the JSON file that `read_config` reads; every field, so that later defaults change nothing."""
    file = _ConfigFile(schema=1, model=kind_of(config).name, config=config.model_dump(mode="json"))
    path.write_text(file.model_dump_json(indent=1, by_alias=True) + "\n", encoding="utf-8")


def read_config(path: Path) -> VoxelConfig:
    """Read a config file strictly.

    Raises:
        BadInputError: there is no such file, it is damaged, or a key is unknown, missing or wrong.
    """
    try:
        file = _ConfigFile.model_validate_json(path.read_bytes())
    except OSError as error:
        raise BadInputError(f"cannot read {path}: {error.strerror}; give the folder of a model") from error
    except ValidationError as error:
        raise BadInputError(f"{path} is no config of a voxel model: {told(error)}") from error
    try:
        return model_kind(file.model).config.model_validate_json(json.dumps(file.config))
    except ValidationError as error:
        raise BadInputError(f"{path} is no config of a {file.model}: {told(error)}") from error
    except BadInputError as error:
        raise BadInputError(f"{path}: {error}") from error
