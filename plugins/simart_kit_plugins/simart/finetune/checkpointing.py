"""Checkpoints of a fine-tuning: all that the next step depends on, as safetensors and JSON.

    RUN/checkpoints/step-0000200/
        state.json                step, plan, places of the lanes, fingerprints
        rank-00000.safetensors    what training changes, the share of each process, and AdamW's moments

Random numbers have no state: every draw has a generator of its own.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Literal

import torch
from pydantic import Field, ValidationError
from torch import Tensor

from simart_kit.errors import BadInputError, OutputError

from ...tables import Table, told
from ..vqvae.weights import read_tensors
from .lanes import Place
from .plan import FinetunePlan

FOLDER, STATE_FILE = "checkpoints", "state.json"
_KEPT = 2
# Fields that a run may change when it goes on: they decide what is written, not what is learnt.
_FREE = {"log_every", "checkpoint_every", "evaluate_every", "evaluated"}


class State(Table):
    """state.json."""

    schema_version: Literal[1] = Field(default=1, alias="schema")
    step: int = Field(ge=0, description="Steps done.")
    tokens: int = Field(default=0, ge=0, description="Tokens read until then.")
    data: str = Field(description="Fingerprint of the records.")
    model: str = Field(description="Identity of the tokens and the codebook.")
    processes: int = Field(gt=0, description="Processes that share the weights.")
    places: tuple[tuple[int, int, int], ...] = Field(description="Epoch, pool and batch of each lane.")
    plan: FinetunePlan

    def place(self, lane: int) -> Place:
        """Where a lane goes on."""
        return Place(*self.places[lane])


def latest(run: Path) -> Path | None:
    """The checkpoint of a run with the most steps, or None."""
    found = _checkpoints(run)
    return found[-1] if found else None


def write_share(run: Path, step: int, rank: int, tensors: Mapping[str, Tensor]) -> None:
    """Write what one process has; `publish` puts the checkpoint into its place when all have.

    Raises:
        OutputError: the folder cannot be written.
    """
    from safetensors import SafetensorError
    from safetensors.torch import save_file

    partial = _partial(run, step)
    try:
        partial.mkdir(parents=True, exist_ok=True)
        shares = {name: tensor.cpu().contiguous() for name, tensor in tensors.items()}
        path = partial / _share_name(rank)
        save_file(shares, path)
        _flush(path)
    except (OSError, SafetensorError) as error:
        raise OutputError(f"cannot write the checkpoint {partial}: {error}") from error


def publish(run: Path, state: State) -> Path:
    """Give a checkpoint that all processes have written its name, and remove all but the last two.

    Raises:
        OutputError: the folder cannot be written.
    """
    partial = _partial(run, state.step)
    target = partial.with_suffix("")
    try:
        path = partial / STATE_FILE
        path.write_text(state.model_dump_json(indent=1, by_alias=True) + "\n", encoding="utf-8")
        _flush(path)
        if target.exists():
            shutil.rmtree(target)
        partial.replace(target)
        for old in _checkpoints(run)[:-_KEPT]:
            shutil.rmtree(old)
        for stale in partial.parent.glob("*.partial"):  # of a run that was killed
            shutil.rmtree(stale)
    except OSError as error:
        raise OutputError(f"cannot write the checkpoint {target}: {error}") from error
    return target


def read_state(folder: Path, expected: State) -> State:
    """The state of a checkpoint, which must be of the same run as the expected one.

    Raises:
        BadInputError: it is missing or damaged, or of another plan, model, data set or number of processes.
    """
    advice = f"delete {folder} to go on from the checkpoint before it"
    path = folder / STATE_FILE
    try:
        state = State.model_validate_json(path.read_bytes())
    except OSError as error:
        raise BadInputError(f"cannot read {path}: {error.strerror}: {advice}") from error
    except ValidationError as error:
        raise BadInputError(f"{path} is no state of a fine-tuning: {told(error)}: {advice}") from error
    _check_same(folder, state, expected)
    return state


def read_share(folder: Path, rank: int, tensors: Mapping[str, Tensor]) -> None:
    """Put a process's share into tensors of the same names and shapes, in place.

    Raises:
        BadInputError: the file is missing, damaged, or of another model.
    """
    advice = f"delete {folder} to go on from the checkpoint before it"
    read = read_tensors(folder / _share_name(rank), dict(tensors), advice)
    with torch.no_grad():
        for name, own in tensors.items():
            own.copy_(read[name])


def _check_same(folder: Path, state: State, expected: State) -> None:
    then, now = state.plan.model_dump(), expected.plan.model_dump()
    changed = [name for name in then if then[name] != now[name] and name not in _FREE]
    others = [f"{name} {then[name]}, now {now[name]}" for name in changed]
    pairs = {
        "records": (state.data, expected.data),
        "tokens and codebook": (state.model, expected.model),
        "processes": (state.processes, expected.processes),
    }
    others += [f"{name} {old}, now {new}" for name, (old, new) in pairs.items() if old != new]
    if others:
        raise BadInputError(
            f"{folder} is of another run ({'; '.join(others)}): go on with what that one had, "
            "or train into another folder"
        )


def _checkpoints(run: Path) -> list[Path]:
    """Whole checkpoints, the oldest first."""
    found = (run / FOLDER).glob("step-*")
    return sorted((p for p in found if re.fullmatch(r"step-\d{7,}", p.name)), key=lambda p: int(p.name[5:]))


def _partial(run: Path, step: int) -> Path:
    return run / FOLDER / f"step-{step:07d}.partial"


def _share_name(rank: int) -> str:
    return f"rank-{rank:05d}.safetensors"


def _flush(path: Path) -> None:
    """Have a file on the disk before its folder gets its name, so that no power cut leaves an empty one."""
    with path.open("rb+") as file:
        os.fsync(file.fileno())
