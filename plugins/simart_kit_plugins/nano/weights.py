"""A network as a folder, for torch: to write one, and to train one on."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import torch

from simart_kit.arrays import Float32Array
from simart_kit.errors import OutputError

from .knowledge import Knowledge
from .network import NanoNetwork
from .novelty import TokenStatistics
from .stored_model import CONFIG_FILE, WEIGHTS_FILE, ConfigFile, read_model
from .weight_shapes import kind_shapes, statistic_shapes


def save_network(
    network: NanoNetwork,
    folder: Path,
    known: Knowledge | None = None,
    statistics: TokenStatistics | None = None,
) -> None:
    """Write a network; the same weights give the same bytes.

    Args:
        network: any device.
        folder: made where there is none; its files are replaced.
        known: what goes with it.
        statistics: of what it was trained on.

    Raises:
        OutputError: the folder cannot be written.
    """
    from safetensors.torch import save_file

    tensors = {name: t.detach().cpu().half().contiguous() for name, t in network.state_dict().items()}
    if statistics is not None:
        tensors |= _halves(statistic_shapes(network.config), statistics.mean, statistics.whitening)
        if statistics.kinds is not None:
            kinds = statistics.kinds
            tensors |= _halves(kind_shapes(network.config), kinds.means, kinds.whitening)
    known = known or Knowledge()
    file = ConfigFile(schema=1, model="simart-nano", config=network.config, knowledge=known)
    partial = folder / f"{WEIGHTS_FILE}.partial"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        text = file.model_dump_json(indent=1, by_alias=True) + "\n"
        (folder / CONFIG_FILE).write_text(text, encoding="utf-8")
        save_file(tensors, partial)
        partial.replace(folder / WEIGHTS_FILE)
    except OSError as error:
        raise OutputError(f"cannot write the model to {folder}: {error.strerror or error}") from error


def _halves(names: Iterable[str], *arrays: Float32Array) -> dict[str, torch.Tensor]:
    return {name: torch.from_numpy(one).half() for name, one in zip(names, arrays, strict=True)}


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
    """Read a folder that `save_network` wrote; raises BadInputError as `read_model` does."""
    stored = read_model(folder)
    network = NanoNetwork(stored.config)
    network.load_state_dict({name: torch.from_numpy(array) for name, array in stored.weights.items()})
    return NanoModel(network.eval(), stored.known)
