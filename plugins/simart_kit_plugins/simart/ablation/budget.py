"""The training that all rows get alike."""

from __future__ import annotations

from dataclasses import dataclass

from simart_kit.errors import BadInputError

from ..training.config import TrainingConfig
from ..training.presets import with_changes


@dataclass(frozen=True)
class Budget:
    """What each row is given.

    Attributes:
        training: its schedule, batch size and seed.
        grids: number of grids that there are to train on.
        fingerprint: of these grids.
        autoencoder: steps of training encoder and decoder without a codebook, before all rows alike.
    """

    training: TrainingConfig
    grids: int
    fingerprint: str
    autoencoder: int = 0

    @property
    def seen(self) -> int:
        """Grids that a row reads in training, each as often as it comes up."""
        return self.training.steps * self.training.batch_size


def shrunk(training: TrainingConfig, steps: int | None) -> TrainingConfig:
    """The same training in another number of steps; stages and their warm-up keep their shares.

    Raises:
        BadInputError: there are no steps.
    """
    if steps is None:
        return training
    if steps < 1:
        raise BadInputError(f"--steps {steps}: give at least 1")
    share = steps / training.steps
    first = round(training.stage1_steps * share)
    warm_up = round(training.warm_up * share)
    return with_changes(training, {"stage1_steps": first, "stage2_steps": steps - first, "warm_up": warm_up})
