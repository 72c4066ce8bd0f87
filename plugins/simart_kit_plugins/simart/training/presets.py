"""Presets of `train vqvae`: a model and how it is trained, in one JSON file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, ValidationError

from simart_kit.errors import BadInputError

from ...tables import Table, told
from ..models import VoxelConfig, VoxelModel, build_model, model_kind
from ..vqvae.checkpoint import load_checkpoint
from .config import TrainingConfig

# Fields of a model's config that say how it is trained, not what its weights are.
_FREE = {"beta", "dice_weight", "ema_decay", "revive_after"}


@dataclass(frozen=True)
class Preset:
    """A preset that was read.

    Attributes:
        config: of the model.
        training: schedule and optimiser.
    """

    config: VoxelConfig
    training: TrainingConfig


class _PresetFile(Table):
    """The JSON file; what `training` leaves out has its default."""

    schema_version: Literal[1] = Field(alias="schema")
    model: str
    config: dict[str, Any]
    training: TrainingConfig


def packaged_presets() -> dict[str, Path]:
    """Presets that come with the package, by name."""
    folder = Path(str(files("simart_kit_plugins.simart"))) / "configs"
    return {path.stem: path for path in sorted(folder.glob("*.json"))}


def read_preset(source: str) -> Preset:
    """Read a packaged preset by its name, or a file.

    Raises:
        BadInputError: there is no such preset, the file is damaged, or a key is unknown, missing or wrong.
    """
    known = packaged_presets()
    path = known.get(source, Path(source))
    try:
        file = _PresetFile.model_validate_json(path.read_bytes())
    except FileNotFoundError as error:
        raise BadInputError(
            f"unknown config '{source}': no such file, and the presets are {', '.join(known)}"
        ) from error
    except OSError as error:
        raise BadInputError(
            f"cannot read config {path}: {error.strerror}; give a file, or one of {', '.join(known)}"
        ) from error
    except ValidationError as error:
        raise BadInputError(f"{path} is no config of a training: {told(error)}") from error
    try:
        # As JSON: strict tables take lists for tuples from JSON only.
        config = model_kind(file.model).config.model_validate_json(json.dumps(file.config))
    except BadInputError as error:
        raise BadInputError(f"{path}: {error}") from error
    except ValidationError as error:
        raise BadInputError(f"{path}: config of {file.model}: {told(error)}") from error
    return Preset(config, file.training)


def with_changes(training: TrainingConfig, changes: Mapping[str, object]) -> TrainingConfig:
    """The config with some fields changed; those that are None stay.

    Raises:
        BadInputError: a value is wrong; all are told.
    """
    given = {name: value for name, value in changes.items() if value is not None}
    try:
        return TrainingConfig.model_validate(training.model_dump() | given)
    except ValidationError as error:
        raise BadInputError(f"training options: {told(error)}") from error


def model_from(folder: Path, config: VoxelConfig) -> VoxelModel:
    """A model of a config with the weights of another, such as an imported one.

    Raises:
        BadInputError: the folder is no model, or one of another config.
    """
    given, model = load_checkpoint(folder), build_model(config)
    old, new = given.config.model_dump(), config.model_dump()
    names = [name for name in old | new if name not in _FREE]
    other = [f"{n} {old.get(n)}, not {new.get(n)}" for n in names if old.get(n) != new.get(n)]
    if type(given) is not type(model) or other:
        raise BadInputError(
            f"{folder} is a model of another config ({'; '.join(other) or 'another kind of model'}): "
            "start with the config that it was made with"
        )
    model.load_state_dict(given.state_dict())
    return model
