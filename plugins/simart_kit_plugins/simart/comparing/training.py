"""The training of a row: so many steps, or so much time, on the same records."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from torch import Tensor

from simart_kit.errors import BadInputError

from ..finetune.adapters import trainable
from ..finetune.examples import ExampleMaker
from ..finetune.lanes import Lane, Place
from ..finetune.machine import machine
from ..finetune.objective import Objective
from ..finetune.optimiser import make_optimiser, set_rate
from ..finetune.plan import FinetunePlan
from ..finetune.records import Records
from ..finetune.step import DivergedError, train_step
from ..mllm.simart_model import SimartModel
from .dense_form import choices_of

Progress = Callable[[int, float], None]


@dataclass(frozen=True)
class Budget:
    """What each row is given.

    Attributes:
        plan: steps, tokens a step and the rest; with `seconds`, the steps are those of its schedule alone.
        seconds: time of the steps [s]; None for as many steps as the plan says.
    """

    plan: FinetunePlan
    seconds: float | None = None


@dataclass(frozen=True)
class Spent:
    """What a row's training took.

    Attributes:
        steps: of the optimiser.
        tokens: read, without padding.
        examples: records read, each as often as it came up.
        loss: mean over the last tenth of the steps [nats a choice]; None where there was no step.
        seconds: time of the steps.
    """

    steps: int
    tokens: int
    examples: int
    loss: float | None
    seconds: float


def trained(
    bundle: SimartModel,
    records: Records,
    maker: ExampleMaker,
    budget: Budget,
    device: str,
    progress: Progress,
) -> Spent:
    """Train a model in place.

    Args:
        bundle: on the CPU; ends on the device, in evaluation mode.
        records: what to train on; the seed of the plan decides their order, which is the same for all rows.
        maker: makes examples in the row's form.
        budget: when to stop.
        device: auto, cpu or cuda.
        progress: told steps done, and the loss.

    Raises:
        BadInputError: the device is not there, no example is short enough, or a loss is not finite.
    """
    plan, tally = budget.plan, _Tally()
    lane = Lane(records, maker, plan, 0, Place())
    with machine(plan, device) as accelerator:
        model = trainable(bundle.model, bundle.vocabulary, plan).train()
        objective = Objective(model, choices_of(bundle.vocabulary)).to(accelerator.device)
        optimiser = make_optimiser(objective, plan)
        begun = time.perf_counter()
        while (place := _place(budget, tally.steps, time.perf_counter() - begun)) < plan.steps:
            set_rate(optimiser, plan.rate(place))
            batch = lane.take()
            try:
                sums, _ = train_step(objective, optimiser, [batch], plan, accelerator)
            except DivergedError as error:
                raise BadInputError(f"{error} at step {tally.steps + 1}: lower --learning-rate") from error
            tally.add(sums, len(batch.cells.present))
            progress(tally.steps, tally.losses[-1])
        seconds = time.perf_counter() - begun
    bundle.model.eval()
    return tally.spent(seconds)


def _place(budget: Budget, steps: int, seconds: float) -> int:
    """Where in the schedule a run stands."""
    if budget.seconds is None:
        return steps
    return int(seconds / budget.seconds * budget.plan.steps)


class _Tally:
    """Sums over the steps."""

    def __init__(self) -> None:
        self.steps = self.tokens = self.examples = 0
        self.losses: list[float] = []

    def add(self, sums: Tensor, examples: int) -> None:
        loss, weight, tokens = sums[:3].tolist()
        self.steps += 1
        self.tokens += int(tokens)
        self.examples += examples
        self.losses.append(loss / max(weight, 1e-9))

    def spent(self, seconds: float) -> Spent:
        last = self.losses[-max(1, len(self.losses) // 10) :]
        mean = sum(last) / len(last) if last else None
        return Spent(self.steps, self.tokens, self.examples, mean, seconds)
