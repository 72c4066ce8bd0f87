"""Writes an answer as the paper's JSON (its appendix, "Representative output")."""

from __future__ import annotations

import json
import re

from ..tokens import VoxelTokens
from .values import ObjectAnswer, PartAnswer

OBJECT, CAPTIONS, VOXELS = "object_captions", "parts_captions", "parts_voxels"
MODULUS = "Young's Modulus (GPa)"
DENSITY_UNIT = "g/cm^3"

_NUMBERS = re.compile(r"\[\s+(-?[0-9]+(?:,\s+-?[0-9]+)*)\s+\]")


def answer_text(answer: ObjectAnswer, *, atoms: bool = False, indent: int | None = None) -> str:
    """The JSON of an answer, which `parsing.parse_answer` reads.

    Keys are the paper's, and `name` of a part where it has one. The same answer gives the same text.

    Args:
        answer: what is written.
        atoms: write voxels by the names of atomic tokens, as a model does, not as the paper prints them.
        indent: blanks a level, lists of numbers on one line, as the paper prints it; None: no blanks at all.
    """
    table = {
        OBJECT: {"name": answer.name, "scale": float(answer.scale)},
        CAPTIONS: {str(number): _caption(part) for number, part in enumerate(answer.parts)},
        VOXELS: {str(n): grounding_text(part.voxels, atoms) for n, part in enumerate(answer.parts)},
    }
    if indent is None:
        return json.dumps(table, separators=(",", ":"))
    text = json.dumps(table, indent=indent)
    return _NUMBERS.sub(_on_one_line, text)


def grounding_text(tokens: VoxelTokens, atoms: bool = False) -> str:
    """Voxels as `<voxel> 43 1930 ...`, or by the names of atomic tokens."""
    return tokens.atoms() if atoms else tokens.text()


def _on_one_line(numbers: re.Match[str]) -> str:
    return "[" + ", ".join(numbers[1].replace(",", " ").split()) + "]"


def _caption(part: PartAnswer) -> dict[str, object]:
    table: dict[str, object] = {"name": part.name} if part.name else {}
    table["type"] = part.type
    if part.parent is not None:
        table["parent"] = str(part.parent)
    if part.motion is not None:
        table["center"] = list(part.motion.center)
        if part.motion.axis is not None and part.motion.limits is not None:
            table["axis"] = list(part.motion.axis)
            table["limits"] = list(part.motion.limits)
    if part.material:
        table["material"] = part.material
    if part.density is not None:
        table["density"] = f"{float(part.density)!r} {DENSITY_UNIT}"
    if part.youngs_modulus is not None:
        table[MODULUS] = float(part.youngs_modulus)
    return table
