"""OpenUSD for simulators: UsdPhysics bodies, joints and colliders, with UsdPreviewSurface looks."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field

from simart_kit import stages
from simart_kit.asset import Asset
from simart_kit.hookspecs import Register, hookimpl

from .gaps import gaps


class Usd(stages.Exporter):
    """One flat, self-contained USD layer with its textures beside it.

    Z up, metres, kilograms. Rigid bodies are flat siblings under the root prim, the layout that most
    simulators read; their frames are those of `simart_kit.kinematics`.
    """

    name = "usd"

    class Options(stages.Options):
        """Options of the USD exporter."""

        format: Literal["usda", "usdc"] = Field(
            "usda",
            description="usda is text that people can read and compare; usdc is binary, a quarter the size",
        )

    options: Options

    def export(self, asset: Asset, directory: Path) -> Path:
        """Write `NAME.usda` (or `.usdc`) and `textures/`; return the former."""
        from .stage import asset_stage

        path = directory / f"{asset.name}.{self.options.format}"
        stage = asset_stage(asset, directory)
        stage.GetRootLayer().Export(str(path))
        return path

    def unsupported(self, asset: Asset) -> tuple[str, ...]:
        """See `gaps`."""
        return gaps(asset)


@hookimpl
def register_exporters(register: Register) -> None:
    """Register the USD exporter."""
    register(Usd)
