"""How a language model is fine-tuned: a strict JSON table, and the presets that come with the package."""

from __future__ import annotations

import math
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Literal, Self

from pydantic import Field, ValidationError, model_validator

from simart_kit.errors import BadInputError, OutputError

from ...tables import Table, told

LORA_TARGETS = r".*language_model.*\.(q_proj|k_proj|v_proj|o_proj|gate_proj|up_proj|down_proj)"
_OPTIMISER = "AdamW, with betas 0.9 and 0.95"


class KindWeights(Table):
    """Weights in the loss of what a token of the answer is."""

    coordinate: float = Field(default=1.0, ge=0, description="Cells of parts.")
    code: float = Field(default=1.0, ge=0, description="Codes of cells.")
    number: float = Field(default=1.0, ge=0, description="Digits and signs of joints, scale and material.")
    word: float = Field(default=1.0, ge=0, description="Names, types, and where lists end.")


class Lora(Table):
    """Low-rank adapters; all else stays as it is but the rows of the added tokens."""

    rank: int = Field(default=64, gt=0, description="Rank of the adapters.")
    alpha: float = Field(default=128.0, gt=0, description="Scale of the adapters, times 1/rank.")
    dropout: float = Field(default=0.0, ge=0, lt=1, description="Of the adapters' input.")
    targets: str = Field(default=LORA_TARGETS, description="Pattern of the linear layers that get one.")


class FinetunePlan(Table):
    """Schedule, data and arithmetic of `finetune`.

    The paper gives 30 000 steps on 32 GPUs and no more. A step takes `lanes` batches of up to `batch_tokens`
    tokens, whatever the number of processes; they share the lanes out between them.
    """

    size: str = Field(description="Preset or file of the language model's size: see mllm/sizes.")
    prompt: Literal["paper", "short", "none"] = Field(description="System prompt; the model keeps it.")
    steps: int = Field(gt=0, description="Steps of the optimiser.")
    batch_tokens: int = Field(gt=0, description="Most tokens of a batch, padding included.")
    lanes: int = Field(default=1, gt=0, description="Batches a step; a multiple of the processes.")
    longest: int = Field(default=8192, gt=0, description="Longer examples are left out [tokens].")
    multiple: int = Field(default=64, gt=0, description="Rows are padded to a multiple of so many tokens.")
    packing: bool = Field(default=False, description="Several examples in a row, blind to each other.")
    pool: int = Field(default=512, gt=0, description="Records of a lane that batches are sorted among.")
    learning_rate: float = Field(gt=0, description=f"Step size of {_OPTIMISER}.")
    lowest_rate: float = Field(default=0.0, ge=0, le=1, description="Share of the rate at the last step.")
    warm_up: int = Field(default=500, ge=0, description="Steps in which the rate rises from 0.")
    weight_decay: float = Field(default=0.01, ge=0, description="Of matrices; not of norms and embeddings.")
    gradient_clip: float = Field(default=1.0, gt=0, description="Largest norm of a step's gradient.")
    precision: Literal["fp32", "bf16"] = Field(default="fp32", description="Arithmetic of the layers.")
    weights: Literal["fp32", "bf16"] = Field(default="fp32", description="What the weights are kept in.")
    picture_share: float = Field(default=0.5, ge=0, le=1, description="Examples asked with their picture.")
    grounding_share: float = Field(default=0.25, ge=0, le=1, description="Examples that ask for one part.")
    forced_weight: float = Field(
        default=0.0, ge=0, le=1, description="Weight in the loss of tokens that the grammar leaves no choice."
    )
    constrained: bool = Field(
        default=False,
        description="Compare a token with those alone that the grammar would allow: for models that are "
        "always decoded under it.",
    )
    kinds: KindWeights = Field(default_factory=KindWeights, description="Weights of the others.")
    train_vision: bool = Field(default=True, description="Whether the vision tower is trained too.")
    lora: Lora | None = Field(default=None, description="Low-rank adapters; null: all weights are trained.")
    fsdp: bool = Field(default=False, description="Share weights and optimiser out over the processes.")
    checkpoint_layers: bool = Field(default=False, description="Compute layers again instead of keeping.")
    seed: int = Field(default=0, ge=0, description="Decides first weights, order and draws.")
    log_every: int = Field(default=10, gt=0, description="Steps between rows of the log.")
    checkpoint_every: int = Field(default=200, gt=0, description="Steps between checkpoints.")
    evaluate_every: int = Field(default=0, ge=0, description="Steps between evaluations; 0: at the end.")
    evaluated: int = Field(default=16, ge=0, description="Held-out records that answers are made for.")
    held_out: float = Field(default=0.02, ge=0, lt=1, description="Share of objects that are kept out.")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.batch_tokens < self.longest:
            raise ValueError(f"batch_tokens {self.batch_tokens} cannot hold the longest, {self.longest}")
        if self.longest % self.multiple or self.batch_tokens % self.multiple:
            raise ValueError(f"longest and batch_tokens must be multiples of {self.multiple}")
        if self.constrained and self.forced_weight:
            raise ValueError("constrained leaves forced tokens no other choice: forced_weight must be 0")
        if self.constrained and (self.lora is not None or self.fsdp):
            raise ValueError("constrained is for models that are trained whole: leave out lora and fsdp")
        if self.warm_up >= self.steps:
            raise ValueError(f"warm_up {self.warm_up} must end before step {self.steps}")
        if self.fsdp and self.weights != "fp32":
            raise ValueError("weights that are shared out must be kept in fp32; precision may be bf16")
        return self

    def rate(self, step: int) -> float:
        """Learning rate of step 0..steps-1: a line up, then a cosine down."""
        if step < self.warm_up:
            return self.learning_rate * (step + 1) / self.warm_up
        share = (step - self.warm_up) / (self.steps - self.warm_up)
        fallen = (1 + math.cos(math.pi * share)) / 2
        return self.learning_rate * (self.lowest_rate + (1 - self.lowest_rate) * fallen)


class _PlanFile(Table):
    """The JSON file."""

    schema_version: Literal[1] = Field(alias="schema")
    plan: FinetunePlan


def packaged_plans() -> dict[str, Path]:
    """Presets that come with the package, by name."""
    folder = Path(str(files("simart_kit_plugins.simart"))) / "finetune" / "configs"
    return {path.stem: path for path in sorted(folder.glob("*.json"))}


def read_plan(source: str) -> FinetunePlan:
    """Read a packaged preset by its name, or a file.

    Raises:
        BadInputError: there is no such preset, the file is damaged, or a key is unknown, missing or wrong.
    """
    known = packaged_plans()
    path = known.get(source, Path(source))
    try:
        return _PlanFile.model_validate_json(path.read_bytes()).plan
    except FileNotFoundError as error:
        raise BadInputError(
            f"unknown config '{source}': no such file, and the presets are {', '.join(known)}"
        ) from error
    except OSError as error:
        raise BadInputError(f"cannot read config {path}: {error.strerror}") from error
    except ValidationError as error:
        raise BadInputError(f"{path} is no plan of a fine-tuning: {told(error)}") from error


def write_plan(plan: FinetunePlan, path: Path) -> None:
    """Write the JSON file that `read_plan` reads, every field in it.

    Raises:
        OutputError: it cannot be written.
    """
    text = _PlanFile(schema=1, plan=plan).model_dump_json(indent=1, by_alias=True) + "\n"
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error


def changed_plan(plan: FinetunePlan, changes: Mapping[str, object]) -> FinetunePlan:
    """The plan with some fields changed; those that are None stay. Fewer steps shorten the warm-up.

    Raises:
        BadInputError: a value is wrong; all are told.
    """
    given = {name: value for name, value in changes.items() if value is not None}
    steps = given.get("steps", plan.steps)
    if isinstance(steps, int) and "warm_up" not in given:
        given["warm_up"] = min(plan.warm_up, steps // 10)
    try:
        return FinetunePlan.model_validate(plan.model_dump() | given)
    except ValidationError as error:
        raise BadInputError(f"options of the fine-tuning: {told(error)}") from error
