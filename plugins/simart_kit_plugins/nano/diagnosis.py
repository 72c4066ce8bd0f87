"""What nano needs, for `simart-kit doctor`; looked for without importing torch."""

from __future__ import annotations

from pathlib import Path

from simart_kit.findings import Finding, library, weights

_FOLDER = Path(__file__).parent / "model"  # as `weights.shipped_folder`, whose module imports torch


def findings() -> list[Finding]:
    """The libraries of the network, and the weights that come with the package."""
    again = "pip install --force-reinstall simart-kit, or train your own with `simart-kit train nano`"
    return [library("torch"), library("safetensors"), weights("weights of nano", _FOLDER, again)]
