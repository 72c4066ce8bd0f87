"""Checkpoints of a run: all that the next step depends on, as safetensors and JSON.

    RUN/checkpoints/step-0000100/
        config.json, model.safetensors    the model, as `load_checkpoint` reads it
        optimiser.safetensors             the state of AdamW, by parameter
        state.json                        step, training config, fingerprint of the data

Random numbers have no state: each step draws from generators of its own.
"""

from __future__ import annotations

import os
import re
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from torch.optim import AdamW

from simart_kit.errors import BadInputError, OutputError

from ...tables import told
from ..models import VoxelModel
from ..vqvae.checkpoint import CONFIG_FILE, WEIGHTS_FILE, save_checkpoint
from ..vqvae.config_file import read_config
from ..vqvae.weights import read_tensors
from .config import TrainingConfig
from .optimiser import load_optimiser_tensors, optimiser_tensors, stage_optimiser

FOLDER = "checkpoints"
OPTIMISER_FILE, STATE_FILE = "optimiser.safetensors", "state.json"
_KEPT = 2
# Fields that a run may change when it goes on: they decide what is written, and where it is computed.
_FREE = {"checkpoint_every", "log_every", "device"}


class _StateFile(BaseModel):
    """state.json."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    schema_version: Literal[1] = Field(alias="schema")
    step: int = Field(gt=0, description="Steps done.")
    data: str = Field(description="Fingerprint of the grids.")
    training: TrainingConfig


@dataclass(frozen=True, eq=False)
class Position:
    """Where a run stands.

    Attributes:
        step: steps done.
        optimiser: that of the stage of the last step done; the model it belongs to was changed in place.
    """

    step: int
    optimiser: AdamW


def latest(run: Path) -> Path | None:
    """The checkpoint of a run with the most steps, or None."""
    found = _checkpoints(run)
    return found[-1] if found else None


def save(run: Path, model: VoxelModel, position: Position, config: TrainingConfig, data: str) -> Path:
    """Write a checkpoint, put it in place in one move, and remove all but the last two.

    Raises:
        OutputError: the folder cannot be written.
    """
    from safetensors import SafetensorError
    from safetensors.torch import save_file

    target = run / FOLDER / f"step-{position.step:07d}"
    partial = target.with_suffix(".partial")
    tensors = {
        name: tensor.detach().cpu().contiguous()
        for name, tensor in optimiser_tensors(model, position.optimiser).items()
    }
    state = _StateFile(schema=1, step=position.step, data=data, training=config)
    try:
        for stale in target.parent.glob("*.partial"):  # of a run that was killed
            shutil.rmtree(stale)
        save_checkpoint(model, partial)
        save_file(tensors, partial / OPTIMISER_FILE)
        text = state.model_dump_json(indent=1, by_alias=True) + "\n"
        (partial / STATE_FILE).write_text(text, encoding="utf-8")
        _flush(partial)
        partial.replace(target)
        for old in _checkpoints(run)[:-_KEPT]:
            shutil.rmtree(old)
    except (OSError, SafetensorError) as error:
        raise OutputError(f"cannot write the checkpoint {target}: {error}") from error
    return target


def load(folder: Path, model: VoxelModel, config: TrainingConfig, data: str) -> Position:
    """Put a checkpoint into a model of the same config, on the model's device.

    Raises:
        BadInputError: a file is missing or damaged, or the checkpoint is of another model, training config or
            data set, with which the run would become another one.
    """
    advice = f"delete {folder} to go on from the checkpoint before it"
    state = _read_state(folder / STATE_FILE, advice)
    _check_same(folder, state, model, config, data)
    optimiser = stage_optimiser(model, config.stage(state.step - 1), config)
    expected = optimiser_tensors(model, optimiser)
    weights = read_tensors(folder / WEIGHTS_FILE, model.state_dict(), advice)
    moments = read_tensors(folder / OPTIMISER_FILE, expected, advice)
    model.load_state_dict(weights)
    load_optimiser_tensors(model, optimiser, moments)
    return Position(state.step, optimiser)


def _checkpoints(run: Path) -> list[Path]:
    """Whole checkpoints, the oldest first."""
    found = (run / FOLDER).glob("step-*")
    return sorted((p for p in found if re.fullmatch(r"step-\d{7,}", p.name)), key=lambda p: int(p.name[5:]))


def _flush(folder: Path) -> None:
    """Have the files on the disk before the folder gets its name, so that no power cut leaves empty ones."""
    for path in folder.iterdir():
        with path.open("rb+") as file:
            os.fsync(file.fileno())


def _read_state(path: Path, advice: str) -> _StateFile:
    try:
        return _StateFile.model_validate_json(path.read_bytes())
    except OSError as error:
        raise BadInputError(f"cannot read {path}: {error.strerror}: {advice}") from error
    except ValidationError as error:
        raise BadInputError(f"{path} is no state of a training run: {told(error)}: {advice}") from error


def _check_same(
    folder: Path, state: _StateFile, model: VoxelModel, config: TrainingConfig, data: str
) -> None:
    pairs = {
        "model": (read_config(folder / CONFIG_FILE), model.config),
        "training": (state.training, config),
    }
    for kind, (then, now) in pairs.items():
        old, new = then.model_dump(), now.model_dump()
        changed = [name for name in old if old[name] != new[name] and name not in _FREE]
        other = [f"{name} {old[name]}, now {new[name]}" for name in changed]
        if other:
            raise BadInputError(
                f"{folder} is of another {kind} config ({'; '.join(other)}): go on with that one, "
                "or train into another folder"
            )
    if state.data != data:
        raise BadInputError(
            f"{folder} was trained on other grids: give the data that the run began with, "
            "or train into another folder"
        )
