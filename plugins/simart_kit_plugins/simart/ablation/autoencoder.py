"""Encoder and decoder without a codebook: what all rows may start from, as the paper's do from TRELLIS."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import torch
from torch.nn.utils import clip_grad_norm_
from torch.optim import AdamW

from simart_kit.errors import BadInputError

from ..models import VoxelConfig, VoxelModel, build_model
from ..training.config import TrainingConfig
from ..training.grids import Grids
from ..training.sampling import Sampler
from ..vqvae.checkpoint import CONFIG_FILE, load_checkpoint, save_checkpoint
from ..vqvae.losses import losses
from ..vqvae.model import SparseVQVAE

# Told after every step: steps done, and of how many.
Progress = Callable[[int, int], None]


def autoencoder(
    config: VoxelConfig,
    training: TrainingConfig,
    steps: int,
    grids: Grids,
    folder: Path,
    progress: Progress,
) -> SparseVQVAE:
    """Train encoder and decoder alone, or read what an earlier run left in the folder.

    Nothing is quantised and no cell is masked: the decoder gets what the encoder gives, of empty cells too.

    Args:
        config: of the rows.
        training: their batch size, seed, rate, arithmetic and device.
        steps: how many.
        grids: to train on.
        folder: of the weights; written when they are done.
        progress: told how far it is.

    Raises:
        BadInputError: the config has no network over whole grids, or the folder has another model.
        OutputError: the folder cannot be written.
    """
    model = build_model(config, training.seed)
    if not isinstance(model, SparseVQVAE):
        raise BadInputError(
            "vq-nano starts from principal components, not from an autoencoder: "
            "leave --autoencoder out, or choose another --config"
        )
    if (folder / CONFIG_FILE).exists():
        start_from(model, load_checkpoint(folder))
        return model
    model.to(training.device)
    sampler = Sampler(grids, training, torch.device(training.device))
    parameters = [*model.encoder.parameters(), *model.decoder.parameters()]
    optimiser = AdamW(parameters, lr=training.learning_rate, weight_decay=training.weight_decay)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimiser, steps)
    for step in range(steps):
        voxels = sampler.batch(step)
        with torch.autocast(voxels.device.type, torch.bfloat16, enabled=training.precision == "bf16"):
            logits = model.decode_features(model.features(voxels)[0])
        nothing = logits.new_zeros(())
        optimiser.zero_grad()
        torch.autograd.backward(losses(logits, voxels, nothing, nothing, config).total)
        clip_grad_norm_(parameters, training.gradient_clip)
        optimiser.step()
        schedule.step()
        progress(step + 1, steps)
    save_checkpoint(model.cpu(), folder)
    return model


def start_from(model: VoxelModel, start: VoxelModel) -> None:
    """Give a model the encoder and decoder of another, whatever the codebooks are.

    Raises:
        BadInputError: they are of other sizes.
    """
    try:
        model.encoder.load_state_dict(start.encoder.state_dict())
        model.decoder.load_state_dict(start.decoder.state_dict())
    except RuntimeError as error:
        raise BadInputError(
            "the autoencoder of this folder is of another config: choose another --run"
        ) from error
