"""A network as a folder: config.json, and model.safetensors in half precision. No pickle."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field, ValidationError

from simart_kit.errors import BadInputError, OutputError

from ..tables import Table
from .config import NanoConfig
from .network import NanoNetwork

CONFIG_FILE, WEIGHTS_FILE = "config.json", "model.safetensors"


class _ConfigFile(Table):
    """The JSON file."""

    schema_version: Literal[1] = Field(alias="schema")
    model: Literal["simart-nano"]
    config: NanoConfig


def save_network(network: NanoNetwork, folder: Path) -> None:
    """Write a network; the same weights give the same bytes.

    Raises:
        OutputError: the folder cannot be written.
    """
    from safetensors.torch import save_file

    tensors = {name: t.detach().cpu().half().contiguous() for name, t in network.state_dict().items()}
    file = _ConfigFile(schema=1, model="simart-nano", config=network.config)
    partial = folder / f"{WEIGHTS_FILE}.partial"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        text = file.model_dump_json(indent=1, by_alias=True) + "\n"
        (folder / CONFIG_FILE).write_text(text, encoding="utf-8")
        save_file(tensors, partial)
        partial.replace(folder / WEIGHTS_FILE)
    except OSError as error:
        raise OutputError(f"cannot write the model to {folder}: {error.strerror or error}") from error


def load_network(folder: Path) -> NanoNetwork:
    """Read a folder that `save_network` wrote, onto the CPU, in float32.

    Raises:
        BadInputError: a file is missing or damaged, or the weights are of another config.
    """
    from safetensors import SafetensorError
    from safetensors.torch import load_file

    try:
        file = _ConfigFile.model_validate_json((folder / CONFIG_FILE).read_bytes())
        network = NanoNetwork(file.config)
        network.load_state_dict({name: t.float() for name, t in load_file(folder / WEIGHTS_FILE).items()})
    except OSError as error:
        raise BadInputError(
            f"cannot read {folder}: {error.strerror or error}: give a model's folder"
        ) from error
    except (ValidationError, SafetensorError, RuntimeError) as error:
        told = str(error).splitlines()[0]
        raise BadInputError(
            f"{folder} holds no simart-nano, or its two files are of different ones ({told})"
        ) from error
    return network.eval()
