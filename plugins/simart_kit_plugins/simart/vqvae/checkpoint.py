"""A model as a folder: config.json for people, model.safetensors for the weights. No pickle."""

from __future__ import annotations

from pathlib import Path

from simart_kit.errors import OutputError

from ..models import VoxelModel, build_model
from .compact import STEP, compacted, expanded
from .config_file import read_config, write_config
from .weights import names, read_tensors

CONFIG_FILE = "config.json"
WEIGHTS_FILE = "model.safetensors"


def save_checkpoint(model: VoxelModel, folder: Path, compact: bool = False) -> Path:
    """Write the folder (the same weights give the same bytes) and return it.

    The weights are put in place in one move: a save that is interrupted leaves the earlier file whole.

    Args:
        model: on any device.
        folder: made where it is missing.
        compact: store the compact form, see `compacted`; `load_checkpoint` makes all float32 again.

    Raises:
        OutputError: the folder cannot be written.
    """
    from safetensors import SafetensorError
    from safetensors.torch import save_file

    tensors = {name: tensor.detach().cpu().contiguous() for name, tensor in model.state_dict().items()}
    tensors = compacted(tensors) if compact else tensors
    partial = folder / f"{WEIGHTS_FILE}.partial"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_config(model.config, folder / CONFIG_FILE)
        save_file(tensors, partial)
        partial.replace(folder / WEIGHTS_FILE)
    except (OSError, SafetensorError) as error:
        raise OutputError(f"cannot write the model to {folder}: {error}") from error
    return folder


def load_checkpoint(folder: str | Path) -> VoxelModel:
    """Read a folder that `save_checkpoint` wrote, onto the CPU.

    Raises:
        BadInputError: a file is missing or damaged, a key is unknown, or the weights are of another config.
    """
    folder = Path(folder)
    model = build_model(read_config(folder / CONFIG_FILE))
    advice = f"give the {WEIGHTS_FILE} that was saved with this {CONFIG_FILE}"
    expected, path = model.state_dict(), folder / WEIGHTS_FILE
    if STEP in names(path, advice):
        model.load_state_dict(expanded(read_tensors(path, compacted(expected), advice), expected))
    else:
        model.load_state_dict(read_tensors(path, expected, advice))
    return model
