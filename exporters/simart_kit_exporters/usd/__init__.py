"""OpenUSD for simulators: UsdPhysics bodies, joints and colliders, with UsdPreviewSurface looks."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field

from simart_kit import stages
from simart_kit.asset import Asset
from simart_kit.findings import Finding, library
from simart_kit.hookspecs import Register, hookimpl

from .gaps import gaps


class Usd(stages.Exporter):
    """A self-contained folder that passes SimReady's profile `Robotics-Prop` and OpenUSD's validators.

    Z up, metres, kilograms. Rigid bodies are flat siblings under the root prim, the layout that most
    simulators read; their frames are those of `simart_kit.kinematics`. Textures and a thumbnail lie beside.
    """

    name = "usd"

    class Options(stages.Options):
        """Options of the USD exporter."""

        format: Literal["usda", "usdc"] = Field(
            "usda",
            description="usda is text that people can read and compare, with the arrays of its meshes in "
            "payloads/geometries.usdc; usdc is one binary file",
        )
        layers: bool = Field(
            False,
            description="write an interface file with payloads for geometry, materials and physics, and "
            "variants `Newton` and `MuJoCo` that load their own joint attributes; always usda",
        )
        thumbnail: bool = Field(
            True, description="write the picture that browsers of assets show, which SimReady demands"
        )
        author: str = Field("unknown", description="who made the object, for its metadata", min_length=1)
        license: str = Field("unknown", description="of the object, such as CC-BY-4.0", min_length=1)

    options: Options

    def export(self, asset: Asset, directory: Path) -> Path:
        """Write `NAME.usda` (or `.usdc`), `payloads/`, `textures/` and `.thumbs/`; return the first."""
        from .draft import new_draft
        from .metadata import layer_data, write_thumbnail
        from .saving import PAYLOADS, layers_of, save_flat, save_layered
        from .stage import write_asset

        options = self.options
        suffix = "usda" if options.layers else options.format
        path = directory / f"{asset.name}.{suffix}"
        draft = new_draft(asset.name, layers_of(options.format, options.layers))
        draft.layers["base"].customLayerData = layer_data(asset, options.author, options.license)
        write_asset(draft, asset, directory / PAYLOADS if options.layers else directory)
        (save_layered if options.layers else save_flat)(draft, path)
        if options.thumbnail:
            write_thumbnail(asset, path)
        return path

    def unsupported(self, asset: Asset) -> tuple[str, ...]:
        """See `gaps`."""
        return gaps(asset)


@hookimpl
def register_exporters(register: Register) -> None:
    """Register the USD exporter."""
    register(Usd)


@hookimpl
def diagnose() -> list[Finding]:
    """OpenUSD's libraries."""
    return [library("usd-core")]
