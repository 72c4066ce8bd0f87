"""A model's folder as arrays: config.json, and weights in half precision beside it. No pickle, no torch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from textwrap import shorten
from typing import Literal

import numpy as np
from pydantic import Field, ValidationError

from simart_kit.arrays import Float32Array
from simart_kit.errors import BadInputError

from ..tables import Table, told
from .array_network import ArrayNetwork
from .config import NanoConfig
from .kinds import KindStatistics
from .knowledge import Knowledge
from .novelty import TokenStatistics
from .weight_shapes import kind_shapes, statistic_shapes, weight_shapes

CONFIG_FILE, WEIGHTS_FILE = "config.json", "model.safetensors"
# Beside the others, and of the same config: weights for skins that are cut by relief.
SKINS_FILE = "skins.safetensors"
_TOGETHER = "copy both files from one folder, or train it again where an older version made it"
_START = "train it with --start and this folder"
_AGAIN = "give a folder that `train nano` wrote, or copy it again"


class ConfigFile(Table):
    """The JSON file."""

    schema_version: Literal[1] = Field(alias="schema")
    model: Literal["simart-nano"]
    config: NanoConfig
    knowledge: Knowledge = Knowledge()


@dataclass(frozen=True, eq=False)
class StoredModel:
    """What a folder holds.

    Attributes:
        config: sizes of the network.
        known: what goes with it.
        weights: float32, of the shapes that the config says.
        statistics: of what it was trained on; None where none were kept.
    """

    config: NanoConfig
    known: Knowledge
    weights: Mapping[str, Float32Array]
    statistics: TokenStatistics | None

    @property
    def network(self) -> ArrayNetwork:
        """What it says, without torch."""
        return ArrayNetwork(self.config, self.weights)


def reads_skins(folder: Path) -> bool:
    """Whether a model has weights of its own for the pieces of closed skins."""
    return (folder / SKINS_FILE).exists()


def shipped_folder() -> Path:
    """The folder of the weights that come with the package."""
    return Path(str(files(__package__))) / "model"


def read_model(folder: Path, weights_file: str = WEIGHTS_FILE) -> StoredModel:
    """Read one of the files of weights of a folder that `save_network` wrote.

    Raises:
        BadInputError: a file is missing or damaged, the weights are of another config, or not all are finite.
    """
    file = _config(folder / CONFIG_FILE)
    weights = _weights(folder / weights_file)
    wanted = weight_shapes(file.config)
    of_statistics, of_kinds = statistic_shapes(file.config), kind_shapes(file.config)
    for optional in (of_statistics, of_kinds):
        wanted |= optional if weights.keys() & optional.keys() else {}
    wrong = _difference({name: array.shape for name, array in weights.items()}, wanted)
    if wrong:
        apart = weights_file == SKINS_FILE
        raise BadInputError(
            f"{folder / weights_file} is not of the network in {CONFIG_FILE} beside it: they are "
            f"of different ones ({shorten(wrong, 160)}): {_START if apart else _TOGETHER}"
        )
    numbers = [weights.pop(name) for name in of_statistics if name in weights]
    of_each = [weights.pop(name) for name in of_kinds if name in weights]
    kinds = KindStatistics(of_each[0], of_each[1]) if of_each else None
    statistics = TokenStatistics(numbers[0], numbers[1], kinds) if numbers else None
    return StoredModel(file.config, file.knowledge, weights, statistics)


def read_knowledge(folder: Path) -> Knowledge:
    """What goes with the network of a folder.

    Raises:
        BadInputError: the config is missing or damaged.
    """
    return _config(folder / CONFIG_FILE).knowledge


def _difference(shapes: Mapping[str, tuple[int, ...]], wanted: Mapping[str, tuple[int, ...]]) -> str:
    """The first thing in which stored weights are not those of a config; empty where there is none."""
    missing = [name for name in wanted if name not in shapes]
    if missing:
        return f"Missing key {missing[0]}"
    unexpected = [name for name in shapes if name not in wanted]
    if unexpected:
        return f"Unexpected key {unexpected[0]}"
    other = [name for name in wanted if shapes[name] != wanted[name]]
    return f"size mismatch for {other[0]}: {shapes[other[0]]}, not {wanted[other[0]]}" if other else ""


def _config(path: Path) -> ConfigFile:
    try:
        return ConfigFile.model_validate_json(path.read_bytes())
    except OSError as error:
        raise _unread(path, error) from error
    except ValidationError as error:
        raise BadInputError(f"{path} holds no simart-nano ({told(error)}): {_AGAIN}") from error


def _weights(path: Path) -> dict[str, Float32Array]:
    """Float32 copies of what a file holds, by name."""
    from safetensors import SafetensorError
    from safetensors.numpy import load_file

    try:
        stored = load_file(path)
    except OSError as error:
        raise _unread(path, error) from error
    except SafetensorError as error:
        raise BadInputError(f"{path} is damaged, it holds no simart-nano ({error}): {_AGAIN}") from error
    wrong = sorted(
        n for n, array in stored.items() if array.dtype.kind != "f" or not np.isfinite(array).all()
    )
    if wrong:
        raise BadInputError(f"{path}: not all numbers of {wrong[0]} are finite: {_AGAIN}")
    return {name: array.astype(np.float32) for name, array in stored.items()}


def _unread(path: Path, error: OSError) -> BadInputError:
    reason = "no such file" if isinstance(error, FileNotFoundError) else error.strerror or error
    return BadInputError(f"cannot read {path}: {reason}: {_AGAIN}")
