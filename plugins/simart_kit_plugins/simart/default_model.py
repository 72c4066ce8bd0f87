"""Which model turns voxels into tokens and back: the shipped one, or a folder that a person names."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

from simart_kit.errors import BadInputError
from simart_kit.extras import require_extra
from simart_kit.provenance import file_hash

from .codec import TokenModel, token_grid
from .tokens import TokenGrid

WEIGHTS_FILE = "model.safetensors"
_FINGERPRINT = 16


@dataclass(frozen=True, eq=False)
class LoadedModel:
    """A model whose tokens can be written down.

    Attributes:
        model: it.
        grid: the cells and codes of its tokens.
        fingerprint: first 16 hex digits of the SHA-256 of its weights' file; codes mean nothing to others.
        folder: where it was read.
    """

    model: TokenModel
    grid: TokenGrid
    fingerprint: str
    folder: Path


def default_model_folder() -> Path:
    """The folder of the model that comes with the package, config.json and model.safetensors in it."""
    return Path(str(files(__package__))) / "weights" / "vq-nano"


def load_model(folder: Path | None = None) -> LoadedModel:
    """Read a model, by default the shipped one, onto the CPU. Imports torch.

    Raises:
        BadInputError: there is no torch, a file is missing or damaged, the weights are of another config, or
            the model has no tokens that can be written (see `token_grid`).
    """
    require_extra("torch", "a voxel model")
    from .vqvae.checkpoint import load_checkpoint

    folder = default_model_folder() if folder is None else folder
    model: TokenModel = load_checkpoint(folder)
    try:
        grid = token_grid(model)
    except BadInputError as error:
        raise BadInputError(f"{folder}: {error}") from error
    return LoadedModel(model, grid, fingerprint(folder), folder)


def fingerprint(folder: Path) -> str:
    """First 16 hex digits of the SHA-256 of the weights in a model's folder."""
    return file_hash(folder / WEIGHTS_FILE)[:_FINGERPRINT]
