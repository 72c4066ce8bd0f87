"""Reads the paper's JSON strictly; every mistake is told in one line that says where it is."""

from __future__ import annotations

import re
from typing import cast

from simart_kit.arrays import IntArray
from simart_kit.errors import BadInputError

from ..token_parser import parse
from ..tokens import TokenGrid, VoxelTokens
from .json_text import fields, load, members_of, number_text, positive, shown, string, whole_numbers
from .values import NAME_LENGTH, PART_TYPES, Motion, ObjectAnswer, PartAnswer, PartType
from .writing import CAPTIONS, DENSITY_UNIT, MODULUS, OBJECT, VOXELS

_DENSITY_UNITS = (DENSITY_UNIT, "g/cm³", "g/cm3")
_MODULUS_UNITS = ("GPa",)
_MATTER = ("name", "material", "density", MODULUS)
# The paper lists "rigid" beside "fixed" and gives no difference.
_RIGID = "rigid"
# A cell takes some thirty characters in either form.
_MOST_OF_A_CELL = 64


def parse_answer(
    text: str, grid: TokenGrid, *, allowed: IntArray | None = None, source: str = "the answer"
) -> ObjectAnswer:
    """Read an answer to the URDF question.

    Keys may come in any order; unknown, missing and repeated ones are mistakes, and so is any text around
    the JSON. Type "rigid" is read as "fixed".

    Args:
        text: what the model wrote, voxels as decimals or by the names of atomic tokens.
        grid: of the tokens.
        allowed: (K,) indices of the input's cells: parts may name no others. None allows all.
        source: what the text is, for messages.

    Raises:
        BadInputError: the first mistake, such as "the answer: parts_captions 1: axis ...".
    """
    table = fields(source, load(text, source), (OBJECT, CAPTIONS, VOXELS))
    where = f"{source}: {OBJECT}"
    caption = fields(where, table[OBJECT], ("name", "scale"))
    name = string(f"{where}: name", caption["name"], NAME_LENGTH)
    scale = positive(f"{where}: scale", caption["scale"])
    captions = _numbered(f"{source}: {CAPTIONS}", table[CAPTIONS])
    voxels = _numbered(f"{source}: {VOXELS}", table[VOXELS])
    if len(captions) != len(voxels):
        raise BadInputError(f"{source}: {len(captions)} parts in {CAPTIONS}, {len(voxels)} in {VOXELS}")
    tokens = [
        _voxels(value, grid, allowed, f"{source}: {VOXELS} {number}") for number, value in enumerate(voxels)
    ]
    parts = [
        _part(f"{source}: {CAPTIONS} {number}", number, value, tokens[number])
        for number, value in enumerate(captions)
    ]
    try:
        return ObjectAnswer(name, scale, tuple(parts))
    except BadInputError as error:
        placed = re.sub(r"\Apart (?=[0-9])", f"{CAPTIONS} ", str(error))
        raise BadInputError(f"{source}: {placed}") from error


def parse_grounding(
    text: str, grid: TokenGrid, allowed: IntArray | None = None, source: str = "the answer"
) -> VoxelTokens:
    """Read an answer to the grounding question: voxels in either form, and nothing else.

    Args:
        text: what the model wrote; an empty text is no cell.
        grid: of the tokens.
        allowed: (K,) indices of the input's cells; None allows all.
        source: what the text is, for messages.

    Raises:
        BadInputError: the first mistake, with its position.
    """
    return _voxels(text, grid, allowed, source)


def _numbered(where: str, value: object) -> list[object]:
    """The members of an object whose keys are "0".."n-1", in that order."""
    members = members_of(where, value)
    if not members:
        raise BadInputError(f"{where}: there is no part")
    expected = [str(number) for number in range(len(members))]
    missing = next((key for key in expected if key not in members), None)
    if missing is not None:
        known = set(expected)
        stray = next(key for key in members if key not in known)
        raise BadInputError(f"{where}: key '{missing}' is missing, and there is a key {shown(stray)}")
    return [members[key] for key in expected]


def _part(where: str, number: int, value: object, voxels: VoxelTokens) -> PartAnswer:
    kind = _type(where, value)
    parent = ("parent",) if number else ()
    moves, required = _motion_keys(kind)
    caption = fields(where, value, ("type", *parent, *required), (*moves, *_MATTER))
    material, density, modulus = (caption.get(key) for key in ("material", "density", MODULUS))
    return PartAnswer(
        kind,
        voxels,
        string(f"{where}: name", caption.get("name", ""), NAME_LENGTH),
        _parent(f"{where}: parent", caption["parent"]) if parent else None,
        _motion(where, caption) if required else None,
        string(f"{where}: material", material, NAME_LENGTH) if "material" in caption else "",
        number_text(f"{where}: density", density, _DENSITY_UNITS) if "density" in caption else None,
        number_text(f"{where}: {MODULUS}", modulus, _MODULUS_UNITS) if MODULUS in caption else None,
    )


def _type(where: str, value: object) -> PartType:
    members = members_of(where, value)
    if "type" not in members:
        raise BadInputError(f"{where}: key 'type' is missing")
    kind = members["type"]
    if kind == _RIGID:
        return "fixed"
    if kind not in PART_TYPES:
        known = ", ".join((*PART_TYPES, _RIGID))
        raise BadInputError(f"{where}: type {shown(kind)} is not one of {known}")
    return cast("PartType", kind)


def _motion_keys(kind: PartType) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Keys that tell of motion: those that a part of the kind may have, and those that it must."""
    if kind == "hinge":
        return ("axis", "limits"), ("center",)
    return (), ("center", "axis", "limits") if kind in ("revolute", "prismatic") else ()


def _motion(where: str, caption: dict[str, object]) -> Motion:
    if ("axis" in caption) != ("limits" in caption):
        raise BadInputError(f"{where}: a hinge has both axis and limits, or is a ball joint with neither")
    x, y, z = whole_numbers(f"{where}: center", caption["center"], 3)
    if "axis" not in caption:
        return Motion((x, y, z))
    u, v, w = whole_numbers(f"{where}: axis", caption["axis"], 3)
    lower, upper = whole_numbers(f"{where}: limits", caption["limits"], 2)
    return Motion((x, y, z), (u, v, w), (lower, upper))


def _parent(where: str, value: object) -> int:
    """Number of a part, as the paper's text or as a number."""
    if isinstance(value, str) and re.fullmatch(r"0|[1-9][0-9]{0,8}", value):
        return int(value)
    if isinstance(value, int) and not isinstance(value, bool):
        return value
    raise BadInputError(f"{where}: {shown(value)} is no number of a part")


def _voxels(value: object, grid: TokenGrid, allowed: IntArray | None, source: str) -> VoxelTokens:
    text = string(source, value, _MOST_OF_A_CELL * grid.cells)
    return parse(text, grid, allowed=allowed, source=source)
