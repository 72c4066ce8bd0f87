"""How a sparse VQ-VAE is trained: a strict JSON table."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Literal, Self

from pydantic import Field, ValidationError, model_validator

from simart_kit.errors import BadInputError, OutputError

from ...tables import Table, told

Stage = Literal[1, 2]


class TrainingConfig(Table):
    """Schedule and optimiser of `train`.

    The paper gives the two stages of 60 000 steps and no more; the rest follows TRELLIS' training of the same
    network (AdamW at 1e-4, no weight decay, batches of 4 a GPU on 8 GPUs).
    """

    stage1_steps: int = Field(default=60_000, ge=0, description="Steps that train the codebook's side only.")
    stage2_steps: int = Field(default=60_000, ge=0, description="Steps that train all parameters.")
    start_codebook: bool = Field(
        default=True,
        description="Set the entries to k-means centres first; off to go on with a model that has codes.",
    )
    batch_size: int = Field(default=32, gt=0, description="Grids a step.")
    learning_rate: float = Field(default=1e-4, gt=0, description="Step size of AdamW, after the warm-up.")
    warm_up: int = Field(
        default=1000, ge=0, description="Steps of each stage in which the rate rises from 0, linearly."
    )
    decay: Literal["constant", "cosine"] = Field(
        default="constant", description="The rate after the warm-up: stays, or falls to 0 by a stage's end."
    )
    weight_decay: float = Field(
        default=0.0, ge=0, description="Of convolution weights; never of codes, norms and biases."
    )
    gradient_clip: float = Field(default=1.0, gt=0, description="Largest norm of a step's whole gradient.")
    augment: bool = Field(
        default=True, description="Turn grids by quarters about z and mirror them, at random."
    )
    seed: int = Field(default=0, ge=0, description="Decides order, augmentation, k-means and revival.")
    checkpoint_every: int = Field(default=1000, gt=0, description="Steps between checkpoints.")
    log_every: int = Field(default=50, gt=0, description="Steps between rows of the log.")
    precision: Literal["fp32", "bf16"] = Field(
        default="fp32", description="Arithmetic of the convolutions; weights and losses stay float32."
    )
    device: str = Field(default="cpu", pattern=r"^(cpu|cuda(:[0-9]+)?)$", description="Where: cpu, cuda:N.")

    @model_validator(mode="after")
    def _check_steps(self) -> Self:
        if not self.steps:
            raise ValueError("stage1_steps and stage2_steps are both 0: nothing would be trained")
        return self

    @property
    def steps(self) -> int:
        """Steps of both stages."""
        return self.stage1_steps + self.stage2_steps

    def stage(self, step: int) -> Stage:
        """Stage of step 0..steps-1."""
        return 1 if step < self.stage1_steps else 2

    def rate(self, step: int) -> float:
        """Learning rate of step 0..steps-1; each stage begins anew."""
        first, length = (
            (0, self.stage1_steps) if self.stage(step) == 1 else (self.stage1_steps, self.stage2_steps)
        )
        done = step - first
        if done < self.warm_up:
            return self.learning_rate * (done + 1) / self.warm_up
        if self.decay == "constant":
            return self.learning_rate
        share = (done - self.warm_up) / (length - self.warm_up)
        return self.learning_rate * (1 + math.cos(math.pi * share)) / 2


class _ConfigFile(Table):
    """The JSON file."""

    schema_version: Literal[1] = Field(alias="schema")
    training: TrainingConfig


def write_training_config(config: TrainingConfig, path: Path) -> None:
    """Write the JSON file that `read_training_config` reads: every field, so later defaults change nothing.

    Raises:
        OutputError: it cannot be written.
    """
    file = _ConfigFile(schema=1, training=config)
    try:
        path.write_text(file.model_dump_json(indent=1, by_alias=True) + "\n", encoding="utf-8")
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error


def read_training_config(path: Path) -> TrainingConfig:
    """Read a config file strictly; fields that it leaves out have their defaults.

    Raises:
        BadInputError: there is no such file, it is damaged, or a key is unknown or wrong; all are told.
    """
    try:
        return _ConfigFile.model_validate_json(path.read_bytes()).training
    except OSError as error:
        raise BadInputError(f"cannot read {path}: {error.strerror}; give a training config") from error
    except ValidationError as error:
        raise BadInputError(f"{path} is no training config: {told(error)}") from error
