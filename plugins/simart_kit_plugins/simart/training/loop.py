"""The two-stage training of a sparse VQ-VAE."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

from simart_kit.errors import BadInputError, OutputError
from simart_kit.output import claimed

from ..models import VoxelModel
from ..vqnano.components import fit_components
from ..vqnano.model import VqNano
from ..vqvae.checkpoint import save_checkpoint
from ..vqvae.initialise import initialise_codebook
from . import checkpointing
from .checkpointing import Position
from .config import TrainingConfig, write_training_config
from .device import deterministic, training_device
from .grids import Grids
from .log import LOG_FILE, LogRow
from .optimiser import stage_optimiser
from .sampling import Sampler, torch_generator
from .step import DivergedError, check_weights, train_step
from .window import Window

MODEL_FOLDER, CONFIG_FILE = "model", "training.json"
Observer = Callable[[LogRow], None]
# Vectors that k-means is given for each code.
_VECTORS_PER_CODE = 16


def train(
    model: VoxelModel,
    grids: Grids,
    config: TrainingConfig,
    run: Path,
    resume: bool = False,
    observer: Observer | None = None,
) -> VoxelModel:
    """Train a model in place, from its weights or from the last checkpoint of the run.

    Stage 1 trains what `stage_parameters` names, from entries that k-means made of the encoder's features;
    stage 2 trains all. The same model, grids and config give the same weights, whether or not the run was
    stopped and gone on with, on one kind of device with one version of torch.

    Args:
        model: ends on the config's device, all parameters trainable.
        grids: what to train on.
        config: schedule, optimiser, seed and device.
        run: folder of the run: training.json, log.csv, checkpoints/ and at the end model/.
        resume: go on from the last checkpoint; without one the run begins.
        observer: told each row of the log.

    Returns:
        The model.

    Raises:
        BadInputError: the grids are not of the model's resolution, there is no such device, the folder has a
            run and `resume` is off or does not fit, or a loss is not finite: checkpoints then stay as they
            are.
        OutputError: the folder cannot be written, or another run is writing to it.
    """
    if grids.resolution != model.config.resolution:
        raise BadInputError(
            f"grids of {grids.resolution} voxels an edge: this model reads {model.config.resolution}"
        )
    device = training_device(config.device)
    _make(run)
    with claimed(run), deterministic(device):
        checkpoint = _checkpoint(run, resume)
        sampler = Sampler(grids, config, device)
        model.to(device)
        try:
            start = (
                _begin(model, sampler)
                if checkpoint is None
                else checkpointing.load(checkpoint, model, config, grids.fingerprint)
            )
            _take_steps(model, sampler, start, run, observer)
        finally:
            model.requires_grad_(True)
        save_checkpoint(model, run / MODEL_FOLDER)
    return model


def _make(run: Path) -> None:
    try:
        run.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot write the run to {run}: {error.strerror}") from error


def _checkpoint(run: Path, resume: bool) -> Path | None:
    found = checkpointing.latest(run)
    if found is not None and not resume:
        raise BadInputError(
            f"{run} has a run already, up to {found.name}: resume it, or choose another folder"
        )
    return found


def _begin(model: VoxelModel, sampler: Sampler) -> Position:
    """The model with its first codebook, and the optimiser of the first step."""
    config = sampler.config
    if config.start_codebook:
        once = range(math.ceil(len(sampler.grids) / config.batch_size))
        most = _VECTORS_PER_CODE * model.config.codebook_size * model.config.codebooks
        if isinstance(model, VqNano):
            fit_components(model, map(sampler.batch, once))
        initialise_codebook(model, map(sampler.batch, once), torch_generator(config.seed, -1), most)
    return Position(0, stage_optimiser(model, config.stage(0), config))


def _take_steps(
    model: VoxelModel, sampler: Sampler, start: Position, run: Path, observer: Observer | None
) -> None:
    config, optimiser = sampler.config, start.optimiser
    write_training_config(config, run / CONFIG_FILE)
    window = Window(run / LOG_FILE, model.config, start.step)
    for step in range(start.step, config.steps):
        if step == config.stage1_steps and step:
            optimiser = stage_optimiser(model, 2, config)
        voxels = sampler.batch(step)
        try:
            output, revived = train_step(model, optimiser, voxels, config, step)
            window.add(output, revived)
            done, last = step + 1, step + 1 == config.steps
            if last or done % config.log_every == 0:
                row = window.close(done, config, output, voxels)
                if observer is not None:
                    observer(row)
            if last or done % config.checkpoint_every == 0:
                check_weights(model)
                checkpointing.save(run, model, Position(done, optimiser), config, sampler.grids.fingerprint)
        except DivergedError as error:
            raise BadInputError(_advice(error, step, config, run)) from error


def _advice(error: DivergedError, step: int, config: TrainingConfig, run: Path) -> str:
    kept = checkpointing.latest(run)
    good = "no checkpoint was written yet" if kept is None else f"the last good checkpoint is {kept}"
    return (
        f"{error} at step {step + 1} (stage {config.stage(step)}, {config.precision}): {good}; "
        f"lower learning_rate, now {config.learning_rate:g}, and train into another folder"
    )
