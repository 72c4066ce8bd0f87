"""What a training of simart-nano consists of: a strict table."""

from __future__ import annotations

import math
from typing import Literal

from pydantic import Field

from ...tables import Table
from ..config import NanoConfig

# Categories that no training sees: kinds of things and of motions that others resemble more or less.
UNSEEN = (
    "aeroplane",
    "gate",
    "grill",
    "keypad_safe",
    "piano",
    "recliner",
    "shoe_cabinet",
    "stapler",
    "suitcase",
    "thermos",
    "toaster",
    "wheelbarrow",
)


class TrainingPlan(Table):
    """Data, schedule and network; equal plans give equal weights on one kind of device."""

    objects: int = Field(default=40_000, gt=0, description="Made-up objects to train on.")
    held_out: int = Field(
        default=600, gt=0, description="Objects to judge on, of another seed; novelty is measured by as many."
    )
    of_each: int = Field(
        default=10, ge=0, description="Objects of each category by which it is told how alike these are."
    )
    unseen: tuple[str, ...] = Field(default=UNSEEN, description="Categories to judge on and not to train on.")
    static_share: float = Field(default=0.2, ge=0, le=1, description="Share of objects that do not move.")
    nameless_share: float = Field(
        default=0.35, ge=0, le=1, description="Share of objects that are nothing in particular."
    )
    skin_share: float = Field(default=0.3, ge=0, le=1, description="Share of objects that are one skin.")
    relief_share: float = Field(
        default=0, ge=0, le=1, description="Share of objects that are a closed skin, cut by relief."
    )
    seed: int = Field(default=0, ge=0, lt=2**31, description="Decides all that is random.")
    steps: int = Field(default=16_000, gt=0, description="Steps of training.")
    batch_size: int = Field(default=16, gt=0, description="Objects a step.")
    learning_rate: float = Field(default=1e-3, gt=0, description="Step size of AdamW, after the warm-up.")
    warm_up: int = Field(default=200, ge=0, description="Steps in which the rate rises from 0.")
    weight_decay: float = Field(default=0.02, ge=0, description="Of weights; not of norms and biases.")
    gradient_clip: float = Field(default=1.0, gt=0, description="Largest norm of a step's gradient.")
    averaging: float = Field(
        default=0.999, ge=0, lt=1, description="Share of the running mean of the weights kept a step."
    )
    checkpoint_every: int = Field(default=500, gt=0, description="Steps between checkpoints.")
    log_every: int = Field(default=50, gt=0, description="Steps between lines.")
    precision: Literal["fp32", "bf16"] = Field(default="bf16", description="Arithmetic of the network.")
    start: str = Field(default="", description="Folder of the model to go on from; from nothing by default.")
    start_share: float = Field(
        default=0, ge=0, lt=1, description="Share of the weights of `start` in those of the result."
    )
    only: Literal["", "pairs"] = Field(
        default="", description="What is trained, all else held: the pair layers; everything by default."
    )
    device: str = Field(default="cpu", pattern=r"^(cpu|cuda(:[0-9]+)?)$", description="cpu or cuda:N.")
    network: NanoConfig = Field(
        default=NanoConfig(), description="Sizes; labels and categories are filled in."
    )

    def rate(self, step: int) -> float:
        """Learning rate of step 0..steps-1: up linearly, then down to 2 % by a cosine."""
        if step < self.warm_up:
            return self.learning_rate * (step + 1) / self.warm_up
        share = (step - self.warm_up) / max(self.steps - self.warm_up, 1)
        return self.learning_rate * (0.02 + 0.98 * (1 + math.cos(math.pi * share)) / 2)
