"""The training of simart-nano."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch.nn.utils import clip_grad_norm_

from simart_kit.errors import BadInputError

from ..config import NanoConfig
from ..generate.catalogue import NAMELESS
from ..learning import batch_of, targets_of
from ..losses import losses
from ..mixing import varied
from ..network import NanoNetwork
from ..store import Stored
from ..stored_model import read_model
from . import checkpoint
from .checkpoint import Progressing
from .plan import TrainingPlan

# Objects of a like size lie side by side in so many batches: less padding.
_SORTED = 16


@dataclass(frozen=True)
class NanoRow:
    """A line of the log; losses are means since the last one.

    Attributes:
        step: steps done.
        rate: learning rate.
        total: weighted sum of the terms.
        terms: each, by name.
        seconds: of training, of all runs that led here [s].
    """

    step: int
    rate: float
    total: float
    terms: dict[str, float]
    seconds: float


def with_names(plan: TrainingPlan, examples: Sequence[Stored]) -> TrainingPlan:
    """The plan with the labels and categories of the examples and of the model that it goes on from.

    What is nothing in particular has none.

    Raises:
        BadInputError: that model cannot be read.
    """
    labels = {str(label) for one in examples for label in one.label}
    categories = {one.category for one in examples} - set(NAMELESS)
    if plan.start:
        known = read_model(Path(plan.start)).config
        labels, categories = labels | set(known.labels), categories | set(known.categories)
    named = {"labels": tuple(sorted(labels)), "categories": tuple(sorted(categories))}
    network = NanoConfig(**{**plan.network.model_dump(), **named})
    return plan.model_copy(update={"network": network})


def train(
    plan: TrainingPlan, examples: Sequence[Stored], run: Path, observer: Callable[[NanoRow], None]
) -> NanoNetwork:
    """Train from the run's checkpoint, or from the beginning; see `checkpoint.result` for what is returned.

    Raises:
        BadInputError: the run's checkpoint is of another plan or damaged, or a loss is not finite.
        OutputError: the run cannot be written to.
    """
    state = checkpoint.load(plan, run) if checkpoint.exists(run) else checkpoint.begun(plan)
    began, gathered = time.perf_counter() - state.seconds, list[dict[str, float]]()
    while state.step < plan.steps:
        rows = batch_rows([len(one.own) for one in examples], plan.batch_size, plan.seed, state.step)
        generator = np.random.default_rng((plan.seed, state.step, 1))
        terms = _step(state, plan, varied([examples[row] for row in rows], generator))
        gathered.append(terms)
        state.seconds = time.perf_counter() - began
        last = state.step == plan.steps
        if last or state.step % plan.log_every == 0:
            means = {name: float(np.mean([row[name] for row in gathered])) for name in terms}
            observer(NanoRow(state.step, plan.rate(state.step - 1), means.pop("total"), means, state.seconds))
            gathered = []
        if last or state.step % plan.checkpoint_every == 0:
            checkpoint.save(state, plan, run)
    return checkpoint.result(state, plan)


def batch_rows(sizes: Sequence[int], batch_size: int, seed: int, step: int) -> list[int]:
    """The examples of a step, a function of seed and step alone: pass after pass, each in its own order.

    Args:
        sizes: pieces of each example; those of a batch have about as many.
        batch_size: examples of a step.
        seed: of the order.
        step: 0...
    """
    weights, count = np.asarray(sizes), len(sizes)
    batch_size = min(batch_size, count)
    per_pass = count // batch_size
    turn = step // per_pass
    generator = np.random.default_rng((seed, turn))
    order = generator.permutation(count)
    group = _SORTED * batch_size
    ordered = [
        part[np.argsort(weights[part], kind="stable")] for part in np.split(order, range(group, count, group))
    ]
    batches = np.concatenate(ordered)[: per_pass * batch_size].reshape(per_pass, batch_size)
    return list(map(int, batches[generator.permutation(per_pass)[step % per_pass]]))


def _step(state: Progressing, plan: TrainingPlan, some: Sequence[Stored]) -> dict[str, float]:
    """One step on a few examples; the state changes, and the losses before it are returned."""
    network = state.network
    batch, targets = batch_of(some).to(plan.device), targets_of(some, plan.network).to(plan.device)
    device = torch.device(plan.device).type
    with torch.autocast(device, torch.bfloat16, enabled=plan.precision == "bf16"):
        reading = network(batch)
        found = losses(network, batch, reading, targets)
    state.optimiser.zero_grad()
    torch.autograd.backward(found.total)
    norm = clip_grad_norm_(network.parameters(), plan.gradient_clip)
    if not torch.isfinite(found.total.detach() + norm):
        raise BadInputError(
            f"the loss is not finite at step {state.step + 1}: the last checkpoint is good; "
            f"lower the learning rate, now {plan.learning_rate:g}, and train into another folder"
        )
    for group in state.optimiser.param_groups:
        group["lr"] = plan.rate(state.step)
    state.optimiser.step()
    state.step += 1
    # Early on the mean is over few steps: it must not hold on to where they began.
    kept = min(plan.averaging, state.step / (state.step + 10))
    for name, tensor in network.state_dict().items():
        state.mean[name].lerp_(tensor, 1 - kept)
    return {"total": found.total.item(), **{name: term.item() for name, term in found.terms.items()}}
