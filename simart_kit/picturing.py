"""`preview.png`, drawn by another process as soon as joints are known, while shapes are still being made."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from . import render
from .asset import Asset
from .beside import Beside, Later


@dataclass(frozen=True, eq=False)
class Picture:
    """A preview that is being drawn.

    Attributes:
        asset: that it shows.
        written: the file, once it is drawn.
    """

    asset: Asset
    written: Later[Path]

    def shows(self, asset: Asset) -> bool:
        """Whether it would be the same of another asset, in which shapes and masses may differ."""
        return self.asset.mesh is asset.mesh and _looks(self.asset) == _looks(asset)


def begun(asset: Asset, path: Path, beside: Beside) -> Picture:
    """The picture of an asset, drawn behind what the other process is asked for next."""
    return Picture(asset, beside.ask_behind(render.write_preview, asset.bare(), path))


def finished(picture: Picture | None, asset: Asset, path: Path, beside: Beside) -> Picture:
    """The picture that was begun, if it shows the asset, else one that does; it is drawn from now on."""
    shown = picture if picture is not None and picture.shows(asset) else begun(asset, path, beside)
    shown.written.begin()
    return shown


def _looks(asset: Asset) -> tuple[object, ...]:
    """What a picture shows besides the surface."""
    parts = tuple(part.name for part in asset.parts)
    return asset.name, parts, asset.face_part.tobytes(), asset.joints
