"""An answer as the texts that the grammar can write: what it cannot write is rounded."""

from __future__ import annotations

from dataclasses import dataclass

from simart_kit import materials
from simart_kit.errors import BadInputError

from ..answer.choices import material_of, material_text
from ..answer.values import Motion, ObjectAnswer, PartAnswer
from ..tokens import VoxelTokens

SCALE_DIGITS = (5, 1)
DENSITY_DIGITS = (2, 2)
YOUNGS_DIGITS = (4, 4)
"""Digits before and behind the point, of the longest side [cm], a density [g/cm^3] and a modulus [GPa]."""
MATERIALS = tuple(material_text(name) for name in materials.MATERIALS)
"""The rows of the material table as they are written."""


@dataclass(frozen=True, slots=True)
class PartText:
    """What is written of a part.

    Attributes:
        name: its name.
        type: its type.
        parent: number of its parent, "" of the root.
        center: three numbers where it moves.
        axis: three numbers, none for a ball joint.
        limits: two numbers, none for a ball joint.
        physics: texts of material, density and Young's modulus; None where nothing is said.
        voxels: where it is.
    """

    name: str
    type: str
    parent: str
    center: tuple[str, ...]
    axis: tuple[str, ...]
    limits: tuple[str, ...]
    physics: tuple[str | None, str | None, str | None]
    voxels: VoxelTokens


@dataclass(frozen=True, slots=True)
class ObjectText:
    """What is written of an object: its name, its longest side, and its parts."""

    name: str
    scale: str
    parts: tuple[PartText, ...]


def object_text(answer: ObjectAnswer, max_parts: int) -> ObjectText:
    """The texts of an answer.

    Numbers are rounded to the digits that the grammar has and kept above 0; several blanks in a row become
    one; limits are widened to hold the pose of the input, 0, and to differ; a material becomes the row of
    the material table that it means.

    Raises:
        BadInputError: there are more parts than `max_parts`, or a part has no voxels.
    """
    if len(answer.parts) > max_parts:
        raise BadInputError(
            f"the answer for '{answer.name}' has {len(answer.parts)} parts, but the grammar writes at most "
            f"{max_parts}: merge parts, or make the grammar with a larger max_parts"
        )
    parts = tuple(_part(number, part) for number, part in enumerate(answer.parts))
    return ObjectText(_name(answer.name), decimal_text(answer.scale, *SCALE_DIGITS), parts)


def decimal_text(value: float, before: int, after: int) -> str:
    """The nearest number above 0 with so many digits at most, in its shortest form: "40.0", "0.05"."""
    step = 10**-after
    kept = min(max(value, step), 10**before - step)
    head, _, tail = f"{kept:.{after}f}".partition(".")
    return f"{head}.{tail.rstrip('0') or '0'}"


def _part(number: int, part: PartAnswer) -> PartText:
    if not len(part.voxels.index):
        raise BadInputError(f"part {number} of the answer has no voxels: leave the part out")
    center, axis, limits = _motion(part.motion)
    return PartText(
        name=_name(part.name),
        type=part.type,
        parent="" if part.parent is None else str(part.parent),
        center=center,
        axis=axis,
        limits=limits,
        physics=_physics(part),
        voxels=part.voxels,
    )


def _motion(motion: Motion | None) -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
    """Texts of center, axis and limits."""
    if motion is None:
        return (), (), ()
    center = tuple(map(str, motion.center))
    if motion.axis is None or motion.limits is None:
        return center, (), ()
    lower, upper = min(motion.limits[0], 0), max(motion.limits[1], 0)
    if lower == upper:
        upper = 1
    return center, tuple(map(str, motion.axis)), (str(lower), str(upper))


def _physics(part: PartAnswer) -> tuple[str | None, str | None, str | None]:
    material = material_text(material_of(part.material, part.density)) if part.material else None
    density = None if part.density is None else decimal_text(part.density, *DENSITY_DIGITS)
    youngs = None if part.youngs_modulus is None else decimal_text(part.youngs_modulus, *YOUNGS_DIGITS)
    return material, density, youngs


def _name(name: str) -> str:
    return " ".join(name.split())
