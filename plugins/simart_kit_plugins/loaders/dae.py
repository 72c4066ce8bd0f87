"""The frame of a COLLADA file, which trimesh does not tell."""

from __future__ import annotations

import math
from xml.parsers import expat

from simart_kit import BadInputError
from simart_kit.mesh import UpAxis

UP_AXES: dict[str, UpAxis] = {"X_UP": "+x", "Y_UP": "+y", "Z_UP": "+z"}


def dae_frame(data: bytes) -> tuple[UpAxis, float]:
    """Up axis and metres a unit, by default Y and 1, as COLLADA has it.

    Raises:
        BadInputError: a DOCTYPE, which no exporter writes and entity bombs need.
    """
    found: dict[str, str] = {}
    parser = expat.ParserCreate(namespace_separator=" ")

    def refuse(*_: object) -> None:
        raise BadInputError("it has a DOCTYPE, which is refused: remove it")

    def start(tag: str, attributes: dict[str, str]) -> None:
        name = tag.rpartition(" ")[2]
        if name == "unit":
            found["unit"] = attributes.get("meter", "1")
        parser.CharacterDataHandler = keep if name == "up_axis" else None

    def keep(text: str) -> None:
        found["up"] = found.get("up", "") + text

    def end(tag: str) -> None:
        parser.CharacterDataHandler = None
        if tag.rpartition(" ")[2] == "asset":  # the first one is the document's
            parser.StartElementHandler = parser.EndElementHandler = None

    parser.StartDoctypeDeclHandler = refuse
    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.Parse(data, True)
    metres = float(found.get("unit", "1"))
    if not (math.isfinite(metres) and metres > 0):
        raise BadInputError(f"it says {metres} m a unit: correct its <unit>")
    return UP_AXES.get(found.get("up", "").strip(), "+y"), metres
