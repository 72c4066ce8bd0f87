"""USDZ: what phones, tablets and headsets show in AR, with the joints' motion baked in."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from simart_kit import stages
from simart_kit.asset import Asset
from simart_kit.findings import Finding, library
from simart_kit.hookspecs import Register, hookimpl

from .gaps import gaps
from .joints import write_joints
from .package import write_package


class Usdz(stages.Exporter):
    """One package for AR Quick Look and RealityKit, and `NAME.joints.json` for code that moves the parts.

    Y up, metres, surfaces alone: AR Quick Look refuses physics. The joints move one after the other, over
    and over, for ten seconds at most.
    """

    name = "usdz"

    def export(self, asset: Asset, directory: Path) -> Path:
        """Write `NAME.usdz` and `NAME.joints.json`; return the former."""
        from .stage import ar_stage

        path = directory / f"{asset.name}.usdz"
        with TemporaryDirectory(dir=directory) as folder:
            layer = Path(folder) / f"{asset.name}.usdc"
            stage = ar_stage(asset, layer.parent)
            stage.GetRootLayer().Export(str(layer))
            write_package(path, layer)
        write_joints(asset, directory)
        return path

    def unsupported(self, asset: Asset) -> tuple[str, ...]:
        """See `gaps`."""
        return gaps(asset)


@hookimpl
def register_exporters(register: Register) -> None:
    """Register the USDZ exporter."""
    register(Usdz)


@hookimpl
def diagnose() -> list[Finding]:
    """OpenUSD's libraries."""
    return [library("usd-core")]
