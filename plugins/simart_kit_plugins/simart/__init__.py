"""The paper's method: a sparse 3D VQ-VAE, voxel tokens, and a language model that reads and writes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from simart_kit.hookspecs import hookimpl

if TYPE_CHECKING:
    from simart_kit.findings import Finding
    from simart_kit.hookspecs import Register, RegisterCommand

# Name, function, extra that it needs, and a line on what it does.
_COMMANDS = (
    ("tokens", "tokens:tokens", "torch", "Count the voxel tokens of a mesh and write them."),
    ("train vqvae", "train_vqvae:train_vqvae", "torch", "Train a sparse 3D VQ-VAE."),
    ("train mllm", "train_mllm:train_mllm", "mllm", "Fine-tune a Qwen3-VL on instruction data."),
    ("dataset build", "dataset_build:dataset_build", "torch", "Make instruction data for the model."),
    (
        "model import-trellis",
        "import_trellis:import_trellis",
        "torch",
        "Make a sparse 3D VQ-VAE of TRELLIS' weights.",
    ),
    ("model evaluate", "evaluate_model:evaluate_model", "torch", "Score a voxel model."),
    ("model shrink", "shrink_model:shrink_model", "torch", "Write a model in half precision, for shipping."),
    ("bench vqvae", "bench_vqvae:bench_vqvae", "torch", "Compare configurations of the sparse 3D VQ-VAE."),
    ("bench mllm", "bench_mllm:bench_mllm", "mllm", "Compare forms of voxel sequences."),
)


@hookimpl
def register_segmenters(register: Register) -> None:
    """Register `tokens` and `simart`."""
    from .segmenter import Simart
    from .tokens_segmenter import Tokens

    register(Tokens)
    register(Simart)


@hookimpl
def register_exporters(register: Register) -> None:
    """Register `simart-json`."""
    from .json_exporter import SimartJson

    register(SimartJson)


@hookimpl
def diagnose() -> list[Finding]:
    """What the weights and libraries of this plugin are like."""
    from .diagnosis import findings

    return findings()


@hookimpl
def register_commands(register: RegisterCommand) -> None:
    """Register `tokens`, what trains and compares models, and what is done with them."""
    for name, function, extra, help in _COMMANDS:
        register(name, f"{__name__}.commands.{function}", help, extra)
