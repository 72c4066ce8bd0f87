"""An answer of the model as values, in the units of the paper's JSON (its appendix, system prompt)."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import Literal, get_args

from simart_kit.errors import BadInputError

from ..tokens import VoxelTokens

PartType = Literal["fixed", "revolute", "prismatic", "free", "hinge"]
PART_TYPES: tuple[str, ...] = get_args(PartType)

CENTER_MAX = 200
"""Grid points along an edge of the object's cube, 0.005 of the edge apart."""
AXIS_MAX = 100
TURN_MAX = 200
"""Limits of turns; 100 is 180 degrees."""
SLIDE_MAX = 100
"""Limits of slides; 100 is the edge of the object's cube, its longest side."""
NAME_LENGTH = 48
NAME_PATTERN = re.compile(r"[A-Za-z0-9](?:[A-Za-z0-9 _\-]*[A-Za-z0-9])?")


@dataclass(frozen=True, slots=True)
class Motion:
    """How a part moves against its parent, in whole numbers.

    Attributes:
        center: (3,) point on the axis, grid points 0..200 of the object's cube.
        axis: (3,) direction, -100..100, the largest component 100 in size; None for a ball joint. The paper's
            own form has no negative numbers: an axis is written with its sign folded into the limits where
            no two components differ in sign.
        limits: (lower, upper) about the pose of the input, 100 for 180 degrees or for the cube's edge; None
            for a ball joint. A turn of (-100, 100) or more has no ends.
    """

    center: tuple[int, int, int]
    axis: tuple[int, int, int] | None = None
    limits: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class PartAnswer:
    """One part.

    Attributes:
        type: "hinge" with axis and limits is a turn, without them a ball joint (class D of PhysXNet).
        voxels: where it is; its cells are a subset of the object's.
        name: what it is called, letters, digits, blanks, - and _; the paper's example has none, ours may.
        parent: number of an earlier part; None for the first part, which is the root.
        motion: of revolute, prismatic and hinge parts; None for fixed and free ones.
        material: as the model says it, such as "Plastic"; "" where it says none.
        density: [g/cm^3]; None where it says none.
        youngs_modulus: [GPa]; None where it says none.
    """

    type: PartType
    voxels: VoxelTokens
    name: str = ""
    parent: int | None = None
    motion: Motion | None = None
    material: str = ""
    density: float | None = None
    youngs_modulus: float | None = None


@dataclass(frozen=True, slots=True)
class ObjectAnswer:
    """An object: the paper's object_captions, parts_captions and parts_voxels.

    Attributes:
        name: such as "Storage Box with Frame".
        scale: longest side [cm].
        parts: at least one; the first is the root, and parents come before their children.

    Raises:
        BadInputError: values that the JSON form cannot hold, naming the part.
    """

    name: str
    scale: float
    parts: tuple[PartAnswer, ...] = field(default=())

    def __post_init__(self) -> None:
        """Check what the grammar promises, for every way an answer can be made."""
        _check_name("object_captions: name", self.name)
        if not (math.isfinite(self.scale) and self.scale > 0):
            raise BadInputError(f"object_captions: scale {self.scale} must be a length above 0 [cm]")
        if not self.parts:
            raise BadInputError("parts_captions: there is no part")
        for number, part in enumerate(self.parts):
            _check_part(number, part)
            if part.voxels.grid != self.parts[0].voxels.grid:
                raise BadInputError(f"part {number}: its voxels are of another grid than those of part 0")


def _check_name(where: str, name: str) -> None:
    if name and (len(name) > NAME_LENGTH or not NAME_PATTERN.fullmatch(name)):
        raise BadInputError(
            f"{where} {name!r} must be 1 to {NAME_LENGTH} letters, digits, blanks, '-' and '_'"
        )


def _check_part(number: int, part: PartAnswer) -> None:
    where = f"part {number}"
    _check_name(f"{where}: name", part.name)
    if part.type not in PART_TYPES:
        raise BadInputError(f"{where}: type {part.type!r} is not one of {', '.join(PART_TYPES)}")
    if number == 0 and (part.parent is not None or part.type != "fixed"):
        raise BadInputError(f"{where}: the first part is the root, of type fixed and without parent")
    if number and (part.parent is None or not 0 <= part.parent < number):
        raise BadInputError(f"{where}: parent {part.parent} is not an earlier part, 0..{number - 1}")
    moves = part.type in ("revolute", "prismatic", "hinge")
    if moves != (part.motion is not None):
        said = "center, axis and limits are missing" if moves else f"a {part.type} part has no motion"
        raise BadInputError(f"{where}: {said}")
    if part.motion is not None:
        _check_motion(where, part.type, part.motion)
    _check_text(where, part)


def _check_motion(where: str, kind: str, motion: Motion) -> None:
    if not all(0 <= value <= CENTER_MAX for value in motion.center):
        raise BadInputError(f"{where}: center {motion.center} must be three of 0..{CENTER_MAX}")
    if (motion.axis is None) != (motion.limits is None) or (motion.axis is None and kind != "hinge"):
        raise BadInputError(f"{where}: a {kind} part needs both axis and limits")
    if motion.axis is None or motion.limits is None:
        return
    if not any(motion.axis) or not all(-AXIS_MAX <= value <= AXIS_MAX for value in motion.axis):
        raise BadInputError(
            f"{where}: axis {motion.axis} must be three of -{AXIS_MAX}..{AXIS_MAX}, not all 0"
        )
    largest = SLIDE_MAX if kind == "prismatic" else TURN_MAX
    lower, upper = motion.limits
    if not -largest <= lower <= upper <= largest:
        raise BadInputError(f"{where}: limits {motion.limits} must rise within -{largest}..{largest}")


def _check_text(where: str, part: PartAnswer) -> None:
    _check_name(f"{where}: material", part.material)
    for what, value in (("density", part.density), ("Young's modulus", part.youngs_modulus)):
        if value is not None and not (math.isfinite(value) and value > 0):
            raise BadInputError(f"{where}: {what} {value} must be above 0")
