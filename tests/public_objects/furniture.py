"""What a catalogue of Sweet Home 3D says of a model: name, size, and how it is turned."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from simart_kit.arrays import FloatArray
from simart_kit.errors import BadInputError

_CATALOGUES = ("DefaultFurnitureCatalog.properties", "PluginFurnitureCatalog.properties")


@dataclass(frozen=True, eq=False)
class Catalogued:
    """A model's entry.

    Attributes:
        name: such as "Chest".
        turn: (3, 3) rotation that brings the model upright.
        size: (3,) width, height and depth [m]; None where it does not say.
        colors: (3,) by material, 0..255, of those that the program knows by itself.
    """

    name: str
    turn: FloatArray
    size: FloatArray | None
    colors: dict[str, FloatArray]

    def scale(self, extent: FloatArray) -> float:
        """Metres a unit, of a model with a (3,) extent in its unit."""
        return 1.0 if self.size is None else float(np.median(self.size / np.maximum(extent, 1e-9)))


def catalogued(path: Path) -> Catalogued:
    """The entry of a model in the catalogue around it; raises BadInputError when there is none."""
    catalogue = _catalogue_of(path)
    row = _row(catalogue, path)
    turn = np.array(row.get("modelRotation", "1 0 0 0 1 0 0 0 1").split(), dtype=np.float64).reshape(3, 3)
    size = (
        np.array([float(row[side]) for side in ("width", "height", "depth")]) / 100
        if "width" in row
        else None
    )
    return Catalogued(row.get("name", ""), turn, size, _built_in(catalogue))


def _catalogue_of(path: Path) -> Path:
    for folder in path.parents:
        for name in _CATALOGUES:
            if (folder / name).is_file():
                return folder / name
    raise BadInputError(f"{path}: there is no catalogue around it")


def _row(catalogue: Path, path: Path) -> dict[str, str]:
    """What the first entry of a catalogue with this model says, by key."""
    rows: dict[str, dict[str, str]] = {}
    for line in catalogue.read_text(encoding="latin-1").splitlines():
        found = re.match(r"(\w+)#(\d+)\s*=\s*(.*)", line.strip())
        if found:
            rows.setdefault(found[2], {})[found[1]] = found[3]
    for row in rows.values():
        if "model" in row and path.as_posix().endswith("/" + row["model"].lstrip("/")):
            return row
    raise BadInputError(f"{path}: {catalogue.name} does not have it")


def _built_in(catalogue: Path) -> dict[str, FloatArray]:
    """Colours of the materials that the program knows by itself: a constant of a class is an MTL file."""
    loader = catalogue.parent.parent / "j3d" / "OBJLoader.class"
    if not loader.is_file():
        return {}
    named = re.findall(rb"newmtl (\S+)\n(?:[^n][^\n]*\n)*?Kd ([\d. ]+)", loader.read_bytes())
    return {name.decode(): np.array(color.split(), float) * 255 for name, color in named}
