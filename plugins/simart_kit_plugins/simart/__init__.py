"""The paper's method: a sparse 3D VQ-VAE, voxel tokens, and a language model that reads and writes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit.hookspecs import hookimpl

if TYPE_CHECKING:
    from simart_kit.findings import Finding
    from simart_kit.hookspecs import Register, RegisterCommand

_COMMANDS = "simart_kit_plugins.simart.commands"


@hookimpl
def register_segmenters(register: Register) -> None:
    """Register `tokens` and `simart`."""
    from .segmenter import Simart
    from .tokens_segmenter import Tokens

    register(Tokens)
    register(Simart)


@hookimpl
def diagnose() -> list[Finding]:
    """What the weights and libraries of this plugin are like."""
    from .diagnosis import findings

    return findings()


@hookimpl
def register_commands(register: RegisterCommand) -> None:
    """Register `tokens`, what trains and compares models, and what is done with them."""
    register("tokens", f"{_COMMANDS}.tokens:tokens", "Count the voxel tokens of a mesh and write them.")
    register("train vqvae", f"{_COMMANDS}.train_vqvae:train_vqvae", "Train a sparse 3D VQ-VAE.")
    register("train mllm", f"{_COMMANDS}.train_mllm:train_mllm", "Fine-tune a Qwen3-VL on instruction data.")
    register(
        "dataset build", f"{_COMMANDS}.dataset_build:dataset_build", "Make instruction data for the model."
    )
    register(
        "model import-trellis",
        f"{_COMMANDS}.import_trellis:import_trellis",
        "Make a sparse 3D VQ-VAE of TRELLIS' weights.",
    )
    register("model evaluate", f"{_COMMANDS}.evaluate_model:evaluate_model", "Score a voxel model.")
    register(
        "model shrink",
        f"{_COMMANDS}.shrink_model:shrink_model",
        "Write a model in half precision, for shipping.",
    )
    register(
        "bench vqvae",
        f"{_COMMANDS}.bench_vqvae:bench_vqvae",
        "Compare configurations of the sparse 3D VQ-VAE.",
    )
    register("bench mllm", f"{_COMMANDS}.bench_mllm:bench_mllm", "Compare forms of voxel sequences.")
