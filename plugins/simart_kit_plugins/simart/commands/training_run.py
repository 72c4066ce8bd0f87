"""A run of `train vqvae`: from a preset and data to a trained model and its scores."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import torch

from simart_kit.errors import BadInputError
from simart_kit.plugins import Plugins

from ..models import VoxelModel, build_model
from ..training import checkpointing
from ..training.config import TrainingConfig
from ..training.device import training_device
from ..training.evaluation import Evaluation, evaluate
from ..training.grids import Grids
from ..training.loop import MODEL_FOLDER, train
from ..training.presets import model_from, read_preset, with_changes
from .training_data import held_out_grids, training_grids
from .training_display import Display


@dataclass(frozen=True)
class Order:
    """What a command line asks for.

    Attributes:
        preset: name or file.
        run: folder of the run.
        folders: of meshes to train on.
        generated: number of objects to make and train on.
        held_out: number of objects to make and judge the model on.
        resume: go on with the run.
        start: folder of a model to begin with; None for random weights.
        changes: of the preset's training config; None for fields that stay.
        threads: processors to use; None for as many as torch does by itself.
    """

    preset: str
    run: Path
    folders: tuple[Path, ...]
    generated: int
    held_out: int
    resume: bool
    start: Path | None
    changes: Mapping[str, object]
    threads: int | None = None


@dataclass(frozen=True)
class Outcome:
    """What a run gave.

    Attributes:
        model: folder of the trained model.
        grids: number of grids that it was trained on.
        steps: of both stages.
        held_out: its scores on held-out objects; None if there are none.
    """

    model: Path
    grids: int
    steps: int
    held_out: Evaluation | None


def perform(order: Order, plugins: Plugins, display: Display) -> Outcome:
    """Train as ordered.

    Raises:
        BadInputError: the preset, an option, the data or the folder of the run cannot be used. What can be
            told before the data are read is told then.
        OutputError: the folder or the cache cannot be written.
    """
    preset = read_preset(order.preset)
    training = with_changes(preset.training, order.changes)
    _check_run(order)
    training_device(training.device)
    if order.threads is not None:
        torch.set_num_threads(order.threads)
    config, start = preset.config, order.start
    model = build_model(config, training.seed) if start is None else model_from(start, config)
    resolution = model.config.resolution
    grids = training_grids(
        order.folders, order.generated, training.seed, resolution, plugins, display.progress
    )
    held_out = held_out_grids(order.held_out, resolution, display.progress) if order.held_out else None
    display.say(f"training {order.preset} on {len(grids)} grids, {training.steps} steps, {training.device}")
    _train(model, grids, training, order, display)
    scores = None if held_out is None else _scores(model, held_out)
    return Outcome(order.run / MODEL_FOLDER, len(grids), training.steps, scores)


def _check_run(order: Order) -> None:
    """What `train` would refuse too, but only after the data have been read."""
    found = checkpointing.latest(order.run)
    if found is not None and not order.resume:
        raise BadInputError(
            f"{order.run} has a run already, up to {found.name}: go on with --resume, or choose another --run"
        )


def _train(model: VoxelModel, grids: Grids, training: TrainingConfig, order: Order, display: Display) -> None:
    codes = model.config.codebook_size - model.config.first_code
    train(model, grids, training, order.run, order.resume, lambda row: display.row(row, training, codes))


def _scores(model: VoxelModel, grids: Grids) -> Evaluation:
    return evaluate(model, (grids.occupancy([row])[0] for row in range(len(grids))))
