"""What the paper's method needs, for `simart-kit doctor`; looked for without importing torch."""

from __future__ import annotations

from pathlib import Path

from simart_kit.extras import EXTRAS
from simart_kit.findings import Finding, library, weights

_CODEC = Path(__file__).parent / "weights" / "vq-nano"
_SPEAKER = Path(__file__).parent / "weights" / "mllm-tiny"


def findings() -> list[Finding]:
    """The libraries, the voxel model that comes with the package, and the extra of the language model."""
    again = "pip install --force-reinstall simart-kit, or train your own with `simart-kit train vqvae`"
    return [
        library("torch", extra="torch"),
        library("safetensors"),
        weights("weights of vq-nano", _CODEC, again),
        weights("weights of mllm-tiny", _SPEAKER, again, stages=()),
        *(library(name, extra="mllm", stages=("simart",)) for name in EXTRAS["mllm"] if name != "torch"),
    ]
