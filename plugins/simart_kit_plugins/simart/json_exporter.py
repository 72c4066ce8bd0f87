"""Exporter `simart-json`: an asset in the words of the paper, as evidence beside it."""

from __future__ import annotations

from pathlib import Path

from pydantic import Field

from simart_kit import stages
from simart_kit.asset import Asset

from .default_model import default_model_folder, fingerprint, load_model


class SimartJson(stages.Exporter):
    """The paper's JSON: captions, joints in whole numbers, and voxel tokens of each part.

    It is what SIMART's language model is asked to write of the object, whoever found its parts and joints.
    """

    name = "simart-json"

    class Options(stages.Options):
        """Which codes."""

        model: str = Field(
            default="", description="Folder of the voxel model that gives the codes; empty: the shipped one."
        )

        def needed_extras(self) -> tuple[str, ...]:
            """That of the voxel model."""
            return ("torch",)

    options: Options

    def export(self, asset: Asset, directory: Path) -> Path:
        """Write and return `NAME.json`."""
        # Here and below, so that who only lists exporters does not wait for it.
        from .answer.writing import answer_text
        from .asset_answer import asset_answer

        answer = asset_answer(asset, load_model(self._folder).model)
        path = directory / f"{asset.name}.json"
        path.write_text(answer_text(answer, indent=2) + "\n", encoding="utf-8")
        return path

    def unsupported(self, asset: Asset) -> tuple[str, ...]:
        """See `gaps`."""
        from .answer_gaps import gaps

        return gaps(asset, fingerprint(self._folder))

    @property
    def _folder(self) -> Path:
        return Path(self.options.model) if self.options.model else default_model_folder()
