"""The voxel model without zero token, which force-sparse sequences need: trained here where none is given."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from simart_kit.errors import BadInputError

from ..ablation.budget import shrunk
from ..ablation.coding import Emptiness
from ..default_model import LoadedModel
from ..models import build_model
from ..training.config import TrainingConfig
from ..training.grids import Grids
from ..training.loop import MODEL_FOLDER, train
from ..training.presets import Preset, read_preset, with_changes
from .dropping import dropping_codec

_PRESET, _BATCH = "nano", 8


def codec_without_zero_token(
    data: LoadedModel,
    grids: Grids,
    given: Path | None,
    run: Path,
    steps: int,
    seed: int,
    say: Callable[[str], None],
) -> tuple[LoadedModel, Emptiness]:
    """A dense model of the data's cells and codes, as `dropping_codec` gives it.

    Args:
        data: the voxel model of the data.
        grids: to train on, and to tell which code stands for emptiness.
        given: folder of such a model; None to train the small one of preset nano without a zero token.
        run: folder of its training, which goes on where it was stopped.
        steps: of the training.
        seed: of the training.
        say: told what goes on.

    Raises:
        BadInputError: the given model does not fit, or `run` has a training of another kind.
    """
    if given is not None:
        return dropping_codec(given, data, grids)
    preset = _preset(data, steps, seed)
    say(f"training a voxel model without zero token: {steps} steps on {len(grids)} grids")
    model = build_model(preset.config, seed)
    train(model, grids, preset.training, run, True, lambda row: say(f"step {row.step}  iou {row.iou:.3f}"))
    return dropping_codec(run / MODEL_FOLDER, data, grids)


def _preset(data: LoadedModel, steps: int, seed: int) -> Preset:
    """Preset nano with the data's cells and codes, without zero token.

    One codebook for all, since which of several a code is from would be told by the empty cells around.
    """
    if steps < 1:
        raise BadInputError(f"--codec-steps {steps}: give at least 1")
    nano = read_preset(_PRESET)
    changes = {
        "mode": "dense",
        "grid": "x".join(map(str, data.grid.shape)),
        "codebook_size": data.grid.codebook,
        "contexts": 1,
        "candidates": 1,
    }
    config = type(nano.config).model_validate(nano.config.model_dump() | changes)
    training: TrainingConfig = with_changes(
        shrunk(nano.training, steps), {"batch_size": _BATCH, "seed": seed, "log_every": max(1, steps // 5)}
    )
    return Preset(config, training)
