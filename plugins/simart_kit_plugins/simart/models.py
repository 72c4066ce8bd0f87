"""The voxel models that there are, by the name that their config file gives."""

from __future__ import annotations

from dataclasses import dataclass

from simart_kit.errors import BadInputError

from .vqnano.config import VqNanoConfig
from .vqnano.model import VqNano
from .vqvae.config import VqvaeConfig
from .vqvae.model import SparseVQVAE

VoxelModel = SparseVQVAE | VqNano
VoxelConfig = VqvaeConfig | VqNanoConfig


@dataclass(frozen=True)
class ModelKind:
    """A class of models.

    Attributes:
        name: in config files.
        config: its table; `build_model` builds what it describes.
    """

    name: str
    config: type[VqvaeConfig] | type[VqNanoConfig]


KINDS = (
    ModelKind("sparse-vqvae", VqvaeConfig),
    ModelKind("vq-nano", VqNanoConfig),
)


def model_kind(name: str) -> ModelKind:
    """The kind of this name; raises BadInputError, with the names that there are."""
    for kind in KINDS:
        if kind.name == name:
            return kind
    raise BadInputError(f"model '{name}' is not known: use {' or '.join(kind.name for kind in KINDS)}")


def kind_of(config: VoxelConfig) -> ModelKind:
    """The kind that a config is of."""
    return next(kind for kind in KINDS if isinstance(config, kind.config))


def build_model(config: VoxelConfig, seed: int = 0) -> VoxelModel:
    """A model with random weights; the same seed gives the same ones."""
    if isinstance(config, VqNanoConfig):
        return VqNano(config, seed)
    return SparseVQVAE(config, seed)
