"""What nano needs, for `simart-kit doctor`; torch only trains it."""

from __future__ import annotations

from simart_kit.findings import Finding, library, weights

from .stored_model import shipped_folder


def findings() -> list[Finding]:
    """The library that reads the network, and the weights that come with the package."""
    again = "pip install --force-reinstall simart-kit, or train your own with `simart-kit train nano`"
    found = weights("weights of nano", shipped_folder(), again)
    return [library("safetensors"), found]
