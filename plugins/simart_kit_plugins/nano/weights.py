"""A network as a folder: config.json, and model.safetensors in half precision. No pickle."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from textwrap import shorten
from typing import Literal

import torch
from pydantic import Field, ValidationError

from simart_kit.errors import BadInputError, OutputError

from ..tables import Table, told
from .config import NanoConfig
from .knowledge import Knowledge
from .network import NanoNetwork

CONFIG_FILE, WEIGHTS_FILE = "config.json", "model.safetensors"
_AGAIN = "give a folder that `train nano` wrote, or copy it again"


class _ConfigFile(Table):
    """The JSON file."""

    schema_version: Literal[1] = Field(alias="schema")
    model: Literal["simart-nano"]
    config: NanoConfig
    knowledge: Knowledge = Knowledge()


def shipped_folder() -> Path:
    """The folder of the weights that come with the package."""
    return Path(str(files(__package__))) / "model"


def save_network(network: NanoNetwork, folder: Path, known: Knowledge | None = None) -> None:
    """Write a network; the same weights give the same bytes.

    Args:
        network: any device.
        folder: made where there is none; its files are replaced.
        known: what goes with it.

    Raises:
        OutputError: the folder cannot be written.
    """
    from safetensors.torch import save_file

    tensors = {name: t.detach().cpu().half().contiguous() for name, t in network.state_dict().items()}
    known = known or Knowledge()
    file = _ConfigFile(schema=1, model="simart-nano", config=network.config, knowledge=known)
    partial = folder / f"{WEIGHTS_FILE}.partial"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        text = file.model_dump_json(indent=1, by_alias=True) + "\n"
        (folder / CONFIG_FILE).write_text(text, encoding="utf-8")
        save_file(tensors, partial)
        partial.replace(folder / WEIGHTS_FILE)
    except OSError as error:
        raise OutputError(f"cannot write the model to {folder}: {error.strerror or error}") from error


@dataclass(frozen=True, eq=False)
class NanoModel:
    """What a folder holds.

    Attributes:
        network: on the CPU, in float32.
        known: what goes with it.
    """

    network: NanoNetwork
    known: Knowledge


def load_model(folder: Path) -> NanoModel:
    """Read a folder that `save_network` wrote.

    Raises:
        BadInputError: a file is missing or damaged, the weights are of another config, or not all are finite.
    """
    file = _config(folder / CONFIG_FILE)
    return NanoModel(_network(file.config, folder), file.knowledge)


def _network(config: NanoConfig, folder: Path) -> NanoNetwork:
    tensors = _tensors(folder / WEIGHTS_FILE)
    try:
        network = NanoNetwork(config)
        network.load_state_dict(tensors)
    except RuntimeError as error:
        first = str(error).splitlines()[:2][-1]  # after a headline
        raise BadInputError(
            f"{folder / WEIGHTS_FILE} is not of the network in {CONFIG_FILE} beside it: they are "
            f"of different ones ({shorten(first, 160)}): copy both files from one folder"
        ) from error
    return network.eval()


def _config(path: Path) -> _ConfigFile:
    try:
        return _ConfigFile.model_validate_json(path.read_bytes())
    except OSError as error:
        raise _unread(path, error) from error
    except ValidationError as error:
        raise BadInputError(f"{path} holds no simart-nano ({told(error)}): {_AGAIN}") from error


def _tensors(path: Path) -> dict[str, torch.Tensor]:
    """Float32 copies of what a file holds, by name."""
    from safetensors import SafetensorError
    from safetensors.torch import load_file

    try:
        stored = load_file(path)
    except OSError as error:
        raise _unread(path, error) from error
    except SafetensorError as error:
        raise BadInputError(f"{path} is damaged, it holds no simart-nano ({error}): {_AGAIN}") from error
    wrong = sorted(name for name, t in stored.items() if not (t.is_floating_point() and t.isfinite().all()))
    if wrong:
        raise BadInputError(f"{path}: not all numbers of {wrong[0]} are finite: {_AGAIN}")
    return {name: t.float() for name, t in stored.items()}


def _unread(path: Path, error: OSError) -> BadInputError:
    reason = "no such file" if isinstance(error, FileNotFoundError) else error.strerror or error
    return BadInputError(f"cannot read {path}: {reason}: {_AGAIN}")
