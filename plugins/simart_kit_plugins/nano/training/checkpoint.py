"""A training's state on disk: network, its running mean, optimiser, plan and step; no pickle."""

from __future__ import annotations

import json
import shutil
from dataclasses import dataclass
from pathlib import Path

import torch
from torch import Tensor
from torch.optim import AdamW

from simart_kit.errors import BadInputError, OutputError

from ..network import NanoNetwork
from .going_on import weights_of_start
from .plan import TrainingPlan

FOLDER, TENSORS, STATE = "checkpoint", "state.safetensors", "state.json"
# What a run may change when it goes on: it decides what is written, and where it is computed.
_FREE = {"checkpoint_every", "log_every", "device", "start_share"}
# A ValidationError is a ValueError.
_DAMAGE = (OSError, ValueError, KeyError, TypeError, RuntimeError)
_MOMENTS = ("step", "exp_avg", "exp_avg_sq")


@dataclass(eq=False)
class Progressing:
    """What changes from step to step.

    Attributes:
        network: in training.
        mean: running mean of its weights, by name.
        optimiser: of its weights.
        step: steps done.
        seconds: that they took [s].
    """

    network: NanoNetwork
    mean: dict[str, Tensor]
    optimiser: AdamW
    step: int = 0
    seconds: float = 0.0


def begun(plan: TrainingPlan) -> Progressing:
    """The state before the first step: random weights, or those of the model to go on from.

    Raises:
        BadInputError: that model cannot be read, or its network is of other sizes than the plan's.
    """
    network = NanoNetwork(plan.network, plan.seed).to(plan.device)
    if plan.start:
        network.load_state_dict(weights_of_start(plan, network.state_dict()))
    return _with(network, plan)


def result(state: Progressing, plan: TrainingPlan) -> NanoNetwork:
    """What a training gives: the mean of its weights, blended with those that it started from.

    Between both a network keeps what it knew of objects unlike the training's (Wortsman et al., "Robust
    fine-tuning of zero-shot models", 2022).

    Raises:
        BadInputError: the model that it started from cannot be read any more, or is another one.
    """
    weights = state.mean
    if plan.start and plan.start_share:
        start = weights_of_start(plan, state.mean)
        weights = {name: torch.lerp(mean, start[name], plan.start_share) for name, mean in weights.items()}
    state.network.load_state_dict(weights)
    return state.network.eval()


def _with(network: NanoNetwork, plan: TrainingPlan) -> Progressing:
    network = network.to(plan.device)
    if plan.only:
        network.requires_grad_(False)
        network.get_submodule(plan.only).requires_grad_(True)
    optimiser = optimiser_of(network, plan)
    return Progressing(network, {n: t.clone() for n, t in network.state_dict().items()}, optimiser)


def optimiser_of(network: NanoNetwork, plan: TrainingPlan) -> AdamW:
    """AdamW with all its state there from the beginning, so that every state has the same names."""
    learning = [p for p in network.parameters() if p.requires_grad]
    decayed = [p for p in learning if p.ndim > 1]
    others = [p for p in learning if p.ndim <= 1]
    groups = [
        {"params": decayed, "weight_decay": plan.weight_decay},
        {"params": others, "weight_decay": 0.0},
    ]
    optimiser = AdamW(groups, lr=plan.learning_rate, fused=True)
    for parameter in network.parameters():
        first, second = torch.zeros_like(parameter), torch.zeros_like(parameter)
        optimiser.state[parameter] = {"step": torch.tensor(0.0), "exp_avg": first, "exp_avg_sq": second}
    return optimiser


def save(state: Progressing, plan: TrainingPlan, run: Path) -> None:
    """Write the state in place of the last one, in one move.

    Raises:
        OutputError: it cannot be written.
    """
    from safetensors.torch import save_file

    target = run / FOLDER
    partial, old = run / f"{FOLDER}.partial", run / f"{FOLDER}.old"
    text = json.dumps({"step": state.step, "seconds": state.seconds, "plan": plan.model_dump(mode="json")})
    try:
        for stale in (partial, old):
            shutil.rmtree(stale, ignore_errors=True)
        partial.mkdir(parents=True)
        save_file(
            {name: t.detach().cpu().contiguous() for name, t in _tensors(state).items()}, partial / TENSORS
        )
        (partial / STATE).write_text(text + "\n", encoding="utf-8")
        if target.exists():
            target.rename(old)
        partial.rename(target)
        shutil.rmtree(old, ignore_errors=True)
    except OSError as error:
        raise OutputError(f"cannot write the checkpoint {target}: {error.strerror or error}") from error


def exists(run: Path) -> bool:
    """Whether a run has a checkpoint; one that was being replaced when the run was killed counts."""
    return (run / FOLDER).is_dir() or (run / f"{FOLDER}.old").is_dir()


def plan_of(run: Path) -> TrainingPlan:
    """The plan of a run that has a checkpoint.

    Raises:
        BadInputError: it is damaged.
    """
    folder = _folder(run)
    try:
        return _plan(json.loads((folder / STATE).read_text(encoding="utf-8")))
    except _DAMAGE as error:
        raise _damaged(folder, error) from error


def _folder(run: Path) -> Path:
    return run / FOLDER if (run / FOLDER).is_dir() else run / f"{FOLDER}.old"


def _plan(table: dict[str, object]) -> TrainingPlan:
    return TrainingPlan.model_validate_json(json.dumps(table["plan"]))


def _damaged(folder: Path, error: Exception) -> BadInputError:
    return BadInputError(f"{folder} is damaged ({type(error).__name__}): train into another folder")


def load(plan: TrainingPlan, run: Path) -> Progressing:
    """Read the state of a run with this plan.

    Raises:
        BadInputError: it is damaged or of another plan.
    """
    from safetensors import SafetensorError
    from safetensors.torch import load_file

    folder = _folder(run)
    try:
        table = json.loads((folder / STATE).read_text(encoding="utf-8"))
        check_same(_plan(table), plan, folder)
        tensors = load_file(folder / TENSORS)
        state = _with(NanoNetwork(plan.network), plan)
        with torch.no_grad():
            for name, own in _tensors(state).items():
                own.copy_(tensors[name])
        state.step, state.seconds = int(table["step"]), float(table["seconds"])
    except (*_DAMAGE, SafetensorError) as error:
        raise _damaged(folder, error) from error
    return state


def _tensors(state: Progressing) -> dict[str, Tensor]:
    """All tensors by name; they are the state's own."""
    found = {f"network.{name}": tensor for name, tensor in state.network.state_dict().items()}
    found |= {f"mean.{name}": tensor for name, tensor in state.mean.items()}
    for name, parameter in state.network.named_parameters():
        found |= {f"{kind}.{name}": state.optimiser.state[parameter][kind] for kind in _MOMENTS}
    return found


def check_same(then: TrainingPlan, now: TrainingPlan, folder: Path) -> None:
    """Refuse to go on with another plan than a run's; raises BadInputError."""
    old, new = then.model_dump(), now.model_dump()
    changed = [name for name in old if old[name] != new[name] and name not in _FREE]
    if changed:
        raise BadInputError(
            f"{folder} is of another plan ({', '.join(changed)} differ): go on with that one, "
            "or train into another folder"
        )
